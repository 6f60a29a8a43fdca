"""What the root sees instead of the points: figures 3 and 4 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from results import Columns, read_data, read_table, unique
from settings import legend_above
from style import (
    PART_COLOURS,
    POINT_COLOUR,
    draw_cloud,
    length_ratio,
    part_colours,
    save,
    show_lengths,
)


def draw_support_mesh(directory: Path, picture: Path) -> bool:
    """Every rank's cells with the centroid and the standard deviation of the points inside."""
    meshes = _by_workload(directory, "cells")
    if not meshes:
        return False
    outlines = [
        {axis: np.append(cells["lower_" + axis], cells["upper_" + axis]) for axis in "xy"}
        for cells in meshes.values()
    ]
    height = length_ratio(outlines) * 8.3 + 0.5
    figure, axes = plt.subplots(
        len(meshes), 1, figsize=(9, height * len(meshes) + 0.4), squeeze=False, sharex=True
    )
    for panel, (workload, cells) in zip(axes[:, 0], meshes.items()):
        num_ranks = len(np.unique(cells["rank"]))
        whose = f"{num_ranks} ranks, a colour each"
        if _ranks_overlap(cells):
            cells = {name: column[cells["rank"] == 0] for name, column in cells.items()}
            whose = f"rank 0 ({num_ranks} ranks' meshes lie over each other)"
        if points := _real_points(directory, workload):
            draw_cloud(panel, points, "#C8C8C8", largest=3)
        _draw_cells(panel, cells)
        panel.set_title(f"{workload}: {len(cells['cell'])} cells of {whose}")
        show_lengths(panel, panel is axes[-1, 0])
    legend_above(figure, _keys(), inches=2.6)
    save(figure, picture)
    return True


def _keys() -> list:
    return [
        Patch(facecolor=PART_COLOURS[0] + "40", edgecolor=PART_COLOURS[0], label="cell of a rank"),
        Line2D([], [], color="#C8C8C8", marker="o", markersize=3, ls="", label="points"),
        Line2D([], [], color="black", marker="o", markersize=3, ls="", label="centroid"),
        Line2D([], [], color="#333333", lw=0.9, label="± standard deviation"),
    ]


def draw_domains(directory: Path, picture: Path) -> bool:
    """The real points and, beside them, the pseudo-random ones that stand for them."""
    sampled = _by_workload(directory, "statistical")
    pairs = {
        workload: (real, statistical)
        for workload, statistical in sampled.items()
        if (real := _real_points(directory, workload))
    }
    if not pairs:
        return False
    height = length_ratio(real for real, _ in pairs.values()) * 5.2 + 0.4
    size = (11, height * len(pairs) + 0.4)
    figure, axes = plt.subplots(
        len(pairs), 2, figsize=size, squeeze=False, sharex=True, sharey=True
    )
    for i, (workload, domains) in enumerate(pairs.items()):
        for j, (points, kind) in enumerate(zip(domains, ("real", "statistical"))):
            shown = draw_cloud(axes[i, j], points, POINT_COLOUR)
            axes[i, j].set_title(f"{workload}, {kind} domain ({shown:,} points shown)")
            show_lengths(axes[i, j], i == len(pairs) - 1, j == 0)
    save(figure, picture)
    return True


def _by_workload(directory: Path, kind: str) -> dict[str, Columns]:
    workloads = unique([row.workload for row in read_table(directory)])
    return {name: data for name in workloads if (data := read_data(directory, kind, name))}


def _real_points(directory: Path, workload: str) -> Columns | None:
    for row in read_table(directory):
        if row.workload == workload:
            if points := read_data(directory, "points", workload, row.method):
                return points
    return None


def _ranks_overlap(cells: Columns) -> bool:
    """Whether the ranks' meshes together are much larger than the domain they cover."""

    def area(of: np.ndarray) -> float:
        return float(
            np.ptp([cells["lower_x"][of].min(), cells["upper_x"][of].max()])
            * np.ptp([cells["lower_y"][of].min(), cells["upper_y"][of].max()])
        )

    ranks = [cells["rank"] == rank for rank in np.unique(cells["rank"])]
    return sum(map(area, ranks)) > 1.5 * area(cells["rank"] >= 0)


def _draw_cells(axes: Axes, cells: Columns) -> None:
    colours = part_colours(cells["rank"])
    corners = zip(cells["lower_x"], cells["lower_y"], cells["upper_x"], cells["upper_y"])
    boxes = [Rectangle((x0, y0), x1 - x0, y1 - y0) for x0, y0, x1, y1 in corners]
    axes.add_collection(PatchCollection(boxes, facecolors=colours, alpha=0.25))
    axes.add_collection(
        PatchCollection(boxes, facecolors="none", edgecolors=colours, linewidths=1.2)
    )
    x, y, dx, dy = (cells[name] for name in ("mean_x", "mean_y", "sigma_x", "sigma_y"))
    bars = [[(a - s, b), (a + s, b)] for a, b, s in zip(x, y, dx)]
    bars += [[(a, b - s), (a, b + s)] for a, b, s in zip(x, y, dy)]
    axes.add_collection(LineCollection(bars, colors="#333333", linewidths=0.9))
    axes.plot(x, y, "o", color="black", markersize=min(2.8, 45 / np.sqrt(len(x))))
