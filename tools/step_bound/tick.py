# SPDX-License-Identifier: Apache-2.0
"""The whole tick of a controller's image, its interrupts apart, how long both take together, and the way from a picture to the torque.

Response-time analysis (Joseph and Pandya, 1986; Audsley et al., 1993): the tick is the lowest of all priorities, so that every interrupt that
may come while it runs is added to it. How often one comes is known by its name, or told: --every NAME=US."""

import json
import math
import os
import subprocess
import tempfile

from . import analysis
from .analysis import TURN
from .cycles import TABLES
from .refusal import Refusal

TICK_US = 1_000
EVERY_US = {"tick_interrupt": 1_000, "can1_reception": 47}  # the timer's period; the shortest frame's 47 bits at 1 Mbit/s
FAULTS = ("reset", "exception")

# Cycles until a handler's first instruction, at zero wait states, and as many for the return: Arm's latencies (Cortex-M0+ TRM DDI 0484C, M3 DDI
# 0337I, M4 DDI 0439D). Eight words are stored, and loaded again, beside the vector and the code's first words.
ABANDONED_CYCLES = 12  # of a division or a long load, which begins again after the interrupt
ENTRY_CYCLES = {"cortex-m0plus": 15, "cortex-m3": 12, "cortex-m4": 12}
EXCEPTION_ACCESSES = 2 * 8 + 4
LETTER_US = 10  # of a serial port at 1 Mbaud


def handlers(image):
    """The functions of the vector table, faults left out; none where the processor has no such table, as a Cortex-R that polls."""
    if not image.has_vectors:
        return []
    found = [(address, size) for name, address, size in image.sized_objects if name.endswith("7vectorsE")]
    if len(found) != 1:
        raise Refusal(f"{image.path}: {len(found)} tables of interrupts called 'vectors', but one was expected")
    names, handled = {address: name for name, address, _ in image.functions}, set()
    for at in range(found[0][0] + 4, sum(found[0]), 4):
        word = image.constant(at)
        if word is None or word & ~1 not in names:
            raise Refusal(f"{image.path}: the interrupt at {at:#x} leads to no function that is known")
        handled.add(names[word & ~1])
    return sorted(handled.difference(FAULTS))


class Part:
    """A root's bound. `interrupt`: with what the hardware does before and after it."""

    def __init__(self, found, frames, cpu, interrupt=False):
        self.bound = found.bound(frames)
        self.instructions = self.bound.total
        self.cycles = self.accesses = None
        if cpu in TABLES:
            self.cycles = found.bound(frames, cpu).total + (2 * ENTRY_CYCLES[cpu] + ABANDONED_CYCLES if interrupt else 0)
            self.accesses = found.accesses(frames) + (EXCEPTION_ACCESSES if interrupt else 0)

    def us(self, arguments):
        return (self.cycles + arguments.wait_states * self.accesses) / arguments.clock_mhz


def response_us(own_us, interrupts):
    """The longest that `own_us` takes, with interrupts (period, cost) in between."""
    if sum(cost / period for period, cost in interrupts) >= 1:
        raise Refusal("the interrupts alone take more time than there is")
    whole = own_us
    while True:
        longer = own_us + sum(math.ceil(whole / period) * cost for period, cost in interrupts)
        if longer <= whole + 1e-9:
            return whole
        whole = longer


def periods(names, told):
    strangers = sorted(set(told).difference(names))
    if strangers:
        raise Refusal(f"--every {strangers[0]}: the image has no such interrupt; it has {', '.join(names) or 'none'}")
    every = {**EVERY_US, **told}
    unknown = [name for name in names if name not in every]
    if unknown:
        raise Refusal(f"how often {unknown[0]} comes is not known: --every {unknown[0]}=MICROSECONDS")
    return {name: every[name] for name in names}


