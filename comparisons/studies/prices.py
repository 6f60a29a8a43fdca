"""The price of accuracy at a glance: of a call, and of the whole simulation.

Several snapshots or clouds are combined by the geometric mean; bands reach from the least lower end
of their intervals to the most upper end.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import geometric_mean, median, mode

import pandas as pd
from intervals import Value, in_digits, value_of
from methods import ACROSS, family, is_of_the_paper, tolerance_asked
from results import Results, cases, is_within, row_of

CALL, STEPS, CALLS, SIMULATION = "call", "steps", "calls", "simulation"


@dataclass(frozen=True)
class Price:
    """A row of price.csv.

    The value of a call is its share of Zoltan RCB's time; of the simulation it is seconds beyond an
    ideally balanced one without calls, over the seconds of that. The tolerance is the one asked
    for; of the paper's methods, which take none, the imbalance they left; of others there is none.
    """

    panel: str
    method: str
    tolerance: str
    value: Value

    @property
    def numbers(self) -> dict:
        ends = zip(("value", "low", "high"), (self.value.number, *self.value.reach))
        return {
            "panel": self.panel, "method": self.method, "tolerance": self.tolerance,
            **{name: f"{number:.6g}" for name, number in ends},
        }  # fmt: skip


def all_runs(results: Results) -> pd.DataFrame:
    return results.swept_runs if results.runs.empty else results.runs


def all_prices(results: Results) -> list[Price]:
    return call_prices(results.calls) + simulation_prices(all_runs(results))


def call_prices(rows: pd.DataFrame) -> list[Price]:
    shares: dict[str, list[Value]] = {}
    for measured in cases(rows).values():
        reference = row_of(measured, "zoltan-rcb")
        for row in measured.itertuples() if reference and reference.time_ms > 0 else ():
            share = value_of(row, "time_vs_zoltan_rcb")
            if not share.number > 0:
                share = Value(row.time_ms / reference.time_ms, share.low, share.high)
            if row.time_ms > 0:
                shares.setdefault(row.method, []).append(share)
    return [
        Price(CALL, method, _tolerance(method, rows), _combined(shares[method]))
        for method in rows["method"].unique()
        if method in shares and _takes_part(method)
    ]


def _takes_part(method: str) -> bool:
    return bool(tolerance_asked(method)) or is_of_the_paper(method) or method in ACROSS


def _combined(shares: list[Value]) -> Value:
    low, high = zip(*(share.reach for share in shares))
    return Value(geometric_mean([share.number for share in shares]), min(low), max(high))


def _tolerance(method: str, rows: pd.DataFrame) -> str:
    if not is_of_the_paper(method):
        return tolerance_asked(method)
    rows = rows[rows["method"] == method]
    is_exact = is_within(rows, "exact").all()
    return "exact" if is_exact else f"{geometric_mean(rows['imbalance']):.6f}"


def _comparable(runs: pd.DataFrame) -> tuple[pd.DataFrame, float]:
    """The runs on as many ranks as most have, and the seconds of their steps if ideal."""
    if runs.empty:
        return runs, 0
    ranks = mode(runs["ranks"])
    runs = runs[(runs["ranks"] == ranks) & (runs["method"] != "serial")]
    return runs, median(runs["step_work_s"]) / ranks if len(runs) else 0


def simulation_prices(runs: pd.DataFrame) -> list[Price]:
    """What unbalance costs is reckoned from the points of the fullest rank in each step, which no
    noise disturbs; what else the critical path holds is the same under every method.
    """
    runs, ideal = _comparable(runs)
    prices = []
    for run in runs.itertuples() if ideal > 0 else ():
        steps = max(run.path_points * run.ranks / (run.points * run.steps) - 1, 0.0)
        calls = (run.balance_path_s + run.balance_network_s) / ideal
        path = value_of(run, "critical_path_s")
        total = [steps + calls + (end - path.number) / ideal for end in path.reach]
        tolerance = tolerance_asked(run.method) or f"{run.mean_imbalance:.6f}"
        prices += [
            Price(STEPS, run.method, tolerance, Value(steps)),
            Price(CALLS, run.method, tolerance, Value(calls)),
            Price(SIMULATION, run.method, tolerance, Value(steps + calls, *total)),
        ]
    return prices


def optimum(prices: list[Price]) -> tuple[Price, list[Price]] | None:
    """RRCB's tolerance of the shortest simulation, and those not told apart from it."""
    totals = [p for p in prices if p.panel == SIMULATION and tolerance_asked(p.method)]
    totals = [p for p in totals if family(p.method) == "rrcb"]
    if len(totals) < 2:
        return None
    best = min(totals, key=lambda p: p.value.number)
    return best, [p for p in totals if p is not best and p.value.low <= best.value.high]


def exchange_rate(runs: pd.DataFrame) -> str:
    """What a per cent of unbalance costs beside a more exact call, in words; else empty."""
    runs, ideal = _comparable(runs)
    calls = {
        tolerance_asked(run.method): (run.balance_path_s + run.balance_network_s)
        / (getattr(run, "rebalances", 0) or -(-run.steps // run.every))
        for run in runs.itertuples()
        if family(run.method) == "rrcb" and tolerance_asked(run.method)
    }
    if "exact" not in calls or len(calls) < 2 or ideal <= 0:
        return ""
    loosest = max(calls.keys() - {"exact"}, key=float)
    steps, every = runs.iloc[0][["steps", "every"]]
    more = calls["exact"] - calls[loosest]
    step = 0.01 * ideal / steps
    a_step, a_round, a_call = (
        f"{in_digits(1e6 * seconds, 2)} µs" for seconds in (step, step * every, abs(more))
    )
    until = f", {a_round} until the next call ({every} steps)" if every else ""
    return (
        f"1 % of unbalance costs {a_step} a step{until};"
        f" an exact call costs {a_call} {'more' if more >= 0 else 'less'} than one to {loosest}."
    )
