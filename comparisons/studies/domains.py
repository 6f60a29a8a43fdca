"""What kinds of statistical domain leave of the imbalance, at equal bytes into the root."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import pandas as pd
import plot
from document import markdown_table
from driver import OUT, PROGRAMS, build, on_ranks
from intervals import Value
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import read_all

CASE = ["cloud", "dim", "parts", "kind"]
LEAST_ERROR = 1e-6  # of what is divided exactly
LATTICE = "lattice"  # no density helps there
ANALYTIC = "analytic"
KINDS = {  # the method whose look the kind has, and its line
    "box": ("zoltan-rib", (0, (5, 1, 1, 1))),
    ANALYTIC: ("rrcb", "-"),
    "counts": ("zoltan-hsfc", "--"),
    "samples": ("rrcb-sampled", "-."),
    "floor": ("zoltan-rcb", ":"),
}


def errors_of(rows: pd.DataFrame) -> pd.DataFrame:
    """The logarithm of imbalance - 1; `level` numbers the meshes of a kind, coarsest first,
    `repeat` the seeds of a cloud or the moments of a scene."""
    level = rows.groupby(CASE)["cells"].rank("dense").astype(int)
    return rows.assign(
        log_error=np.log((rows["imbalance"] - 1).clip(lower=LEAST_ERROR)),
        level=level,
        repeat=rows.groupby([*CASE, "cells"]).cumcount(),
    )


def mean_errors(errors: pd.DataFrame) -> pd.DataFrame:
    """Geometric means over the clouds but the lattice: of all repeats, and the least and the most
    of one."""
    rows = errors[errors["cloud"] != LATTICE]
    keys = ["dim", "parts", "kind", "level"]
    of_repeat = np.exp(rows.groupby([*keys, "repeat"])["log_error"].mean()).groupby(keys)
    return pd.DataFrame(
        {
            "bytes": rows.groupby(keys)["root_bytes_in"].mean(),
            "number": np.exp(rows.groupby(keys)["log_error"].mean()),
            "low": of_repeat.min(),
            "high": of_repeat.max(),
        }
    ).reset_index()


def ratios(errors: pd.DataFrame, kind: str, other: str = ANALYTIC) -> pd.Series:
    """Logarithm of the error of a kind over another's, by cloud, dimension, parts, level and
    repeat."""
    keys = ["cloud", "dim", "parts", "level", "repeat"]
    by_kind = errors.pivot_table(index=keys, columns="kind", values="log_error")
    return by_kind[kind] - by_kind[other]


def spread_of(logs: pd.Series) -> Value:
    """Geometric mean of ratios, with the least and the most of one repeat."""
    of_repeat = np.exp(logs.groupby("repeat").mean())
    return Value(float(np.exp(logs.mean())), float(of_repeat.min()), float(of_repeat.max()))


def table_of(errors: pd.DataFrame) -> str:
    """Markdown: by cloud and dimension, the error of each kind over the analytic domain's."""
    others = [kind for kind in KINDS if kind != ANALYTIC]
    all_ratios = {kind: ratios(errors, kind) for kind in others}
    lines = [["cloud", "dim", *others]]
    for case, _ in errors.groupby(["cloud", "dim"], sort=False):
        lines.append([*case, *(spread_of(all_ratios[kind].loc[case]).text(2) for kind in others)])
    return markdown_table(lines)


def draw_errors(means: pd.DataFrame) -> Figure:
    """A panel per dimension and number of parts."""
    dimensions, parts = (sorted(means[name].unique()) for name in ("dim", "parts"))
    figure, grid = plot.panels(
        len(dimensions), len(parts), 0.8 + 3.4 * len(parts), 1 + 2.8 * len(dimensions),
        sharex="row", sharey=True,
    )  # fmt: skip
    for line, dimension in zip(grid, dimensions):
        for axes, number in zip(line, parts):
            here = means[(means["dim"] == dimension) & (means["parts"] == number)]
            _draw_case(axes, here)
            axes.set_title(f"{dimension}-D, {number} parts")
    plot.label_edges(grid, "bytes received by rank 0", "imbalance − 1")
    return plot.legend_above(figure, grid[0, 0], inches=1.2)


def _draw_case(axes: Axes, rows: pd.DataFrame) -> None:
    for kind, (method, line) in KINDS.items():
        points = rows[rows["kind"] == kind].sort_values("bytes")
        if len(points):
            columns = (points[name] for name in ("bytes", "number", "low", "high"))
            colour = plot.method_style(method).colour
            plot.draw_line(axes, *columns, label=kind, color=colour, linestyle=line, marker=".")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(True)


def main() -> None:
    parser = argparse.ArgumentParser(prog="comparisons/run --domains", description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT, help="folder of the results; comparisons/out")
    parser.add_argument("--quick", action="store_true", help="a small run of everything")
    arguments = parser.parse_args()
    directory = arguments.out
    directory.mkdir(parents=True, exist_ok=True)
    build("rrcb_domains")
    with (directory / "domains.csv").open("w") as rows:
        words = ["--quick"] * arguments.quick
        on_ranks(1, PROGRAMS / "rrcb_domains", *words, stdout=rows, check=True)
    errors = errors_of(read_all(directory / "domains.csv"))
    plot.use_style()
    plot.save(draw_errors(mean_errors(errors)), directory / "domains.png")
    print(table_of(errors))


if __name__ == "__main__":
    main()
