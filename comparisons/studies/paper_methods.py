"""Draws what docs/paper.md shows: paper_methods.py DIRECTORY writes the flow charts of the paper's
RCB and RRCB and the map from one cut to the next."""

from __future__ import annotations

import sys
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import plot
from cycle import draw_map
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch, Patch

EVERY_RANK, ROOT, MESSAGE = "every rank", "root", "message"
COLOURS = {EVERY_RANK: "#DCEBF5", ROOT: "#FBE3D0", MESSAGE: "#FFFFFF"}

Step = tuple[str, str]
SHARED: list[Step] = [
    (ROOT, "cut each box across its longest axis\nuntil there is a box for every process"),
    (MESSAGE, "the boxes to every rank"),
    (EVERY_RANK, "find the box of each of its points"),
    (MESSAGE, "points go to the rank of their box"),
]
METHODS: dict[str, list[Step]] = {
    "RCB": [
        (EVERY_RANK, "take the points"), (MESSAGE, "all points to the root"), *SHARED,
    ],  # fmt: skip
    "RRCB": [
        (EVERY_RANK, "lay a support mesh of n × n cells\nover the box of its points"),
        (EVERY_RANK, "in each cell: number of points,\nmean and σ of their positions per axis"),
        (MESSAGE, "cells that hold points to the root"),
        (ROOT, "draw the statistical domain: in mean ± k σ\nof each cell points as its share of a"
         " fraction\nof all, pseudo-random, from a fixed seed"),
        *SHARED,
    ],
}


def draw_methods() -> Figure:
    figure, grid = plot.panels(1, len(METHODS), 8.6, 7.2)
    longest = max(map(len, METHODS.values()))
    arrow = {"arrowstyle": "-|>", "color": "#444444"}
    for axes, (name, steps) in zip(grid[0], METHODS.items()):
        # The steps that both have stand beside each other.
        places = [*range(len(steps) - len(SHARED)), *range(longest - len(SHARED), longest)]
        for number, (place, step) in enumerate(zip(places, steps)):
            _draw_step(axes, -place, step)
            if number > 0:
                tip, tail = (0, -place + 0.3), (0, -places[number - 1] - 0.3)
                axes.annotate("", tip, tail, arrowprops=arrow)
        axes.set_title(f"the paper's {name}")
        axes.set_xlim(-1.05, 1.05)
        axes.set_ylim(-longest + 0.5, 0.5)
        axes.set_axis_off()
    handles = [Patch(facecolor=c, edgecolor="#444444", label=n) for n, c in COLOURS.items()]
    figure.legend(handles=handles, loc="lower center", ncol=len(handles))
    figure.supxlabel(" ", fontsize=16)  # keeps room for the legend
    return figure


def _draw_step(axes: Axes, y: float, step: Step) -> None:
    kind, text = step
    axes.add_patch(
        FancyBboxPatch(
            (-0.95, y - 0.3), 1.9, 0.6, boxstyle="round,pad=0,rounding_size=0.1",
            facecolor=COLOURS[kind], edgecolor="#444444", linestyle="--" if kind == MESSAGE else "-",
        )
    )  # fmt: skip
    axes.text(0, y, text, ha="center", va="center", fontsize=9)


def main() -> int:
    if len(sys.argv) != 2 or not (directory := Path(sys.argv[1])).is_dir():
        print("usage: paper_methods.py DIRECTORY", file=sys.stderr)
        return 2
    plot.use_style()
    plot.save(draw_methods(), directory / "paper_methods.png")
    plot.save(draw_map(), directory / "paper_cycle_map.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
