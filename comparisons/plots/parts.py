"""The points coloured by part, with the boxes of the parts: figure 2 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from results import Columns, Measurement, read_data, read_table, unique
from style import length_ratio, part_colours, save, show_lengths

MAX_POINTS = 60_000
MARKER_AREA = 0.55
PANEL_WIDTH = 4.2


def draw_parts(directory: Path, picture: Path) -> bool:
    """A panel per method (rows) and workload (columns); methods without points are left out."""
    rows = {(row.method, row.workload): row for row in read_table(directory)}
    panels = {key: points for key in rows if (points := read_data(directory, "points", *key[::-1]))}
    if not panels:
        return False
    methods = unique([method for method, _ in panels])
    workloads = unique([workload for _, workload in panels])
    height = length_ratio(panels.values()) * PANEL_WIDTH + 0.5
    figure, axes = plt.subplots(
        len(methods),
        len(workloads),
        figsize=(PANEL_WIDTH * len(workloads) + 0.7, height * len(methods) + 0.5),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    for i, method in enumerate(methods):
        for j, workload in enumerate(workloads):
            panel = axes[i, j]
            show_lengths(panel, i == len(methods) - 1, j == 0)
            if points := panels.get((method, workload)):
                _draw_points(panel, points)
                _draw_boxes(panel, points, read_data(directory, "boxes", workload, method))
                panel.set_title(_title(rows[method, workload]), fontsize=9)
    save(figure, picture)
    return True


def _draw_points(axes: Axes, points: Columns) -> None:
    chosen = slice(None, None, len(points["x"]) // MAX_POINTS + 1)
    axes.scatter(
        points["x"][chosen],
        points["y"][chosen],
        c=part_colours(points["part"][chosen]),
        s=MARKER_AREA,
        linewidths=0,
        rasterized=True,
    )


def _draw_boxes(axes: Axes, points: Columns, boxes: Columns | None) -> None:
    """The parts' boxes, their open sides ended at the points, numbered where their points are."""
    if boxes is None:
        return
    limits = {axis: (points[axis].min(), points[axis].max()) for axis in "xy"}
    for k, part in enumerate(boxes["part"]):
        x0, x1 = np.clip([boxes["lower_x"][k], boxes["upper_x"][k]], *limits["x"])
        y0, y1 = np.clip([boxes["lower_y"][k], boxes["upper_y"][k]], *limits["y"])
        axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, lw=0.8, ec="black"))
        mine = points["part"] == part
        if mine.any():
            axes.text(
                points["x"][mine].mean(),
                points["y"][mine].mean(),
                f"{part:.0f}",
                ha="center",
                va="center",
                fontsize=8,
                bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8},
            )


def _title(row: Measurement) -> str:
    return f"{row.method}\n{row.workload}, imbalance {row.imbalance:.4f}"
