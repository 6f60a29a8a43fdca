"""Where the time of the whole simulation goes under each balancer."""

from __future__ import annotations

import os
from pathlib import Path

from matplotlib import pyplot as plt

from intervals import decimals, with_interval
from results import read_simulations
from settings import legend_above
from style import CALL_COLOUR, IDEAL_COLOUR, UNBALANCE_COLOUR, save


def draw_simulation(directory: Path, picture: Path) -> bool:
    """A bar per method: the critical path, as a core for every rank would give, in parts."""
    runs = read_simulations(directory)
    if not runs:
        return False
    ideals = [run.step_work / run.ranks for run in runs]
    paths = [run.step_path + run.step_network for run in runs]
    figure, axes = plt.subplots(figsize=(11, 0.42 * len(runs) + 1.6))
    rows = [run.method for run in runs]
    left = [0.0] * len(runs)
    for name, seconds, colour, hatch in (
        ("steps, all work / ranks", ideals, IDEAL_COLOUR, ""),
        (
            "steps beyond it: unbalance, noise, messages",
            [max(path - ideal, 0) for path, ideal in zip(paths, ideals)],
            UNBALANCE_COLOUR,
            "",
        ),
        (
            "balancing",
            [run.balance_path + run.balance_network for run in runs],
            CALL_COLOUR,
            "///",
        ),
    ):
        axes.barh(
            rows, seconds, left=left, color=colour, hatch=hatch, edgecolor="white", label=name
        )
        left = [start + length for start, length in zip(left, seconds)]
    digits = decimals(left, 3)
    for row, (run, end) in enumerate(zip(runs, left)):
        path = with_interval(run.critical_path, run.critical_path_interval, digits)
        text = f" {path} s, mean imbalance {run.mean_imbalance:.4f}; wall {run.wall:.{digits}f} s"
        axes.text(end, row, text, va="center", fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.7 * max(left))
    axes.set_xlabel("critical path [s]: what the run would take with a core for every rank")
    first = runs[0]
    cores = os.cpu_count() or 1
    shared = f" that share {cores} cores" if cores < first.ranks else ""
    axes.set_title(
        f"The whole simulation: {first.points:,} points, {first.steps:,} steps,"
        f" {first.ranks} ranks{shared}"
    )
    legend_above(figure, axes.get_legend_handles_labels()[0], inches=3.4)
    save(figure, picture)
    return True
