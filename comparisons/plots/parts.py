"""The points coloured by part, with the boxes of the parts: figure 2 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from results import Columns, Measurement, read_data, read_table, unique
from style import draw_cloud, length_ratio, part_colours, save, show_lengths

PANEL_WIDTH = 4.2


def draw_parts(directory: Path, picture: Path) -> bool:
    """A panel per method (rows) and workload (columns), or in two columns for one workload."""
    rows = {(row.method, row.workload): row for row in read_table(directory)}
    panels = {key: points for key in rows if (points := read_data(directory, "points", *key[::-1]))}
    if not panels:
        return False
    grid = _arrange(list(panels))
    height = length_ratio(panels.values()) * PANEL_WIDTH + 0.5
    figure, axes = plt.subplots(
        *grid.shape,
        figsize=(PANEL_WIDTH * grid.shape[1] + 0.7, height * grid.shape[0] + 0.5),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    for (i, j), key in np.ndenumerate(grid):
        show_lengths(axes[i, j], i == grid.shape[0] - 1, j == 0)
        if key not in panels:
            axes[i, j].set_axis_off()
            continue
        draw_cloud(axes[i, j], panels[key], part_colours(panels[key]["part"]))
        _draw_boxes(axes[i, j], panels[key], read_data(directory, "boxes", *key[::-1]))
        axes[i, j].set_title(_title(rows[key]), fontsize=9)
    save(figure, picture)
    return True


def _arrange(keys: list[tuple[str, str]]) -> np.ndarray:
    """Which (method, workload) each panel of the picture shows; None where there is none."""
    methods, workloads = (unique(list(names)) for names in zip(*keys))
    rows = [[(method, workload) for workload in workloads] for method in methods]
    if len(workloads) == 1:
        rows = [keys[i : i + 2] for i in range(0, len(keys), 2)]
    grid = np.full((len(rows), max(map(len, rows))), None, dtype=object)
    for i, row in enumerate(rows):
        for j, key in enumerate(row):
            grid[i, j] = key
    return grid


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
