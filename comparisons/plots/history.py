"""The load unbalance over the steps of the simulation: figure 6 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from results import Columns, read_history
from style import PART_COLOURS, method_style, save

FLOOR_PERCENT = 1e-3
MOST_WINDOWS = 150  # lines that swing at every rebalance would run into one another


def draw_history(directory: Path, picture: Path) -> bool:
    """All methods together by their worst part, then every part of each method, in windows."""
    histories = read_history(directory)
    if not histories:
        return False
    figure = plt.figure(figsize=(9, 3.4 + 1.5 * len(histories)))
    rows = figure.subplots(
        len(histories) + 1, 1, sharex=True, height_ratios=[2.2] + [1] * len(histories)
    )
    draw_worst(rows[0], histories)
    for axes, (method, history) in zip(rows[1:], histories.items()):
        draw_parts_of(axes, method, history)
    rows[-1].set_xlabel("time simulated [s]")
    save(figure, picture)
    return True


def _per_part(history: Columns) -> tuple[np.ndarray, np.ndarray]:
    """Times of the steps, and the unbalance as an array of parts by steps."""
    _, first, step = np.unique(history["step"], return_index=True, return_inverse=True)
    unbalance = np.full((int(history["part"].max()) + 1, len(first)), np.nan)
    unbalance[history["part"].astype(int), step] = history["lu_percent"]
    return history["time"][first], unbalance


def _windows(steps: int) -> np.ndarray:
    """First step of each window of consecutive steps."""
    return np.unique(np.linspace(0, steps, min(steps, MOST_WINDOWS), endpoint=False).astype(int))


def draw_worst(axes: Axes, histories: dict[str, Columns]) -> None:
    """The worst part of every method, the worst step of each window."""
    for method, history in histories.items():
        style = method_style(method)
        times, unbalance = _per_part(history)
        worst = np.maximum(np.nanmax(np.abs(unbalance), axis=0), FLOOR_PERCENT)
        windows = _windows(len(times))
        worst = np.maximum.reduceat(worst, windows)
        axes.plot(times[windows], worst, color=style.colour, linestyle=style.line, label=method)
    axes.set_yscale("log")
    axes.set_ylabel("worst |Lu| [%]")
    axes.set_title("Load unbalance Lu = (ideal − actual) / ideal of the worst part, worst step of each window")
    axes.grid(True, axis="y")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=3.5)


def draw_parts_of(axes: Axes, method: str, history: Columns) -> None:
    """Lu of every part, from least to most of each window."""
    times, unbalance = _per_part(history)
    axes.axhline(0, color="#999999", linewidth=0.6)
    windows = _windows(len(times))
    for part, values in enumerate(unbalance):
        colour = PART_COLOURS[part % len(PART_COLOURS)]
        lowest = np.fmin.reduceat(values, windows)
        highest = np.fmax.reduceat(values, windows)
        axes.fill_between(times[windows], lowest, highest, color=colour, alpha=0.35, linewidth=0)
        axes.plot(times[windows], (lowest + highest) / 2, color=colour, linewidth=0.9)
    axes.set_ylabel("Lu [%]")
    axes.set_title(f"{method}: Lu of every part, from least to most", fontsize=9, loc="left")
