"""What accuracy costs: of all settings of a sweep, and over the paper's."""

from __future__ import annotations

import pandas as pd
import plot
from choice import pareto_front
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from methods import parse, setting_of, values_of
from results import Results, cases


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
