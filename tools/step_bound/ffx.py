# SPDX-License-Identifier: Apache-2.0
"""The flow facts of an image for OTAWA (http://www.otawa.fr), in its XML form FFX: what its flow-fact loader documents ("Flow Fact XML format",
src/prog/util_FlowFactLoader.cpp): `noreturn`, `multibranch`, and `function`, `call`, `loop` nested as the calls are.

`maxcount` is how often a loop goes back at most for one entry; `totalcount`, where a fact knows that alone, how often in all. Facts about calls that hold for
several contexts together have no element there: the file names them in a comment, and a bound without them is no smaller."""

from xml.etree import ElementTree
from xml.sax.saxutils import escape

from .bound import Bound
from .functions import plain_name


def write(found, frames):
    """The file's text. `found` is an image's Analysis."""
    bound = found.bound(frames)
    root = ElementTree.Element("flowfacts")
    for start in sorted(found.reachable):
        _branches(root, found.program.functions[start])
    for start in sorted(start for start in found.reachable if _never_returns(found, start)):
        _element(root, "noreturn", start, plain_name(found.program.functions[start].name))
    top = _element(root, "function", found.root, plain_name(found.program.functions[found.root].name))
    totals = _totals(found, bound, frames)
    _content(found, bound, totals, (), top)
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n<!-- {_told(found, bound)} -->\n{text}\n'


def _told(found, bound):
    left_out = [fact.name for fact in bound.facts if fact.kind == "calls" and fact.name in bound.used_facts]
    irreducible = [plain_name(found.program.functions[start].name) for start in found.reachable if found.program.functions[start].irreducible]
    text = (f"by tools/step-bound: {bound.total} instructions at most with all its facts; not in this file: {', '.join(left_out)}; "
            f"irreducible, without a bound here: {', '.join(irreducible) or 'none'}")
    return escape(text).replace("--", "- -")


def _element(parent, tag, address, comment=None):
    if comment:
        parent.append(ElementTree.Comment(" " + comment.replace("--", "- -") + " "))
    return ElementTree.SubElement(parent, tag, address=f"{address:#x}")


def _branches(root, function):
    for block in function.blocks.values():
        targets = sorted({target for target, kind in block.successors if kind == "table"})
        if targets:
            branch = _element(root, "multibranch", block.last.address)
            for target in targets:
                _element(branch, "target", target)


def _never_returns(found, start):
    """In no context."""
    contexts = [context for context, function in found.findings.contexts.items() if function == start]
    left = {context for context, _, target, _ in found.findings.feasible if target is None}
    return bool(contexts) and not any(context in left for context in contexts)


def _totals(found, bound, frames):
    """(fact, head) -> how often the loops that a fact bounds in all contexts together go back at most."""
    totals = {}
    for (_, head), contexts in bound.shared_turns.items():
        function = found.program.functions[found.findings.contexts[contexts[0][0]]]
        latches = set(next(loop for loop in function.loops if loop.head == head).latches)
        kinds = {(start, kind) for start in latches for target, kind in function.blocks[start].successors if target == head}
        most = Bound(found.program, found.root, found.findings, found.facts_for(frames), lambda block: 0,
                     lambda block, kind, ways=kinds: int((block.start, kind) in ways)).total
        for context, _ in contexts:
            totals[(context, head)] = most
    return totals


def _content(found, bound, totals, context, parent):
    """Whether there was any."""
    function = found.program.functions[found.findings.contexts[context]]
    for loop in function.loops:
        turns, total = bound.turns.get((context, loop.head)), totals.get((context, loop.head))
        if turns is not None or total is not None:
            element = _element(parent, "loop", loop.head & ~1)
            for name, value in (("maxcount", turns), ("totalcount", total)):
                if value is not None:
                    element.set(name, str(value))
    for block in sorted(function.blocks.values(), key=lambda block: block.start):
        below = context + (block.last.address,)
        if block.callee is None or below not in found.findings.contexts:
            continue
        call = _element(parent, "call", block.last.address)
        callee = _element(call, "function", block.callee, plain_name(found.program.functions[block.callee].name))
        if not _content(found, bound, totals, below, callee):
            parent.remove(call)
    return any(child.tag is not ElementTree.Comment for child in parent)
