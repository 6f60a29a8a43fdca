"""The points coloured by part, with the boxes and the loads of the parts."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pandas as pd
import plot
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import Results

PANEL_WIDTH = 4.2
MOST_TEXTS = 8  # parts with their points and Lu written inside; more get their number alone


def draw_parts(results: Results) -> Figure | None:
    """The points, coloured by part, with the boxes of the parts; in each part its number and, where
    every point is drawn, its points and their Lu. All scales are equal."""
    rows = {(row.method, row.workload): row for row in results.table.itertuples()}
    clouds = {key: results.data("points", *key[::-1]) for key in rows}
    clouds = {key: points for key, points in clouds.items() if len(points)}
    if not clouds:
        return None
    names = same_parts(clouds)
    clouds = {key: points for key, points in clouds.items() if key[0] in names}
    places = _places(clouds)
    lines, columns = (1 + max(numbers) for numbers in zip(*places.values()))
    height = (plot.length_ratio(clouds.values()) * PANEL_WIDTH + 0.7) * lines + 0.5
    width = PANEL_WIDTH * columns + 0.7
    figure, grid = plot.panels(lines, columns, width, height, sharex=True, sharey=True)
    for axes in grid.flat:
        axes.set_axis_off()
    for key, (i, j) in places.items():
        axes, points = grid[i, j], clouds[key]
        axes.set_axis_on()
        plot.draw_cloud(axes, points, plot.part_colours(points["part"]))
        _draw_boxes(axes, points, results.data("boxes", *key[::-1]))
        _write_loads(axes, points, rows[key])
        axes.set_title(_title(names[key[0]], rows[key]), fontsize=9)
    for (i, j), axes in np.ndenumerate(grid):
        plot.show_lengths(axes, i == lines - 1, j == 0)
    return figure


def same_parts(clouds: dict[tuple[str, str], pd.DataFrame]) -> dict[str, list[str]]:
    """By the first of each group of methods, all of the group."""
    made: dict[str, list[bytes]] = {}
    for (method, _), points in clouds.items():
        made.setdefault(method, []).append(points["part"].to_numpy().tobytes())
    groups: dict[tuple[bytes, ...], list[str]] = {}
    for method, parts in made.items():
        groups.setdefault(tuple(parts), []).append(method)
    return {methods[0]: methods for methods in groups.values()}


def _places(keys: Iterable[tuple[str, str]]) -> dict[tuple[str, str], tuple[int, int]]:
    """A row per method and a column per workload; two columns of the methods of one workload."""
    methods, workloads = (list(dict.fromkeys(names)) for names in zip(*keys))
    if len(workloads) == 1:
        return {key: divmod(number, 2) for number, key in enumerate(keys)}
    return {key: (methods.index(key[0]), workloads.index(key[1])) for key in keys}


def _draw_boxes(axes: Axes, points: pd.DataFrame, boxes: pd.DataFrame) -> None:
    """The parts' boxes, their open sides ended at the points."""
    for side in [f"{end}_{axis}" for end in ("lower", "upper") for axis in "xy" if len(boxes)]:
        boxes[side] = boxes[side].clip(points[side[-1]].min(), points[side[-1]].max())
    for box in plot.rectangles(boxes, fill=False, lw=0.8, ec="black"):
        axes.add_patch(box)


def part_loads(points: pd.DataFrame, row: object) -> np.ndarray | None:
    """Points of each part; None where the file has not all of them, or their weights differ."""
    loads = np.bincount(points["part"].astype(int), minlength=row.ranks)
    is_all = len(points) == row.points
    return loads if is_all and abs(loads.max() / loads.mean() - row.imbalance) < 1e-6 else None


def _write_loads(axes: Axes, points: pd.DataFrame, row: object) -> None:
    """Inside each part its number, and its points and Lu where they are known."""
    loads = part_loads(points, row)
    for part, inside in points.groupby(points["part"].astype(int)):
        text = f"{part}"
        if loads is not None and row.ranks <= MOST_TEXTS:
            text += f"\n{loads[part]:,}\n{100 * (1 - loads[part] / loads.mean()):+.2f} %"
        # The point nearest to the mean, which may lie in another part.
        places = inside[["x", "y"]]
        x, y = places.loc[((places - places.mean()) ** 2).sum(axis=1).idxmin()]
        box = {"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8}
        axes.text(x, y, text, ha="center", va="center", fontsize=8, linespacing=1.05, bbox=box)


def _title(methods: list[str], row: object) -> str:
    lines = [", ".join(methods[i : i + 3]) for i in range(0, len(methods), 3)]
    worst = f"largest |Lu| {row.lu_max_percent:.2f} %"
    return "\n".join([*lines, f"{row.workload}: imbalance {row.imbalance:.5f}, {worst}"])
