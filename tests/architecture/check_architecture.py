#!/usr/bin/env python3
"""Checks a source tree against the table "who may know whom" and the limits of length.

    check_architecture.py TREE

Prints one sentence for each thing that is against a rule; exits 1 where there is one.
"""

import re
import sys
from pathlib import Path

from function_lengths import functions

# What a plugin, a solver and core share: the headers directly in include/switchyard.
SHARED = {"abi.h", "hints.h", "dynamics.h", "plugin.hpp", "problem.hpp", "problem_update.hpp", "cones.hpp",
          "boxes.hpp", "safe_bound.hpp", "arcs.hpp", "arc_graph.hpp",
          "sos1_groups.hpp"}

# Inside core, each part and the parts it may know. `abi` are the shared headers, known to all.
# Bridges map a sy_problem to a sy_problem: the host applies them for each backend, and neither knows
# the model.
CORE_KNOWS = {
    "linalg": set(),
    "functions": {"linalg"},
    "symbolic": {"functions"},
    "problem": {"linalg"},
    "bridges": {"linalg", "problem"},
    "host": {"linalg", "problem", "bridges"},
    "dynamics": {"linalg", "functions", "host"},
    "model": {"linalg", "functions", "symbolic"},
    "lower": {"linalg", "functions", "symbolic", "problem", "model"},
}
for above in ("solve", "sets", "gcs", "trajectory"):
    CORE_KNOWS[above] = set(CORE_KNOWS) - {"dynamics"}
# A robot's efforts, frames and distances are asked of along a trajectory alone.
CORE_KNOWS["trajectory"].add("dynamics")
# Files hold programs, graphs and trajectories, and no answers.
CORE_KNOWS["io"] = {"linalg", "functions", "symbolic", "model", "sets", "gcs", "trajectory"}

# Inside solvers, likewise.
SOLVERS_KNOW = {
    "linalg": set(),
    "cones": {"linalg"},
    "presolve": set(),
    "conic": {"linalg", "cones", "presolve"},
    "rounding": set(),
    "mip": {"rounding"},
}
# Only this part orders matrices.
ORDERING_PART = "linalg"
ORDERING_HEADERS = {"amd.h", "metis.h"}

# What no product may include.
MEASURES = ("tests/", "benchmarks/")

# Headers of solver libraries: core names no solver.
SOLVER_HEADERS = re.compile(
    r"(Highs\w*|highs/.*|interfaces/highs_c_api|Clp\w*|Cbc\w*|Cgl\w*|Osi\w*|Coin\w*|coin/.*"
    r"|clarabel.*|IpTNLP|IpIpopt.*|nlopt.*|gurobi.*|mosek.*|scip/.*|ilcplex/.*|xpr[sm]\w*"
    r"|copt.*|osqp.*|scs|ecos|cuopt.*)(\.h|\.hpp|\.hh)?")

