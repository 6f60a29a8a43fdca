"""The first picture of every report: what a call costs at the imbalance it leaves."""

from __future__ import annotations

import pandas as pd
import plot
from intervals import value_of
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from methods import parse
from results import Results, cases


def draw_price(results: Results) -> Figure | None:
    """What accuracy costs: the time of a call over the imbalance it leaves, with 95 % intervals, of
    every method on the same points. A mark of several names is one and the same partition. One
    point more in a part than in the mean is the least that can be told."""
    by_case = list(cases(results.table).values())
    if not by_case:
        return None
    rows = by_case[len(by_case) // 2]
    figure, grid = plot.panels(1, 1, 8, 5)
    axes = grid[0, 0]
    marks = [_draw_mark(axes, names, row) for names, row in _partitions(rows)]
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(50 * rows["excess"].min(), 300 * rows["excess"].max())
    axes.set_ylim(rows["time_ms"].min() / 2, rows["time_ms"].max() * 2)
    _shade_one_point(axes, rows)
    axes.grid(True)
    axes.set_xlabel("imbalance left: heaviest part above the mean [%]")
    axes.set_ylabel("time of a call [ms]")
    first = rows.iloc[0]
    axes.set_title(
        f"{first['workload']}, {first['layout']}: {first['points']:,} points, {first['ranks']} ranks"
    )
    plot.label_marks(axes, marks)
    return figure


def _partitions(rows: pd.DataFrame) -> list[tuple[str, object]]:
    """Each with the name of its method; one for all tolerances that the same parts are within, at
    the default setting where it is among them."""
    groups: dict[tuple, list] = {}
    for row in rows.itertuples():
        same = (row.imbalance, row.bytes) if _has_tolerance(row) else row.Index
        groups.setdefault(same, []).append(row)
    found = []
    for group in groups.values():
        shown = next((row for row in group if row.method == "rrcb"), group[0])
        tolerances = [parse(row.method)[1].get("tol", "1.01") for row in group]
        also = f", tolerance {', '.join(tolerances)}" if len(group) > 1 else ""
        found.append((parse(shown.method)[0] + also if also else shown.method, shown))
    return found


def _has_tolerance(row: object) -> bool:
    name, parameters = parse(row.method)
    return name == "rrcb" and parameters.keys() <= {"tol"}


def _draw_mark(axes: Axes, name: str, row: object) -> tuple[float, float, str, str]:
    style = plot.method_style(row.method)
    time = value_of(row, "time_ms")
    low, high = time.reach if time.has_interval else (row.time_ms, row.time_ms)
    ends = [[max(row.time_ms - low, 0)], [max(high - row.time_ms, 0)]]
    axes.errorbar([100 * row.excess], [row.time_ms], yerr=ends, markersize=7, elinewidth=0.9,
                  **style.mark)  # fmt: skip
    return 100 * row.excess, row.time_ms, name.replace(",k=", ",\nk="), style.colour


def _shade_one_point(axes: Axes, rows: pd.DataFrame) -> None:
    """Where no part has more than one point above the mean."""
    point = 100 * rows["point"].iloc[0]
    if 100 * rows["excess"].min() <= 1.001 * point:
        axes.axvspan(point / 100, point, color="#F0F0F0", zorder=0)
        axes.set_xlim(left=point / 4)
        axes.annotate(
            "one point\nor less", (point, 0.01), (-4, 2), xycoords=axes.get_xaxis_transform(),
            textcoords="offset points", ha="right", va="bottom", fontsize=8,
        )  # fmt: skip
