"""Summarizes rounds of simulations in simulation.csv and noise.csv, from the runs that the driver recorded. columns.md
describes their columns.

The simulations of one round take turns, and so do calls, so that noise slows all of them down in the same way. They are
compared in pairs, never by medians over the rounds.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from intervals import Value, interval95, median_of

AGAIN = " again"  # follows the name of a repeated measurement
MARGIN = 0.01  # share of a program's time above which a difference matters
KEY = ["ranks", "points", "steps", "every"]
MEDIANS = (
    "wall_s balance_s step_s mean_imbalance worst_imbalance front_x_m moved_m mass_kg path_points"
    " step_work_s step_path_s step_root_s step_network_s"
    " step_messages step_bytes balance_messages balance_bytes"
    " balance_work_s balance_path_s balance_root_s balance_network_s"
    " decide_s decide_work_s decide_path_s decide_root_s decide_network_s counted counted_path"
).split()


def once(rows: pd.DataFrame) -> pd.DataFrame:
    """Returns the rows without repeated measurements."""
    return rows[~rows["method"].str.endswith(AGAIN)] if len(rows) else rows


def summarise(runs: pd.DataFrame) -> pd.DataFrame:
    """Returns a row for each method. If it failed in a round, the row has only the reason."""
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
    """Adds the speed-up over "none", from pairs of runs. Also adds two shares of the possible gain that is realized.
    The first assumes free rebalancing and steps as short as with the best method. The second is the gain of counted
    work in the steps, compared with the least work of any method distributed evenly."""
    names = [f"speed_up_critical_path{end}" for end in ("", "_low", "_high")]
    rows[[*names, "ideal_speed_up", "gain_kept", "gain_kept_work"]] = np.nan
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
    longest, even = rows["counted_path"]["none"], rows["counted"].min() / rounds["ranks"].iloc[0]
    if longest > even:
        rows["gain_kept_work"] = (longest - rows["counted_path"]) / (longest - even)


def _close_fixed_imbalances(rows: pd.DataFrame, of_method: object) -> None:
    """Gives bit-identical values of rounds without a seed intervals of zero width: nothing is random about them."""
    values = of_method["mean_imbalance"]
    fixed = (of_method["seed"].count() == 0) & (values.size() > 1) & (values.nunique() == 1)
    for end in ("low", "high"):
        rows.loc[fixed, f"mean_imbalance_{end}"] = rows["mean_imbalance"][fixed]


def noise(runs: pd.DataFrame, calls: pd.DataFrame) -> pd.DataFrame:
    """Compares repeated measurements with the first ones: simulations with the first method, and calls of Zoltan's RCB
    on each workload."""
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
    """Returns the median over the rounds of the method's value divided by the reference's, with its interval. Calls of
    one turn are paired in the same way. Returns None if a method is missing."""
    chosen = [rounds["method"] == m for m in (method, reference)]
    found = [values[c].set_axis(rounds.loc[c, number]) for c in chosen]
    ratios = (found[0] / found[1]).dropna()
    ratios = ratios[np.isfinite(ratios)]
    return median_of(ratios) if len(ratios) else None


def of_method(rounds: pd.DataFrame, values: pd.Series, method: str) -> Value:
    return median_of(values[rounds["method"] == method].dropna())


def balancing(rounds: pd.DataFrame) -> pd.Series:
    """Returns the seconds of all rebalances on the critical path, including the points that they move."""
    return rounds["balance_path_s"] + rounds["balance_network_s"]


def uneven_points(rounds: pd.DataFrame) -> pd.Series:
    """Returns the points of the fullest rank divided by the mean, as mean over the steps."""
    return rounds["path_points"] * rounds["ranks"] / (rounds["points"] * rounds["steps"])


def uneven_work(rounds: pd.DataFrame, work: str = "counted") -> pd.Series:
    """Returns the work of the busiest rank of a step divided by the mean. `work` is "counted", or "least_s" for the
    least seconds of equal runs, or "counted_at_rest" or "least_at_rest_s" for the first twentieth of the steps."""
    return rounds[f"{work}_path"] * rounds["ranks"] / rounds[work]


def slope_of_work(rounds: pd.DataFrame) -> Value | None:
    """Returns by how many percent the counted work of the steps grows if the fullest rank has 1 % more points. It is the
    slope of a line through the balanced methods of a round, as median over the rounds. The run without balancing is
    left out, because its points are also distributed differently."""
    slopes = []
    for _, simulated in rounds[rounds["rebalances"] > 0].groupby("round"):
        points, work = uneven_points(simulated), uneven_work(simulated)
        if len(simulated) > 2 and points.max() - points.min() > 0.001:
            slopes.append(np.polyfit(points, work, 1)[0])
    return median_of(slopes) if slopes else None


def limit_of(call: float, other: float, step: float) -> float:
    """Returns the number of steps between rebalances below which the slower of two balancers costs a program MARGIN of
    its time. The three times have the same unit.

    With the best interval of k steps, balancing takes 2 call / (k step) of the time; see docs/design/rebalancing.md.
    The best interval grows with the square root of the time of a call. A call that takes 1 / r of the time therefore
    saves 1 - 1 / sqrt(r) of this share.
    """
    slower, faster = max(call, other), min(call, other)
    return 2 * (1 - (faster / slower) ** 0.5) * slower / (MARGIN * step)
