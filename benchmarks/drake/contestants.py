"""The two that are compared, each run in a process of its own, with what it answers in one form.

An answer has `status` and, where there is one, `seconds`, `objective`, `edges` and `points`, beside
what else the one who answers has to say. A process that aborts or exceeds its limit is an answer
without seconds, whose status says so.
"""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

VERSION = "1.51.0"
PHASES = ("build", "lower", "presolve", "solve", "recover")


def _run(command, limit):
    """(standard output, None) of a process, or (None, why there is nothing from it).

    The process leads a group of its own, which a limit ends as a whole.
    """
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          start_new_session=True) as process:
        try:
            out, error = process.communicate(timeout=limit)
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


def _built_and_solved(command, limit):
    """What a process answers that says its seconds of `build` and `solve`."""
    out, failure = _run(command, limit)
    if failure:
        return {"status": failure}
    answer = json.loads(out)
    return answer | {"seconds": answer["build"] + answer["solve"]}


class Drake:
    """Drake in `folder`, an environment that is made where there is none."""

    def __init__(self, folder, threads):
        self._python = folder / "bin" / "python"
        self._threads = threads
        if self._installed() == VERSION:
            return
        print(f"installing Drake {VERSION} in {folder}", file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        subprocess.run([self._python, "-m", "pip", "install", "--quiet", f"drake=={VERSION}"],
                       check=True)

    def _installed(self):
        """The version that stands in the folder, None where there is none."""
        if not self._python.exists():
            return None
        asked = "import importlib.metadata as m; print(m.version('drake'))"
        return subprocess.run([self._python, "-c", asked], capture_output=True, text=True,
                              check=False).stdout.strip() or None

    def solve(self, file, paths, limit, preprocessing=False, script="solve_with_drake.py"):
        """Seconds are those from the beginning of the build of the graph to the answer."""
        return _built_and_solved([self._python, "-B", Path(__file__).with_name(script), file,
                                  str(paths), str(int(preprocessing)), str(self._threads)], limit)

    def solve_trajectory(self, file, paths, limit, preprocessing=False):
        return self.solve(file, paths, limit, preprocessing, "solve_trajectory_with_drake.py")


class Switchyard:
    def __init__(self, program, threads):
        self._program = program
        self._threads = ["--threads", str(threads)] if threads > 0 else []

    def solve(self, file, paths, limit):
        """Seconds are those of all phases but reading; `whole` is from the start to the answer."""
        strategy = ["--paths", str(paths)] if paths > 0 else ["--relaxation"]
        out, failure = _run([self._program, "plan", file, *strategy, "--seed", "0", "--quiet",
                             "--json", "-", *self._threads], limit)
        if failure:
            return {"status": failure}
        result = json.loads(out)
        answer = {"status": result["termination"], "phases": result["seconds"],
                  "seconds": sum(result["seconds"][phase] for phase in PHASES),
                  "whole": result["seconds"]["total"], "bound": result.get("bound")}
        if result["primal"] == "feasible":
            answer["objective"] = result["objective"]
        for name in ("edges", "points"):
            if name in result:
                answer[name] = result[name]
        return answer


class Trajectories:
    """Switchyard's trajectories, by the program of runner/trajectories.cpp."""

    def __init__(self, program, threads):
        self._program = program
        self._threads = threads

    def solve_trajectory(self, file, paths, limit):
        return _built_and_solved([self._program, file, str(paths), str(self._threads)], limit)
