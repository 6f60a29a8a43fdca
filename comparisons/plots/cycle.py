"""Calls again and again on points that stand still, and the map from one cut to the next."""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, sqrt
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from intervals import Spread, spread_of
from results import read_rows, unique
from settings import SETTING, legend_above, setting_of
from style import CALL_COLOUR, method_style, multiplier_colour, save

LATE = 10  # calls after which what remains is called lasting


@dataclass(frozen=True)
class Call:
    """A row of cycle.csv."""

    method: str
    ranks: int
    points: int
    seed: str
    call: int
    imbalance: float
    moved: float  # share of the points that changed rank


def read_cycle(directory: Path) -> list[Call]:
    """The calls on as many points and ranks as the last ones."""
    calls = [
        Call(
            row["method"],
            int(row["ranks"]),
            int(row["points"]),
            row["seed"],
            int(row["call"]),
            float(row["imbalance"]),
            float(row["moved_fraction"]),
        )
        for row in read_rows(directory / "cycle.csv")
        if not row["error"]
    ]
    return [c for c in calls if (c.ranks, c.points) == (calls[-1].ranks, calls[-1].points)]


def draw_cycle(directory: Path, picture: Path) -> bool:
    """Imbalance and moved share over the calls: medians, with their intervals over the seeds."""
    calls = read_cycle(directory)
    if not calls:
        return False
    panels = {name: methods for name, methods in _panels(calls).items() if methods}
    figure, grid = plt.subplots(
        2,
        len(panels),
        figsize=(3.4 * len(panels) + 0.8, 7.2),
        squeeze=False,
        sharex=True,
        sharey="row",
    )
    for column, (name, methods) in enumerate(panels.items()):
        for method in methods:
            _draw_method(grid[:, column], [c for c in calls if c.method == method])
        grid[0, column].set_title(name)
        grid[1, column].set_xlabel("call")
        grid[1, column].legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), fontsize=8)
    grid[0, 0].set_ylabel("imbalance")
    grid[1, 0].set_ylabel("points that change rank [%]")
    for axes in grid[1]:
        axes.set_yscale("symlog", linthresh=1)
        axes.yaxis.set_major_formatter("{x:g}")
    for axes in grid.flat:
        axes.grid(True, axis="y")
        axes.xaxis.get_major_locator().set_params(integer=True)
    save(figure, picture)
    return True


def _panels(calls: list[Call]) -> dict[str, list[str]]:
    methods = unique([call.method for call in calls])
    sampled = [method for method in methods if SETTING.fullmatch(method)]
    of_mesh_4 = [method for method in sampled if _is_of_mesh_4(method)]
    return {
        "mesh 4, 100 % of the points": [m for m in of_mesh_4 if setting_of(m)[2] == 1],
        "mesh 4, 12.5 %": [m for m in of_mesh_4 if setting_of(m)[2] == 0.125],
        "other settings of the paper": [m for m in sampled if m not in of_mesh_4],
        "no samples": [m for m in methods if m not in sampled],
    }


def _is_of_mesh_4(method: str) -> bool:
    return SETTING.fullmatch(method) is not None and setting_of(method)[0] == 4


def _draw_method(panels: np.ndarray, calls: list[Call]) -> None:
    method = calls[0].method
    numbers = sorted({call.call for call in calls})
    style = method_style(method)
    colour, line = style.colour, style.line
    if _is_of_mesh_4(method):
        k = setting_of(method)[1]
        colour, line = multiplier_colour(k), "-" if (2 * k).is_integer() else "--"
    for axes, value in zip(panels, (lambda c: c.imbalance, lambda c: 100 * c.moved)):
        spreads = [spread_of([value(c) for c in calls if c.call == n]) for n in numbers]
        axes.plot(
            numbers,
            [spread.median for spread in spreads],
            color=colour,
            linestyle=line,
            marker=".",
            label=method.removeprefix("rrcb-sampled"),
        )
        lows, highs = [s.low for s in spreads], [s.high for s in spreads]
        axes.fill_between(numbers, lows, highs, color=colour, alpha=0.18, linewidth=0)


