"""What accuracy cost, in sentences computed from the measurements."""

from __future__ import annotations

from collections.abc import Callable
from statistics import geometric_mean

from choice import cases, fastest, find_method, is_within
from intervals import (
    NOT_TOLD_APART,
    are_apart,
    decimals,
    differs_from_one,
    in_digits,
    inverse,
    mean_interval,
    quotient,
    with_interval,
)
from results import Interval, Measurement, Simulation, unique

Case = list[Measurement]
Pairs = list[tuple[Measurement, Measurement]]


def sentences(rows: list[Measurement]) -> list[str]:
    """Each number is the geometric mean over the workloads that have it; none without rows."""
    if not rows:
        return []
    by_case = list(cases(rows).values())
    return [
        _cost_of_exactness(by_case),
        _beside_zoltan(by_case),
        _fewest_bytes(by_case),
        _beside_the_paper(by_case),
    ]


def simulation_sentence(runs: list[Simulation]) -> str:
    """Which method's simulation is the shortest on the critical path, if one is; else empty."""
    runs = [run for run in runs if run.method != "serial"]
    if len(runs) < 2 or len({run.ranks for run in runs}) > 1:
        return ""
    best = min(runs, key=lambda run: run.critical_path)
    same = [
        run.method
        for run in runs
        if run is not best
        and not are_apart(run.critical_path_interval, best.critical_path_interval)
    ]
    digits = decimals([best.critical_path], 4)
    seconds = with_interval(best.critical_path, best.critical_path_interval, digits)
    text = f"With a core for every rank the simulation would take {seconds} s under {best.method}"
    if same:
        return f"{text}, {NOT_TOLD_APART} from {_list(same)}."
    return f"{text}, the least of {len(runs)} methods."


def _cost_of_exactness(by_case: list[Case]) -> str:
    pairs = _pairs(by_case, lambda rows: fastest(rows, "1.10"), lambda rows: fastest(rows, "exact"))
    if not pairs:
        return "No method balanced any of the workloads exactly, so exactness has no price here."
    return (
        f"Exact balance took {_time_ratio(pairs)} of the fastest setting within"
        f" ten per cent ({_mean([exact.time_ms for _, exact in pairs])} ms against"
        f" {_mean([rough.time_ms for rough, _ in pairs])} ms) and"
        f" {_times(_ratio(pairs, _bytes))} its bytes{_of(pairs, by_case)}."
    )


def _beside_zoltan(by_case: list[Case]) -> str:
    pairs = _pairs(by_case, _fastest_exact_rrcb, lambda rows: find_method(rows, "zoltan-rcb"))
    if not pairs:
        return "Zoltan's RCB and an exact setting of RRCB were not measured on the same points."
    return (
        f"Zoltan's RCB needed {_time_ratio(pairs)} of the fastest exactly"
        f" balanced RRCB and {_times(_ratio(pairs, _bytes))} its bytes, while its own imbalance was"
        f" {_mean([zoltan.imbalance for _, zoltan in pairs], 6)}{_of(pairs, by_case)}."
    )


def _fewest_bytes(by_case: list[Case]) -> str:
    """Zoltan's RCB is not the method that moves the fewest bytes."""
    pairs = _pairs(by_case, _fastest_exact_rrcb, _fewest_bytes_exactly)
    if not pairs:
        return "No exact setting of RRCB was measured, so its bytes are not compared."
    names = _list(unique([fewest.method for _, fewest in pairs]))
    ratio = _ratio(pairs, _bytes)
    if all(ours is fewest for ours, fewest in pairs):
        return f"Of all methods that balanced exactly, {names} moved the fewest bytes."
    return (
        f"Of all methods that balanced exactly, {names} moved the fewest bytes,"
        f" {_times(ratio)} those of that RRCB{_of(pairs, by_case)}."
    )


