"""What accuracy cost, in three sentences computed from the measurements."""

from __future__ import annotations

from collections.abc import Callable
from statistics import geometric_mean

from choice import cases, fastest, find_method
from results import Measurement

Case = list[Measurement]


def sentences(rows: list[Measurement]) -> list[str]:
    """Each number is the geometric mean over the workloads that have it."""
    by_case = list(cases(rows).values())
    return [_cost_of_exactness(by_case), _beside_zoltan(by_case), _beside_the_paper(by_case)]


def _cost_of_exactness(by_case: list[Case]) -> str:
    pairs = _pairs(by_case, lambda rows: fastest(rows, "1.10"), lambda rows: fastest(rows, "exact"))
    if not pairs:
        return "No method balanced any of the workloads exactly, so exactness has no price here."
    return (
        f"Exact balance took {_times(_ratio(pairs, _time))} the time of the fastest setting within"
        f" ten per cent ({_mean([exact.time_ms for _, exact in pairs])} ms against"
        f" {_mean([rough.time_ms for rough, _ in pairs])} ms) and"
        f" {_times(_ratio(pairs, _bytes))} its bytes{_of(pairs, by_case)}."
    )


def _beside_zoltan(by_case: list[Case]) -> str:
    pairs = _pairs(by_case, _fastest_exact_rrcb, lambda rows: find_method(rows, "zoltan-rcb"))
    if not pairs:
        return "Zoltan's RCB and an exact setting of RRCB were not measured on the same points."
    return (
        f"Zoltan's RCB needed {_times(_ratio(pairs, _time))} the time of the fastest exactly"
        f" balanced RRCB and {_times(_ratio(pairs, _bytes))} its bytes, while its own imbalance was"
        f" {_mean([zoltan.imbalance for _, zoltan in pairs], 6)}{_of(pairs, by_case)}."
    )


def _beside_the_paper(by_case: list[Case]) -> str:
    pairs = _pairs(by_case, _best_of_the_paper, _at_least_as_balanced)
    if not pairs:
        return "The paper's RRCB was not measured beside a setting of RRCB at least as balanced."
    return (
        f"The paper's RRCB at its most accurate left an imbalance of"
        f" {_mean([paper.imbalance for paper, _ in pairs], 5)}; RRCB at least as balanced took"
        f" {_times(_ratio(pairs, _time))} its time and left"
        f" {_mean([ours.imbalance for _, ours in pairs], 5)}{_of(pairs, by_case)}."
    )


def _fastest_exact_rrcb(rows: Case) -> Measurement | None:
    return fastest([row for row in rows if _is_ours(row)], "exact")


def _best_of_the_paper(rows: Case) -> Measurement | None:
    sampled = [row for row in rows if row.method.startswith("rrcb-sampled")]
    return min(sampled, key=lambda row: (row.imbalance, row.time_ms), default=None)


def _at_least_as_balanced(rows: Case) -> Measurement | None:
    paper = _best_of_the_paper(rows)
    if paper is None:
        return None
    ours = [row for row in rows if _is_ours(row) and row.imbalance <= paper.imbalance]
    return min(ours, key=_time, default=None)


def _is_ours(row: Measurement) -> bool:
    return row.method.split("[")[0] in ("rrcb", "rrcb-exact")


def _pairs(
    by_case: list[Case],
    first: Callable[[Case], Measurement | None],
    second: Callable[[Case], Measurement | None],
) -> list[tuple[Measurement, Measurement]]:
    found = [(first(rows), second(rows)) for rows in by_case]
    return [(a, b) for a, b in found if a and b and a.time_ms > 0 and a.bytes > 0]


def _time(row: Measurement) -> float:
    return row.time_ms


def _bytes(row: Measurement) -> float:
    return row.bytes


def _ratio(
    pairs: list[tuple[Measurement, Measurement]], value: Callable[[Measurement], float]
) -> float:
    """Second over first; the ratio of the means is the mean of the ratios."""
    return geometric_mean([value(second) / value(first) for first, second in pairs])


def _times(ratio: float) -> str:
    return f"{ratio:.3g} times"


def _mean(values: list[float], digits: int = 2) -> str:
    return f"{geometric_mean(values):.{digits}f}"


def _of(pairs: list, by_case: list[Case]) -> str:
    if len(by_case) == 1:
        return ""
    return f" (geometric means over {len(pairs)} of {len(by_case)} workloads)"
