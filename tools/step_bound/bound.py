# SPDX-License-Identifier: Apache-2.0
"""The bound: the most that one call of the root can cost, over every path that the control flow, the loops' bounds and the facts
allow, in all contexts at once (implicit path enumeration: Li and Malik, 1995)."""

from .facts import matches
from .functions import plain_name
from .linear_program import LinearProgram
from .refusal import Refusal


def instructions(block):
    return len(block.instructions)


def turns_of(bodies, function, loop):
    """The body runs once before each turn back where a test stands at each of its ends; where one stands elsewhere, before the first too."""
    tests = {source for source, _ in loop.exits(function)}
    return bodies - (1 if tests == set(loop.latches) else 0)


class Bound:
    """`block_cost(block)`; `edge_cost(block, kind)` where a taken branch costs more."""

    def __init__(self, program, root, findings, facts, block_cost=instructions, edge_cost=None):
        self.program, self.findings, self.facts = program, findings, facts
        self.block_cost, self.edge_cost = block_cost, edge_cost
        self.lp = LinearProgram()
        self.edges = {}    # (context, block, successor, kind) -> variable
        self.entries = {}  # context -> variable: how often it is called
        self.into = {}     # (context, block) -> variables: how often it runs
        self.turns = {}    # (context, head): how often a loop turns back at most for one entry
        self.shared_turns = {}  # (fact with a `plus`, head) -> [(context, turns for one entry)]: in all contexts together
        self.loop_facts = []    # (fact without one, context, head, turns for one entry)
        self.fact_heads = {}    # (fact, context) -> the loops that it is for
        self.backs = {}    # (context, irreducible part): how often it goes back at most in one call
        self.used_facts, self.unbounded = set(), []
        self.turns_together = {}  # (fact, context) -> [(head, the variables of what goes back to it)]
        self._shared_rows = {}
        self._add_context((), root, None)
        self._add_call_facts()
        for (fact, context), loops in self.turns_together.items():
            self.lp.row([(1, v) for _, back in loops for v in back] + [(-fact.at_most, self.entries[context])], 0)
        for (fact, _), rows in self._shared_rows.items():
            self.lp.row(rows + self._allowance(fact), 0)
        if self.unbounded:
            raise Refusal("no bound, and no fact: " + "; ".join(sorted(set(self.unbounded))))
        (self.total, self.values), self.is_whole = self.lp.maximum()

    def chain(self, context):
        return [self.program.functions[self.findings.contexts[context[:i]]].name for i in range(len(context) + 1)]

    def runs(self, context, block):
        return sum(self.values[variable] for variable in self.into.get((context, block), ()))

    def calls(self, context):
        return self.values[self.entries[context]]

    # ---- the program --------------------------------------------------------------------------------------------------------
    def _add_context(self, context, start, calling):
        """`calling`: the variables whose sum is the number of calls; None for the root, which is called once."""
        function = self.program.functions[start]
        entry = self.entries[context] = self.lp.variable()
        self.lp.row([(1, entry)] + [(-1, v) for v in calling or ()], 1 if calling is None else 0, equal=True)
        into = {start: [] for start in function.blocks}
        out = {start: [] for start in function.blocks}
        into[function.start].append(entry)
        for block in function.blocks.values():
            for target, kind in block.successors:
                self._add_edge((context, block.start, target, kind), block, into, out)
        for block in function.blocks.values():
            if into[block.start]:
                self._add_block(context, block, into[block.start], out[block.start])
        for loop in function.loops:
            self._bound_loop(context, function, loop)
        if function.irreducible:
            self._bound_irreducible(context, function)

    def _add_edge(self, edge, block, into, out):
        if edge not in self.findings.feasible:
            return
        variable = self.edges[edge] = self.lp.variable()
        _, source, target, kind = edge
        out[source].append(variable)
        if target is not None:
            into[target].append(variable)
        if self.edge_cost is not None:
            self.lp.costs[variable] += self.edge_cost(block, kind)

    def _add_block(self, context, block, into, out):
        self.into[(context, block.start)] = into
        self.lp.row([(1, v) for v in into] + [(-1, v) for v in out], 0, equal=True)
        cost = self.block_cost(block)
        for variable in into:
            self.lp.costs[variable] += cost
        if block.callee is not None:
            below = context + (block.last.address,)
            if below in self.findings.contexts:
                self._add_context(below, block.callee, into)

    def _variables(self, context, function, sources, target):
        return [self.edges[edge] for source in sources for successor, kind in function.blocks[source].successors
                if successor == target and (edge := (context, source, target, kind)) in self.edges]

    # ---- loops --------------------------------------------------------------------------------------------------------------
    def _bound_loop(self, context, function, loop):
        entering = self._variables(context, function, [p for p in function.predecessors[loop.head] if p not in loop.body], loop.head)
        entering += [self.entries[context]] if loop.head == function.start else []
        back = self._variables(context, function, set(loop.latches), loop.head)
        if not entering or not back:
            return
        turns = self.findings.turns.get((context, loop.head))
        if not any(edge in self.edges for edge in self._exits(context, function, loop)):
            self.lp.row([(1, v) for v in back], 0)  # it is never left: no call that returns runs it
            return
        if turns is None:
            self._bound_by_facts(context, function, loop, back, entering)
            return
        self._bound_turns(context, loop, turns, back, entering)
        for edge, passes in self.findings.passes.get((context, loop.head), {}).items():
            variable = self.edges.get((context, *edge))
            if variable is not None and passes is not None and passes < self._implied_passes(context, function, loop, edge[0]):
                self.lp.row([(1, variable)] + [(-passes, v) for v in entering], 0)

    @staticmethod
    def _exits(context, function, loop):
        return [(context, start, target, kind) for start in loop.body for target, kind in function.blocks[start].successors
                if target not in loop.body]

    def _bound_turns(self, context, loop, turns, back, entering):
        self.turns[(context, loop.head)] = turns
        self.lp.row([(1, v) for v in back] + [(-turns, v) for v in entering], 0)

    def _bound_by_facts(self, context, function, loop, back, entering):
        facts, together = self.facts_of("loop", context), self.facts_of("turns", context)
        for fact in together:
            self._bound_turns(context, loop, fact.at_most, back, entering)
            self.turns_together.setdefault((fact, context), []).append((loop.head, back))
        if not facts and not together:
            called_by = plain_name(self.chain(context[:-1])[-1]) if context else "nobody"
            self.unbounded.append(f"{plain_name(function.name)}, called by {called_by}: the loop at {loop.head:#x}")
        for fact in facts:
            heads = self.fact_heads.setdefault((fact, context), set())
            heads.add(loop.head)
            if len(heads) > fact.loops:
                raise Refusal(f"the fact [{fact.name}] is for {fact.loops} of {plain_name(function.name)}'s loops, but there are {len(heads)}: the last at {loop.head:#x}")
            turns = turns_of(fact.at_most, function, loop)
            if not fact.plus:
                self.loop_facts.append((fact, context, loop.head, turns))
                self._bound_turns(context, loop, min(turns, self.turns.get((context, loop.head), turns)), back, entering)
                continue
            self.shared_turns.setdefault((fact, loop.head), []).append((context, turns))
            self._shared_rows.setdefault((fact, loop.head), []).extend([(1, v) for v in back] + [(-turns, v) for v in entering])

    def _implied_passes(self, context, function, loop, block):
        """What the turns of the loops allow by themselves, of `loop` and of those within it around the block."""
        product = 1
        for inner in function.loops:
            if block in inner.body and inner.body <= loop.body:
                product *= (self.findings.turns.get((context, inner.head)) or 0) + 1
        return product

    def _bound_irreducible(self, context, function):
        facts = self.facts_of("back", context)
        if not facts:
            self.unbounded.append(f"{function.name}: an irreducible loop at {function.irreducible[0][1][0][1]:#x}")
        for number, (part, edges) in enumerate(function.irreducible if facts else []):
            most = self.backs[(context, number)] = min(fact.back_of(number, len(function.irreducible)) for fact in facts)
            back = [v for source, target in edges for v in self._variables(context, function, [source], target)]
            entering = [v for target in part for v in self._variables(
                context, function, [p for p in function.predecessors[target] if p not in part], target)]
            entering += [self.entries[context]] if function.start in part else []
            for ways in (entering, [self.entries[context]]):  # a circle that nothing enters does not turn
                self.lp.row([(1, v) for v in back] + [(-most, v) for v in ways], 0)

    # ---- facts --------------------------------------------------------------------------------------------------------------
    def facts_of(self, kind, context):
        found = [fact for fact in self.facts if fact.kind == kind and fact.covers(self.chain(context))]
        self.used_facts.update(fact.name for fact in found)
        return found

    def _add_call_facts(self):
        for fact in self.facts:
            if fact.kind != "calls":
                continue
            meant = [(weight, variable) for context, variable in self.entries.items() if (weight := fact.covers(self.chain(context)))]
            if meant:
                self.used_facts.add(fact.name)
                self._require_what_it_names(fact, meant)
                for row in [[one] for one in meant] if fact.contexts else [meant]:
                    self.lp.row(row + self._allowance(fact), fact.at_most)

    def _require_what_it_names(self, fact, meant):
        """A compiler that inlines what allows more would make the fact false, and one that merges calls would share its number."""
        chains = [self.chain(context) for context in self.entries]
        if any(not any(matches(pattern, chain) for chain in chains) for pattern in fact.plus):
            raise Refusal(f"the fact [{fact.name}] allows more for calls that are not there")
        if fact.contexts and len(meant) != fact.contexts:
            raise Refusal(f"the fact [{fact.name}] is for {fact.contexts} calling contexts, but there are {len(meant)}")

    def _allowance(self, fact):
        return [(-more, variable) for context, variable in self.entries.items() if (more := fact.allows_more(self.chain(context)))]
