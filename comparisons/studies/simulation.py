"""What the rounds of simulations come to: simulation.csv and noise.csv, of the runs that the driver
records. columns.md describes their columns.

Simulations of one round take turns, and so do calls, so what noise there is slows all of them alike:
they are compared in pairs, never by medians over the rounds.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from intervals import Value, interval95, median_of

AGAIN = " again"  # behind the name of what is measured a second time
MARGIN = 0.01  # of the time of a program, from which a difference matters
KEY = ["ranks", "points", "steps", "every"]
MEDIANS = (
    "wall_s balance_s step_s mean_imbalance worst_imbalance front_x_m moved_m mass_kg path_points"
    " step_work_s step_path_s step_root_s step_network_s"
    " balance_work_s balance_path_s balance_root_s balance_network_s"
    " decide_s decide_work_s decide_path_s decide_root_s decide_network_s"
).split()


def once(rows: pd.DataFrame) -> pd.DataFrame:
    """Without what was measured a second time."""
    return rows[~rows["method"].str.endswith(AGAIN)] if len(rows) else rows


def summarise(runs: pd.DataFrame) -> pd.DataFrame:
    """A row for each method; of one that failed in a round only the reason."""
    runs = once(runs)
    last = runs.groupby("method", sort=False).tail(1).set_index("method")
    rounds = runs[runs["method"].isin(last.index[last["error"].isna()])]
    of_method = rounds.groupby("method", sort=False)
    rows = of_method[MEDIANS].median()
    rows["repeats"] = of_method.size()
    _add_interval(rows, "wall_s", of_method["wall_s"])
    rows["critical_path_s"] = of_method["critical_path_s"].median()
    _add_interval(rows, "critical_path_s", of_method["critical_path_s"])
    _compare_with_none(rows, rounds)
    rows["rebalances"] = of_method["rebalances"].median().astype(int)
    rows["moved_fraction"] = of_method["moved_fraction"].median()
    _add_interval(rows, "mean_imbalance", of_method["mean_imbalance"])
    _close_fixed_imbalances(rows, of_method)
    rows = last[KEY].join(rows).join(last["error"]).reset_index()
    return rows.astype({"repeats": "Int64", "rebalances": "Int64"})


def _add_interval(rows: pd.DataFrame, name: str, values: object) -> None:
    ends = values.agg(lambda of_rounds: interval95(of_rounds))
    rows[f"{name}_low"], rows[f"{name}_high"] = ends.str[0], ends.str[1]


def _compare_with_none(rows: pd.DataFrame, rounds: pd.DataFrame) -> None:
    """Adds the speed-up over none, of pairs; and the share that is kept of what could be gained if
    rebalancing were free and the steps as short as under any method; and of what could be gained if
    also the least work of any method were even over the ranks, without messages."""
    names = [f"speed_up_critical_path{end}" for end in ("", "_low", "_high")]
    rows[[*names, "ideal_speed_up", "gain_kept", "gain_kept_time"]] = np.nan
    if "none" not in rows.index:
        return
    for method in rows.index:
        found = paired(rounds, rounds["critical_path_s"], "none", method)
        rows.loc[method, names] = found.number, found.low, found.high
    steps = rounds["step_path_s"] + rounds["step_network_s"]
    shortest = steps.groupby(rounds["method"]).median().min()
    longest = rows["critical_path_s"]["none"]
    rows["ideal_speed_up"] = longest / shortest
    if longest > shortest:
        rows["gain_kept"] = (longest - rows["critical_path_s"]) / (longest - shortest)
    even = rows["step_work_s"].min() / rounds["ranks"].iloc[0]
    if longest > even:
        rows["gain_kept_time"] = (longest - rows["critical_path_s"]) / (longest - even)


def _close_fixed_imbalances(rows: pd.DataFrame, of_method: object) -> None:
    """Rounds without a seed that agree to the last bit have nothing random about them."""
    values = of_method["mean_imbalance"]
    fixed = (of_method["seed"].count() == 0) & (values.size() > 1) & (values.nunique() == 1)
    for end in ("low", "high"):
        rows.loc[fixed, f"mean_imbalance_{end}"] = rows["mean_imbalance"][fixed]


def noise(runs: pd.DataFrame, calls: pd.DataFrame) -> pd.DataFrame:
    """How far what was measured twice is from itself: simulations under the first method, and calls of
    Zoltan's RCB on each workload."""
    cases = []
    for method in runs.loc[runs["method"].str.endswith(AGAIN), "method"].unique() if len(runs) else ():
        twice = method.removesuffix(AGAIN)
        if runs.loc[runs["method"].isin([method, twice]), "error"].isna().all():
            scene = runs["scene"].iloc[0]
            cases.append((scene, twice, runs, "wall_s", twice, "round"))
            cases.append((scene, f"{twice} critical path", runs, "critical_path_s", twice, "round"))
    for workload, turns in calls.groupby("workload", sort=False) if len(calls) else ():
        cases.append((workload, "zoltan-rcb", turns, "time_ms", "zoltan-rcb", "turn"))
    found = []
    for workload, what, rows, column, method, number in cases:
        if of := paired(rows, rows[column], method + AGAIN, method, number):
            found.append((workload, what, of.number, of.low, of.high))
    return pd.DataFrame(found, columns=["workload", "what", "ratio", "low", "high"])


