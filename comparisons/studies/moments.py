"""Draws and tabulates the errors of standard deviations: moments.py DIRECTORY with moments_error.csv.

An error that is no number belongs to a standard deviation whose square came out negative.
"""

from __future__ import annotations

import sys
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import pandas as pd
import plot
from document import markdown_table
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import read_all

FLOOR = 1e-17
# Colours that no balancer has, but for RRCB's own.
STYLES = {
    "naive sums": plot.MethodStyle("#7A5C4A", "--", "s"),
    "Welford": plot.MethodStyle("#B0005E", ":", "^"),
    "Chan, pairwise": plot.MethodStyle("#4B5D0B", "-.", "D"),
    "RRCB": plot.method_style("rrcb"),
}


def table_of(errors: pd.DataFrame) -> str:
    """Markdown: a row per cloud, offset and number of points, a column per method."""
    lines = [["points", "offset", "number", *errors["method"].unique()]]
    for (cloud, offset, points), rows in errors.groupby(["cloud", "offset", "points"], sort=False):
        texts = ["no number" if pd.isna(e) else f"{e:.0e}" if e > 0 else "0" for e in rows["error"]]
        lines.append([cloud, f"{offset:.0e}", f"{points:,}", *texts])
    return markdown_table(lines)


def draw_errors(errors: pd.DataFrame) -> Figure:
    figure, grid = plot.panels(1, 2, 9, 3.8, sharey=True)
    left, right = grid[0]
    is_uniform = errors["cloud"] == "uniform"
    _draw_panel(left, errors[is_uniform], "offset")
    _draw_panel(right, errors[~is_uniform], "points")
    left.set_xlabel("offset of a uniform cloud of extent 1")
    left.set_ylabel("relative error of sigma")
    right.set_xlabel("number of points of two values, 0.7 apart at $10^6$")
    left.set_ylim(FLOOR / 2, 1e17)
    left.legend(loc="upper left")
    return figure


def _draw_panel(axes: Axes, errors: pd.DataFrame, abscissa: str) -> None:
    for method, style in STYLES.items():
        mine = errors[errors["method"] == method].dropna(subset="error")
        axes.plot(mine[abscissa], mine["error"].clip(lower=FLOOR), **style.look, markersize=4,
                  label=method)  # fmt: skip
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.axhline(1e-12, color="#BBBBBB", linewidth=0.8)
    axes.grid(True)


def main() -> None:
    directory = Path(sys.argv[1])
    errors = read_all(directory / "moments_error.csv")
    plot.use_style()
    plot.save(draw_errors(errors), directory / "moments_error.png")
    print(table_of(errors))


if __name__ == "__main__":
    main()
