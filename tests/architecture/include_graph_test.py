#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The rooms and their arrows: reads every #include of the sources and holds who may include whom, that no circle is
among rooms or files, that includes name the owner, that no room is crowded, and that each file names its
licence. Then it adds each kind of violation to
a copy and requires that it is noticed."""

import argparse
import collections
import os
import re
import sys
import tempfile

SOURCES = (".cpp", ".hpp", ".h", ".c")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
MOST_LINES = 330
MOST_SOURCES = 16
LICENCE = "SPDX-License-Identifier: Apache-2.0"

# A room and what it may include besides itself. A room is the longest of these names that a path begins with.
ARROWS = {
    "firmware/policy": [],
    "firmware/core": ["firmware/policy"],
    "firmware/can": ["firmware/core"],
    "firmware/safety": ["firmware/can"],
    "firmware/loop": ["firmware/can", "firmware/core", "firmware/policy", "firmware/safety"],
    "firmware/host": ["firmware/can", "firmware/core"],
    "firmware/ports/bare_metal": ["firmware/loop", "firmware/can", "firmware/core"],
    "firmware/ports/boards": ["firmware/ports/bare_metal"],
    "firmware/ports/linux": ["firmware/host", "firmware/loop", "firmware/can", "firmware/core"],
    "firmware/programs": ["firmware/ports/linux", "firmware/host", "firmware/loop", "firmware/can", "firmware/core",
                          "firmware/policy"],
    "firmware/examples": ["firmware/loop", "firmware/can", "firmware/core", "firmware/policy"],
    "sil/world": ["firmware/core"],
    "sil/task": ["sil/world", "firmware/core", "firmware/host", "firmware/policy"],
    "sil/bus": ["firmware/can", "firmware/core", "firmware/host", "firmware/loop"],
    "sil/robot": ["sil/bus", "sil/world", "firmware/can", "firmware/core", "firmware/host", "firmware/loop"],
    "sil/robot/description": ["sil/world", "firmware/core", "firmware/can", "firmware/host"],
    "sil/fault": ["sil/record", "sil/bus", "sil/robot", "sil/world", "firmware/can", "firmware/core", "firmware/host",
                  "firmware/policy"],
    "sil/record": ["sil/robot", "sil/bus", "sil/task", "sil/world", "firmware/can", "firmware/core", "firmware/host",
                   "firmware/loop", "firmware/policy"],
    "sil/scenario": ["sil/fault", "sil/record", "sil/robot", "sil/bus", "sil/task", "sil/world", "firmware/can",
                     "firmware/core", "firmware/host", "firmware/loop"],
    "sil/match/referee": ["sil/world", "firmware/core"],
    "sil/match/team": ["sil/match/referee", "sil/world", "firmware/host"],
    "sil/match/record": ["sil/match/team", "sil/match/referee", "sil/world", "firmware/core", "firmware/host"],
    "sil/match/play": ["sil/match/record", "sil/match/team", "sil/match/referee", "sil/fault", "sil/record", "sil/robot",
                       "sil/bus",
                       "sil/scenario", "sil/world", "firmware/can", "firmware/core", "firmware/host", "firmware/loop"],
    "sil/match/replay": ["sil/match/play", "sil/match/record", "sil/match/team", "sil/match/referee", "sil/record",
                         "sil/robot", "sil/bus", "sil/world", "firmware/can", "firmware/core", "firmware/host"],
    "sil/match/league": ["sil/match/play", "sil/match/record", "sil/match/team", "sil/match/referee", "sil/scenario",
                         "sil/task", "firmware/host"],
    "sil/view": ["sil/match/record", "sil/match/referee", "sil/scenario", "sil/fault", "sil/record", "sil/bus", "sil/world",
                 "firmware/can", "firmware/host", "firmware/loop", "firmware/policy"],
    "sil/view/web": ["sil/view"],
    "sil/policy": ["firmware/can", "firmware/core", "firmware/host", "firmware/loop", "firmware/policy"],
    "sil/budget": ["sil/bus", "firmware/can", "firmware/core", "firmware/host", "firmware/loop"],
    "sil/programs": ["sil", "firmware/host", "firmware/can", "firmware/core", "firmware/loop", "firmware/policy"],
    "training/task": ["sil/world", "sil/task", "firmware/core", "firmware/policy"],
    "training/learner": ["training/task", "sil/world", "sil/task"],
    "training/model": ["training/learner", "firmware/host"],
    "training/line": ["training/task", "sil/task", "sil/world"],
    "training/search": ["training/line", "training/task", "sil/task"],
    "training/rollout": ["training/search", "training/line", "training/learner", "training/task", "sil/task", "sil/world"],
    "training/run": ["training/rollout", "training/line", "training/learner", "training/model", "training/task",
                     "sil/task", "sil/world", "firmware/core", "firmware/host"],
    "training/export": ["training/run", "training/learner", "training/model", "training/task", "sil/task", "sil/world",
                        "firmware/host", "firmware/policy"],
    "training/experiment": ["training/run", "training/learner", "training/model", "training/task", "sil/task",
                            "sil/world", "firmware/host"],
    "training/ceiling": ["training/run", "training/search", "training/line", "training/learner", "training/task", "sil/task", "sil/world",
                         "firmware/core", "firmware/host"],
    "training/plane": ["training/export", "training/line", "training/learner", "training/task", "sil/task", "sil/world"],
    "training/programs": ["training", "sil/robot/description", "sil/task", "sil/world", "firmware/core", "firmware/host"],
    "training/python": ["training", "sil/robot/description", "sil/match", "sil/task", "sil/world", "firmware/core"],
    "training/benchmarks": ["training", "sil/task", "sil/world"],
    "tests": ["firmware", "sil", "training"],
}

GENERATED = {"paper_toml.hpp"}  # by the build


def sources_of(root):
    for top in ("firmware", "sil", "training", "tests"):
        for folder, folders, files in os.walk(os.path.join(root, top)):
            folders[:] = [name for name in folders if not name.startswith(".")]
            for name in files:
                if name.endswith(SOURCES):
                    yield os.path.relpath(os.path.join(folder, name), root)


def scripts_of(root):
    for top in ("tools", "tests", "training", "firmware"):
        for folder, _, files in os.walk(os.path.join(root, top)):
            for name in files:
                if name.endswith(".py") or (top == "tools" and "." not in name):
                    yield os.path.relpath(os.path.join(folder, name), root)


def room_of(path):
    rooms = [room for room in ARROWS if path.startswith(room + "/")]
    return max(rooms, key=len) if rooms else None


def may_include(room, target):
    return target == room or any(target == allowed or target.startswith(allowed + "/") for allowed in ARROWS[room])


def includes_of(root, path, problems):
    """The included files of the tree, as paths from its root."""
    with open(os.path.join(root, path), encoding="utf-8") as text:
        for include in INCLUDE.findall(text.read()):
            beside = os.path.normpath(os.path.join(os.path.dirname(path), include))
            if os.path.exists(os.path.join(root, include)):
                yield include
            elif path.startswith("firmware/examples/") and os.path.exists(os.path.join(root, beside)):
                yield beside  # a project of its own
            elif os.path.basename(include) not in GENERATED:
                problems.append(f"{path}: \"{include}\" does not name a file from the project's root")


def circle_in(graph):
    """A circle of the graph as a list of nodes, or nothing."""
    done, on_way = set(), []

    def visit(node):
        if node in on_way:
            return on_way[on_way.index(node):] + [node]
        if node in done:
            return None
        on_way.append(node)
        found = next((circle for circle in map(visit, sorted(graph[node])) if circle), None)
        on_way.pop()
        done.add(node)
        return found

    return next((circle for circle in map(visit, sorted(graph)) if circle), None)


def crowds(root, paths):
    folders = collections.Counter(os.path.dirname(path) for path in paths)
    for folder, count in sorted(folders.items()):
        if count > MOST_SOURCES:
            yield f"{folder}: {count} sources at one level, more than {MOST_SOURCES}"
    for path in [*paths, *scripts_of(root)]:
        if path.startswith("firmware/policy/exported/"):
            continue  # generated
        with open(os.path.join(root, path), encoding="utf-8") as text:
            content = text.read()
        lines = content.count("\n")
        if not any(LICENCE in line for line in content.split("\n", 2)[:2]):
            yield f"{path}: its first lines do not say {LICENCE}"
        if lines > MOST_LINES:
            yield f"{path}: {lines} lines, more than {MOST_LINES}"


def problems_of(root):
    problems = []
    files = collections.defaultdict(set)
    rooms = collections.defaultdict(set)
    paths = sorted(sources_of(root))
    for path in paths:
        room = room_of(path)
        if room is None:
            problems.append(f"{path}: in no room that this test knows")
            continue
        for target in includes_of(root, path, problems):
            files[path].add(target)
            target_room = room_of(target)
            if target_room is None:
                continue
            if target_room != room:
                rooms[room].add(target_room)
            if not may_include(room, target_room):
                problems.append(f"{path}: includes {target}, but {room} may not include {target_room}")
    for name, graph in (("files", files), ("rooms", rooms)):
        closed = collections.defaultdict(set, {key: set(value) for key, value in graph.items()})
        for targets in list(graph.values()):
            for target in targets:
                closed[target]  # a node of its own, even if it includes nothing
        circle = circle_in(closed)
        if circle:
            problems.append(f"a circle of {name}: {' -> '.join(circle)}")
    problems.extend(crowds(root, paths))
    return problems


# A file, what is put in its first line, and what has to be said.
VIOLATIONS = (
    ("firmware/core/supervision/supervisor.cpp", '#include "firmware/can/messages.hpp"', "may not include firmware/can"),
    ("firmware/can/receiver.cpp", '#include "firmware/loop/tick.hpp"', "may not include firmware/loop"),
    ("firmware/loop/built_in_node.cpp", '#include "tests/policy/synthetic_policy.hpp"', "may not include tests"),
    ("sil/robot/plant.cpp", '#include "firmware/ports/linux/real_time.hpp"', "may not include firmware/ports/linux"),
    ("sil/match/referee/referee.cpp", '#include "sil/bus/stamped_frame.hpp"', "may not include sil/bus"),
    ("training/learner/dqn.cpp", '#include "training/run/config.hpp"', "may not include training/run"),
    ("firmware/core/state.hpp", '#include "firmware/core/supervision/supervisor.hpp"', "a circle of files"),
    ("firmware/core/supervision/supervisor.cpp", '#include "supervisor.hpp"', "does not name a file"),
    ("firmware/core/supervision/supervisor.cpp", "\n" * MOST_LINES, "lines, more than"),
    ("firmware/core/supervision/supervisor.cpp", "\n", "its first lines do not say"),
)


def copy_sources(root, to):
    for path in sources_of(root):
        target = os.path.join(to, path)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(os.path.join(root, path), encoding="utf-8") as text, open(target, "w", encoding="utf-8") as copy:
            copy.write(text.read())


def is_noticed(root, before, path, line, said):
    with tempfile.TemporaryDirectory() as copy:
        copy_sources(root, copy)
        with open(os.path.join(copy, path), encoding="utf-8") as text:
            sound = text.read()
        with open(os.path.join(copy, path), "w", encoding="utf-8") as text:
            text.write(line + "\n" + sound)
        return any(said in problem for problem in problems_of(copy) if problem not in before)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sources", help="the project's root")
    arguments = parser.parse_args()
    problems = problems_of(arguments.sources)
    for problem in problems:
        print(problem)
    unnoticed = [violation for violation in VIOLATIONS if not is_noticed(arguments.sources, problems, *violation)]
    for path, line, said in unnoticed:
        print(f"NOT NOTICED: {line.strip() or 'blank lines'} in {path} ({said})")
    print(f"{len(problems)} problems; {len(VIOLATIONS) - len(unnoticed)} of {len(VIOLATIONS)} violations noticed")
    sys.exit(1 if problems or unnoticed else 0)


if __name__ == "__main__":
    main()
