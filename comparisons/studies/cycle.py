"""Calls again and again on points that stand still, and the map from one cut to the next."""

from __future__ import annotations

from math import copysign, sqrt

import numpy as np
import pandas as pd
import plot
from intervals import Value, median_of
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from methods import setting_of
from results import Results

LATE = 10  # calls after which what remains is called lasting


def draw_cycle(results: Results) -> Figure | None:
    """Calls on points that stand still, each from the cuts of the one before: medians and 95 %
    intervals over the seeds."""
    calls = results.cycle
    if calls.empty:
        return None
    columns = {"mesh 4, 100 % of the points": [], "mesh 4, 12.5 %": [],
               "other settings of the paper": [], "no samples": []}  # fmt: skip
    for method in calls["method"].unique():
        mesh, _, fraction = setting_of(method) or (0, 0, 0)
        place = 3 if mesh == 0 else 2 if mesh != 4 else {1: 0, 0.125: 1}.get(fraction)
        if place is not None:
            list(columns.values())[place].append(method)
    columns = {name: methods for name, methods in columns.items() if methods}
    number = len(columns)
    figure, grid = plot.panels(2, number, 3.4 * number + 0.8, 7.2, sharex=True, sharey="row")
    for column, (name, methods) in zip(grid.T, columns.items()):
        for method in methods:
            _draw_method(column, method, calls[calls["method"] == method])
        column[0].set_title(name)
        column[1].legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), fontsize=8)
        column[1].set_yscale("symlog", linthresh=1)
        column[1].yaxis.set_major_formatter("{x:g}")
    plot.label_edges(grid, ["call"] * number, ["imbalance", "points that change rank [%]"])
    for axes in grid.flat:
        axes.grid(True, axis="y")
        axes.xaxis.get_major_locator().set_params(integer=True)
    return figure


def _draw_method(column: np.ndarray, method: str, calls: pd.DataFrame) -> None:
    style = plot.method_style(method)
    look = {"color": style.colour, "linestyle": style.line}
    mesh, k, _ = setting_of(method) or (0, 0, 0)
    if mesh == 4:
        line = "-" if (2 * k).is_integer() else "--"
        look = {"color": plot.multiplier_colour(k), "linestyle": line}
    look |= {"marker": ".", "label": method.removeprefix("rrcb-sampled")}
    by_call = calls.groupby("call")
    for axes, name in zip(column, ("imbalance", "moved")):
        values = map(median_of, by_call[name].agg(list))
        plot.draw_line(axes, list(by_call.groups), values, 0.18, **look)


def lasting(calls: pd.DataFrame) -> dict[str, dict[str, Value]]:
    """What a method does for ever to points that stand still: the least and the most imbalance of
    the late calls, and their mean share of points that change rank; medians over the seeds."""
    late = calls[calls["call"] > LATE] if len(calls) else calls
    found = {}
    for method, of_method in late.groupby("method", sort=False) if len(late) else ():
        seeds = of_method.groupby("seed", dropna=False)
        imbalance = seeds["imbalance"]
        values = {"least": imbalance.min(), "most": imbalance.max(), "moved": seeds["moved"].mean()}
        found[method] = {name: median_of(of_seeds) for name, of_seeds in values.items()}
    return found


def cycle_table(calls: pd.DataFrame) -> list[dict[str, str]]:
    return [
        {
            "method": method,
            "seeds": str(found["moved"].count) if setting_of(method) else "–",
            "least imbalance": found["least"].text(4),
            "most": found["most"].text(4),
            "change rank at each call, %": found["moved"].text(2),
        }
        for method, found in lasting(calls).items()
    ]


def next_offset(offset: float, mesh: int, multiplier: float) -> float:
    """The cut of evenly spread points on [0, 1] after that at 1/2 + offset, less 1/2.

    A rank lies on each side of the cut, with `mesh` cells; a box is r = k / √3 times as wide as its
    cell. docs/paper.md derives it; for r < 2 and cuts less than about |r - 1| cells from 1/2.
    """
    r = multiplier / sqrt(3)
    if r > 1:
        return offset * (1 - r / 2 + (r - 1) / (2 * mesh))
    cell = (0.5 + abs(offset)) / mesh  # on the side with more points
    return -copysign((1 - r) * (cell / 2 - abs(offset)), offset)


def alternating_offset(mesh: int, multiplier: float) -> float:
    """How far the cuts of a multiplier below √3 lie from 1/2, to either side in turn, for ever."""
    gap = 1 - multiplier / sqrt(3)
    return gap / (4 * mesh) / (1 + gap * (1 - 1 / (2 * mesh)))


def draw_map() -> Figure:
    """The map of the model with its steps, for a multiplier below, at and above √3; mesh 4."""
    figure, grid = plot.panels(1, 3, 10.5, 4.6, sharey=True)
    for axes, (multiplier, name) in zip(grid[0], ((1.5, "1.5"), (sqrt(3), "√3"), (2, "2"))):
        _draw_steps(axes, 4, multiplier, -0.016)
        axes.set_title(f"k = {name}")
        axes.set_box_aspect(1)
        axes.grid(True)
    plot.label_edges(grid, ["offset of a cut from ½ [%]"] * 3, ["offset of the next [%]"])
    return plot.legend_above(figure, grid[0, 0], inches=2.2)


def _draw_steps(axes: Axes, mesh: int, multiplier: float, start: float) -> None:
    reach = 0.02
    ends = [-100 * reach, 100 * reach]
    axes.plot(ends, ends, color="#999999", linewidth=0.8, label="a cut that stays")
    for side in (-1, 1):
        offsets = side * np.linspace(1e-9, reach, 50)
        mapped = [100 * next_offset(e, mesh, multiplier) for e in offsets]
        label = "the next cut" if side < 0 else None
        axes.plot(100 * offsets, mapped, color=plot.CALL_COLOUR, linewidth=1.8, label=label)
    offset, path = start, [(start, 0.0)]
    for _ in range(12):
        following = next_offset(offset, mesh, multiplier)
        path += [(offset, following), (following, following)]
        offset = following
    x, y = 100 * np.array(path).T
    colour = plot.method_style("rrcb-sampled").colour
    axes.plot(x, y, color=colour, linewidth=1, marker=".", label="twelve calls")
