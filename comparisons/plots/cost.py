"""What accuracy costs: the time of a call against the imbalance it leaves."""

from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from results import Measurement, read_table, unique
from settings import legend_above
from style import MethodStyle, distinct_styles, save


def draw_cost(directory: Path, picture: Path) -> bool:
    """A panel per workload; lower is better balanced, further left is faster."""
    table = read_table(directory)
    if not table:
        return False
    workloads = unique([row.workload for row in table])
    figure, axes = plt.subplots(
        1,
        len(workloads),
        figsize=(max(7.5, 3.7 * len(workloads) + 0.9), 5.4),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    styles = distinct_styles([row.method for row in table])
    for workload, panel in zip(workloads, axes[0]):
        _draw_workload(panel, [row for row in table if row.workload == workload], styles)
    _set_limits(axes[0, 0], table)
    axes[0, 0].set_ylabel("heaviest part above the mean [%]")
    keys = [
        Line2D([], [], color=style.colour, marker=style.marker, linestyle="", label=method)
        for method, style in styles.items()
    ]
    legend_above(figure, keys, inches=3.6)
    save(figure, picture)
    return True


def percent_above(row: Measurement) -> float:
    """Of the heaviest part above the mean; no less than one point, which is all that shows."""
    return 100 * max(row.imbalance - 1, row.point)


def shade_one_point(axes: Axes, rows: list[Measurement]) -> None:
    """What one point more in a part is, where a method was as good as that."""
    point = 100 * min(row.point for row in rows)
    if min(map(percent_above, rows)) <= 1.001 * point:
        axes.axhspan(point / 10, point, color="#F0F0F0", zorder=0)
        axes.set_ylim(bottom=point / 4)
        axes.annotate(
            "one point or less", (0.99, point), (0, -7), xycoords=axes.get_yaxis_transform(),
            textcoords="offset points", ha="right", va="top", fontsize=8,
        )  # fmt: skip


def _draw_workload(
    axes: Axes, rows: list[Measurement], styles: dict[str, MethodStyle]
) -> None:
    for row in rows:
        style = styles[row.method]
        low, high = row.time_interval or (row.time_ms_min, row.time_ms_max)
        axes.errorbar(
            [row.time_ms],
            [percent_above(row)],
            xerr=[[max(row.time_ms - low, 0)], [max(high - row.time_ms, 0)]],
            color=style.colour,
            marker=style.marker,
            markersize=7,
            elinewidth=0.8,
            alpha=0.9,
        )
    first = rows[0]
    axes.set_title(f"{first.workload}: {first.points:,} points, {first.ranks} ranks")
    has_intervals = all(row.time_interval for row in rows)
    axes.set_xlabel("time of a call [ms]: " + ("95 %" if has_intervals else "least to most"))
    axes.grid(True)


def _set_limits(axes: Axes, table: list[Measurement]) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(min(r.time_ms_min for r in table) / 1.5, max(r.time_ms_max for r in table) * 1.5)
    lowest = min(map(percent_above, table))
    axes.set_ylim(lowest / 2, max(map(percent_above, table)) * 2)
    for panel in axes.figure.axes:
        shade_one_point(panel, table)
