#!/usr/bin/env python3
"""Installs the build, moves it, and uses it from outside: a program and a plugin are built against
it by CMake and by pkg-config, and the moved command line solves a file with that plugin.

    install_test.py --build BUILD --source SOURCE --cmake CMAKE --compiler CXX --flags FLAGS
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

BOX = """NAME BOX
ROWS
 N COST
COLUMNS
 X COST 2
 Y COST -3
BOUNDS
 LO BND X 1
 UP BND Y 5
ENDATA
"""
BOX_OPTIMUM = 2 * 1 - 3 * 5


def run(command, **more):
    """The standard output of a command that has to succeed."""
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n"
                 f"{done.stdout}{done.stderr}")
    return done.stdout


def check(true, sentence):
    if not true:
        sys.exit(sentence)


def environment(**more):
    """No setting of the caller leaks in: the moved tree has to find its own parts."""
    kept = {k: v for k, v in os.environ.items()
            if not k.startswith("SWITCHYARD_") and k != "LD_LIBRARY_PATH"}
    return kept | {k: str(v) for k, v in more.items()}


class Tree:
    """An installed tree at `prefix`."""

    def __init__(self, prefix):
        self.prefix = prefix
        self.pc = next(prefix.rglob("switchyard.pc")).parent
        self.plugins = self.pc.parent / "switchyard" / "plugins"
        self.library = next(self.pc.parent.glob("libswitchyard.so"))

    def pkg_config(self, *what):
        path = os.pathsep.join([str(self.pc), os.environ.get("PKG_CONFIG_PATH", "")])
        return run(["pkg-config", *what, "switchyard"],
                   env=environment(PKG_CONFIG_PATH=path)).split()

    def switchyard(self, *arguments, **more):
        return run([self.prefix / "bin" / "switchyard", *arguments], env=environment(**more))


def install_and_move(args, work):
    first, moved = work / "first", work / "moved"
    run([args.cmake, "--install", args.build, "--prefix", first, "--strip"])
    first.rename(moved)
    return Tree(moved), first


def check_no_absolute_paths(tree, foreign, sanitized):
    """No file of ours names the source, the build or the first prefix; `deps` are not ours, and
    sanitizers write the places of the source into binaries."""
    for path in sorted(tree.prefix.rglob("*")):
        if path.is_symlink() or not path.is_file() or path.parent.name == "deps":
            continue
        if sanitized and (path.parent.name == "bin" or ".so" in path.name):
            continue
        content = path.read_bytes()
        for place in foreign:
            check(str(place).encode() not in content,
                  f"{path.relative_to(tree.prefix)} holds the absolute path {place}")


def dynamic_section(path):
    return run(["readelf", "-d", path])


def exported(path):
    """Names and versions of what a module or library defines for others."""
    lines = run(["nm", "-D", "--defined-only", path]).splitlines()
    return {line.split()[-1].split("@")[0] for line in lines if line.split()[-2] != "A"}


def check_binaries(tree):
    soname = re.search(r"SONAME.*\[(libswitchyard\.so\.[0-9.]+)\]", dynamic_section(tree.library))
    check(soname, "libswitchyard.so has no soname with a version")
    check((tree.library.parent / soname[1]).exists(), f"{soname[1]} is not installed")
    modules = sorted(tree.plugins.glob("*.so"))
    for path in [tree.prefix / "bin" / "switchyard", tree.library, *modules]:
        for entry in re.findall(r"(?:RUNPATH|RPATH).*\[(.*)\]", dynamic_section(path)):
            for place in entry.split(":"):
                check(place.startswith("$ORIGIN"), f"{path.name} has {place} on its run path")
    for path in modules:
        lost = [line.split()[0] for line in run(["ldd", path], env=environment()).splitlines()
                if "not found" in line]
        check(not lost, f"{path.name} does not find {', '.join(lost)}")
        check(exported(path) == {"switchyard_plugin_v1"},
              f"{path.name} exports {sorted(exported(path))}, not switchyard_plugin_v1 alone")
    for name in exported(tree.library):  # hidden visibility leaves templates of the standard library
        check(re.match(r"_Z[A-Z]*(St|9__gnu_cxx)", name) or "switchyard" in name,
              f"{tree.library.name} exports {name}, which is not a name of Switchyard")


def build_with_cmake(args, tree, work, name, source):
    build = work / f"{name}-build"
    run([args.cmake, "-S", args.source / "tests" / "install" / name, "-B", build,
         f"-DCMAKE_PREFIX_PATH={tree.prefix}", f"-DCMAKE_CXX_COMPILER={args.compiler}",
         f"-DCMAKE_CXX_FLAGS={args.flags}", "-DCMAKE_BUILD_TYPE=Debug",
         f"-D{'PROGRAM' if name == 'program' else 'SIGNS'}_SOURCE={source}"], env=environment())
    run([args.cmake, "--build", build])
    return build


def build_with_pkg_config(args, tree, work, program, plugin):
    compiler = [args.compiler, "-std=c++20", *args.flags.split()]
    flags = tree.pkg_config("--cflags", "--libs")
    run([*compiler, program, "-o", work / "program", *flags, f"-Wl,-rpath,{tree.library.parent}"])
    folder = work / "pkg-config-plugins"
    folder.mkdir()
    run([*compiler, "-fPIC", "-shared", "-fvisibility=hidden", *tree.pkg_config("--cflags"),
         plugin, "-o", folder / "signs.so"])
    return work / "program", folder


def check_plugin_is_used(tree, work, folder):
    box, answer = work / "box.mps", work / "box.json"
    box.write_text(BOX)
    listing = tree.switchyard("plugins", "list", SWITCHYARD_PLUGIN_PATH=folder)
    check("signs" in listing, f"the plugin of {folder.name} is not in the list:\n{listing}")
    tree.switchyard("solve", box, "--solver", "signs", "--json", answer,
                    SWITCHYARD_PLUGIN_PATH=folder)
    found = json.loads(answer.read_text())
    check(found["solver"] == "org.example.signs" and found["termination"] == "optimal" and
          abs(found["objective"] - BOX_OPTIMUM) < 1e-9,
          f"signs should answer {BOX_OPTIMUM}; the result is {found}")


def main():
    parser = argparse.ArgumentParser()
    for name in ("build", "source"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    for name in ("cmake", "compiler", "flags"):
        parser.add_argument(f"--{name}", required=True)
    args = parser.parse_args()
    program = args.source / "examples" / "programs" / "two_products.cpp"
    plugin = args.source / "examples" / "plugin" / "signs.cpp"
    with tempfile.TemporaryDirectory(prefix="switchyard-install-") as folder:
        work = Path(folder).resolve()
        tree, first = install_and_move(args, work)
        check_no_absolute_paths(tree, [first, args.source.resolve()], bool(args.flags))
        check_binaries(tree)
        built = build_with_cmake(args, tree, work, "program", program)
        by_cmake = build_with_cmake(args, tree, work, "plugin", plugin)
        by_hand, plugins = build_with_pkg_config(args, tree, work, program, plugin)
        for each in (by_cmake, plugins):
            check_plugin_is_used(tree, work, each)
        if any(tree.plugins.glob("*.so")):
            said = {run([each], env=environment()) for each in (built / "program", by_hand)}
            check(len(said) == 1 and "earns" in said.pop(), "the two programs say different things")
    print("installed, moved and used")


if __name__ == "__main__":
    main()
