"""The load unbalance over the steps of the simulation: figure 6 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from results import Columns, read_history
from style import PART_COLOURS, method_style, save

FLOOR_PERCENT = 1e-3


def draw_history(directory: Path, picture: Path) -> bool:
    """All methods together by their worst part, then every part of each method."""
    histories = read_history(directory)
    if not histories:
        return False
    figure = plt.figure(figsize=(9, 3.4 + 1.5 * len(histories)))
    rows = figure.subplots(
        len(histories) + 1, 1, sharex=True, height_ratios=[2.2] + [1] * len(histories)
    )
    _draw_worst(rows[0], histories)
    for axes, (method, history) in zip(rows[1:], histories.items()):
        _draw_parts(axes, method, history)
    rows[-1].set_xlabel("time simulated [s]")
    save(figure, picture)
    return True


def _per_part(history: Columns) -> tuple[np.ndarray, np.ndarray]:
    """Times of the steps, and the unbalance as an array of parts by steps."""
    _, first, step = np.unique(history["step"], return_index=True, return_inverse=True)
    unbalance = np.full((int(history["part"].max()) + 1, len(first)), np.nan)
    unbalance[history["part"].astype(int), step] = history["lu_percent"]
    return history["time"][first], unbalance


def _draw_worst(axes: Axes, histories: dict[str, Columns]) -> None:
    for method, history in histories.items():
        style = method_style(method)
        times, unbalance = _per_part(history)
        worst = np.maximum(np.nanmax(np.abs(unbalance), axis=0), FLOOR_PERCENT)
        axes.plot(times, worst, color=style.colour, linestyle=style.line, label=method)
    axes.set_yscale("log")
    axes.set_ylabel("worst |Lu| [%]")
    axes.set_title("Load unbalance Lu = (ideal − actual) / ideal of the worst part")
    axes.grid(True, axis="y")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=3.5)


def _draw_parts(axes: Axes, method: str, history: Columns) -> None:
    times, unbalance = _per_part(history)
    axes.axhline(0, color="#999999", linewidth=0.6)
    lowest, highest = np.nanmin(unbalance, axis=0), np.nanmax(unbalance, axis=0)
    axes.fill_between(times, lowest, highest, color="#DDDDDD", linewidth=0)
    for part, values in enumerate(unbalance):
        colour = PART_COLOURS[part % len(PART_COLOURS)]
        axes.plot(times, values, color=colour, linewidth=0.8)
    axes.set_ylabel("Lu [%]")
    axes.set_title(f"{method}: Lu of every part", fontsize=9, loc="left")