def _beside_the_paper(by_case: list[Case]) -> str:
    settings = unique([row.method for rows in by_case for row in rows if _is_the_papers(row)])
    best = _most_accurate(settings, by_case)
    pairs = _pairs(
        by_case,
        lambda rows: find_method(rows, best),
        lambda rows: _at_least_as_balanced(rows, find_method(rows, best)),
    )
    if not pairs:
        return "The paper's RRCB was not measured beside a setting of RRCB at least as balanced."
    number = f"{len(settings)} measured setting" + "s" * (len(settings) > 1)
    return (
        f"Of the {number} of the paper's RRCB, {best} was the most accurate and left an imbalance"
        f" of {_mean([paper.imbalance for paper, _ in pairs], 5)}; RRCB at least as balanced took"
        f" {_time_ratio(pairs, 'its time')} and left"
        f" {_mean([ours.imbalance for _, ours in pairs], 5)}{_of(pairs, by_case)}."
    )


def _fastest_exact_rrcb(rows: Case) -> Measurement | None:
    return fastest([row for row in rows if _is_ours(row)], "exact")


def _fewest_bytes_exactly(rows: Case) -> Measurement | None:
    exact = [row for row in rows if is_within(row, "exact")]
    ours = _fastest_exact_rrcb(rows)
    return min(exact, key=lambda row: (row.bytes, row is not ours), default=None)


def _most_accurate(settings: list[str], by_case: list[Case]) -> str:
    """Least imbalance beyond 1 in the geometric mean of the workloads that have it."""

    def beyond(method: str) -> float:
        found = [row for rows in by_case for row in rows if row.method == method]
        return geometric_mean([max(row.imbalance - 1, row.point) for row in found])

    return min(settings, key=beyond, default="")


def _at_least_as_balanced(rows: Case, paper: Measurement | None) -> Measurement | None:
    if paper is None:
        return None
    ours = [row for row in rows if _is_ours(row) and row.imbalance <= paper.imbalance]
    return min(ours, key=_time, default=None)


def _is_ours(row: Measurement) -> bool:
    return row.method.split("[")[0] in ("rrcb", "rrcb-exact")


def _is_the_papers(row: Measurement) -> bool:
    return row.method.split("[")[0] == "rrcb-sampled"


def _pairs(
    by_case: list[Case],
    first: Callable[[Case], Measurement | None],
    second: Callable[[Case], Measurement | None],
) -> Pairs:
    found = [(first(rows), second(rows)) for rows in by_case]
    return [(a, b) for a, b in found if a and b and a.time_ms > 0 and a.bytes > 0]


def _time(row: Measurement) -> float:
    return row.time_ms


def _bytes(row: Measurement) -> float:
    return row.bytes


def _time_ratio(pairs: Pairs, what: str = "the time") -> str:
    """The second's time over the first's."""
    interval = mean_interval(_quotient_of_times(first, second) for first, second in pairs)
    text = f"{with_interval(_ratio(pairs, _time), interval, 2)} times {what}"
    if not differs_from_one(interval):
        text += f" ({NOT_TOLD_APART})"
    return text


def _quotient_of_times(first: Measurement, second: Measurement) -> Interval | None:
    """Of the paired ratios where one of them is Zoltan's RCB, which all are measured beside."""
    if second.method == "zoltan-rcb":
        return inverse(first.share_interval)
    if first.method == "zoltan-rcb":
        return second.share_interval
    return quotient(second.time_interval, first.time_interval)


def _ratio(pairs: Pairs, value: Callable[[Measurement], float]) -> float:
    """Second over first; the ratio of the means is the mean of the ratios."""
    return geometric_mean([value(second) / value(first) for first, second in pairs])


def _times(ratio: float) -> str:
    return f"{in_digits(ratio, 3)} times"


def _mean(values: list[float], digits: int = 2) -> str:
    return f"{geometric_mean(values):.{digits}f}"


def _list(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _of(pairs: list, by_case: list[Case]) -> str:
    if len(by_case) == 1:
        return ""
    return f" (geometric means over {len(pairs)} of {len(by_case)} workloads)"
