"""What accuracy costs: of a comparison, of all settings of a sweep, and over the paper's."""

from __future__ import annotations

import pandas as pd
import plot
from choice import pareto_front
from intervals import value_of
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from methods import parse, setting_of, values_of
from results import Results, cases


def draw_cost(results: Results) -> Figure | None:
    """What accuracy costs: the time of a call against the imbalance it leaves; lower is better
    balanced, further left is faster. One point more in a part than in the mean is the least that
    can be told."""
    table = results.table
    if table.empty:
        return None
    workloads = table.groupby("workload", sort=False)
    width = max(7.5, 3.7 * len(workloads) + 0.9)
    figure, grid = plot.panels(1, len(workloads), width, 5.4, sharex=True, sharey=True)
    styles = plot.distinct_styles(table["method"])
    for axes, (_, rows) in zip(grid[0], workloads):
        for row in rows.itertuples():
            time = value_of(row, "time_ms")
            low, high = time.reach if time.has_interval else (row.time_ms_min, row.time_ms_max)
            ends = [[max(row.time_ms - low, 0)], [max(high - row.time_ms, 0)]]
            axes.errorbar([row.time_ms], [100 * row.excess], xerr=ends, markersize=7,
                          elinewidth=0.8, alpha=0.9, **styles[row.method].look)  # fmt: skip
        first = rows.iloc[0]
        axes.set_title(f"{first['workload']}: {first['points']:,} points, {first['ranks']} ranks")
        has_intervals = "time_ms_low" in rows and rows["time_ms_low"].notna().all()
        axes.set_xlabel("time of a call [ms]: " + ("95 %" if has_intervals else "least to most"))
        axes.grid(True)
    _set_limits(grid[0, 0], table)
    grid[0, 0].set_ylabel("heaviest part above the mean [%]")
    keys = [style.key(name) for name, style in styles.items()]
    return plot.legend_above(figure, keys, inches=3.6)


def _set_limits(axes: Axes, table: pd.DataFrame) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(table["time_ms_min"].min() / 1.5, table["time_ms_max"].max() * 1.5)
    axes.set_ylim(50 * table["excess"].min(), 200 * table["excess"].max())
    for panel in axes.figure.axes:
        _shade_one_point(panel, table)


def _shade_one_point(axes: Axes, rows: pd.DataFrame) -> None:
    """What one point more in a part is, where a method was as good as that."""
    point = 100 * rows["point"].min()
    if 100 * rows["excess"].min() <= 1.001 * point:
        axes.axhspan(point / 10, point, color="#F0F0F0", zorder=0)
        axes.set_ylim(bottom=point / 4)
        axes.annotate(
            "one point or less", (0.99, point), (0, -7), xycoords=axes.get_yaxis_transform(),
            textcoords="offset points", ha="right", va="top", fontsize=8,
        )  # fmt: skip


def draw_sweep_time(results: Results) -> Figure | None:
    """What accuracy costs in time: every setting on every cloud, and the front of those that no
    other beats in both."""
    return _draw_fronts(results.clouds, "time_ms", "time of a call [ms]")


def draw_sweep_bytes(results: Results) -> Figure | None:
    """What accuracy costs in traffic."""
    return _draw_fronts(results.clouds, "bytes", "bytes sent in a call")


def _draw_fronts(clouds: pd.DataFrame, cost: str, label: str) -> Figure | None:
    """A panel per case: every setting, and the front of those that no other beats in both."""
    if clouds.empty:
        return None
    by_case = cases(clouds)
    figure = plot.small_multiples(
        list(by_case), lambda axes, case: _draw_front(axes, by_case[case], cost), (0.4, 0.9),
        label, "heaviest part\nabove the mean [%]",
    )  # fmt: skip
    for axes, rows in zip(figure.axes, by_case.values()):
        _shade_one_point(axes, rows)
    methods = dict.fromkeys(parse(method)[0] for method in clouds["method"])
    handles = [plot.method_style(name).key(name) for name in methods]
    front = {"color": "#444444", "linewidth": 1, "linestyle": "-"}
    handles.append(plot.key("Pareto front (large marks)", **front))
    return plot.legend_above(figure, handles)


def _draw_front(axes: Axes, rows: pd.DataFrame, cost: str) -> None:
    rows = rows[rows[cost] > 0]
    front = pareto_front(rows, cost)
    axes.step(
        front[cost], 100 * front["excess"], where="post", color="#444444", linewidth=1, zorder=1
    )
    for row in rows.itertuples():
        is_best = row.Index in front.index
        look = {**plot.method_style(parse(row.method)[0]).look, "markersize": 6 if is_best else 4}
        axes.plot(getattr(row, cost), 100 * row.excess, alpha=1 if is_best else 0.55, **look)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(True)


def draw_study(results: Results) -> Figure | None:
    """The paper's parameters on snapshots of the failing slope: lines are means of the snapshots,
    bands reach from least to most."""
    rows = results.snapshots
    rows = rows[[bool(setting_of(method)) for method in rows["method"]]]
    if rows.empty:
        return None
    fractions = values_of(rows["method"], 2)[::-1]
    figure, grid = plot.panels(2, len(fractions), 2.8 * len(fractions) + 0.6, 5.6, sharey="row")
    for column, fraction in zip(grid.T, fractions):
        chosen = rows[[setting_of(method)[2] == fraction for method in rows["method"]]]
        for axes, name in zip(column, ("lu_max_percent", "time_ms")):
            plot.draw_settings(axes, chosen, name)
            axes.set_yscale("log")
        column[0].set_title(f"{100 * fraction:g} % of the points")
    plot.label_edges(grid, ["support mesh, cells per axis"] * len(fractions),
                ["largest |Lu| [%]", "time of a call [ms]"])  # fmt: skip
    return plot.legend_above(figure, grid[0, 0])
