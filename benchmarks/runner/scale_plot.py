#!/usr/bin/env python3
"""A plot of what graph_scale measured: seconds before any backend over the number of edges.

    graph_scale | scale_plot.py FILE.svg

Both axes are logarithmic; the thin line has slope 1 through the largest graph, so a build that is
linear in its edges runs along it.
"""

import math
import sys

WIDTH, HEIGHT, MARGIN = 640, 420, 64
SERIES = [("total s", "#d55e00"), ("build s", "#0072b2"), ("lower s", "#009e73")]


def read(lines):
    """The header's names, as graph_scale prints them in columns of two words at most, and rows."""
    names = ["size", "edges", "build s", "prune s", "lower s", "total s", "graph MB", "peak MB",
             "us per edge"]
    rows = [dict(zip(names, map(float, line.split()))) for line in lines[1:] if line.strip()]
    if not rows:
        sys.exit("scale_plot: needs the table of graph_scale on standard input, got none")
    return rows


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def main():
    rows = read(sys.stdin.read().splitlines())
    edges = [row["edges"] for row in rows]
    seconds = [max(row[name], 1e-4) for row in rows for name, _ in SERIES]
    (left, right), (low, high) = decades(edges), decades(seconds)

    def x(value):
        return MARGIN + (math.log10(value) - left) / (right - left) * (WIDTH - 2 * MARGIN)

    def y(value):
        return HEIGHT - MARGIN - (math.log10(value) - low) / (high - low) * (HEIGHT - 2 * MARGIN)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
           'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" '
           'fill="white"/>']

    def line(points, colour, width):
        at = " ".join(f"{x(a):.1f},{y(b):.1f}" for a, b in points)
        out.append(f'<polyline points="{at}" fill="none" stroke="{colour}" '
                   f'stroke-width="{width}"/>')

    def text(px, py, words, anchor="middle", colour="#222222"):
        out.append(f'<text x="{px:.1f}" y="{py:.1f}" text-anchor="{anchor}" '
                   f'fill="{colour}">{words}</text>')

    for decade in range(left, right + 1):
        line([(10 ** decade, 10 ** low), (10 ** decade, 10 ** high)], "#dddddd", 1)
        text(x(10 ** decade), HEIGHT - MARGIN + 18, f"1e{decade}")
    for decade in range(low, high + 1):
        line([(10 ** left, 10 ** decade), (10 ** right, 10 ** decade)], "#dddddd", 1)
        text(MARGIN - 8, y(10 ** decade) + 4, f"1e{decade}", "end")
    last = rows[-1]
    slope = last["total s"] / last["edges"]
    start = max(10 ** left, 10 ** low / slope)
    line([(start, slope * start), (last["edges"], last["total s"])], "#888888", 0.8)
    for k, (name, colour) in enumerate(SERIES):
        points = [(row["edges"], max(row[name], 1e-4)) for row in rows]
        line(points, colour, 2)
        out += [f'<circle cx="{x(a):.1f}" cy="{y(b):.1f}" r="3" fill="{colour}"/>'
                for a, b in points]
        text(MARGIN + 12, MARGIN + 16 * k, name.removesuffix(" s"), "start", colour)
    text(WIDTH / 2, HEIGHT - 14, "edges")
    text(MARGIN, MARGIN - 22, "seconds before any backend; the thin line is linear", "start")
    out.append("</svg>")
    with open(sys.argv[1], "w") as file:
        file.write("\n".join(out) + "\n")


if __name__ == "__main__":
    main()
