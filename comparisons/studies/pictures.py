"""The pictures of comparisons/run: points by part, ghosts, and load unbalance over
the steps. Their captions are the docstrings of what draws them."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plot
from history import draw_history, draw_seconds
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import Results, cases

BASE, METHOD = "zoltan-rcb", "rrcb"


def draw_all(results: Results) -> dict[str, str]:
    """Draws what there is data for, and removes pictures of earlier runs; returns the captions."""
    plot.use_style()
    captions = {}
    for name, draw in PICTURES.items():
        path = results.folder / name
        path.unlink(missing_ok=True)
        if figure := draw(results):
            plot.save(figure, path)
            captions[name] = " ".join(draw.__doc__.split())
    return captions


def _middle_case(results: Results) -> pd.DataFrame:
    by_case = list(cases(results.table).values())
    return by_case[len(by_case) // 2] if by_case else results.table


# --- points by part, with the boxes of the parts ---


def draw_parts(results: Results) -> Figure | None:
    """The points by part under each method, with the boxes of the parts."""
    found = []
    for row in _middle_case(results).itertuples():
        points, boxes = (results.data(kind, row.workload, row.method) for kind in ("points", "boxes"))
        found += [(row, points, boxes)] * (len(points) > 0)
    if not found:
        return None
    columns = min(2, len(found))
    lines = -(-len(found) // columns)
    height = 4.2 * plot.length_ratio(points for _, points, _ in found) + 0.8
    figure, grid = plot.panels(lines, columns, 4.2 * columns, height * lines, sharex=True, sharey=True)
    for axes in grid.flat[len(found) :]:
        axes.set_visible(False)
    for axes, (row, points, boxes) in zip(grid.flat, found):
        draw_part_boxes(axes, points, boxes, points)
        axes.set_title(f"{row.method}: {row.imbalance:.5f}", fontsize=9)
    return figure


def draw_part_boxes(axes: Axes, points: pd.DataFrame, boxes: pd.DataFrame, whole: pd.DataFrame) -> None:
    """Open sides reach to the ends of the whole."""
    plot.draw_cloud(axes, points, plot.part_colours(points["part"]), largest=6)
    boxes = boxes.copy()
    for side in [f"{end}_{axis}" for end in ("lower", "upper") for axis in "xy" if len(boxes)]:
        end = "min" if side.startswith("lower") else "max"
        boxes.loc[boxes[side] == boxes[side].agg(end), side] = whole[side[-1]].agg(end)
    for box in plot.rectangles(boxes, fill=False, lw=1, ec="black"):
        axes.add_patch(box)
    plot.show_lengths(axes)


def draw_ghosts(results: Results) -> Figure | None:
    """Points by part at the end of a scene, and in black those that are ghosts of another part, because
    one of its points is within twice the median distance to the nearest point."""
    end = results.table[results.table["workload"].str.endswith("-end")] if len(results.table) else results.table
    found = [
        (row, points, results.data("boxes", row.workload, row.method))
        for row in end.itertuples()
        if row.method in (BASE, METHOD)
        and len(points := results.data("points", row.workload, row.method))
        and "z" not in points
    ]
    if len(found) != 2:
        return None
    height = 6 * plot.length_ratio([points for _, points, _ in found]) + 0.6
    figure, grid = plot.panels(1, 2, 12, height, sharex=True, sharey=True)
    for axes, (row, points, boxes) in zip(grid[0], found):
        draw_part_boxes(axes, points, boxes, points)
        near = points[are_near_others(points)]
        axes.scatter(near["x"], near["y"], c="black", s=6, linewidths=0)
        axes.set_title(f"{row.method}: {row.ghosts:,.0f} ghosts")
    return figure


def are_near_others(points: pd.DataFrame) -> np.ndarray:
    """Of each point, whether one of another part is within twice the median distance to the nearest."""
    x, parts = points[["x", "y"]].to_numpy(), points["part"].to_numpy()
    squared = lambda some: ((some[:, None] - x) ** 2).sum(axis=2)  # noqa: E731
    spacings = squared(x[:: len(x) // 128 + 1])
    radius = 4 * np.median(np.where(spacings > 0, spacings, np.inf).min(axis=1))
    chunks = np.array_split(np.arange(len(x)), len(x) // 256 + 1)
    return np.concatenate([
        ((squared(x[k]) <= radius) & (parts[k][:, None] != parts)).any(axis=1) for k in chunks
    ])  # fmt: skip


def draw_unbalance(results: Results) -> Figure | None:
    """The largest load unbalance of a part over the steps of the simulation, the worst of each window
    of steps. Without learned costs, which even the time and not the points."""
    return draw_history({name: of for name, of in results.histories().items() if name != "learned"})


def draw_rank_times(results: Results) -> Figure | None:
    """The time of each rank in a step over the simulation, if points are counted and if they weigh what
    they are learned to cost; dashed: the mean of the ranks."""
    histories = results.histories()
    if not {"count", "learned"} <= histories.keys():
        return None
    figure, grid = plot.panels(1, 2, 10, 3.6, sharex=True, sharey=True)
    for axes, method in zip(grid[0], ("count", "learned")):
        draw_seconds(axes, histories[method])
        axes.set_title(method)
    grid[0, 0].set_ylabel("time of a step [ms]")
    return figure


PICTURES = {
    "parts.png": draw_parts,
    "ghosts.png": draw_ghosts,
    "unbalance_history.png": draw_unbalance,
    "rank_times.png": draw_rank_times,
}
