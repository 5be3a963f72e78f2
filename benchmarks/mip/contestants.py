"""Who is compared, each solve in a process of its own, with answers in one form.

An answer has `end` ("optimal", "infeasible", "unbounded", "limit", or "failed"), `status` (its own
word) and `version`; where there are such, `seconds`, `objective`, `bound`, `nodes` and `x`, a value
by name. A process that aborts or goes far beyond the limit is an answer that failed.
"""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

GRACE = 30.0  # seconds beyond the limit after which a process is ended
PHASES = ("build", "lower", "presolve", "solve", "recover")
PACKAGES = {"pyscipopt": "6.3.0", "highspy": "1.16.0", "casadi": "3.8.2"}
# Libraries that would use more threads than those that are asked for.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def run(command, limit, given=None, environment=None):
    """(standard output, None) of a process, or (None, why there is nothing from it).

    The process leads a group of its own, which the limit ends as a whole.
    """
    with subprocess.Popen(command, stdin=subprocess.PIPE if given else subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          start_new_session=True, env=os.environ | (environment or {})) as process:
        try:
            out, error = process.communicate(given, timeout=limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return None, f"over {limit:g} s"
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    if process.returncode < 0:
        return None, f"ended by {signal.Signals(-process.returncode).name}"
    if not out.strip():
        return None, (error.strip().splitlines() or ["no answer"])[-1]
    return out, None


def last_line(out):
    """The JSON that a script ends with; what it runs may have written before."""
    return json.loads(out.strip().splitlines()[-1])


class Switchyard:
    """`PROGRAM solve`; its seconds are those of all phases but reading."""

    ENDS = ("optimal", "infeasible", "unbounded")
    FAILURES = ("backend_failed", "numerical_trouble", "no_backend")

    def __init__(self, program, solver, options, folder):
        self.name = solver
        self._program = program
        self._options = [word for option in options for word in ("--option", option)]
        self._solution = folder / "solution.json"

    def takes(self, _kind):
        return True

    def solve(self, file, limits):
        self._solution.unlink(missing_ok=True)
        out, failure = run(
            [self._program, "solve", file, "--solver", self.name, "--quiet", "--json", "-",
             "--solution", self._solution, "--gap", str(limits.gap), "--time-limit",
             str(limits.seconds), "--threads", str(limits.threads), *self._options],
            limits.seconds + GRACE)
        if failure:
            return {"end": "failed", "status": failure}
        result = json.loads(out)
        said = result["termination"]
        answer = {"end": said if said in self.ENDS else "limit", "status": said,
                  "message": result.get("message"), "nodes": result.get("nodes"),
                  "seconds": sum(result["seconds"][phase] for phase in PHASES)}
        if said in self.FAILURES:
            answer["end"] = "failed"
        if "solver" in result:
            answer["version"] = f"{result['solver']} {result['solver_version']}"
        if isinstance(result.get("bound"), float):
            answer["bound"] = result["bound"]
        if result.get("primal") == "feasible":
            answer["objective"] = result["objective"]
            answer["x"] = json.loads(self._solution.read_text())["variables"]
        return answer


class Peer:
    """One script of this folder, run by the environment of the peers."""

    NAMES = {"scip": "SCIP", "highs": "HiGHS", "bonmin": "Bonmin"}
    KINDS = {"scip": ("misocp", "milp"), "highs": ("milp",), "bonmin": ("misocp",)}

    def __init__(self, script, environment):
        self.name = self.NAMES[script]
        self._script = script
        self._python = environment / "bin" / "python"

    def takes(self, kind):
        return kind in self.KINDS[self._script]

    def solve(self, file, limits):
        script = Path(__file__).with_name(f"solve_with_{self._script}.py")
        out, failure = run([self._python, "-B", script, file, str(limits.seconds),
                            str(limits.gap), str(limits.threads)], limits.seconds + GRACE,
                           environment=ONE_THREAD)
        return {"end": "failed", "status": failure} if failure else last_line(out)


def judge_mps(environment, file, x):
    """(objective, violation) of a point of an MPS file."""
    out, failure = run([environment / "bin" / "python", "-B",
                        Path(__file__).with_name("judge_mps.py"), file], GRACE, json.dumps(x))
    if failure:
        raise RuntimeError(f"judge of {file}: {failure}")
    return last_line(out)


def make_environment(folder):
    """The peers in an environment of their own, made where it lacks one of them."""
    python = folder / "bin" / "python"
    asked = (f"import importlib.metadata as m; "
             f"assert all(m.version(p) == v for p, v in {PACKAGES}.items())")
    if python.exists() and subprocess.run([python, "-c", asked], capture_output=True,
                                          check=False).returncode == 0:
        return
    packages = [f"{name}=={version}" for name, version in PACKAGES.items()]
    print(f"installing {', '.join(packages)} in {folder}", file=sys.stderr)
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
                    *packages], check=True)
