"""What the root sees instead of the points."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plot
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from results import Results


def draw_support_mesh(results: Results) -> Figure | None:
    """A support mesh with the centroids and standard deviations of its cells."""
    meshes = _by_workload(results, "cells")
    if not meshes:
        return None
    corners = [_corners(cells) for cells in meshes.values()]
    height = (plot.length_ratio(corners) * 8.3 + 0.5) * len(meshes) + 0.4
    figure, grid = plot.panels(len(meshes), 1, 9, height, sharex=True)
    for axes, (workload, cells) in zip(grid[:, 0], meshes.items()):
        num_ranks = cells["rank"].nunique()
        whose = f"{num_ranks} ranks, a colour each"
        if _ranks_overlap(cells):
            cells = cells[cells["rank"] == 0]
            whose = f"rank 0 ({num_ranks} ranks' meshes lie over each other)"
        if len(points := _real_points(results, workload)):
            plot.draw_cloud(axes, points, "#C8C8C8", largest=3)
        _draw_cells(axes, cells)
        axes.set_title(f"{workload}: {len(cells)} cells of {whose}")
        plot.show_lengths(axes, axes is grid[-1, 0])
    colour = plot.PART_COLOURS[0]
    keys = [
        Patch(facecolor=colour + "40", edgecolor=colour, label="cell of a rank"),
        plot.key("points", color="#C8C8C8", marker="o", markersize=3),
        plot.key("centroid", color="black", marker="o", markersize=3),
        plot.key("± standard deviation", color="#333333", linewidth=0.9, linestyle="-"),
    ]
    return plot.legend_above(figure, keys, inches=2.6)


def draw_domains(results: Results) -> Figure | None:
    """The real points and the statistical domain that stands for them, on equal scales."""
    sampled = _by_workload(results, "statistical")
    pairs = {name: (_real_points(results, name), points) for name, points in sampled.items()}
    pairs = {name: (real, points) for name, (real, points) in pairs.items() if len(real)}
    if not pairs:
        return None
    height = (plot.length_ratio(real for real, _ in pairs.values()) * 5.2 + 0.4) * len(pairs) + 0.4
    figure, grid = plot.panels(len(pairs), 2, 11, height, sharex=True, sharey=True)
    for line, (workload, domains) in zip(grid, pairs.items()):
        for axes, points, kind in zip(line, domains, ("real", "statistical")):
            shown = plot.draw_cloud(axes, points, plot.POINT_COLOUR)
            axes.set_title(f"{workload}, {kind} domain ({shown:,} points shown)")
            plot.show_lengths(axes, axes in grid[-1], kind == "real")
    return figure


def _by_workload(results: Results, kind: str) -> dict[str, pd.DataFrame]:
    workloads = results.table["workload"].unique() if len(results.table) else ()
    return {name: data for name in workloads if len(data := results.data(kind, name))}


def _real_points(results: Results, workload: str) -> pd.DataFrame:
    for row in results.table.itertuples():
        if row.workload == workload and len(p := results.data("points", workload, row.method)):
            return p
    return pd.DataFrame()


def _corners(cells: pd.DataFrame) -> pd.DataFrame:
    sides = (cells[[f"{end}_x", f"{end}_y"]] for end in ("lower", "upper"))
    return pd.concat([side.set_axis(["x", "y"], axis=1) for side in sides])


def _ranks_overlap(cells: pd.DataFrame) -> bool:
    """Whether the ranks' meshes together are much larger than the domain they cover."""

    def area(cells: pd.DataFrame) -> float:
        return np.ptp(_corners(cells), axis=0).prod()

    return sum(area(of_rank) for _, of_rank in cells.groupby("rank")) > 1.5 * area(cells)


def _draw_cells(axes: Axes, cells: pd.DataFrame) -> None:
    colours = plot.part_colours(cells["rank"])
    boxes = plot.rectangles(cells)
    for look in (
        {"facecolors": colours, "alpha": 0.25},
        {"facecolors": "none", "edgecolors": colours, "linewidths": 1.2},
    ):
        axes.add_collection(PatchCollection(boxes, **look))
    x, y, dx, dy = (cells[name] for name in ("mean_x", "mean_y", "sigma_x", "sigma_y"))
    bars = [[(a - s, b), (a + s, b)] for a, b, s in zip(x, y, dx)]
    bars += [[(a, b - s), (a, b + s)] for a, b, s in zip(x, y, dy)]
    axes.add_collection(LineCollection(bars, colors="#333333", linewidths=0.9))
    axes.plot(x, y, "o", color="black", markersize=min(2.8, 45 / np.sqrt(len(x))))
