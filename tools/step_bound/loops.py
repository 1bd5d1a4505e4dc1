# SPDX-License-Identifier: Apache-2.0
"""A function's natural loops. A loop with two entries, as GCC's cross-jumping makes them, gets one where the other entry is a
few instructions: outside the loop a copy of them runs. What stays irreducible is listed as `retreating` edges."""

import networkx

MOST_COPIED = 3


class Loop:
    def __init__(self, head):
        self.head, self.body, self.latches = head, set(), []  # latches: blocks with an edge back to the head

    def exits(self, function):
        return [(start, target) for start in self.body for target, _ in function.blocks[start].successors
                if target not in self.body]


def graph_of(function):
    graph = networkx.DiGraph()
    graph.add_nodes_from(function.blocks)
    graph.add_edges_from((block.start, target) for block in function.blocks.values()
                         for target, _ in block.successors if target is not None)
    return graph


def find_loops(function):
    _find(function)
    if function.retreating and _split_entries(function):
        _find(function)
    function.irreducible = _edges_back(function) if function.retreating else []


def _find(function):
    graph = graph_of(function)
    function.predecessors = {start: list(graph.predecessors(start)) for start in function.blocks}
    function.order = list(networkx.dfs_postorder_nodes(graph, function.start))[::-1]
    position = {start: i for i, start in enumerate(function.order)}
    above = networkx.immediate_dominators(graph, function.start)
    loops, function.retreating = {}, []
    for source, target in graph.edges:
        if position[target] > position[source]:
            continue
        if not _dominates(above, target, source):
            function.retreating.append((source, target))
            continue
        loop = loops.setdefault(target, Loop(target))
        loop.latches.append(source)
        loop.body |= _body(function, target, source)
    function.loops = sorted(loops.values(), key=lambda loop: position[loop.head])
    function.innermost = {}
    for start in function.order:
        around = [loop for loop in function.loops if start in loop.body]
        function.innermost[start] = min(around, key=lambda loop: len(loop.body)) if around else None


def _dominates(above, one, other):
    while other != one:
        if above[other] == other:
            return False
        other = above[other]
    return True


def _body(function, head, latch):
    body, todo = {head, latch}, [latch] if latch != head else []
    while todo:
        for before in function.predecessors[todo.pop()]:
            if before not in body:
                body.add(before)
                todo.append(before)
    return body


def _edges_back(function):
    """[(irreducible part, edges)], by address: the one edge that every way around takes, and no way in; else those that go back."""
    graph, found = graph_of(function), []
    graph.remove_edges_from([(latch, loop.head) for loop in function.loops for latch in loop.latches])
    for part in sorted((part for part in networkx.strongly_connected_components(graph) if len(part) > 1), key=min):
        within = graph.subgraph(part)
        closing = [edge for edge in sorted(within.edges) if part.issuperset(graph.predecessors(edge[1])) and
                   networkx.is_directed_acyclic_graph(networkx.restricted_view(within, [], [edge]))]
        found.append((part, closing[-1:] or [edge for edge in function.retreating if part.issuperset(edge)]))
    return found


def _split_entries(function):
    graph, changed = graph_of(function), False
    todo = [part for part in networkx.strongly_connected_components(graph) if len(part) > 1]
    while todo:
        part = todo.pop()
        entries = [b for b in part if b == function.start or any(p not in part for p in graph.predecessors(b))]
        if len(entries) == 2:
            small, head = sorted(entries, key=lambda b: (len(function.blocks[b].instructions), b))
            changed = _copy_entry(function, small, head, part) or changed
        if len(entries) == 1:
            inner = graph.subgraph(part - set(entries))
            todo += [p for p in networkx.strongly_connected_components(inner) if len(p) > 1]
    return changed


def _copy_entry(function, small, head, part):
    """Whoever enters by `small` from outside runs a copy of it, at an odd address."""
    block = function.blocks[small]
    if len(block.instructions) > MOST_COPIED or block.callee is not None or [t for t, _ in block.successors] != [head]:
        return False
    twin = type(block)(small | 1, block.instructions, list(block.successors), after=block.after)
    for other in function.blocks.values():
        if other.start not in part:
            other.successors = [(twin.start if t == small else t, kind) for t, kind in other.successors]
    function.blocks[twin.start] = twin
    return True
