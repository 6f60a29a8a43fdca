"""What accuracy costs: the time of a call against the imbalance it leaves."""

from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from results import Measurement, read_table, unique
from style import method_style, place_labels, save

FLOOR = 1e-6


def draw_cost(directory: Path, picture: Path) -> bool:
    """A panel per workload; lower is better balanced, further left is faster."""
    table = read_table(directory)
    if not table:
        return False
    workloads = unique([row.workload for row in table])
    figure, axes = plt.subplots(
        1,
        len(workloads),
        figsize=(4.4 * len(workloads) + 0.9, 4.2),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    panels = dict(zip(workloads, axes[0]))
    for workload, panel in panels.items():
        _draw_workload(panel, [row for row in table if row.workload == workload])
    _set_limits(axes[0, 0], table)
    axes[0, 0].set_ylabel("imbalance − 1  (heaviest part / mean part − 1)")
    for workload, panel in panels.items():
        _label(panel, [row for row in table if row.workload == workload])
    save(figure, picture)
    return True


def _excess(row: Measurement) -> float:
    return max(row.imbalance - 1, FLOOR)


def _draw_workload(axes: Axes, rows: list[Measurement]) -> None:
    for row in rows:
        style = method_style(row.method)
        spread = [[row.time_ms - row.time_ms_min], [row.time_ms_max - row.time_ms]]
        axes.errorbar(
            [row.time_ms],
            [_excess(row)],
            xerr=spread,
            color=style.colour,
            marker=style.marker,
            markersize=6,
            elinewidth=0.8,
            alpha=0.9,
        )
    first = rows[0]
    axes.set_title(f"{first.workload}: {first.points:,} points, {first.ranks} ranks")
    axes.set_xlabel("time of a call [ms]: median, from least to most")
    if any(_excess(row) == FLOOR for row in rows):
        axes.axhspan(FLOOR / 10, FLOOR, color="#F0F0F0", zorder=0)
        axes.text(0.02, 0.01, "$10^{-6}$ or less", transform=axes.transAxes, fontsize=8)
    axes.grid(True)


def _set_limits(axes: Axes, table: list[Measurement]) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_xlim(min(r.time_ms_min for r in table) / 2, max(r.time_ms_max for r in table) * 3)
    lowest = min(map(_excess, table))
    axes.set_ylim(lowest / (3 if lowest > FLOOR else 2), max(map(_excess, table)) * 4)


def _label(axes: Axes, rows: list[Measurement]) -> None:
    marks = [(row.time_ms_min, row.time_ms, row.time_ms_max, _excess(row)) for row in rows]
    place_labels(axes, marks, [row.method.replace("[", "\n[") for row in rows])
