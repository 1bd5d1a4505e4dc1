# SPDX-License-Identifier: Apache-2.0
"""A linear program over whole numbers, maximised by GLPK.

First its relaxation: that is an upper bound already, and mostly whole. Where it is not, a search for the whole optimum gets a minute;
what it does not finish keeps the relaxation's bound.
"""

import math

import swiglpk as glpk

from .refusal import Refusal

SEARCH_MS = 60_000  # the answer must not depend on how busy the machine is: none took a second so far on a quiet one
NEAR = 1e-6


class LinearProgram:
    def __init__(self):
        self.costs, self.rows = [], []

    def variable(self):
        self.costs.append(0)
        return len(self.costs) - 1

    def row(self, terms, most, equal=False):
        """The sum of the terms, (factor, variable), is at most `most`, or equal to it."""
        merged = {}
        for factor, variable in terms:
            merged[variable] = merged.get(variable, 0) + factor
        self.rows.append(({v: f for v, f in merged.items() if f}, most, equal))

    def maximum(self):
        """(the bound, the variables' values there, whether they are whole)."""
        problem = self._problem()
        try:
            self._relaxed(problem)
            bound = math.floor(glpk.glp_get_obj_val(problem) + NEAR)
            values = [glpk.glp_get_col_prim(problem, i + 1) for i in range(len(self.costs))]
            if all(abs(value - round(value)) < NEAR for value in values):
                return self._whole([round(value) for value in values], bound), True
            if self._searched(problem):
                values = [round(glpk.glp_mip_col_val(problem, i + 1)) for i in range(len(self.costs))]
                return self._whole(values, round(glpk.glp_mip_obj_val(problem))), True
            return (bound, values), False
        finally:
            glpk.glp_delete_prob(problem)

    @staticmethod
    def _relaxed(problem):
        parameters = glpk.glp_smcp()
        glpk.glp_init_smcp(parameters)
        parameters.msg_lev = glpk.GLP_MSG_OFF
        glpk.glp_term_out(glpk.GLP_OFF)
        glpk.glp_adv_basis(problem, 0)
        if glpk.glp_simplex(problem, parameters) or glpk.glp_get_status(problem) != glpk.GLP_OPT:
            raise Refusal("the linear program has no greatest value: a loop without a bound, or facts that exclude each other")

    @staticmethod
    def _searched(problem):
        parameters = glpk.glp_iocp()
        glpk.glp_init_iocp(parameters)
        parameters.msg_lev, parameters.tm_lim = glpk.GLP_MSG_OFF, SEARCH_MS
        return glpk.glp_intopt(problem, parameters) == 0 and glpk.glp_mip_status(problem) == glpk.GLP_OPT

    def _whole(self, values, bound):
        """GLPK computes in floating point: a whole answer is held to every row in integers."""
        for terms, most, equal in self.rows:
            total = sum(factor * values[variable] for variable, factor in terms.items())
            if total > most or equal and total != most:
                raise Refusal("GLPK's answer does not keep to the program, in integers")
        if bound != sum(cost * value for cost, value in zip(self.costs, values)):
            raise Refusal("GLPK's answer has another cost, in integers")
        return bound, values

    def _problem(self):
        problem = glpk.glp_create_prob()
        glpk.glp_set_obj_dir(problem, glpk.GLP_MAX)
        glpk.glp_add_cols(problem, len(self.costs))
        for i, cost in enumerate(self.costs):
            glpk.glp_set_col_bnds(problem, i + 1, glpk.GLP_LO, 0, 0)
            glpk.glp_set_col_kind(problem, i + 1, glpk.GLP_IV)
            glpk.glp_set_obj_coef(problem, i + 1, cost)
        glpk.glp_add_rows(problem, len(self.rows))
        entries = [(i + 1, v + 1, f) for i, (terms, _, _) in enumerate(self.rows) for v, f in terms.items()]
        for i, (_, most, equal) in enumerate(self.rows):
            glpk.glp_set_row_bnds(problem, i + 1, glpk.GLP_FX if equal else glpk.GLP_UP, most, most)
        rows, columns, factors = glpk.intArray(len(entries) + 1), glpk.intArray(len(entries) + 1), glpk.doubleArray(len(entries) + 1)
        for at, (row, column, factor) in enumerate(entries):
            rows[at + 1], columns[at + 1], factors[at + 1] = row, column, factor
        glpk.glp_load_matrix(problem, len(entries), rows, columns, factors)
        return problem
