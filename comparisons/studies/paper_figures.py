"""Figures 2 to 6 of the paper as it has them, and the map from one cut to the next that docs/design/paper.md
derives."""

from __future__ import annotations

from math import copysign, sqrt
from pathlib import Path

import numpy as np
import pandas as pd
import plot
from history import TIME, draw_history, draw_parts_of
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from methods import RCB, WINNERS
from results import Results

START = "slope-start"
CAPTIONS = {
    "paper_figure_2.png": "Figure 2: the slope in six boxes, by the paper's RCB.",
    "paper_figure_3.png": "Figure 3: the support mesh of 10 × 10 cells (red) of one sub-domain of"
    " four, and the centroids of its cells (green).",
    "paper_figure_4.png": "Figure 4: the statistical domain of that sub-domain, 1.5 σ, 100 % of the"
    " points. Bands between the cells stay empty, and the incline is poorly represented.",
    "paper_figure_5.png": "Figure 5: load unbalance of the four sub-domains over the steps, under"
    " RCB and four settings of RRCB. Scales differ.",
    "paper_figure_6.png": "Figure 6: the largest load unbalance of a sub-domain over the steps.",
    "paper_cycle_map.png": "The map from one cut to the next.",
}


def draw_all(out: Path) -> list[str]:
    """Draws the figures whose files are there; returns their names."""
    figures = (draw_boxes, draw_mesh, draw_domain, draw_unbalance, draw_largest, draw_map)
    drawn = {name: figure for name, draw in zip(CAPTIONS, figures) if (figure := draw(out))}
    for name, figure in drawn.items():
        plot.save(figure, out / name)
    return list(drawn)


def draw_boxes(out: Path) -> Figure | None:
    results = Results(out / "six")
    points, boxes = (results.data(kind, START, RCB) for kind in ("points", "boxes"))
    if points.empty:
        return None
    figure, axes = _panel(points)
    plot.draw_cloud(axes, points, plot.part_colours(points["part"]))
    for box in plot.rectangles(boxes, fill=False, linewidth=1.4):
        axes.add_patch(box)
    plot.show_lengths(axes)
    return figure


def draw_mesh(out: Path) -> Figure | None:
    cells = sub_domain(Results(out / "mesh"))
    if cells.empty:
        return None
    corners = pd.DataFrame({axis: cells[[f"lower_{axis}", f"upper_{axis}"]].stack() for axis in "xy"})
    figure, axes = _panel(corners)
    boxes = PatchCollection(plot.rectangles(cells), facecolors="none", edgecolors="#D62728")
    axes.add_collection(boxes)
    axes.plot(cells["mean_x"], cells["mean_y"], "o", color="#2CA02C", markersize=4)
    plot.show_lengths(axes)
    return figure


def draw_domain(out: Path) -> Figure | None:
    results = Results(out / "mesh")
    cells, points = sub_domain(results), results.data("statistical", START)
    if points.empty:
        return None
    inside = points["x"].between(cells["lower_x"].min(), cells["upper_x"].max())
    figure, axes = _panel(points[inside])
    plot.draw_cloud(axes, points[inside], plot.POINT_COLOUR, largest=2)
    plot.show_lengths(axes)
    return figure


def sub_domain(results: Results) -> pd.DataFrame:
    """Cells of the rank with the fewest, which has the incline: cells without points are left out."""
    cells = results.data("cells", START)
    return cells if cells.empty else cells[cells["rank"] == cells["rank"].value_counts().idxmin()]


def _panel(points: pd.DataFrame) -> tuple[Figure, Axes]:
    figure, grid = plot.panels(1, 1, 7, 7 * plot.length_ratio([points]) + 0.7)
    return figure, grid[0, 0]


def _histories(out: Path) -> dict[str, pd.DataFrame]:
    found = Results(out / "simulations").histories()
    return {name: found[name] for name in (RCB, *WINNERS) if name in found}


def draw_unbalance(out: Path) -> Figure | None:
    histories = _histories(out)
    if not histories:
        return None
    figure, grid = plot.panels(len(histories), 1, 8, 1.6 * len(histories) + 0.8, sharex=True)
    for axes, (method, history) in zip(grid[:, 0], histories.items()):
        draw_parts_of(axes, method, history)
        axes.grid(True, axis="y")
    grid[-1, 0].set_xlabel(TIME)
    return figure


def draw_largest(out: Path) -> Figure | None:
    return draw_history(_histories(out))


# --- cuts that alternate ---


def next_offset(offset: float, mesh: int, multiplier: float) -> float:
    """The cut of evenly spread points on [0, 1] after that at 1/2 + offset, less 1/2.

    A rank lies on each side of the cut, with `mesh` cells; a box is r = k / √3 times as wide as its
    cell. docs/design/paper.md derives it; for r < 2 and cuts less than about |r - 1| cells from 1/2.
    """
    r = multiplier / sqrt(3)
    if r > 1:
        return offset * (1 - r / 2 + (r - 1) / (2 * mesh))
    cell = (0.5 + abs(offset)) / mesh  # on the side with more points
    return -copysign((1 - r) * (cell / 2 - abs(offset)), offset)


def draw_map(_: Path) -> Figure:
    """The map of the model with its steps, for a multiplier below, at and above √3; mesh 4."""
    figure, grid = plot.panels(1, 3, 9, 3.8, sharey=True)
    for axes, (multiplier, name) in zip(grid[0], ((1.5, "1.5"), (sqrt(3), "√3"), (2, "2"))):
        _draw_steps(axes, 4, multiplier, -0.016)
        axes.set_title(f"k = {name}")
        axes.set_box_aspect(1)
        axes.grid(True)
    plot.label_edges(grid, "offset of a cut from ½ [%]", "offset of the next [%]")
    return plot.legend_above(figure, grid[0, 0], inches=2.2)


def _draw_steps(axes: Axes, mesh: int, multiplier: float, start: float) -> None:
    reach = 0.02
    ends = [-100 * reach, 100 * reach]
    axes.plot(ends, ends, color="#999999", linewidth=0.8, label="fixed points")
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
    axes.plot(x, y, color=colour, linewidth=1, marker="o", markersize=4, label="twelve calls")
