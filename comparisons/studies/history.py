"""Draws the load unbalance during simulations."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plot
from matplotlib.axes import Axes
from matplotlib.figure import Figure

MOST_WINDOWS = 150  # with more windows lines that change at every rebalance would overlap
TIME = "time simulated [s]"


def draw_history(histories: dict[str, pd.DataFrame]) -> Figure | None:
    if not histories:
        return None
    figure, grid = plot.panels(1, 1, 9, 4.6)
    _draw_worst(grid[0, 0], histories)
    grid[0, 0].set_xlabel(TIME)
    return plot.legend_above(figure, grid[0, 0], inches=3.4)


def per_part(
    history: pd.DataFrame, column: str = "lu_percent"
) -> tuple[np.ndarray, np.ndarray]:
    """Returns the times of the steps, and a column as an array of parts by steps."""
    values = history.pivot_table(column, "part", "step", dropna=False)
    values = values.reindex(range(history["part"].max() + 1))
    return history.groupby("step")["time"].first().to_numpy(), values.to_numpy()


def one_point(history: pd.DataFrame) -> float:
    """Returns how much one more point in a part is, in percent of the mean."""
    return 100 / max(history["points"][history["step"] == history["step"].iloc[0]].mean(), 1)


def _windows(steps: int) -> np.ndarray:
    """Returns the first step of each window of consecutive steps."""
    return np.unique(np.linspace(0, steps, min(steps, MOST_WINDOWS), endpoint=False).astype(int))


def _draw_worst(axes: Axes, histories: dict[str, pd.DataFrame]) -> None:
    """Draws the worst part of every method, in the worst step of each window."""
    for method, style in plot.distinct_styles(histories).items():
        times, unbalance = per_part(histories[method])
        worst = np.maximum(np.nanmax(np.abs(unbalance), axis=0), one_point(histories[method]))
        windows = _windows(len(times))
        worst = np.maximum.reduceat(worst, windows)
        axes.plot(times[windows], worst, color=style.colour, linestyle=style.line, label=method)
    axes.set_yscale("log")
    axes.set_ylabel("largest |Lu| [%]")
    axes.set_title("Largest |Lu| of the parts, Lu = (ideal − actual) / ideal; worst of each window")
    axes.grid(True, axis="y")


def draw_work(axes: Axes, history: pd.DataFrame) -> None:
    """Draws the counted work of each rank in a step as mean of each window; a dashed line is the mean of the ranks."""
    times, work = per_part(history, "work")
    windows = _windows(len(times))
    lengths = np.diff([*windows, len(times)])
    means = 1e-6 * np.add.reduceat(work, windows, axis=1) / lengths
    for part, of_part in enumerate(means):
        axes.plot(times[windows], of_part, color=plot.PART_COLOURS[part % len(plot.PART_COLOURS)],
                  linewidth=0.9, label=f"rank {part}")  # fmt: skip
    axes.plot(times[windows], means.mean(axis=0), color="black", linestyle="--", linewidth=0.9, label="mean")
    axes.set_ylim(bottom=0)
    axes.set_xlabel(TIME)
    axes.grid(True, axis="y")
