# SPDX-License-Identifier: Apache-2.0
"""An image's analysis, once, and the bounds that it gives."""

import os
import re

from . import abstract_execution
from .bound import Bound
from .cycles import ARCHITECTURES, TABLES, Cycles, memory_words
from .facts import is_named, read_facts
from .functions import Program, plain_name, short_name
from .image import Image
from .refusal import Refusal

FACTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "facts.toml")
STEP = r"loop::GatedNode<.*>::step\("
TURN = r"loop::TickLoop<.*>::turn\("
OF_OBJECTS = (STEP, TURN)  # whose arguments are objects
WEIGHTS = r"WeightsCheck.*layer_words"
PASS_TICKS = 500  # firmware/policy/weights_check.hpp


def delays_commands(image):
    """Of the robot that the image was built for, as its build folder says; without one, as if it did."""
    header = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(image))), "firmware", "built_in_robot.hpp")
    try:
        with open(header, encoding="utf-8") as file:
            return re.search(r"command_delay_ms = \{0\}", file.read()) is None
    except OSError:
        return True


def accesses_of(block):
    return sum(1 + memory_words(insn) for insn in block.instructions)


class Analysis:
    """Of one image, for a robot whose commands are `late`, or act at once."""

    def __init__(self, path, root=STEP, late=True, facts=FACTS, missed=0):
        self.program = Program(Image(path))
        self.root = self.program.find(root)
        self.reachable = self.program.reachable(self.root)
        self.late, self.facts, self.missed = late, facts, missed
        words = [(fact.chains[0][0][0], "r0", fact.offset, fact.at_most) for fact in self.facts_for(0) if fact.kind == "word"]
        # A clone that GCC made may be given their members instead.
        are_objects = root in OF_OBJECTS and "[clone" not in self.program.symbols[self.root][0]
        self.findings = abstract_execution.run(self.program, self.root, words, are_objects)

    def facts_for(self, frames):
        parameters = {"frames": frames, "missed": self.missed, "acts_at_once": int(not self.late), "weights_slice": self._weights_slice()}
        is_slow = self.program.image.architecture in ARCHITECTURES["cortex-m0plus"]  # with the nRF51's FIFO
        parameters |= {"letters_of_a_poll": 24 if is_slow else 8, "lines_of_a_poll": 4 if is_slow else 2}
        names = [self.program.symbols[start][0] for start in self.reachable]
        return [fact for fact in read_facts(self.facts, parameters)
                if not fact.image_with or any(is_named(name, fact.image_with) for name in names)]

    def _weights_slice(self):
        """WeightsCheck::words_a_tick, from the words that the image says it has."""
        address = self.program.image.object(WEIGHTS)
        words = sum(self.program.image.constant(address + 4 * layer) for layer in range(3)) if address is not None else 0
        return (words + PASS_TICKS - 4) // (PASS_TICKS - 3)

    def bound(self, frames=24, cpu=None):
        """In instructions, or in cycles of `cpu`."""
        read = self.facts_for(frames)
        if cpu is None:
            return Bound(self.program, self.root, self.findings, read)
        if cpu not in TABLES:
            raise Refusal(f"Arm publishes no table of instruction timings for {cpu}")
        if self.program.image.architecture not in ARCHITECTURES[cpu]:
            raise Refusal(f"the image is for {self.program.image.architecture}, and {cpu} has {' or '.join(ARCHITECTURES[cpu])}")
        cycles = Cycles(cpu)
        return Bound(self.program, self.root, self.findings, read, cycles.block, cycles.edge)

    def accesses(self, frames):
        """Fetches and accesses to memory, of a word or less each, that a step makes at most."""
        return Bound(self.program, self.root, self.findings, self.facts_for(frames), accesses_of).total

    def worst_path(self, bound):
        """[(cost, calls, function)] of the path that the bound is for, the costliest first."""
        total = {}
        for context, start in self.findings.contexts.items():
            function = self.program.functions[start]
            name = plain_name(function.name)
            cost, calls = total.get(name, (0, 0))
            for block in function.blocks.values():
                cost += bound.runs(context, block.start) * bound.block_cost(block)
            total[name] = cost, calls + bound.calls(context)
        return sorted(((round(cost), round(calls), name) for name, (cost, calls) in total.items() if cost), reverse=True)

    def summary(self):
        second = self.program.second
        return {"root": short_name(self.program.symbols[self.root][0]), "functions": len(self.reachable),
                "loops": sum(len(self.program.functions[start].loops) for start in self.reachable),
                "contexts": len(self.findings.contexts), "decoded_twice": second.agreed, "decoded_once": second.unknown}
