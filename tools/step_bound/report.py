# SPDX-License-Identifier: Apache-2.0
"""The bounds of an image as text and as JSON."""

from .cycles import TABLES
from .refusal import Refusal

FRAMES_A_TICK = (1, 8, 24, 32)
SHOWN_FUNCTIONS = 25
TICK_US = 1_000


def measure(analysis, path, cpu, frames):
    """Everything there is to say of an image, for JSON."""
    bound = analysis.bound(frames)
    report = {"image": path, "cpu": cpu, "frames": frames, "delayed_commands": analysis.late, **analysis.summary(),
              "instructions": bound.total, "is_whole": bound.is_whole,
              "by_frames": {str(n): analysis.bound(n).total for n in FRAMES_A_TICK},
              "worst_path": [{"instructions": cost, "calls": calls, "function": name}
                             for cost, calls, name in analysis.worst_path(bound)],
              "facts": {fact.name: fact.proved_by for fact in bound.facts if fact.name in bound.used_facts or fact.kind == "word"}}
    if cpu is None:
        report["no_cycles"] = "the processor is not named: --cpu"
    else:
        try:
            report["cycles"] = analysis.bound(frames, cpu).total
            report["cycles_by"] = TABLES[cpu]
        except Refusal as refusal:
            report["no_cycles"] = str(refusal)
    return report


def add_time(report, analysis, arguments):
    """The step's share of a tick, where every fetch and every access to memory waits."""
    if "cycles" not in report:
        return
    waits = arguments.wait_states and arguments.wait_states * analysis.accesses(report["frames"])
    cycles = report["cycles"] + waits
    us = cycles / arguments.clock_mhz
    report["time"] = {"clock_mhz": arguments.clock_mhz, "wait_states": arguments.wait_states, "cycles": cycles, "us": us,
                      "share_of_tick": us / TICK_US}


def show(report):
    print(f"{report['image']}: {report['root']}, up to {report['frames']} frames a tick")
    print(f"  {report['functions']} functions, {report['loops']} loops, {report['contexts']} calling contexts; two decoders agree on "
          f"{report['decoded_twice']:,} instructions, {report['decoded_once']:,} are known to objdump alone")
    print(f"  proved: at most {report['instructions']:,} instructions"
          + ("" if report["is_whole"] else " (the relaxation's bound: a longest path is not named)"))
    if "cycles" in report:
        print(f"  proved: at most {report['cycles']:,} cycles at zero wait states, by Arm {report['cycles_by']}")
    else:
        print(f"  no cycles: {report['no_cycles']}")
    if "time" in report:
        time = report["time"]
        print(f"  at {time['clock_mhz']:g} MHz with {time['wait_states']} wait states for every fetch and access: {time['cycles']:,} "
              f"cycles, {time['us']:.1f} us, {time['share_of_tick']:.1%} of a tick, without caches and interrupts")
    print("  by frames a tick: " + ", ".join(f"{n}: {total:,}" for n, total in report["by_frames"].items()))
    print("  the worst path, by function:\n      instructions  calls")
    for row in report["worst_path"][:SHOWN_FUNCTIONS]:
        print(f"    {row['instructions']:12,} {row['calls']:6,}  {row['function']}")
    rest = report["worst_path"][SHOWN_FUNCTIONS:]
    if rest:
        print(f"    {sum(row['instructions'] for row in rest):12,}         in {len(rest)} others")
    print("  by the facts: " + ", ".join(f"{name} ({proof})" for name, proof in report["facts"].items()))
