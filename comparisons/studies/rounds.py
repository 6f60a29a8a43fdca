"""Simulations of one round take turns, and so do calls, so what noise there is slows all of them:
they are compared in pairs and never by medians over the rounds."""

from __future__ import annotations

import numpy as np
import pandas as pd
from intervals import Value, median_of
from simulation import paired  # noqa: F401


def of_method(rounds: pd.DataFrame, values: pd.Series, method: str) -> Value:
    return median_of(values[rounds["method"] == method])


def path(rounds: pd.DataFrame) -> pd.Series:
    return rounds["critical_path_s"]


def balancing(rounds: pd.DataFrame) -> pd.Series:
    """Seconds of all rebalances on the critical path, with all that they move."""
    return rounds["balance_path_s"] + rounds["balance_network_s"]


def rebalance(rounds: pd.DataFrame) -> pd.Series:
    """Seconds of one of them; NaN where there was none."""
    return balancing(rounds) / rounds["rebalances"].where(rounds["rebalances"] > 0)


def ideal_step(rounds: pd.DataFrame) -> pd.Series:
    """Seconds of a step if its work were the same on every rank."""
    return rounds["step_work_s"] / rounds["ranks"] / rounds["steps"]


def uneven_points(rounds: pd.DataFrame) -> pd.Series:
    """Points of the fullest rank over the mean, mean of the steps."""
    return rounds["path_points"] * rounds["ranks"] / (rounds["points"] * rounds["steps"])


def uneven_work(rounds: pd.DataFrame) -> pd.Series:
    """Time of the slowest rank of a step over the mean, as measured."""
    return rounds["step_path_s"] * rounds["ranks"] / rounds["step_work_s"]


def slope_of_work(rounds: pd.DataFrame) -> Value | None:
    """Per cent that the steps take longer for 1 % more points on the fullest rank: the slope of a
    line through all methods of a round, median of the rounds."""
    slopes = []
    for _, simulated in rounds.groupby("round"):
        points, work = uneven_points(simulated), uneven_work(simulated)
        if len(simulated) > 2 and points.max() - points.min() > 0.01:
            slopes.append(np.polyfit(points, work, 1)[0])
    return median_of(slopes) if slopes else None
