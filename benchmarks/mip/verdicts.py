"""Which answers to one instance count as solved, and which are wrong.

All are judged together: what one proved or found speaks for or against the others. An answer has,
beside what contestants.py says, `cost` and `violation` where its point was judged in the file; the
objective of the file is maximized or minimized. What is wrong is a list of sentences in `wrong`,
what is only worth a word one in `notes`.
"""

import math

CLEAN = 1e-8  # relative violation up to which a point speaks against others
BROKEN = 1e-5  # from which it is worth a word
WRONG = 1e-3  # from which it is no point
SLACK = 1e-6  # absolute, on top of the gap
SAME = 1e-5  # between an objective as said and as judged, relative to max(1, |cost|)


def _beyond(value, limit, gap):
    """Is value above limit by more than the gap?"""
    return value > limit + gap * abs(limit) + SLACK


def measured_gap(answer):
    """|objective - bound| / max(1e-10, |objective|); None without both."""
    if "objective" not in answer or "bound" not in answer:
        return None
    return abs(answer["objective"] - answer["bound"]) / max(1e-10, abs(answer["objective"]))


def best_known(answers, optimum, sign):
    """The least objective, times sign, of the reference and points without fault; or infinity."""
    known = [math.inf if optimum is None else sign * optimum]
    known += [sign * one["cost"] for one in answers if one.get("violation", math.inf) <= CLEAN]
    return min(known)


def _of_its_point(answer, best, sign, gap, optimum):
    said, notes = sign * answer["objective"], []
    if answer.get("violation", 0) > BROKEN:
        words = f"breaks a constraint by {answer['violation']:.1e}"
        (answer["wrong"] if answer["violation"] > WRONG else notes).append(words)
    if "cost" in answer:
        cost = sign * answer["cost"]
        if abs(said - cost) > SAME * max(1, abs(cost)):
            answer["wrong"].append(f"says {answer['objective']:.9g}, costs {answer['cost']:.9g}")
    if "bound" in answer and _beyond(sign * answer["bound"], said, gap):
        answer["wrong"].append("its objective is beyond its bound")
    if answer["end"] == "optimal" and _beyond(said, best, gap):
        answer["wrong"].append(f"optimal, and {sign * best:.9g} is known")
    if optimum is not None and _beyond(sign * optimum, said, gap):
        notes.append("better than the reference")
    return notes


def _is_solved(answer, limits):
    if answer["wrong"] or answer["seconds"] > limits.seconds + 1:
        return False
    if answer["end"] == "infeasible":
        return True
    if answer["end"] != "optimal" or "objective" not in answer:
        return False
    if "bound" not in answer:
        return True  # its word
    distance = abs(answer["objective"] - answer["bound"])
    return distance <= 1.01 * limits.gap * abs(answer["objective"]) + SLACK


def judge_together(answers, optimum, maximize, limits):
    """Adds `wrong`, `notes`, `gap` and `solved` to each answer; `optimum` is None where unknown."""
    sign = -1 if maximize else 1
    best = best_known(answers, optimum, sign)
    proven = [(sign * one["bound"], one["name"]) for one in answers
              if "bound" in one and not _beyond(sign * one["bound"], best, limits.gap)]
    for answer in answers:
        answer["wrong"], answer["notes"] = [], []
        answer["gap"] = measured_gap(answer)
        if answer["end"] in ("infeasible", "unbounded") and best < math.inf:
            answer["wrong"].append(f"{answer['end']}, and {sign * best:.9g} is known")
        if "bound" in answer and _beyond(sign * answer["bound"], best, limits.gap):
            answer["wrong"].append(f"its bound is beyond {sign * best:.9g}")
        if "objective" in answer:
            answer["notes"] += _of_its_point(answer, best, sign, limits.gap, optimum)
            answer["notes"] += [f"better than the bound of {name}" for bound, name in proven
                                if name != answer["name"]
                                and _beyond(bound, sign * answer["objective"], limits.gap)]
        if answer["end"] == "failed":
            answer["notes"].append(answer.get("message") or answer["status"])
        answer["solved"] = "seconds" in answer and _is_solved(answer, limits)
