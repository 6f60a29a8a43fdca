"""Draws figures 1 to 6 of the paper, and the map from one cut to the next that docs/design/paper.md derives."""

from __future__ import annotations

from math import copysign, sqrt
from pathlib import Path

import numpy as np
import pandas as pd
import plot
from history import draw_history
from intervals import ONE, Value
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from methods import RCB, WINNERS, setting_of
from PIL import Image
from results import Results, sound
from simulation import of_method, once, paired

START = "slope-start"
SERIAL = "serial"
FINEST = "rrcb-sampled[mesh=10,k=1.5,fraction=1]"  # of figures 3 and 4
CHART_K = (1, 1.5, 2)  # of figure 5
CAPTIONS = {
    "paper_figure_1.png": "Figure 1: the procedures of the paper (left) and of the library (right).",
    "paper_figure_2.png": "Figure 2: the slope in six boxes, by the paper's RCB.",
    "paper_figure_3.png": "Figure 3: the support mesh of 10 × 10 cells (red) of one sub-domain of"
    " four, its points (grey), and the centroids of its cells (green).",
    "paper_figure_4.png": "Figure 4: the statistical domain of the four sub-domains, 1.5 σ, 100 % of the"
    " points. Bands between the cells stay empty, and the incline is poorly represented.",
    "paper_figure_5.png": "Figure 5: speed-up of the simulation on 4 ranks, rebalanced at each step, and its 95 % intervals.",
    "paper_figure_6.png": "Figure 6: the largest load unbalance of a sub-domain over the steps.",
    "paper_cycle_map.png": "The map from one cut to the next.",
}


def draw_all(out: Path) -> list[str]:
    """Draws the figures whose files exist. Returns their names."""
    figures = (draw_procedures, draw_boxes, draw_mesh, draw_domain, draw_speed_ups, draw_largest, draw_map)
    drawn = {name: figure for name, draw in zip(CAPTIONS, figures) if (figure := draw(out))}
    for name, figure in drawn.items():
        plot.save(figure, out / name)
    draw_together(out, [name for name in drawn if name[-5] in "1234"])
    return list(drawn)


def draw_together(out: Path, names: list[str]) -> None:
    """Draws the figures small and below each other, for the page that discusses them."""
    images = [plot.plt.imread(out / name) for name in names]
    if not images:
        return
    heights = [image.shape[0] / image.shape[1] for image in images]
    figure, grid = plot.panels(len(images), 1, 4, 4 * sum(heights), height_ratios=heights)
    for axes, image in zip(grid[:, 0], images):
        axes.imshow(image, interpolation="antialiased")
        axes.axis("off")
    path = out / "paper_figure_all.png"
    plot.save(figure, path)
    Image.open(path).convert("RGB").quantize(96).save(path, optimize=True)


MOMENTS = ("every rank", "lays a support mesh over its points;\nsends count, mean and σ of each cell")
PROCEDURES = {
    "the paper's RRCB, at each step": (
        MOMENTS,
        ("rank 0", "draws random points within mean ± k σ"),
        ("rank 0", "bisects the drawn points\nacross the longest axis of each box"),
        ("rank 0", "broadcasts the boxes"),
        ("every rank", "sends each point to the rank of its box"),
    ),
    "the library, when it pays": (
        MOMENTS,
        ("rank 0", "makes a density of each cell"),
        ("rank 0", "bisects the densities\nacross the axis with fewest points near"),
        ("every rank", "counts its points near the cuts;\nthe cuts move until the parts are even"),
        ("every rank", "sends each point to the rank of its box"),
    ),
}


def draw_procedures(_: Path) -> Figure:
    """Draws a box for each step, from top to bottom. Steps of rank 0 are grey."""
    figure, grid = plot.panels(1, 2, 9, 4.4)
    for axes, (title, steps) in zip(grid[0], PROCEDURES.items()):
        for line, (who, text) in enumerate(steps):
            look = {"boxstyle": "round", "facecolor": "#E0E0E0" if who == "rank 0" else "white"}
            arrow = {"arrowstyle": "<-", "shrinkB": 16} if line else None
            axes.annotate(f"{who}: {text}", (0.5, -max(0, line - 1)), (0.5, -line), ha="center", va="center",
                          bbox=look, arrowprops=arrow)  # fmt: skip
        axes.set(title=title, xlim=(0, 1), ylim=(0.5 - len(steps), 0.5))
        axes.axis("off")
    return figure


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
    points = Results(out / "mesh").data("points", START, FINEST)
    low, high = corners.min(), corners.max()
    inside = points[((points[["x", "y"]] >= low) & (points[["x", "y"]] <= high)).all(axis=1)]
    axes.plot(inside["x"], inside["y"], ".", color="#BBBBBB", markersize=1.5)
    boxes = PatchCollection(plot.rectangles(cells), facecolors="none", edgecolors="#D62728")
    axes.add_collection(boxes)
    axes.plot(cells["mean_x"], cells["mean_y"], "o", color="#2CA02C", markersize=4)
    plot.show_lengths(axes)
    return figure