LIMITS = {"header": 300, "source": 500, "plugin source": 300, "root CMake file": 120}
FUNCTION_LIMIT = 60
# A contract is read in one piece, and so is its translation to another language.
WITHOUT_LIMIT = {"include/switchyard/abi.h", "plugins/clarabel/src/abi.rs"}
SUFFIXES = {".h", ".hpp", ".c", ".cpp", ".rs"}
IGNORED = {"build", ".git", "target"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')


def sources(tree):
    for path in sorted(tree.rglob("*")):
        inside = path.relative_to(tree)
        if path.suffix in SUFFIXES and not IGNORED & set(inside.parts) and path.is_file():
            yield path, inside


def part_of_core(inside):
    """The part of core that a file belongs to, by its folder; None outside core."""
    parts = inside.parts
    if parts[0] == "core" and len(parts) > 2:
        return parts[1]
    if parts[:2] == ("include", "switchyard") and len(parts) > 3:
        return parts[2]
    return None


def part_included(header):
    """The part of core that an include reaches; None for a shared or a foreign header."""
    names = header.removeprefix("switchyard/").removeprefix("core/").split("/")
    return names[0] if len(names) > 1 and names[0] in CORE_KNOWS else None


def check_shared(header, inside):
    if inside.as_posix() == "include/switchyard/abi.h" and header not in ("stddef.h", "stdint.h"):
        return "abi.h knows nothing but stddef.h and stdint.h"
    if part_included(header):
        return "a header that a plugin shares knows no part of core"
    return None


def check_core(part, header):
    target = part_included(header)
    if target and target != part and target not in CORE_KNOWS[part]:
        known = ", ".join(sorted(CORE_KNOWS[part])) or "the shared headers alone"
        return f"{part} may know {known}, not {target}"
    if SOLVER_HEADERS.fullmatch(header):
        return "core names no solver: a solver's library is a plugin's business"
    if header.startswith(("solvers/", "plugins/", "tools/") + MEASURES):
        return "core knows neither solvers nor plugins nor tools, nor what tests it"
    return None


def check_outside(folder, header):
    """What plugins/ and solvers/ may include: the shared headers, their own, one library."""
    if part_included(header) or header.startswith("core/"):
        return f"{folder} know the shared headers, never core"
    if header.startswith("switchyard/") and header.removeprefix("switchyard/") not in SHARED:
        return f"{folder} know of switchyard/ only {', '.join(sorted(SHARED))}"
    unknown = ("tools/",) + MEASURES + (("plugins/",) if folder == "solvers" else ())
    if header.startswith(unknown):
        return f"{folder} do not know {header.split('/')[0]}"
    return None


def check_solvers(part, header):
    target = header.split("/")[1] if header.startswith("solvers/") else None
    if target and target != part and target not in SOLVERS_KNOW[part]:
        known = " and ".join(sorted(SOLVERS_KNOW[part])) or "no other part of solvers"
        return f"{part} may know {known}, not {target}"
    if header in ORDERING_HEADERS and part != ORDERING_PART:
        return f"orderings are the business of {ORDERING_PART}"
    if SOLVER_HEADERS.fullmatch(header):
        return "solvers are algorithms of our own: a library's are a plugin's business"
    return check_outside("solvers", header)


def check_benchmarks(header):
    """They may know everything, but of the tests only what these share."""
    if header.startswith("tests/") and not header.startswith("tests/support/"):
        return "benchmarks know of tests only tests/support"
    return None


def include_mistakes(path, inside):
    part = part_of_core(inside)
    if part is not None and part not in CORE_KNOWS:
        yield f"{inside}: core has no part {part}; its parts are {', '.join(CORE_KNOWS)}"
        return
    folder = inside.parts[0]
    solver = inside.parts[1] if folder == "solvers" and len(inside.parts) > 2 else None
    if solver is not None and solver not in SOLVERS_KNOW:
        yield f"{inside}: solvers has no part {solver}; its parts are {', '.join(SOLVERS_KNOW)}"
        return
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        found = INCLUDE.match(line)
        if not found:
            continue
        header, wrong = found[1], None
        if part is not None:
            wrong = check_core(part, header)
        elif inside.parts[:2] == ("include", "switchyard"):
            wrong = check_shared(header, inside)
        elif solver is not None:
            wrong = check_solvers(solver, header)
        elif folder in ("plugins", "solvers"):
            wrong = check_outside(folder, header)
        elif folder == "benchmarks":
            wrong = check_benchmarks(header)
        if wrong:
            yield f"{inside}:{number}: includes {header}; {wrong}"


def kind_of_file(inside):
    if inside.suffix in (".h", ".hpp"):
        return "header"
    return "plugin source" if inside.parts[0] == "plugins" else "source"


def length_mistakes(path, inside):
    text = path.read_text(errors="replace")
    kind, lines = kind_of_file(inside), len(text.splitlines())
    if lines > LIMITS[kind] and inside.as_posix() not in WITHOUT_LIMIT:
        yield f"{inside}: has {lines} lines; a {kind} has at most {LIMITS[kind]}"
    for name, line, length in functions(text, inside.suffix):
        if length > FUNCTION_LIMIT:
            yield (f"{inside}:{line}: the function {name} has {length} lines; "
                   f"at most {FUNCTION_LIMIT}")


def mistakes(tree):
    for path, inside in sources(tree):
        yield from include_mistakes(path, inside)
        yield from length_mistakes(path, inside)
    cmake = tree / "CMakeLists.txt"
    if cmake.exists():
        lines = len(cmake.read_text().splitlines())
        if lines > LIMITS["root CMake file"]:
            yield (f"CMakeLists.txt: has {lines} lines; "
                   f"a root CMake file has at most {LIMITS['root CMake file']}")


def main():
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        sys.exit("usage: check_architecture.py TREE")
    found = list(mistakes(Path(sys.argv[1]).resolve()))
    for sentence in found:
        print(sentence)
    print(f"architecture: {len(found)} against the rules" if found else
          "architecture: the includes and the lengths are right")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
