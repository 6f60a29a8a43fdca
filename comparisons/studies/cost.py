"""What accuracy costs: time against imbalance of all settings of a study."""

from __future__ import annotations

import pandas as pd
import plot
from choice import pareto_front
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from methods import parse
from results import cases


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


def draw_sweep_time(clouds: pd.DataFrame) -> Figure:
    """What accuracy costs in time: every setting on every cloud, and the front of those that no
    other beats in both."""
    by_case = cases(clouds)
    figure = plot.small_multiples(
        list(by_case), lambda axes, case: _draw_front(axes, by_case[case]), (0.4, 0.9),
        "time of a call [ms]", "heaviest part\nabove the mean [%]",
    )  # fmt: skip
    for axes, rows in zip(figure.axes, by_case.values()):
        _shade_one_point(axes, rows)
    methods = dict.fromkeys(parse(method)[0] for method in clouds["method"])
    handles = [plot.method_style(name).key(name) for name in methods]
    front = {"color": "#444444", "linewidth": 1, "linestyle": "-"}
    handles.append(plot.key("Pareto front (large marks)", **front))
    return plot.legend_above(figure, handles)


def _draw_front(axes: Axes, rows: pd.DataFrame) -> None:
    rows = rows[rows["time_ms"] > 0]
    front = pareto_front(rows)
    axes.step(
        front["time_ms"], 100 * front["excess"], where="post", color="#444444", linewidth=1, zorder=1
    )
    for row in rows.itertuples():
        is_best = row.Index in front.index
        look = {**plot.method_style(parse(row.method)[0]).look, "markersize": 6 if is_best else 4}
        axes.plot(row.time_ms, 100 * row.excess, alpha=1 if is_best else 0.55, **look)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(True)
