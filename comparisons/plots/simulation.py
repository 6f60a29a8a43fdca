"""Where the time of the whole simulation goes under each balancer."""

from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot as plt

from results import read_simulations
from style import method_style, save


def draw_simulation(directory: Path, picture: Path) -> bool:
    """A bar per method: steps of the simulation, balancing, and the rest."""
    runs = read_simulations(directory)
    if not runs:
        return False
    methods = [run.method for run in runs]
    figure, axes = plt.subplots(figsize=(8, 0.5 * len(runs) + 1.3))
    left = [0.0] * len(runs)
    for name, seconds, colour, hatch in (
        ("steps of the simulation", [run.step for run in runs], "#9DC3E0", ""),
        ("balancing", [run.balance for run in runs], "#D55E00", "///"),
        ("rest", [max(run.wall - run.step - run.balance, 0) for run in runs], "#DDDDDD", ""),
    ):
        axes.barh(
            methods, seconds, left=left, color=colour, hatch=hatch, edgecolor="white", label=name
        )
        left = [start + length for start, length in zip(left, seconds)]
    for row, (run, end) in enumerate(zip(runs, left)):
        text = (
            f" {run.wall:.3g} s, balancing {run.balance:.2g} s,"
            f" mean imbalance {run.mean_imbalance:.3f}"
        )
        axes.text(end, row, text, va="center", fontsize=8)
    for tick, method in zip(axes.get_yticklabels(), methods):
        tick.set_color(method_style(method).colour)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.75 * max(left))
    axes.set_xlabel("wall time [s]")
    first = runs[0]
    axes.set_title(
        f"The whole simulation: {first.points:,} points, {first.steps:,} steps,"
        f" {first.ranks} ranks",
        pad=24,
    )
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)
    save(figure, picture)
    return True
