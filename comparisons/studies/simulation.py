"""Where the time of the whole simulation goes under each balancer."""

from __future__ import annotations

import plot
from intervals import decimals, value_of
from machine import CORES
from matplotlib.figure import Figure
from results import Results


def draw_simulation(results: Results) -> Figure | None:
    """Where the time of the whole simulation goes, on the critical path."""
    runs = results.runs
    if runs.empty:
        return None
    ideals = runs["step_work_s"] / runs["ranks"]
    beyond = (runs["step_path_s"] + runs["step_network_s"] - ideals).clip(lower=0)
    balancing = runs["balance_path_s"] + runs["balance_network_s"]
    figure, grid = plot.panels(1, 1, 11, 0.42 * len(runs) + 1.6)
    axes = grid[0, 0]
    ends = 0 * ideals
    for name, seconds, colour, hatch in (
        ("steps, all work / ranks", ideals, plot.IDEAL_COLOUR, ""),
        ("steps beyond it: unbalance, noise, messages", beyond, plot.UNBALANCE_COLOUR, ""),
        ("balancing", balancing, plot.CALL_COLOUR, "///"),
    ):
        axes.barh(runs["method"], seconds, left=ends, color=colour, hatch=hatch, edgecolor="white",
                  label=name)  # fmt: skip
        ends = ends + seconds
    digits = decimals(ends, 3)
    for row, (run, end) in enumerate(zip(runs.itertuples(), ends)):
        path = value_of(run, "critical_path_s").text(digits)
        text = f" {path} s, mean imbalance {run.mean_imbalance:.4f}; wall {run.wall_s:.{digits}f} s"
        axes.text(end, row, text, va="center", fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.7 * ends.max())
    axes.set_xlabel("critical path [s]: what the run would take with a core for every rank")
    first = runs.iloc[0]
    axes.set_title(
        f"The whole simulation: {first['points']:,} points, {first['steps']:,} steps,"
        f" {first['ranks']} ranks" + f" that share {CORES} cores" * (CORES < first["ranks"])
    )
    return plot.legend_above(figure, axes, inches=3.4)
