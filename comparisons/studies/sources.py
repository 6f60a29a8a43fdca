"""Where the error of an estimate comes from: from the points to the samples, stage by stage."""

from __future__ import annotations

import pandas as pd
import plot
from intervals import Value, mean_of, median_of
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import Results, cases

CELLS, CUT_OFF, WHOLE = (
    plot.method_style(name).colour for name in ("rrcb", "rrcb[tol=1.05]", "rrcb[tol=1.1]")
)
FEW, AS_MANY, MORE = (
    plot.method_style(f"rrcb-sampled{setting}").colour
    for setting in ("[mesh=2,k=1.5,fraction=0.25]", "", "[mesh=8,k=2,fraction=0.125]")
)
K_1, K_1_5, _, K_2_5 = plot.MULTIPLIER_COLOURS
STAGES = {  # colour and line of each, and which rows it is drawn of
    "cells, as RRCB does": (CELLS, "-", "domain == 'cells'"),
    "boxes of √3 σ, cut off at the cell": (CUT_OFF, ":", "domain == 'in_cells'"),
    "boxes of √3 σ, cut off at all points": (CUT_OFF, "-.", "domain == 'in_all'"),
    "boxes of √3 σ": (WHOLE, "--", "domain == 'boxes' and 1.7320498 < k < 1.7320518"),
    "boxes of 1 σ": (K_1, ":", "domain == 'boxes' and k == 1"),
    "boxes of 1.5 σ": (K_1_5, "-", "domain == 'boxes' and k == 1.5"),
    "boxes of 2.5 σ": (K_2_5, "-.", "domain == 'boxes' and k == 2.5"),
    "samples of 1.5 σ, 400 %": (MORE, "--", "domain == 'sampled' and fraction == 4"),
    "samples of 1.5 σ, 100 %": (AS_MANY, "-", "domain == 'sampled' and fraction == 1"),
    "samples of 1.5 σ, 12.5 %": (FEW, "-.", "domain == 'sampled' and fraction == 0.125"),
}


def draw_sources(results: Results) -> Figure | None:
    """Imbalance when what is bisected goes from all points to a sample of them: the support mesh
    adds what lies between the points and the cells, another half-width than √3 σ, or a box cut off,
    what lies between cells and boxes, the sampling what lies above the boxes (lines: medians over
    the seeds, bands: their 95 % intervals)."""
    rows = results.sources
    if rows.empty:
        return None
    by_case = cases(rows)
    figure = plot.small_multiples(
        list(by_case), lambda axes, case: _draw_case(axes, by_case[case]), (0.6, 1.1),
        "support mesh, cells per axis", "imbalance − 1, at least a point",
    )  # fmt: skip
    return plot.legend_above(figure, figure.axes[0], inches=2.4)


def _draw_case(axes: Axes, rows: pd.DataFrame) -> None:
    exact = rows.loc[rows["domain"] == "points", "excess"].iloc[0]
    axes.axhline(exact, color="#000000", linewidth=0.8, label="all points")
    for label, (colour, line, chosen) in STAGES.items():
        by_mesh = rows.query(chosen).groupby("mesh")["excess"].agg(list).map(median_of)
        if len(by_mesh):
            look = {"color": colour, "linestyle": line, "marker": ".", "label": label}
            plot.draw_line(axes, by_mesh.index, by_mesh, **look)
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_yscale("log")
    axes.grid(True)


def source_table(rows: pd.DataFrame) -> list[dict[str, str]]:
    """Imbalance beyond 1 in percent, per mesh and stage."""
    meshes = sorted(set(rows["mesh"]) - {0})
    exact = mean_excess(rows[rows["domain"] == "points"]).text(3, "g")
    table = [{"what is bisected": "all points (one point at least)"}]
    table[0] |= {f"mesh {mesh}": exact for mesh in meshes}
    for label, (*_, chosen) in STAGES.items():
        stage = rows.query(chosen)
        if len(stage):
            of = {f"mesh {mesh}": mean_excess(stage[stage["mesh"] == mesh]) for mesh in meshes}
            texts = {name: value.text(3, "g") for name, value in of.items()}
            table.append({"what is bisected": label, **texts})
    return table


def mean_excess(rows: pd.DataFrame) -> Value:
    """In percent: geometric mean over the clouds of the medians over the seeds, with that of the
    ends of their intervals."""
    return mean_of(map(median_of, rows.groupby("case", sort=False)["excess"].agg(list))) * 100
