# SPDX-License-Identifier: Apache-2.0
"""Follows what really ran through the graph that a bound was proved on. Every difference is a contradiction: an edge that is not there
or was held infeasible, a loop that turns too often, a fact that does not hold, a call that is longer than its bound."""

import functools
from collections import Counter
from typing import NamedTuple

from step_bound.functions import plain_name


class Contradiction(Exception):
    """The code does not do what the analysis says."""


class Place(NamedTuple):
    """In the middle of a block: `index` instructions of it have run. The calls that led here are the context."""
    context: tuple
    block: int
    index: int


class Walker:
    """Edges of single calls of the root. An edge is (context, block or None for the entry, successor or None for the return)."""

    def __init__(self, bound, root):
        self.program, self.findings, self.root = bound.program, bound.findings, root
        self.steps = {}     # (place, instructions that ran) -> (edges, place after them or None after the end)
        self.call_sites = {}
        for context in self.findings.contexts:
            if context:
                caller = self.function(context[:-1])
                self.call_sites[context] = next(b for b in caller.blocks.values() if b.callee is not None and b.last.address == context[-1])

    def function(self, context):
        return self.program.functions[self.findings.contexts[context]]

    def calls(self, blocks):
        """(instructions, edges) of each call of the root."""
        place, edges, count = None, Counter(), 0
        for block in blocks:
            if place is None:
                if block[0] != self.root:
                    continue
                place = Place((), self.root, 0)
                edges, count = Counter({((), None, self.root): 1}), 0
            key = (place, block)
            if key not in self.steps:
                self.steps[key] = self._follow(place, block)
            taken, place, ran = self.steps[key]
            edges.update(taken)
            count += ran
            if place is None:
                yield count, edges

    def _follow(self, place, addresses):
        taken = []
        for ran, address in enumerate(addresses):
            place = self._advance(place, address, taken)
            if place is None:
                return taken, None, ran
        block = self.function(place.context).blocks[place.block]
        if place.index == len(block.instructions) and not place.context and block.callee is None and \
                [target for target, _ in block.successors] == [None]:
            taken.append(((), place.block, None))  # the root's return: what follows it is not traced
            return taken, None, len(addresses)
        return taken, place, len(addresses)

    def _advance(self, place, address, taken):
        block = self.function(place.context).blocks[place.block]
        if place.index < len(block.instructions):
            if block.instructions[place.index].address != address:
                raise Contradiction(f"{address:#x} ran where the graph has {block.instructions[place.index]}")
            return place._replace(index=place.index + 1)
        if block.callee is not None and address == block.callee:
            below = place.context + (block.last.address,)
            if below not in self.findings.contexts:
                raise Contradiction(f"a call that was held infeasible: {block.last}")
            taken.append((below, None, address))
            return Place(below, address, 1)
        following = [target for target, _ in block.successors if target is not None and target & ~1 == address]
        if following and block.callee is None:
            taken.append((place.context, block.start, following[0]))
            return Place(place.context, following[0], 1)
        if any(target is None for target, _ in block.successors):
            return self._return(place, address, taken)
        raise Contradiction(f"{address:#x} ran after {block.last}")

    def _return(self, place, address, taken):
        context, block = place.context, place.block
        taken.append((context, block, None))
        while context:
            site = self.call_sites[context]
            context = context[:-1]
            if site.is_tail_call:
                taken.append((context, site.start, None))
                continue
            if site.last.next != address:
                raise Contradiction(f"a return to {address:#x}, not behind {site.last}")
            taken.append((context, site.start, address))
            return Place(context, address, 1)
        return None


