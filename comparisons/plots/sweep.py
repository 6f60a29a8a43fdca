"""Pictures of a sweep: what accuracy costs over all settings, and the paper's parameter study."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from choice import COSTS, cases, pareto_front
from cost import percent_above, shade_one_point
from results import Measurement, read_table, unique
from settings import SETTING, draw_lines, legend_above, setting_of, values_of
from style import method_style, save

SWEEP = "sweep.csv"


def read_clouds(directory: Path) -> list[Measurement]:
    return [row for row in read_table(directory, SWEEP) if row.layout != "simulation"]


def read_snapshots(directory: Path) -> list[Measurement]:
    return [row for row in read_table(directory, SWEEP) if row.layout == "simulation"]


def draw_sweep_time(directory: Path, picture: Path) -> bool:
    return _draw_costs(directory, picture, COSTS["time_ms"], "time of a call [ms]")


def draw_sweep_bytes(directory: Path, picture: Path) -> bool:
    return _draw_costs(directory, picture, COSTS["bytes"], "bytes sent in a call")


def _draw_costs(
    directory: Path, picture: Path, cost: Callable[[Measurement], float], label: str
) -> bool:
    """A panel per case: every setting, and the front of those that no other beats in both."""
    panels = cases(read_clouds(directory))
    if not panels:
        return False
    columns = min(4, len(panels))
    rows = -(-len(panels) // columns)
    figure, grid = plt.subplots(
        rows,
        columns,
        figsize=(3.1 * columns + 0.4, 2.5 * rows + 0.9),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    for axes in grid.flat[len(panels) :]:
        axes.set_visible(False)
    for axes, (name, settings) in zip(grid.flat, panels.items()):
        _draw_case(axes, [row for row in settings if cost(row) > 0], cost)
        axes.set_title(name, fontsize=9)
    for axes, rows_of in zip(grid.flat, panels.values()):
        shade_one_point(axes, rows_of)
    for axes in grid[-1]:
        axes.set_xlabel(label)
    for axes in grid[:, 0]:
        axes.set_ylabel("heaviest part\nabove the mean [%]")
    methods = unique([row.method.split("[")[0] for rows in panels.values() for row in rows])
    handles = [_mark(method) for method in methods]
    handles.append(Line2D([], [], color="#444444", linewidth=1, label="Pareto front (large marks)"))
    legend_above(figure, handles)
    save(figure, picture)
    return True


def _mark(method: str) -> Line2D:
    style = method_style(method)
    return Line2D([], [], color=style.colour, marker=style.marker, linestyle="", label=method)


def _draw_case(
    axes: Axes, rows: list[Measurement], cost: Callable[[Measurement], float]
) -> None:
    front = pareto_front(rows, cost)
    axes.step(
        [cost(row) for row in front],
        [percent_above(row) for row in front],
        where="post",
        color="#444444",
        linewidth=1,
        zorder=1,
    )
    for row in rows:
        style = method_style(row.method.split("[")[0])
        axes.plot(
            cost(row),
            percent_above(row),
            color=style.colour,
            marker=style.marker,
            markersize=6 if row in front else 4,
            alpha=1 if row in front else 0.55,
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(True)


def draw_study(directory: Path, picture: Path) -> bool:
    """Unbalance and time over the paper's parameters: mean, least and most of the snapshots."""
    rows = [row for row in read_snapshots(directory) if SETTING.fullmatch(row.method)]
    if not rows:
        return False
    fractions = values_of([row.method for row in rows], 3)
    figure, grid = plt.subplots(
        2, len(fractions), figsize=(2.8 * len(fractions) + 0.6, 5.6), squeeze=False, sharey="row"
    )
    for column, fraction in enumerate(fractions):
        chosen = [row for row in rows if setting_of(row.method)[2] == fraction]
        draw_lines(grid[0, column], chosen, lambda r: r.method, lambda r: r.lu_percent)
        draw_lines(grid[1, column], chosen, lambda r: r.method, lambda r: r.time_ms)
        grid[0, column].set_title(f"{100 * fraction:g} % of the points")
        grid[1, column].set_xlabel("support mesh, cells per axis")
    grid[0, 0].set_ylabel("largest |Lu| [%]")
    grid[1, 0].set_ylabel("time of a call [ms]")
    for axes in grid.flat:
        axes.set_yscale("log")
    legend_above(figure, grid[0, 0].get_legend_handles_labels()[0])
    save(figure, picture)
    return True
