#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Configures, builds and, on the host, runs firmware/examples as a project of its own, with Striker as a subproject or as
an installed package. It must link neither heap nor exceptions nor the C++ standard library, and Striker must leave the
other project's settings alone."""

import argparse
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLES = os.path.join(ROOT, "firmware", "examples")
PROGRAMS = ("own_port", "c_face")
TOOLCHAIN = f"-DCMAKE_TOOLCHAIN_FILE={EXAMPLES}/cortex-m4.cmake"

# A heap, exceptions, floating point, and what only libstdc++ has.
FORBIDDEN = re.compile(
    r"malloc|calloc|realloc|free|_sbrk|_?malloc_r|_Zn[wa].*|_Zd[la].*|__cxa_(?!finalize).*|_Unwind_.*|__gxx_personality.*"
    r"|_ZTVN10__cxxabiv.*|_ZSt\d+__(throw|glibcxx).*|__aeabi_[cfd](f|d|add|sub|mul|div|cmp|2|r).*"
    r"|__aeabi_(u?[il]2[fd]|f2.*|d2.*)")


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"examples_test: {' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def configure(source, build_dir, *options):
    run("cmake", "-G", "Ninja", "-S", source, "-B", build_dir, "-DCMAKE_BUILD_TYPE=Release", *options)


def install(arguments, prefix):
    """Striker's libraries for the processor: the host's are in the build that runs this test."""
    build_dir = arguments.host_build
    if arguments.processor != "host":
        build_dir = os.path.join(arguments.build_dir, "striker")
        configure(ROOT, build_dir, TOOLCHAIN)
        run("cmake", "--build", build_dir)
    run("cmake", "--install", build_dir, "--prefix", prefix)


def symbols(program, processor):
    """What a program on the host takes from libraries; what an image has in it."""
    tool = ["nm", "--undefined-only"] if processor == "host" else ["arm-none-eabi-nm"]
    lines = (line.split()[-2:] for line in run(*tool, program).splitlines())
    return {name.split("@")[0] for kind, name in lines if processor != "host" or kind == "U"}


def check(holds, text):
    print(("ok: " if holds else "FAILED: ") + text)
    return holds


def check_program(program, processor):
    name = os.path.basename(program)
    found = symbols(program, processor)
    forbidden = sorted(filter(FORBIDDEN.fullmatch, found))
    good = check(found and not forbidden, f"{name}: {len(found)} symbols, none of a heap, of exceptions, of floating point "
                 f"or of libstdc++: {forbidden}")
    if processor == "host":
        needed = re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "--dynamic", program))
        good &= check(needed == ["libc.so.6"], f"{name}: needs {needed}")
        status = subprocess.run([program], check=False, timeout=60).returncode
        good &= check(status == 0, f"{name}: ends with status {status}")
    else:
        print(run("arm-none-eabi-size", program), end="")
    return good


def check_manners(build_dir):
    """As a subproject: warnings are no errors, and nothing is built but the libraries."""
    with open(os.path.join(build_dir, "build.ninja"), encoding="utf-8") as text:
        rules = text.read()
    good = check("-Werror" not in rules, "warnings of Striker are no errors here")
    strangers = sorted(set(re.findall(r"striker/((?:sil|training|tests|firmware/(?:host|ports|programs))/\w+)", rules)))
    good &= check(not strangers, f"nothing but the libraries is built: {strangers[:3]}")
    outputs = [name for name in ("bin", "lib") if os.path.exists(os.path.join(build_dir, name))]
    return check(not outputs, f"no output folders of Striker's: {outputs}") and good


def check_no_build_type(build_dir, options):
    """Striker sets none where the other project sets none."""
    run("cmake", "-G", "Ninja", "-S", EXAMPLES, "-B", build_dir, f"-DSTRIKER_SOURCES={ROOT}", *options)
    with open(os.path.join(build_dir, "CMakeCache.txt"), encoding="utf-8") as cache:
        chosen = re.search(r"^CMAKE_BUILD_TYPE:\w+=(.*)$", cache.read(), re.MULTILINE)[1]
    return check(chosen == "", f"no build type is forced: '{chosen}'")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--processor", required=True, choices=("host", "cortex-m4"))
    parser.add_argument("--way", required=True, choices=("subproject", "package"))
    parser.add_argument("--host-build", required=True, help="a build of Striker for the host")
    parser.add_argument("--build-dir", required=True, help="a folder that is emptied first")
    arguments = parser.parse_args()
    shutil.rmtree(arguments.build_dir, ignore_errors=True)
    build_dir, prefix = os.path.join(arguments.build_dir, "examples"), os.path.join(arguments.build_dir, "installed")
    options = [] if arguments.processor == "host" else [TOOLCHAIN]
    if arguments.way == "package":
        install(arguments, prefix)
        configure(EXAMPLES, build_dir, f"-Dstriker_ROOT={prefix}", *options)
    else:
        configure(EXAMPLES, build_dir, f"-DSTRIKER_SOURCES={ROOT}", *options)
    run("cmake", "--build", build_dir)
    good = all([check_program(os.path.join(build_dir, program), arguments.processor) for program in PROGRAMS])
    if arguments.way == "subproject":
        good &= check_manners(build_dir)
        good &= check_no_build_type(os.path.join(arguments.build_dir, "no_build_type"), options)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