def draw_domain(out: Path) -> Figure | None:
    points = Results(out / "mesh").data("statistical", START)
    if points.empty:
        return None
    figure, axes = _panel(points)
    plot.draw_cloud(axes, points, plot.POINT_COLOUR, largest=2)
    plot.show_lengths(axes)
    return figure


def sub_domain(results: Results) -> pd.DataFrame:
    """Returns the cells of the rank with the fewest, which contains the incline: cells without points are left out."""
    cells = results.data("cells", START)
    return cells if cells.empty else cells[cells["rank"] == cells["rank"].value_counts().idxmin()]


def _panel(points: pd.DataFrame) -> tuple[Figure, Axes]:
    figure, grid = plot.panels(1, 1, 7, 7 * plot.length_ratio([points]) + 0.7)
    return figure, grid[0, 0]


def _histories(out: Path) -> dict[str, pd.DataFrame]:
    found = Results(out / "simulations").histories()
    return {name: found[name] for name in (RCB, *WINNERS) if name in found}


def draw_speed_ups(out: Path) -> Figure | None:
    speeds = speed_ups(out / "grid")
    settings = {method: setting_of(method) for method in speeds if setting_of(method)}
    if not settings:
        return None
    fractions = sorted({setting[2] for setting in settings.values()}, reverse=True)
    figure, grid = plot.panels(1, len(fractions), 3 * len(fractions) + 0.5, 3.4, sharey=True)
    points = Results(out / "grid").all_runs["points"].iloc[0]
    for axes, fraction in zip(grid[0], fractions):
        for k, line in zip(CHART_K, (":", "-", "--")):
            found = sorted((mesh, speeds[method]) for method, (mesh, of, part) in settings.items()
                           if (of, part) == (k, fraction))  # fmt: skip
            if found:
                meshes, values = zip(*found)
                numbers, lows, highs = zip(*((v.number, *v.reach) for v in values))
                look = {"color": plot.method_style("rrcb-sampled").colour, "linestyle": line, "marker": "."}
                plot.draw_line(axes, meshes, numbers, lows, highs, label=f"k = {k:g}", **look)
        levels = ((speeds.get(RCB), RCB, "the paper's RCB"), (speeds.get("rrcb"), "rrcb", "rrcb"), (ONE, "none", "serial"))
        for value, method, label in (level for level in levels if level[0]):
            colour = plot.method_style(method).colour
            axes.axhline(value.number, color=colour, label=label)
            axes.axhspan(*value.reach, color=colour, alpha=0.15, linewidth=0)
        axes.set(title=f"{points * fraction:,.0f} points drawn", xlabel="cells along an axis")
        axes.grid(True)
    grid[0, 0].set_ylabel("speed-up of the simulation")
    grid[0, 0].set_ylim(bottom=0)
    return plot.legend_above(figure, grid[0, 0])


def speed_ups(folder: Path) -> dict[str, Value]:
    """Returns for each method the critical path of the serial run divided by its own, as the median of pairs of a round."""
    runs = once(sound(Results(folder).all_runs))
    if runs.empty or SERIAL not in set(runs["method"]):
        return {}
    methods = [method for method in runs["method"].unique() if method not in (SERIAL, "none")]
    return {method: paired(runs, runs["critical_path_s"], SERIAL, method) for method in methods}


def moved_shares(folder: Path) -> dict[str, float]:
    """Returns for each method the mean share of the points that a call of the first round moves, except the first call."""
    histories = Results(folder).histories()
    return {method: rows[rows["step"] > rows["step"].min()]["moved_fraction"].mean() for method, rows in histories.items()}


def grid_table(out: Path) -> pd.DataFrame:
    """Returns the speed-ups of figure 5, with the steps, the moved share and the imbalance of each setting."""
    runs, moved = once(sound(Results(out / "grid").all_runs)), moved_shares(out / "grid")
    lines = [
        {"setting": method, "speed-up": speed.text(2), "steps": f"{runs['steps'].iloc[0]}",
         "moved in a call, %": f"{100 * moved.get(method, 0):.2g}",
         "mean imbalance": of_method(runs, runs["mean_imbalance"], method).text(4)}
        for method, speed in speed_ups(out / "grid").items()
    ]  # fmt: skip
    return pd.DataFrame(lines)


def draw_largest(out: Path) -> Figure | None:
    return draw_history(_histories(out))


# --- cuts that alternate ---


def next_offset(offset: float, mesh: int, multiplier: float) -> float:
    """Returns the offset from 1/2 of the cut that follows a cut at 1/2 + offset, for uniform points on [0, 1].

    On each side of the cut is a rank with `mesh` cells. A box is r = k / √3 times as wide as its cell. The model is
    valid for r < 2 and cuts less than about |r - 1| cells from 1/2. docs/design/paper.md derives it.
    """
    r = multiplier / sqrt(3)
    if r > 1:
        return offset * (1 - r / 2 + (r - 1) / (2 * mesh))
    cell = (0.5 + abs(offset)) / mesh  # on the side with more points
    return -copysign((1 - r) * (cell / 2 - abs(offset)), offset)


def draw_map(_: Path) -> Figure:
    """Draws the map of the model with its steps, for multipliers below, at and above √3, with a mesh of 4."""
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
