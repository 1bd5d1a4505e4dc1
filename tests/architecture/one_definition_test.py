#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""No two headers define a type of one name in one namespace: in a program that has both, the linker takes either's members
for both, and no compiler says so. Usage: one_definition_test.py PROJECT"""

import os
import re
import sys

ROOMS = ("firmware", "sil", "training")
APART = ("firmware/ports/boards/",)  # an image has one board's
NAMESPACE = re.compile(r"^(?:inline )?namespace ([\w:]+) \{|^\}  // namespace ([\w:]+)")
TYPE = re.compile(r"^(?:class|struct|union|enum class|enum) (\w+)(?: final)?(?: :[^;]*)? \{")


def definitions(text):
    """Types at the outermost level of namespaces, as full names."""
    inside = []
    for line in text.splitlines():
        if parts := NAMESPACE.match(line):
            if parts[1]:
                inside.append(parts[1])
            elif inside:
                inside.pop()
        elif (parts := TYPE.match(line)) and inside:
            yield "::".join([*inside, parts[1]])


def headers(project):
    for room in ROOMS:
        for folder, _, names in os.walk(os.path.join(project, room)):
            for name in names:
                path = os.path.relpath(os.path.join(folder, name), project)
                if name.endswith(".hpp") and not path.startswith(APART):
                    yield path


def twice(texts):
    places = {}
    for path, text in sorted(texts.items()):
        for name in definitions(text):
            places.setdefault(name, set()).add(path)
    return {name: sorted(paths) for name, paths in places.items() if len(paths) > 1}


def sees_what_it_looks_for():
    one = "namespace a::b {\nnamespace c {\nstruct One {\n};\n}  // namespace c\nclass Two final : public X {\n};\nstruct Three;\n}  // namespace a::b\n"
    other = "namespace a::b {\nenum class Two : int {\n};\nstruct One {\n};\nstruct Three {\n};\n}  // namespace a::b\n"
    return twice({"one": one, "other": other}) == {"a::b::Two": ["one", "other"]}


def main():
    project = sys.argv[1]
    texts = {}
    for path in headers(project):
        with open(os.path.join(project, path), encoding="utf-8") as text:
            texts[path] = text.read()
    found = twice(texts)
    for name, paths in found.items():
        print(f"{name} is defined in {' and '.join(paths)}: give one another name")
    types = sum(len(list(definitions(text))) for text in texts.values())
    print(f"{types} types in {len(texts)} headers")
    sys.exit(0 if not found and types > 300 and sees_what_it_looks_for() else 1)


if __name__ == "__main__":
    main()
