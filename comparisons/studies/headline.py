"""The sentences that a report begins with, computed from the measurements: what a call costs at
which imbalance, what the simulation gains, and when it matters."""

from __future__ import annotations

from statistics import geometric_mean

import pandas as pd
import rounds as by_round
from intervals import NOT_TOLD_APART, ONE, Value, in_digits, mean_of, value_of
from results import cases, row_of

# Each with the exact setting of the same interface: callbacks with callbacks, arrays with arrays.
INTERFACES = {"rrcb": "rrcb-exact", "rrcb-arrays": "rrcb-arrays[refine=exact]"}
ZOLTAN = "zoltan-rcb"


def headline(rows: pd.DataFrame, turns: pd.DataFrame, rounds: pd.DataFrame) -> list[str]:
    """Of table.csv, call_times.csv and simulation_runs.csv."""
    texts = [_call(rows), *(_exactness(rows, turns, *names) for names in INTERFACES.items())]
    texts = [" ".join(filter(None, texts)), _gain(rounds), _matter(rounds) or _ghosts(rows)]
    return list(filter(None, texts))


def _call(rows: pd.DataFrame) -> str:
    """What a call of RRCB costs, beside Zoltan's RCB."""
    if not (pairs := _pairs(rows, "rrcb", ZOLTAN)):
        return ""
    share = mean_of(value_of(ours, "time_vs_zoltan_rcb") for ours, _ in pairs)
    return (
        f"A call of rrcb left an imbalance of {_imbalance(ours for ours, _ in pairs)} and took"
        f" {share.text(3)} of the time of Zoltan's RCB, which left"
        f" {_imbalance(zoltan for _, zoltan in pairs)}{_over(pairs)}."
    )


def _exactness(rows: pd.DataFrame, turns: pd.DataFrame, method: str, exact: str) -> str:
    pairs = _pairs(rows, exact, method)
    if not pairs or turns.empty:
        return ""
    calls = [turns[turns["workload"] == a.workload] for a, _ in pairs]
    time = mean_of(by_round.paired(c, c["time_ms"], exact, method, "turn") for c in calls)
    size = geometric_mean([a.bytes / b.bytes for a, b in pairs])
    return (
        f"{exact} took {_ratio(time)} the time of {method} and {in_digits(size, 3)} times its"
        f" bytes, and left {_imbalance(a for a, _ in pairs)}."
    )


def _gain(rounds: pd.DataFrame) -> str:
    if rounds.empty or (gain := _paths(rounds, "none")) is None:
        return ""
    text = f"With a core for every rank the simulation under rrcb took {gain.text(3)} of the time"
    text += " without rebalancing"
    if zoltan := _paths(rounds, ZOLTAN):
        text += f" and {zoltan.text(3)} of that under Zoltan's RCB"
        if zoltan.has_interval and not zoltan.is_apart(ONE):
            most = 100 * max(1 - zoltan.low, zoltan.high - 1)
            text += f" ({NOT_TOLD_APART}: they differ by {in_digits(most, 2)} % at most)"
        seconds = by_round.balancing(rounds)
        seconds = [by_round.of_method(rounds, seconds, m) for m in ("rrcb", ZOLTAN)]
        ours, theirs = (in_digits(1e3 * s.number, 3) for s in seconds)
        text += f"; all rebalances took {ours} ms against {theirs}"
    return f"{text} (pairs of {gain.count} rounds)."


def _matter(rounds: pd.DataFrame) -> str:
    """How often points must need a rebalance for the choice of the balancer to show."""
    if rounds.empty:
        return ""
    each = by_round.rebalance(rounds)
    ours, theirs = (by_round.of_method(rounds, each, m) if m in set(rounds["method"]) else None
                    for m in ("rrcb", ZOLTAN))  # fmt: skip
    if ours is None or theirs is None or not (ours.number > 0 and theirs.number > 0):
        return ""
    step = by_round.ideal_step(rounds).median()
    run = rounds[rounds["method"] == "rrcb"].median(numeric_only=True)
    times = [f"{in_digits(1e3 * v.number, 3)} ms" for v in (ours, theirs)]
    steps = [in_digits(v.number / step, 2) for v in (ours, theirs)]
    often = abs(theirs.number - ours.number) / (0.01 * step)
    return (
        f"One rebalance with all that it moves took {times[0]} under rrcb and {times[1]} under"
        f" Zoltan's RCB, as long as {steps[0]} and {steps[1]} steps: the choice of the balancer matters by"
        f" more than 1 % where points need one every {often:.0f} steps or more often; here rrcb made"
        f" {run.rebalances:.0f} in {run.steps:,.0f}."
    )


def _ghosts(rows: pd.DataFrame) -> str:
    pairs = _pairs(rows, "rrcb", ZOLTAN) if "ghosts" in rows else []
    pairs = [(a, b) for a, b in pairs if a.ghosts > 0 and b.ghosts > 0]
    if not pairs:
        return ""
    ratio = geometric_mean([ours.ghosts / zoltan.ghosts for ours, zoltan in pairs])
    share = 100 * geometric_mean([ours.ghosts / ours.points for ours, _ in pairs])
    return (
        f"In every step the application then pays for ghosts: those of rrcb's parts are"
        f" {in_digits(share, 3)} % of the points, {in_digits(ratio, 3)} times those of Zoltan's RCB;"
        " how much of a step the time of a call is depends on the application (docs/rebalancing.md)."
    )


def work_paragraph(rounds: pd.DataFrame) -> str:
    """What uneven points cost the steps, as measured; empty where methods do not differ in them."""
    if rounds.empty or (slope := by_round.slope_of_work(rounds)) is None:
        return ""
    points = by_round.uneven_points(rounds)
    text = (
        f"1 % more points on the fullest rank made the steps {slope.text(2)} % longer, by lines"
        f" through the measured times of the methods of each of {slope.count} rounds, whose mean imbalance was"
        f" {points.min():.3f} to {points.max():.3f}."
    )
    if "rrcb-exact" in set(rounds["method"]):
        slowest, evenest = (
            by_round.of_method(rounds, 100 * (values - 1), "rrcb-exact")
            for values in (by_round.uneven_work(rounds), points)
        )
        text += (
            f" Equal points are not equal work: under rrcb-exact the fullest rank held"
            f" {evenest.number:.1f} % more points than the mean over the steps, and the slowest rank of"
            f" a step took {slowest.text(1)} % longer than the mean, noise included."
        )
    return text


def _paths(rounds: pd.DataFrame, reference: str) -> Value | None:
    return by_round.paired(rounds, by_round.path(rounds), "rrcb", reference)


def _pairs(rows: pd.DataFrame, first: str, second: str) -> list[tuple]:
    found = [(row_of(case, first), row_of(case, second)) for case in cases(rows).values()]
    return [(a, b) for a, b in found if a and b and b.time_ms > 0 and b.bytes > 0]


def _imbalance(rows: object) -> str:
    return f"{geometric_mean(row.imbalance for row in rows):.5f}"


def _over(pairs: list[tuple]) -> str:
    return f" (geometric means over {len(pairs)} workloads)" * (len(pairs) > 1)


def _ratio(ratio: Value) -> str:
    same = f" ({NOT_TOLD_APART})" * (not ratio.is_apart(ONE))
    return f"{ratio.text(2)} times{same}"