def measure(path, cpu, arguments):
    """Everything of one image, for JSON."""
    late = analysis.delays_commands(path)
    found = analysis.Analysis(path, TURN, late, arguments.facts, arguments.missed)
    tick = Part(found, arguments.frames, cpu)
    facts = {fact.name: fact.proved_by for fact in tick.bound.facts if fact.name in tick.bound.used_facts or fact.kind == "word"}
    names = handlers(found.program.image)
    every = periods(names, arguments.every)
    parts = {name: Part(analysis.Analysis(path, f"^{name}$", late, arguments.facts), arguments.frames, cpu, True) for name in names}
    report = {"image": path, "cpu": cpu, "frames": arguments.frames, "missed": arguments.missed, **found.summary(),
              "instructions": tick.instructions, "is_whole": tick.bound.is_whole, "cycles": tick.cycles,
              "interrupts": {name: {"instructions": part.instructions, "cycles": part.cycles, "every_us": every[name]}
                             for name, part in parts.items()},
              "letters": round(sum(tick.bound.calls(context) for context, start in found.findings.contexts.items()
                                   if "put_in_time" in found.program.functions[start].name)),
              "assumed": {fact.name: fact.because for fact in tick.bound.facts
                          if fact.proved_by == "assumed" and fact.name in tick.bound.used_facts},
              "facts": facts,
              "worst_path": [{"instructions": cost, "calls": calls, "function": name}
                             for cost, calls, name in found.worst_path(tick.bound)]}
    if arguments.clock_mhz is not None and tick.cycles is not None:
        own_us = tick.us(arguments)
        response = response_us(own_us, [(every[name], part.us(arguments)) for name, part in parts.items()])
        report["time"] = {"clock_mhz": arguments.clock_mhz, "wait_states": arguments.wait_states, "own_us": own_us,
                          "interrupts_us": {name: part.us(arguments) for name, part in parts.items()}, "response_us": response,
                          "share_of_tick": response / TICK_US}
        if not report["letters"] and response <= TICK_US:
            report["way"] = way_of_a_picture(response, arguments.bus_budget)
    return report


def way_of_a_picture(response, program):
    """[(what, us, how it is known)], from the camera's hand-over of a picture to the torque command at the drives."""
    if not os.path.exists(program):
        return None
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "budget.json")
        # Its status tells missed deadlines: they are in the file, too.
        done = subprocess.run([program, "--lateness-us", "0", "--step-us", str(math.ceil(response)), "--json", path], capture_output=True,
                              text=True, check=False)
        if not os.path.exists(path):
            raise Refusal(f"{program}: {done.stderr.strip()}")
        with open(path, encoding="utf-8") as file:
            budget = json.load(file)
    decision = budget["decision"]
    rows = [("the picture's two frames on the bus", decision["picture_us"], "proved: bus budget"),
            ("it has just missed a tick", decision["phase_us"], "proved: the timer's period"),
            ("the tick, a poll before it and interrupts in it", math.ceil(response), "proved: step-bound"),
            ("the torque command's frame on the bus", decision["command_us"], "proved: bus budget")]
    return {"rows": rows, "total_us": sum(us for _, us, _ in rows), "missed_deadlines": budget["missed"]}


def show(report):
    print(f"{report['image']}: a whole tick, up to {report['frames']} frames in it, {report['missed']} ticks missed before it")
    print(f"  {report['functions']} functions, {report['loops']} loops, {report['contexts']} calling contexts")
    cycles = f", {report['cycles']:,} cycles at zero wait states" if report["cycles"] is not None else ""
    print(f"  proved: at most {report['instructions']:,} instructions{cycles}, interrupts apart")
    if report["cycles"] is None:
        print("  no cycles: " + (f"Arm publishes no table of instruction timings for {report['cpu']}" if report["cpu"] else "the processor is not named: --cpu"))
    for name, part in report["interrupts"].items():
        cycles = f", {part['cycles']:,} cycles with entry and return" if part["cycles"] is not None else ""
        print(f"  interrupt {name}: at most {part['instructions']:,} instructions{cycles}, every {part['every_us']:g} us at most")
    for name, because in report["assumed"].items():
        print(f"  assumed: {name}: {' '.join(because.split())}")
    if report["letters"]:
        print(f"  waits for the serial port, apart: {report['letters']} letters on that path, {LETTER_US} us each at 1 Mbaud: "
              f"{LETTER_US * report['letters']:,} us")
    if "time" in report:
        _show_time(report)
    rows = [f"{row['function']} {row['instructions']:,} ({row['calls']:,} calls)" for row in report["worst_path"][:8]]
    print("  the worst path: " + ", ".join(rows))


def _show_time(report):
    time = report["time"]
    print(f"  at {time['clock_mhz']:g} MHz with {time['wait_states']} wait states for every fetch and access, without caches:")
    print(f"    the tick by itself {time['own_us']:8.1f} us")
    for name, us in time["interrupts_us"].items():
        print(f"    {name:18} {us:8.1f} us, each time")
    print(f"    the tick's response{time['response_us']:8.1f} us, {time['share_of_tick']:.1%} of a tick"
          + ("" if time["share_of_tick"] <= 1 else ": it does not fit, and no-tick-was-missed does not hold"))
    if "way" in report and report["way"] is None:
        print("  the way from a picture to the torque command takes a program that knows the bus: build striker-bus-budget, or name it with --bus-budget")
    elif way := report.get("way"):
        print("  from a picture to the torque command:")
        for what, us, known in way["rows"]:
            print(f"    {us:8.0f} us  {what} ({known})")
        print(f"    {way['total_us']:8.0f} us  at most, all of it proved; what a simulator measured is in sil/budget")
        if way["missed_deadlines"]:
            print("    with such a tick these miss their deadline on the bus: " + ", ".join(way["missed_deadlines"]))