def paired(
    rounds: pd.DataFrame, values: pd.Series, method: str, reference: str, number: str = "round"
) -> Value | None:
    """Median over the rounds of the method's value over the reference's, with its interval. Calls
    of one turn are paired in the same way; none where a method is not there."""
    chosen = [rounds["method"] == m for m in (method, reference)]
    found = [values[c].set_axis(rounds.loc[c, number]) for c in chosen]
    ratios = (found[0] / found[1]).dropna()
    ratios = ratios[np.isfinite(ratios)]
    return median_of(ratios) if len(ratios) else None


def of_method(rounds: pd.DataFrame, values: pd.Series, method: str) -> Value:
    return median_of(values[rounds["method"] == method])


def balancing(rounds: pd.DataFrame) -> pd.Series:
    """Seconds of all rebalances on the critical path, with all that they move."""
    return rounds["balance_path_s"] + rounds["balance_network_s"]


def uneven_points(rounds: pd.DataFrame) -> pd.Series:
    """Points of the fullest rank over the mean, mean of the steps."""
    return rounds["path_points"] * rounds["ranks"] / (rounds["points"] * rounds["steps"])


def uneven_work(rounds: pd.DataFrame) -> pd.Series:
    """Time of the slowest rank of a step over the mean, as measured."""
    return rounds["step_path_s"] * rounds["ranks"] / rounds["step_work_s"]


def slope_of_work(rounds: pd.DataFrame) -> Value | None:
    """Per cent that the steps take longer for 1 % more points on the fullest rank: the slope of a
    line through the balanced methods of a round, median of the rounds. Without balancing the points
    lie elsewhere, which is not what uneven points cost."""
    slopes = []
    for _, simulated in rounds[rounds["rebalances"] > 0].groupby("round"):
        points, work = uneven_points(simulated), uneven_work(simulated)
        if len(simulated) > 2 and points.max() - points.min() > 0.001:
            slopes.append(np.polyfit(points, work, 1)[0])
    return median_of(slopes) if slopes else None


def limit_of(call: float, other: float, step: float) -> float:
    """Steps between rebalances below which the slower of two balancers costs a program MARGIN of its
    time; call, other and step in the same unit.

    At the best interval of k steps balancing takes 2 call / (k step) of the time, by
    docs/design/rebalancing.md; the best interval grows with the root of the call, so a call that takes
    1 / r of the time saves 1 - 1 / sqrt(r) of that.
    """
    slower, faster = max(call, other), min(call, other)
    return 2 * (1 - (faster / slower) ** 0.5) * slower / (MARGIN * step)
