"""Draws the error of each rung of a ladder against its cost, with the Pareto front."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

from ladder_problems import PROBLEMS  # noqa: E402

COLOURS = {"linear": "#0067A5", "quadratic": "#D55E00", "gimp": "#2E8B57"}
MARKERS = {"flip": "o", "apic": "^", "flip modified": "s"}
FRONT = {"color": "black", "linewidth": 2.5, "alpha": 0.3, "marker": "o", "markersize": 9}
COSTS = {"point_steps": "points × steps", "seconds": "time [s]"}


def front(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Those (cost, error) that no other beats in both, by rising cost."""
    best: list[tuple[float, float]] = []
    for cost, error in sorted(points):
        if not best or error < best[-1][1]:
            best.append((cost, error))
    return best


def draw_all(rungs: Sequence, folder: Path, costs: Sequence[str]) -> None:
    for problem in dict.fromkeys(rung.problem for rung in rungs):
        of_problem = [rung for rung in rungs if rung.problem == problem]
        draw(of_problem, folder / f"ladder_{problem}.png", costs)


def draw(rungs: Sequence, picture: Path, costs: Sequence[str]) -> None:
    inches = (1.6 + 3.7 * len(costs), 3.6)
    figure, axes_of = plt.subplots(
        1, len(costs), figsize=inches, sharey=True, layout="constrained", squeeze=False
    )
    panels = axes_of[0]
    for axes, (cost, label) in zip(panels, ((cost, COSTS[cost]) for cost in costs)):
        _draw_panel(axes, rungs, cost)
        axes.set_xlabel(label)
    panels[0].set_ylabel(PROBLEMS[rungs[0].problem].says)
    figure.suptitle(rungs[0].problem, fontsize=10)
    panels[-1].legend(
        handles=_legend(), loc="center left", bbox_to_anchor=(1, 0.5), fontsize=8, frameon=False
    )
    figure.savefig(picture, dpi=150, metadata={"Software": None})
    plt.close(figure)


def _draw_panel(axes: Axes, rungs: Sequence, cost: str) -> None:
    """Lines join the cell sizes of a method; hollow marks have fewer points in a cell."""
    fewest = min(rung.points_per_cell for rung in rungs)
    for key in dict.fromkeys((r.shape_function, r.transfer, r.points_per_cell) for r in rungs):
        shape, transfer, count = key
        line = [r for r in rungs if (r.shape_function, r.transfer, r.points_per_cell) == key]
        axes.plot(
            [getattr(rung, cost) for rung in line],
            [rung.error for rung in line],
            color=COLOURS[shape],
            marker=MARKERS[transfer],
            markerfacecolor="white" if count == fewest else COLOURS[shape],
            markersize=5,
            linewidth=0.7,
        )
    best = front([(getattr(rung, cost), rung.error) for rung in rungs])
    axes.step(*zip(*best), where="post", **FRONT)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(True, color="#DDDDDD", linewidth=0.6)
    axes.tick_params(labelsize=8)


def _legend() -> list[Line2D]:
    def mark(label: str, colour: str, marker: str, face: str) -> Line2D:
        return Line2D([], [], color=colour, marker=marker, markerfacecolor=face, label=label)

    shapes = [Line2D([], [], color=colour, label=shape) for shape, colour in COLOURS.items()]
    transfers = [mark(name, "black", marker, "black") for name, marker in MARKERS.items()]
    few = [mark("fewer points", "black", "o", "white")]
    pareto = [Line2D([], [], label="Pareto front", **FRONT)]
    return shapes + transfers + few + pareto
