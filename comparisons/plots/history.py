"""The load unbalance over the steps of the simulation: figure 6 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from results import Columns, read_history
from settings import legend_above
from style import PART_COLOURS, distinct_styles, save

MOST_WINDOWS = 150  # lines that swing at every rebalance would run into one another


def draw_history(directory: Path, picture: Path) -> bool:
    """All methods together by their worst part, then every part of each method, in windows."""
    histories = read_history(directory)
    if not histories:
        return False
    lines = -(-len(histories) // 2)
    figure = plt.figure(figsize=(11, 4.6 + 1.6 * lines))
    grid = figure.add_gridspec(lines + 1, 2, height_ratios=[2.4] + [1] * lines)
    top = figure.add_subplot(grid[0, :])
    draw_worst(top, histories)
    top.set_xlabel("time simulated [s]")
    for number, (method, history) in enumerate(histories.items()):
        axes = figure.add_subplot(grid[1 + number // 2, number % 2], sharex=top)
        draw_parts_of(axes, method, history)
        if number >= len(histories) - 2:
            axes.set_xlabel("time simulated [s]")
    parts = max(int(history["part"].max()) for history in histories.values()) + 1
    keys = top.get_legend_handles_labels()[0]
    keys += [
        Line2D([], [], color=PART_COLOURS[part], label=f"part {part}")
        for part in range(min(parts, len(PART_COLOURS)))
    ]
    legend_above(figure, keys, inches=3.4)
    save(figure, picture)
    return True


def _per_part(history: Columns) -> tuple[np.ndarray, np.ndarray]:
    """Times of the steps, and the unbalance as an array of parts by steps."""
    _, first, step = np.unique(history["step"], return_index=True, return_inverse=True)
    unbalance = np.full((int(history["part"].max()) + 1, len(first)), np.nan)
    unbalance[history["part"].astype(int), step] = history["lu_percent"]
    return history["time"][first], unbalance


def _one_point(history: Columns) -> float:
    """What one point more in a part is, in percent of the mean."""
    return 100 / max(history["points"][history["step"] == history["step"][0]].mean(), 1)


def _windows(steps: int) -> np.ndarray:
    """First step of each window of consecutive steps."""
    return np.unique(np.linspace(0, steps, min(steps, MOST_WINDOWS), endpoint=False).astype(int))


def draw_worst(axes: Axes, histories: dict[str, Columns]) -> None:
    """The worst part of every method, the worst step of each window."""
    for method, style in distinct_styles(list(histories)).items():
        history = histories[method]
        times, unbalance = _per_part(history)
        worst = np.maximum(np.nanmax(np.abs(unbalance), axis=0), _one_point(history))
        windows = _windows(len(times))
        worst = np.maximum.reduceat(worst, windows)
        axes.plot(times[windows], worst, color=style.colour, linestyle=style.line, label=method)
    axes.set_yscale("log")
    axes.set_ylabel("largest |Lu| [%]")
    axes.set_title("Largest |Lu| of the parts, Lu = (ideal − actual) / ideal; worst of each window")
    axes.grid(True, axis="y")


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
    most = np.nanmax(np.abs(unbalance))
    axes.set_title(f"{method}: |Lu| ≤ {most:.2g} %, a scale of its own", fontsize=9, loc="left")