@dataclass(frozen=True)
class Lasting:
    """What a method does for ever to points that stand still; spreads over the seeds."""

    method: str
    better: Spread  # the least imbalance of the late calls
    worse: Spread  # the most
    moved: Spread  # share of the points that change rank, mean of the late calls


def lasting(calls: list[Call]) -> list[Lasting]:
    late = [call for call in calls if call.call > LATE]
    return [_lasting(name, late) for name in unique([call.method for call in late])]


def _lasting(method: str, late: list[Call]) -> Lasting:
    seeds = unique([call.seed for call in late if call.method == method])
    runs = [[c for c in late if (c.method, c.seed) == (method, seed)] for seed in seeds]
    return Lasting(
        method,
        spread_of([min(call.imbalance for call in run) for run in runs]),
        spread_of([max(call.imbalance for call in run) for run in runs]),
        spread_of([float(np.mean([call.moved for call in run])) for run in runs]),
    )


def cycle_table(calls: list[Call]) -> tuple[list[str], list[list[str]]]:
    header = ["method", "seeds", "least imbalance", "most", "change rank at each call, %"]
    return header, [
        [
            found.method,
            str(found.moved.count) if SETTING.fullmatch(found.method) else "–",
            found.better.text(4),
            found.worse.text(4),
            _percent(found.moved).text(2),
        ]
        for found in lasting(calls)
    ]


def _percent(share: Spread) -> Spread:
    ends = share.interval and (100 * share.interval[0], 100 * share.interval[1])
    return Spread(100 * share.median, ends, share.count)


def next_offset(offset: float, mesh: int, multiplier: float) -> float:
    """The cut of evenly spread points on [0, 1] after that at 1/2 + offset, less 1/2.

    A rank lies on each side of the cut, with `mesh` cells; a box is r = k / √3 times as wide as its
    cell. docs/paper.md derives it; for r < 2 and cuts less than about |r - 1| cells from 1/2.
    """
    r = multiplier / sqrt(3)
    if r > 1:
        return offset * (1 - r / 2 + (r - 1) / (2 * mesh))
    cell = (0.5 + abs(offset)) / mesh  # on the side with more points
    return -copysign((1 - r) * (cell / 2 - abs(offset)), offset)


def alternating_offset(mesh: int, multiplier: float) -> float:
    """How far the cuts of a multiplier below √3 lie from 1/2, to either side in turn, for ever."""
    gap = 1 - multiplier / sqrt(3)
    return gap / (4 * mesh) / (1 + gap * (1 - 1 / (2 * mesh)))


def draw_map(picture: Path) -> None:
    """The map of the model with its steps, for a multiplier below, at and above √3; mesh 4."""
    mesh, start = 4, -0.016
    figure, panels = plt.subplots(1, 3, figsize=(10.5, 4.6), sharey=True)
    for axes, (multiplier, name) in zip(panels, ((1.5, "1.5"), (sqrt(3), "√3"), (2, "2"))):
        _draw_steps(axes, mesh, multiplier, start)
        axes.set_title(f"k = {name}")
        axes.set_xlabel("offset of a cut from ½ [%]")
        axes.set_box_aspect(1)
        axes.grid(True)
    panels[0].set_ylabel("offset of the next [%]")
    legend_above(figure, panels[0].get_legend_handles_labels()[0], inches=2.2)
    save(figure, picture)


def _draw_steps(axes: Axes, mesh: int, multiplier: float, start: float) -> None:
    reach = 0.02
    ends = [-100 * reach, 100 * reach]
    axes.plot(ends, ends, color="#999999", linewidth=0.8, label="a cut that stays")
    for side in (-1, 1):
        offsets = side * np.linspace(1e-9, reach, 50)
        mapped = [100 * next_offset(e, mesh, multiplier) for e in offsets]
        label = "the next cut" if side < 0 else None
        axes.plot(100 * offsets, mapped, color=CALL_COLOUR, linewidth=1.8, label=label)
    offset, path = start, [(start, 0.0)]
    for _ in range(12):
        following = next_offset(offset, mesh, multiplier)
        path += [(offset, following), (following, following)]
        offset = following
    x, y = (100 * np.array(values) for values in zip(*path))
    colour = method_style("rrcb-sampled").colour
    axes.plot(x, y, color=colour, linewidth=1, marker=".", label="twelve calls")
