#!/usr/bin/env python3
"""A plot of time against predicted work: seconds for each iteration over the multiplications that a
factorization was predicted to take.

    work_plot.py FILE.svg [TABLE.csv]

The table has the columns `instance`, `predicted work` and `seconds per iteration`, and may have
`set`, which colours the points; without a file it is read from standard input. Both axes are
logarithmic; the thin line has slope 1 through the largest work: what lies on it takes the time that
its work says. A viewer that shows titles names each point.
"""

import csv
import math
import sys
from html import escape

from scale_plot import HEIGHT, MARGIN, WIDTH, decades

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
WORK, SECONDS = "predicted work", "seconds per iteration"


def read(file):
    """The rows (set, instance, work, seconds), by set and work."""
    table = csv.DictReader(file, skipinitialspace=True)
    missing = [name for name in ("instance", WORK, SECONDS) if name not in (table.fieldnames or [])]
    if missing:
        sys.exit(f"work_plot: needs the columns instance, {WORK} and {SECONDS}, got no "
                 f"{' and no '.join(missing)}")
    rows = []
    for row in table:
        try:
            work, seconds = float(row[WORK]), float(row[SECONDS])
        except (TypeError, ValueError):
            sys.exit(f"work_plot: line {table.line_num}: needs two numbers, got {row[WORK]!r} and "
                     f"{row[SECONDS]!r}")
        if 0 < work < math.inf and 0 < seconds < math.inf:  # others have no place on these axes
            rows.append((row.get("set") or "", row["instance"], work, seconds))
    if not rows:
        sys.exit("work_plot: needs a row with positive work and seconds, got none")
    return sorted(rows, key=lambda row: (row[0], row[2]))


class Picture:
    def __init__(self, works, seconds):
        (self.left, self.right), (self.low, self.high) = decades(works), decades(seconds)
        self.right = max(self.right, self.left + 1)
        self.high = max(self.high, self.low + 1)
        self.out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
                    'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" '
                    'fill="white"/>']

    def x(self, work):
        share = (math.log10(work) - self.left) / (self.right - self.left)
        return MARGIN + share * (WIDTH - 2 * MARGIN)

    def y(self, seconds):
        share = (math.log10(seconds) - self.low) / (self.high - self.low)
        return HEIGHT - MARGIN - share * (HEIGHT - 2 * MARGIN)

    def line(self, points, colour, width):
        at = " ".join(f"{self.x(a):.1f},{self.y(b):.1f}" for a, b in points)
        self.out.append(f'<polyline points="{at}" fill="none" stroke="{colour}" '
                        f'stroke-width="{width}"/>')

    def text(self, px, py, words, anchor="middle", colour="#222222"):
        self.out.append(f'<text x="{px:.1f}" y="{py:.1f}" text-anchor="{anchor}" '
                        f'fill="{colour}">{escape(words)}</text>')

    def point(self, work, seconds, colour, title):
        self.out.append(f'<circle cx="{self.x(work):.1f}" cy="{self.y(seconds):.1f}" r="3" '
                        f'fill="{colour}" fill-opacity="0.7"><title>{escape(title)}</title></circle>')

    def axes(self):
        for decade in range(self.left, self.right + 1):
            self.line([(10 ** decade, 10 ** self.low), (10 ** decade, 10 ** self.high)],
                      "#dddddd", 1)
            self.text(self.x(10 ** decade), HEIGHT - MARGIN + 18, f"1e{decade}")
        for decade in range(self.low, self.high + 1):
            self.line([(10 ** self.left, 10 ** decade), (10 ** self.right, 10 ** decade)],
                      "#dddddd", 1)
            self.text(MARGIN - 8, self.y(10 ** decade) + 4, f"1e{decade}", "end")
        self.text(WIDTH / 2, HEIGHT - 14, "predicted multiplications of a factorization")

    def slope(self, rate):
        """seconds = work / rate, as far as it is on the picture."""
        first = max(10 ** self.left, 10 ** self.low * rate)
        last = min(10 ** self.right, 10 ** self.high * rate)
        self.line([(first, first / rate), (last, last / rate)], "#888888", 0.8)
        self.text(MARGIN, MARGIN - 22, "seconds for each iteration; the thin line is linear: "
                  f"{rate:.2g} multiplications a second", "start")

    def save(self, name):
        with open(name, "w") as file:
            file.write("\n".join(self.out + ["</svg>"]) + "\n")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: work_plot.py FILE.svg [TABLE.csv]")
    if len(sys.argv) == 3:
        with open(sys.argv[2], newline="") as file:
            rows = read(file)
    else:
        rows = read(sys.stdin)
    picture = Picture([row[2] for row in rows], [row[3] for row in rows])
    picture.axes()
    largest = max(rows, key=lambda row: row[2])
    picture.slope(largest[2] / largest[3])
    sets = sorted({row[0] for row in rows})
    for of, instance, work, seconds in rows:
        picture.point(work, seconds, COLOURS[sets.index(of) % len(COLOURS)],
                      f"{instance}: {work:.3g} multiplications, {seconds:.3g} s")
    for k, of in enumerate(sets):
        picture.text(MARGIN + 12, MARGIN + 16 * (k + 1), of, "start", COLOURS[k % len(COLOURS)])
    picture.save(sys.argv[1])


if __name__ == "__main__":
    main()
