"""What a point of an MPS file is worth: reads {name: value}, writes [objective, violation].

    judge_mps.py FILE < POINT

The file is read by HiGHS. The violation is the largest over bounds, rows and integrality, each
relative to max(1, the largest term that meets in it).
"""

import json
import sys

import highspy


def _outside(lower, value, upper):
    return max(lower - value, value - upper, 0.0)


def main():
    model = highspy.Highs()
    model.setOptionValue("output_flag", False)
    model.readModel(sys.argv[1])
    lp = model.getLp()
    point = json.load(sys.stdin)
    x = [point[name] for name in lp.col_names_]
    worst = 0.0
    kinds = list(lp.integrality_) or [highspy.HighsVarType.kContinuous] * len(x)
    for value, lower, upper, kind in zip(x, lp.col_lower_, lp.col_upper_, kinds):
        broken = _outside(lower, value, upper) / max(1.0, abs(value))
        if kind in (highspy.HighsVarType.kSemiContinuous, highspy.HighsVarType.kSemiInteger):
            broken = min(broken, abs(value))  # 0 is the other choice
        if kind in (highspy.HighsVarType.kInteger, highspy.HighsVarType.kSemiInteger):
            broken = max(broken, abs(value - round(value)))
        worst = max(worst, broken)
    values, sizes = [0.0] * lp.num_row_, [1.0] * lp.num_row_
    matrix = lp.a_matrix_  # by columns, as it is read
    starts, rows, entries = list(matrix.start_), list(matrix.index_), list(matrix.value_)
    for j, value in enumerate(x):
        for k in range(starts[j], starts[j + 1]):
            values[rows[k]] += entries[k] * value
            sizes[rows[k]] = max(sizes[rows[k]], abs(entries[k] * value))
    for value, size, lower, upper in zip(values, sizes, lp.row_lower_, lp.row_upper_):
        worst = max(worst, _outside(lower, value, upper) / size)
    print(json.dumps([lp.offset_ + sum(c * v for c, v in zip(lp.col_cost_, x)), worst]))


if __name__ == "__main__":
    main()
