#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tools/mutate makes the mutants that it says and knows its lists; tools/fuzz and tools/coverage refuse wrong use.
What they find is theirs to say: nothing is built here.
Usage: assurance_test.py TOOLS"""

import os
import subprocess
import sys
import tempfile
import unittest

TOOLS = sys.argv.pop()
ROOT = os.path.dirname(TOOLS)
sys.path.insert(0, TOOLS)
sys.dont_write_bytecode = True

import mutation_operators  # noqa: E402
import mutation_runner  # noqa: E402


def tool(name, *arguments):
    return subprocess.run([os.path.join(TOOLS, name), *arguments], capture_output=True, text=True, check=False, timeout=60)


def changes(text):
    """What the mutants of a line make of it."""
    found = mutation_operators.mutants_of("x.hpp", text)
    return [mutation_operators.applied(mutant, text) for mutant in found]


class Operators(unittest.TestCase):
    def test_operators_have_their_neighbours(self):
        self.assertEqual(changes("return a < b && c == d;"), ["return a <= b && c == d;", "return a < b || c == d;",
                                                              "return a < b && c != d;"])

    def test_numbers_go_up_and_down(self):
        self.assertEqual(changes("x{10'000U};"), ["x{10001U};", "x{9999U};"])
        self.assertEqual(changes("x{0};"), ["x{1};"])
        self.assertEqual(changes("x{0x7F};"), ["x{0x7e};", "x{0x80};"])

    def test_words_have_their_opposites(self):
        self.assertEqual(changes("bool armed_ = false;"), ["bool armed_ = true;"])
        self.assertEqual(changes("return std::min(a, b);"), ["return std::max(a, b);"])
        self.assertEqual(changes("return std::numeric_limits<int>::max();"), [])

    def test_conditions_are_negated_unless_their_operator_does_it(self):
        self.assertIn("if (!(ready())) {", changes("if (ready()) {"))
        self.assertEqual(changes("if (a != b) {"), ["if (a == b) {"])
        self.assertIn("if (int x = f();!(x)) {", changes("if (int x = f(); x) {"))

    def test_calls_and_assignments_are_left_out_and_declarations_are_not(self):
        self.assertIn("{ ; }", changes("{ count_up(); }"))
        self.assertIn("{ ; }", changes("{ a.b[c] |= d; }"))
        self.assertIn("{ ; }", changes("{ ++a; }"))
        for text in ("{ const int a = b; }", "{ std::vector<int> a(b); }", "{ auto& a = b; }", "{ return f(); }",
                     "{ can::Frame frame = f(); }"):
            self.assertEqual(changes(text), [], text)

    def test_templates_texts_comments_and_static_assertions_stay(self):
        for text in ("std::array<int, N> a;", "// a < b && true", 'fail("a < b 1");', "#if A == 1\n",
                     "static_assert(a == 1 && b < 2);", "case 'a':"):
            self.assertEqual(changes(text), [], text)

    def test_a_mutant_is_known_by_its_lines(self):
        text = "int f() {\n  return  a +\n      1;\n}\n"
        mutant = mutation_operators.mutants_of("x.cpp", text)[0]
        self.assertEqual(mutation_operators.line_of(mutant, text), 3)
        self.assertEqual(mutation_operators.lines_of(mutant, text), ("1;", "0;"))


class Lists(unittest.TestCase):
    def test_every_file_that_is_mutated_by_default_has_mutants(self):
        result = tool("mutate", "--list")
        self.assertEqual(result.returncode, 0, result.stderr)
        for path in ("firmware/safety/command_gate.hpp", "firmware/core/supervision/supervisor.cpp", "sil/robot/striker_drives.cpp"):
            self.assertIn(path, result.stdout)

    def test_every_hand_made_mutant_fits_the_code_as_it_is(self):
        result = tool("mutate", "--hand-made", "--list")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_every_explained_survivor_stands_in_the_code(self):
        self.assertEqual(mutation_runner.read_reasons(ROOT)[1], [])

    def test_an_explanation_that_fits_nothing_is_a_problem(self):
        with tempfile.TemporaryDirectory() as root:
            os.makedirs(os.path.join(root, "tests", "mutation"))
            with open(os.path.join(root, "x.hpp"), "w", encoding="utf-8") as text:
                text.write("int a = 1;\n")
            with open(os.path.join(root, mutation_runner.EQUIVALENT), "w", encoding="utf-8") as text:
                text.write("x.hpp\n- int a = 1;\n+ int a = 2;\nnobody reads it\n\nx.hpp\n- int b = 1;\n+ int b = 2;\nold\n\n"
                           "x.hpp\n- int a = 1;\n+ int a = 0;\n")
            reasons, problems = mutation_runner.read_reasons(root)
            self.assertEqual(reasons["x.hpp", "int a = 1;", "int a = 2;"], "nobody reads it")
            self.assertEqual(len(problems), 2)


class WrongUse(unittest.TestCase):
    def test_it_is_refused_in_words(self):
        for name, arguments, word in (("mutate", ("--sample", "0"), "--sample"), ("mutate", ("--files", "none.hpp"), "none.hpp"),
                                      ("mutate", ("--hand-made", "--sample", "3"), "--hand-made"),
                                      ("fuzz", ("--seconds", "0"), "--seconds"), ("fuzz", ("--target", "none"), "none"),
                                      ("coverage", ("--lines", "many"), "many"), ("coverage", ("--html",), "--html")):
            result = tool(name, *arguments)
            self.assertNotEqual(result.returncode, 0, arguments)
            self.assertIn(word, result.stderr)

    def test_each_says_how_it_is_used(self):
        for name in ("mutate", "fuzz", "coverage"):
            result = tool(name, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertIn("Exit status", result.stdout)

    def test_every_fuzz_target_has_seeds(self):
        targets = tool("fuzz", "--list").stdout.split()
        self.assertIn("node", targets)
        for target in targets:
            self.assertTrue(os.listdir(os.path.join(ROOT, "tests", "fuzz", "seeds", target)), target)


if __name__ == "__main__":
    unittest.main(verbosity=2)
