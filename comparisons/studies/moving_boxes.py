"""Why a simulation rebalances: its points leave the boxes of the ranks."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plot
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import Results

METHOD = "rrcb"


def draw_moving_boxes(results: Results) -> Figure | None:
    """Points of a scene by the rank that holds them, with the boxes of the ranks: balanced at the
    start, half of the simulation later still in these boxes, and after a call of rrcb."""
    scenes = [name.removesuffix("-start") for name in results.table["workload"]]
    moments = [[f"{name}-{moment}" for moment in ("start", "middle")] for name in scenes[:1]]
    data = [[results.data(kind, moment, METHOD) for kind in ("points", "boxes")]
            for moment in sum(moments, [])]  # fmt: skip
    if not data or any(rows.empty or "z" in rows for moment in data for rows in moment):
        return None
    (start, old_boxes), (later, new_boxes) = data
    before = later.assign(part=parts_in(later, old_boxes))
    panels = {
        "start, after a call": (start, old_boxes),
        "later, before a call": (before, old_boxes),
        "later, after a call": (later, new_boxes),
    }
    height = 3.8 * plot.length_ratio([start, later]) + 0.8
    figure, grid = plot.panels(1, 3, 12, height, sharex=True, sharey=True)
    whole = pd.concat([start, later])
    for axes, (name, (points, boxes)) in zip(grid[0], panels.items()):
        _draw(axes, points, boxes, whole)
        loads = np.bincount(points["part"], minlength=len(boxes))
        fullest = loads.max() / loads.mean()
        axes.set_title(f"{name}: fullest rank {fullest:.{2 if fullest > 1.1 else 4}f} × mean")
        plot.show_lengths(axes, True, axes is grid[0, 0])
    return figure


def parts_in(points: pd.DataFrame, boxes: pd.DataFrame) -> np.ndarray:
    """The part whose box holds each point; boxes without ends outwards, as these are clipped."""
    whole_low, whole_high = ([boxes[f"{end}_{a}"].agg(agg) for a in "xy"]
                             for end, agg in (("lower", "min"), ("upper", "max")))  # fmt: skip
    found = np.zeros(len(points), int)
    for box in boxes.itertuples():
        inside = np.ones(len(points), bool)
        for a, low, high in zip("xy", whole_low, whole_high):
            lower, upper = getattr(box, f"lower_{a}"), getattr(box, f"upper_{a}")
            inside &= (points[a].to_numpy() >= lower) | (lower <= low)
            inside &= (points[a].to_numpy() < upper) | (upper >= high)
        found[inside] = int(box.part)
    return found


def _draw(axes: Axes, points: pd.DataFrame, boxes: pd.DataFrame, whole: pd.DataFrame) -> None:
    plot.draw_cloud(axes, points, plot.part_colours(points["part"]), largest=6)
    outer = {f"{end}_{a}": agg for end, agg in (("lower", "min"), ("upper", "max")) for a in "xy"}
    ends = {name: boxes[name].agg(agg) for name, agg in outer.items()}
    boxes = boxes.copy()
    for name, agg in outer.items():  # open sides reach to the ends of all points
        boxes.loc[boxes[name] == ends[name], name] = whole[name[-1]].agg(agg)
    for box in plot.rectangles(boxes, fill=False, lw=1, ec="black"):
        axes.add_patch(box)