class Checker:
    """Holds calls of the root to a bound."""

    def __init__(self, bound):
        self.bound, self.findings = bound, bound.findings
        self.feasible = {(context, source, target) for context, source, target, _ in bound.findings.feasible}
        self.seen, self.most_turns, self.longest, self.longest_edges, self.count = set(), {}, 0, None, 0
        self.attained = set()  # names of facts: with a number that is one less they would be contradictions

    def check(self, instructions, edges):
        self.count += 1
        if instructions > self.bound.total:
            raise Contradiction(f"a call took {instructions:,} instructions, more than {self.bound.total:,}")
        for edge in edges.keys() - self.seen:
            if edge[1] is not None and edge not in self.feasible:
                raise Contradiction(f"an edge that was held infeasible: {edge[1]:#x} to {edge[2] and hex(edge[2])}")
        self.seen |= edges.keys()
        calls = {context: n for (context, source, _), n in edges.items() if source is None}
        self._check_facts(calls)
        for context in calls:
            self._check_loops(context, edges, calls[context])
        self._check_shared_turns(edges, calls)
        self._check_turns_together(edges, calls)
        if instructions > self.longest:
            self.longest, self.longest_edges = instructions, dict(edges)

    def _turns_all(self, context, head, turns, edges, calls):
        function = self.function(context)
        loop = next(loop for loop in function.loops if loop.head == head)
        back, entering = self._turned(context, function, loop, edges, calls[context])
        return back == turns * entering > 0

    def _check_facts(self, calls):
        for fact in self.bound.facts:
            if fact.kind == "calls":
                found = [n * self._covers(fact, context) for context, n in calls.items()]
                total = max(found) if fact.contexts else sum(found)
                allowed = fact.at_most + self._allowance(fact, calls)
                if total == allowed and total:
                    self.attained.add(fact.name)
                if total > allowed:
                    raise Contradiction(f"the fact {fact.name}: {total} calls, not {fact.at_most}")

    def _allowance(self, fact, calls):
        return sum(n * self._allows(fact, context) for context, n in calls.items()) if fact.plus else 0

    @functools.cache
    def _covers(self, fact, context):
        return fact.covers(self.bound.chain(context))

    @functools.cache
    def _allows(self, fact, context):
        return fact.allows_more(self.bound.chain(context))

    def _check_loops(self, context, edges, calls):
        function = self.function(context)
        for loop in function.loops:
            turns = self.bound.turns.get((context, loop.head))
            back, entering = self._turned(context, function, loop, edges, calls)
            if turns is None or not back:
                continue
            if back > turns * entering:
                raise Contradiction(f"{function.name}: the loop at {loop.head:#x} turned {back} times in {entering} entries, not {turns}")
            self.most_turns[(context, loop.head)] = max(self.most_turns.get((context, loop.head), 0), -(-back // entering))
        for part, (_, edges_back) in enumerate(function.irreducible):
            back = sum(edges.get((context, source, target), 0) for source, target in edges_back)
            if back and back == self.bound.backs[(context, part)] * calls:
                self.attained.update(fact.name for fact in self.bound.facts_of("back", context))
            if back > self.bound.backs[(context, part)] * calls:
                chain = " > ".join(map(plain_name, self.bound.chain(context)))
                raise Contradiction(f"{chain} went back {back} times in {calls} calls, in its irreducible part {part}")

    def _check_shared_turns(self, edges, calls):
        """Of a loop that a fact with a `plus` is for, in all contexts together."""
        for (fact, head), contexts in self.bound.shared_turns.items():
            beyond = -self._allowance(fact, calls)
            for context, turns in contexts:
                function = self.function(context)
                loop = next(loop for loop in function.loops if loop.head == head)
                back, entering = self._turned(context, function, loop, edges, calls.get(context, 0))
                beyond += back - turns * entering
            if beyond == 0 and any(calls.get(context) for context, _ in contexts):
                self.attained.add(fact.name)
            if beyond > 0:
                raise Contradiction(f"the fact {fact.name}: {beyond} turns too many")

    def _check_turns_together(self, edges, calls):
        for (fact, context), loops in self.bound.turns_together.items():
            called, function, heads = calls.get(context, 0), self.function(context), {head for head, _ in loops}
            turned = sum(self._turned(context, function, loop, edges, called)[0] for loop in function.loops if loop.head in heads)
            if turned == fact.at_most * called > 0:
                self.attained.add(fact.name)
            if turned > fact.at_most * called:
                raise Contradiction(f"the fact {fact.name}: {turned} turns in {called} calls, not {fact.at_most} each")

    @staticmethod
    def _turned(context, function, loop, edges, calls):
        """(times back, times entered)."""
        back = sum(edges.get((context, latch, loop.head), 0) for latch in loop.latches)
        entering = sum(edges.get((context, source, loop.head), 0) for source in function.predecessors[loop.head]
                       if source not in loop.body)
        return back, entering + (calls if loop.head == function.start else 0)

    def function(self, context):
        return self.bound.program.functions[self.findings.contexts[context]]
