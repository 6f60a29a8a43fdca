"""The points coloured by part, with the boxes and the loads of the parts: figure 2 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from results import Columns, Measurement, read_data, read_table, unique
from style import draw_cloud, length_ratio, part_colours, save, show_lengths

PANEL_WIDTH = 4.2
MOST_TEXTS = 8  # parts with their points and Lu written inside; more get their number alone


def draw_parts(directory: Path, picture: Path) -> bool:
    """A panel per method (rows) and workload (columns), or in two columns for one workload.

    Methods that make the same parts of every workload share a row.
    """
    rows = {(row.method, row.workload): row for row in read_table(directory)}
    panels = {key: points for key in rows if (points := read_data(directory, "points", *key[::-1]))}
    if not panels:
        return False
    names = _same_parts(panels)
    panels = {key: points for key, points in panels.items() if key[0] in names}
    grid = _arrange(list(panels))
    height = length_ratio(panels.values()) * PANEL_WIDTH + 0.7
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
        _write_loads(axes[i, j], panels[key], rows[key])
        axes[i, j].set_title(_title(names[key[0]], rows[key]), fontsize=9)
    save(figure, picture)
    return True


def _same_parts(panels: dict[tuple[str, str], Columns]) -> dict[str, list[str]]:
    """By the first of each group of methods, all of the group."""
    made: dict[str, list[bytes]] = {}
    for (method, _), points in panels.items():
        made.setdefault(method, []).append(points["part"].tobytes())
    groups: dict[tuple[bytes, ...], list[str]] = {}
    for method, parts in made.items():
        groups.setdefault(tuple(parts), []).append(method)
    return {methods[0]: methods for methods in groups.values()}


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
    """The parts' boxes, their open sides ended at the points."""
    if boxes is None:
        return
    limits = {axis: (points[axis].min(), points[axis].max()) for axis in "xy"}
    for k in range(len(boxes["part"])):
        x0, x1 = np.clip([boxes["lower_x"][k], boxes["upper_x"][k]], *limits["x"])
        y0, y1 = np.clip([boxes["lower_y"][k], boxes["upper_y"][k]], *limits["y"])
        axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, lw=0.8, ec="black"))


def part_loads(points: Columns, row: Measurement) -> np.ndarray | None:
    """Points of each part; None where the file has not all of them, or their weights differ."""
    loads = np.bincount(points["part"].astype(int), minlength=row.ranks)
    is_all = len(points["part"]) == row.points
    return loads if is_all and abs(loads.max() / loads.mean() - row.imbalance) < 1e-6 else None


def _write_loads(axes: Axes, points: Columns, row: Measurement) -> None:
    """Inside each part its number, and its points and Lu where they are known."""
    loads = part_loads(points, row)
    for part in np.unique(points["part"]).astype(int):
        text = f"{part}"
        if loads is not None and row.ranks <= MOST_TEXTS:
            unbalance = 100 * (1 - loads[part] / loads.mean())
            text += f"\n{loads[part]:,}\n{unbalance:+.2f} %"
        x, y = _middle(points, part)
        axes.text(
            x,
            y,
            text,
            ha="center",
            va="center",
            fontsize=8,
            linespacing=1.05,
            bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8},
        )


def _middle(points: Columns, part: int) -> tuple[float, float]:
    """The point of the part nearest to its mean, which may lie in another part."""
    x, y = (points[axis][points["part"] == part] for axis in "xy")
    nearest = np.argmin((x - x.mean()) ** 2 + (y - y.mean()) ** 2)
    return x[nearest], y[nearest]


def _title(methods: list[str], row: Measurement) -> str:
    lines = [", ".join(methods[i : i + 3]) for i in range(0, len(methods), 3)]
    worst = f"largest |Lu| {row.lu_percent:.2f} %"
    return "\n".join([*lines, f"{row.workload}: imbalance {row.imbalance:.5f}, {worst}"])
