"""Draws the pictures of comparisons/run: ghosts, and load unbalance over the steps. The docstrings of the functions
that draw them are their captions."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plot
from history import draw_history, draw_work
from matplotlib.figure import Figure
from results import Results

BASE, METHOD = "zoltan-rcb", "rrcb"


def draw_all(results: Results) -> dict[str, str]:
    """Draws the pictures that have data, and removes those of earlier runs. Returns the captions."""
    plot.use_style()
    captions = {}
    for name, draw in PICTURES.items():
        path = results.folder / name
        path.unlink(missing_ok=True)
        if figure := draw(results):
            plot.save(figure, path)
            captions[name] = " ".join(draw.__doc__.split())
    return captions


def draw_ghosts(results: Results) -> Figure | None:
    """Points by part at the end of a scene. Black points are ghosts of another part, because one of its points is
    within twice the median distance to the nearest point. The slope has no such picture: with all methods its parts
    are strips."""
    end = results.table
    if len(end):
        end = end[end["workload"].str.endswith("-end") & (end["workload"] != "slope-end")]
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
        plot.draw_cloud(axes, points, plot.part_colours(points["part"]), largest=6)
        for box in plot.rectangles(boxes, fill=False, lw=1, ec="black"):
            axes.add_patch(box)
        plot.show_lengths(axes)
        near = points[are_near_others(points)]
        axes.scatter(near["x"], near["y"], c="black", s=6, linewidths=0)
        axes.set_title(f"{row.method}: {row.ghosts:,.0f} ghosts")
    return figure


def are_near_others(points: pd.DataFrame) -> np.ndarray:
    """Returns for each point whether a point of another part is within twice the median distance to the nearest point.
    """
    x, parts = points[["x", "y"]].to_numpy(), points["part"].to_numpy()
    squared = lambda some: ((some[:, None] - x) ** 2).sum(axis=2)  # noqa: E731
    spacings = squared(x[:: len(x) // 128 + 1])
    radius = 4 * np.median(np.where(spacings > 0, spacings, np.inf).min(axis=1))
    chunks = np.array_split(np.arange(len(x)), len(x) // 256 + 1)
    return np.concatenate([
        ((squared(x[k]) <= radius) & (parts[k][:, None] != parts)).any(axis=1) for k in chunks
    ])  # fmt: skip


def draw_unbalance(results: Results) -> Figure | None:
    """The largest load unbalance of a part during the simulation, as the worst step of each window of steps.
    Simulations with weights are left out, because they balance the time and not the points."""
    return draw_history({name: of for name, of in results.histories().items() if name not in ("learned", "known")})


def draw_rank_times(results: Results) -> Figure | None:
    """The counted work of each rank in a step during the simulation, with counted points, with points that weigh their
    learned costs, and with known costs. The dashed line is the mean of the ranks."""
    histories = results.histories()
    names = [name for name in ("count", "learned", "known") if name in histories]
    if not names:
        return None
    figure, grid = plot.panels(1, len(names), 3.6 * len(names), 3.6, sharex=True, sharey=True)
    for axes, method in zip(grid[0], names):
        draw_work(axes, histories[method])
        axes.set_title(method)
    grid[0, 0].set_ylabel("counted work of a step [M instructions]")
    return plot.legend_above(figure, grid[0, 0])


PICTURES = {
    "ghosts.png": draw_ghosts,
    "unbalance_history.png": draw_unbalance,
    "rank_times.png": draw_rank_times,
}
