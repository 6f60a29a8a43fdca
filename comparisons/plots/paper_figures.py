"""Figures 2 and 6 of the paper: the boxes of six processes, and the load over the simulation."""

from __future__ import annotations

from pathlib import Path
from statistics import mode

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from history import draw_parts_of
from results import Columns, read_data, read_histories, read_study_history
from settings import SETTING, handles_of, legend_above, setting_of, values_of
from speed_up import EVERY_STEP, SIMULATIONS, WINNERS, read_speed_ups
from style import draw_cloud, length_ratio, multiplier_colour, part_colours, save, show_lengths

SIX = "six-boxes"  # the driver's name of the data of figure 2
CONFIGURATIONS = ("root-rcb", *WINNERS)


def draw_figure_2(directory: Path, picture: Path) -> bool:
    """The statistical domain bisected into a box for each of six processes, and the points."""
    samples = read_data(directory, "statistical", SIX)
    points = read_data(directory, "points", SIX, "rrcb-sampled")
    boxes = read_data(directory, "boxes", SIX, "rrcb-sampled")
    if samples is None or points is None or boxes is None:
        return False
    height = length_ratio([points, samples]) * 5.2 + 0.8
    figure, panels = plt.subplots(1, 2, figsize=(11, height), sharex=True, sharey=True)
    for axes, cloud, name in zip(panels, (samples, points), ("statistical domain", "points")):
        shown = draw_cloud(axes, cloud, part_colours(_box_of(cloud, boxes)))
        _outline(axes, boxes)
        axes.set_title(f"{name} in {len(boxes['part'])} boxes ({shown:,} shown)")
        show_lengths(axes, y_label=axes is panels[0])
    save(figure, picture)
    return True


def _box_of(cloud: Columns, boxes: Columns) -> np.ndarray:
    """Part of each point; the outer faces are open, and an inner one belongs to a box beside it."""
    parts = np.zeros(len(cloud["x"]))
    for i, part in enumerate(boxes["part"]):
        inside = np.ones(len(cloud["x"]), dtype=bool)
        for axis in "xy":
            lower, upper = boxes["lower_" + axis], boxes["upper_" + axis]
            inside &= (cloud[axis] >= lower[i]) | (lower[i] == lower.min())
            inside &= (cloud[axis] <= upper[i]) | (upper[i] == upper.max())
        parts[inside] = part
    return parts


def _outline(axes: Axes, boxes: Columns) -> None:
    names = ("lower_x", "lower_y", "upper_x", "upper_y")
    for x0, y0, x1, y1 in zip(*(boxes[name] for name in names)):
        axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, linewidth=1.2))


def draw_figure_6(directory: Path, picture: Path) -> bool:
    """Lu of every part, with its sign, under the paper's RCB and its RRCB with four settings."""
    histories, every = _configurations(directory)
    if not histories:
        return False
    figure, grid = plt.subplots(
        len(histories), 1, figsize=(8, 1.6 * len(histories) + 0.8), squeeze=False, sharex=True
    )
    for axes, (method, history) in zip(grid[:, 0], histories.items()):
        draw_parts_of(axes, f"{method}, rebalanced every {every}", history)
        axes.grid(True, axis="y")
    grid[-1, 0].set_xlabel("time simulated [s]")
    save(figure, picture)
    return True


def _configurations(directory: Path) -> tuple[dict[str, Columns], str]:
    """Of the runs that rebalance at every step, where there are any."""
    for file, prefix in ((EVERY_STEP, "paper_history"), (SIMULATIONS, "history")):
        runs = [s.run for s in read_speed_ups(directory, file) if s.run.method in CONFIGURATIONS]
        if not runs:
            continue
        ranks = mode([run.ranks for run in runs])
        histories = read_histories(directory, f"{prefix}_*_{ranks}.csv")
        chosen = {name: histories[name] for name in CONFIGURATIONS if name in histories}
        return chosen, "step" if runs[0].every == 1 else f"{runs[0].every} steps"
    return {}, ""


def draw_study_history(directory: Path, picture: Path) -> bool:
    """Largest |Lu| over the steps, a panel per mesh and fraction, a line per k."""
    runs = [s.run for s in read_speed_ups(directory) if SETTING.fullmatch(s.run.method)]
    if not runs:
        return False
    histories = read_study_history(directory, mode([run.ranks for run in runs]))
    if not histories:
        return False
    methods = sorted(histories, key=setting_of)
    meshes = sorted(values_of(methods, 1))
    fractions = values_of(methods, 3)
    figure, grid = plt.subplots(
        len(meshes),
        len(fractions),
        figsize=(2.8 * len(fractions) + 0.6, 1.7 * len(meshes) + 0.9),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    for method in methods:
        mesh, k, fraction = setting_of(method)
        axes = grid[meshes.index(mesh), fractions.index(fraction)]
        colour = multiplier_colour(k)
        times, worst = _worst_over_time(histories[method])
        axes.plot(times, worst, color=colour, linewidth=0.9, label=f"k = {k:g}")
    for axes, fraction in zip(grid[0], fractions):
        axes.set_title(f"{100 * fraction:g} % of the points")
    for axes, mesh in zip(grid[:, 0], meshes):
        axes.set_ylabel(f"mesh {mesh:g}\nlargest |Lu| [%]")
    for axes in grid.flat:
        axes.set_yscale("log")
        axes.grid(True, axis="y")
    for axes in grid[-1]:
        axes.set_xlabel("time simulated [s]")
    legend_above(figure, handles_of(grid.flat))
    save(figure, picture)
    return True


def _worst_over_time(history: dict[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    times, where = np.unique(history["time"], return_inverse=True)
    worst = np.zeros(len(times))
    np.maximum.at(worst, where, np.abs(history["lu_percent"]))
    return times, worst
