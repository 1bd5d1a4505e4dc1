# SPDX-License-Identifier: Apache-2.0
"""Tries a mutant in a copy of the tree, and reads what tests/mutation says of mutants."""

import hashlib
import os
import re
import shutil
import subprocess
import time

from mutation_operators import Mutant

# All that the project tests/mutation/CMakeLists.txt builds from.
FOLDERS = ("firmware", "sil", "tests")
SUFFIXES = (".cpp", ".hpp", ".dbc", "CMakeLists.txt")
EQUIVALENT = "tests/mutation/equivalent.txt"
HAND_MADE = "tests/mutation/hand_made.txt"


class BuildError(Exception):
    """The tests cannot be built, or do not pass, as the code stands."""


def sources_of(root):
    for top in FOLDERS:
        for folder, folders, files in os.walk(os.path.join(root, top)):
            folders.sort()
            for name in sorted(files):
                if name.endswith(SUFFIXES):
                    yield os.path.relpath(os.path.join(folder, name), root)


def tree_digest(root):
    digest = hashlib.sha256()
    for path in sources_of(root):
        with open(os.path.join(root, path), "rb") as content:
            digest.update(path.encode() + b"\0" + content.read() + b"\0")
    return digest.hexdigest()[:16]


class Worker:
    """One copy of the tree with its build."""

    def __init__(self, root, copy, timeout_s, stop, kills, compilers):
        self.tree, self.build = os.path.join(copy, "tree"), os.path.join(copy, "build")
        self.root, self.timeout_s, self.stop = root, timeout_s, stop
        self.compilers = str(compilers)
        self.kills = kills  # by file and program, of all workers: who noticed most is asked first, then the file's namesake
        self.update()
        self.run_or_raise("cmake", "-S", os.path.join(self.tree, "tests", "mutation"), "-B", self.build, "-G", "Ninja",
                          "-DCMAKE_CXX_COMPILER_LAUNCHER=")
        self.run_or_raise("ninja", "-C", self.build, "-j", self.compilers)
        with open(os.path.join(self.build, "programs.txt"), encoding="utf-8") as lines:
            self.programs = lines.read().split()
        for program in self.programs:
            if self.run_tests(program) is not None:
                raise BuildError(f"{program} fails as the code stands: mend it first ({self.build}/{program})")

    def update(self):
        """Brings the copy to the tree as it stands; what is equal keeps its time, so that it is not built again."""
        wanted = set(sources_of(self.root))
        for path in [path for path in sources_of(self.tree) if path not in wanted]:
            os.remove(os.path.join(self.tree, path))
        for path in wanted:
            source, target = os.path.join(self.root, path), os.path.join(self.tree, path)
            with open(source, "rb") as content:
                now = content.read()
            if os.path.exists(target):
                with open(target, "rb") as content:
                    if content.read() == now:
                        continue
            os.makedirs(os.path.dirname(target), exist_ok=True)
            with open(target, "wb") as content:
                content.write(now)

    def run_or_raise(self, *command):
        done = subprocess.run(command, capture_output=True, text=True, check=False, start_new_session=True)
        if done.returncode != 0:
            raise BuildError(f"{' '.join(command)} failed:\n{(done.stdout + done.stderr)[-3000:]}")

    def run(self, command, timeout_s):
        """The exit status and the output; None for a status means that time ran out, or that all is to stop."""
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True, errors="replace", start_new_session=True)
        end = time.monotonic() + timeout_s
        while True:
            try:
                output, _ = process.communicate(timeout=0.5)
                return process.returncode, output
            except subprocess.TimeoutExpired:
                if time.monotonic() > end or self.stop.is_set():
                    process.kill()
                    process.communicate()
                    return None, ""

    def run_tests(self, program):
        """Nothing if all pass; else the first test that does not."""
        status, output = self.run([os.path.join(self.build, program), "--gtest_brief=1", "--gtest_fail_fast"],
                                  self.timeout_s)
        if status == 0:
            return None
        failed = re.search(r"\[  FAILED  \] (\S+)", output)
        return "" if status is None else failed[1] if failed else f"{program}, which ended with {status}"

    def verdict_of(self, case):
        target = os.path.join(self.tree, case.path)
        shutil.copyfile(target, target + ".sound")
        try:
            with open(target, "w", encoding="utf-8") as text:
                text.write(case.content)
            return self.try_programs(case)
        finally:
            os.replace(target + ".sound", target)
            os.utime(target)

    def try_programs(self, case):
        kills = self.kills.setdefault(case.path, {})
        stem = os.path.splitext(os.path.basename(case.path))[0]
        for program in sorted(self.programs, key=lambda name: (-kills.get(name, 0), stem not in name)):
            status, output = self.run(["ninja", "-C", self.build, "-j", self.compilers, program], 600)
            if status is None:
                return "timed out", "the compiler"
            if status != 0:
                error = re.search(r"error: (.*)", output)
                return "killed by the compiler", error[1][:100] if error else ""
            if "no work to do" in output:
                continue
            failed = self.run_tests(program)
            if failed is not None:
                kills[program] = kills.get(program, 0) + 1
                return ("killed", failed) if failed else ("timed out", program)
        return "survived", ""


def blocks_of(path):
    """Blocks between blank lines, without comments: lists of lines."""
    if not os.path.exists(path):
        return
    block = []
    with open(path, encoding="utf-8") as text:
        for line in [*text.read().split("\n"), ""]:
            if line.strip():
                block.append(line)
            elif block:
                if not block[0].startswith("#"):
                    yield block
                block = []


def changed_lines(block):
    before = [line[2:] for line in block if line.startswith("- ")]
    after = [line[2:] for line in block if line.startswith("+ ")]
    return before, after


def read_reasons(root):
    """Why a survivor is accepted, by file and lines; and what is wrong with the list."""
    reasons, problems = {}, []
    for block in blocks_of(os.path.join(root, EQUIVALENT)):
        before, after = changed_lines(block)
        reason = " ".join(line.strip() for line in block[1:] if line[:2] not in ("- ", "+ "))
        if not before or not after or not reason:
            problems.append(f"{EQUIVALENT}: {block[0]}: a file, lines with - and +, and a reason are needed")
        reasons[(block[0].strip(), " ".join(" ".join(before).split()), " ".join(" ".join(after).split()))] = reason
    for path, before, _ in list(reasons):
        with_file = os.path.join(root, path)
        if not os.path.exists(with_file):
            problems.append(f"{EQUIVALENT}: {path}: no such file")
            continue
        with open(with_file, encoding="utf-8") as text:
            if before not in " ".join(text.read().split()):
                problems.append(f"{EQUIVALENT}: {path} has no such line any more: {before}")
    return reasons, problems


def read_hand_made(root, read, fail):
    """Name and mutant of each."""
    for block in blocks_of(os.path.join(root, HAND_MADE)):
        head = re.fullmatch(r"\[(\S+)\] (\S+): (.*)", block[0])
        if not head:
            fail(f"{HAND_MADE}: {block[0]}: must be [NAME] FILE: WHAT IT BREAKS")
        before, after = ("\n".join(lines) for lines in changed_lines(block))
        text = read(head[2])
        if not before or text.count(before) != 1:
            fail(f"{HAND_MADE}: {head[1]}: what it changes stands {text.count(before) if before else 0} times in {head[2]}, "
                 "not once; write it for the code as it is now")
        begin = text.index(before)
        yield head[1], Mutant(head[2], begin, begin + len(before), after, head[3])
