"""What accuracy cost, in sentences computed from the measurements."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from statistics import geometric_mean

import pandas as pd
from choice import fastest
from intervals import NOT_TOLD_APART, ONE, Value, in_digits, mean_of, value_of
from methods import is_ours, parse
from results import cases, is_within, row_of

Cases = list[pd.DataFrame]
Pairs = list[tuple]


def sentences(rows: pd.DataFrame) -> list[str]:
    """Each number is the geometric mean over the workloads that have it; none without rows."""
    by_case = list(cases(rows).values())
    parts = (_cost_of_exactness, _beside_zoltan, _fewest_bytes, _beside_the_paper)
    return [sentence(by_case) for sentence in parts if by_case]


def _cost_of_exactness(by_case: Cases) -> str:
    pairs = _pairs(by_case, lambda rows: fastest(_ours(rows), "1.10"), _fastest_exact_rrcb)
    if not pairs:
        return "No setting of RRCB balanced exactly, so exactness has no price here."
    return (
        f"Exact balance by RRCB took {_time_ratio(pairs)} of its fastest setting within"
        f" ten per cent ({_mean(exact.time_ms for _, exact in pairs)} ms against"
        f" {_mean(rough.time_ms for rough, _ in pairs)} ms) and"
        f" {_byte_ratio(pairs)} its bytes{_of(pairs, by_case)}."
    )


def _beside_zoltan(by_case: Cases) -> str:
    pairs = _pairs(by_case, _fastest_exact_rrcb, lambda rows: row_of(rows, "zoltan-rcb"))
    if not pairs:
        return "Zoltan's RCB and an exact setting of RRCB were not measured on the same points."
    return (
        f"Zoltan's RCB needed {_time_ratio(pairs)} of the fastest exactly"
        f" balanced RRCB and {_byte_ratio(pairs)} its bytes, while its own imbalance was"
        f" {_mean((zoltan.imbalance for _, zoltan in pairs), 6)}{_of(pairs, by_case)}."
    )


def _fewest_bytes(by_case: Cases) -> str:
    """Zoltan's RCB is not the method that moves the fewest bytes."""
    pairs = _pairs(by_case, _fastest_exact_rrcb, _fewest_bytes_exactly)
    if not pairs:
        return "No exact setting of RRCB was measured, so its bytes are not compared."
    names = _list(list(dict.fromkeys(fewest.method for _, fewest in pairs)))
    text = f"Of all methods that balanced exactly, {names} moved the fewest bytes"
    if any(ours.method != fewest.method for ours, fewest in pairs):
        text += f", {_byte_ratio(pairs)} those of that RRCB{_of(pairs, by_case)}"
    return text + "."


def _beside_the_paper(by_case: Cases) -> str:
    rows = pd.concat(by_case)
    rows = rows[[parse(method)[0] == "rrcb-sampled" for method in rows["method"]]]
    means = rows.groupby("method", sort=False)["excess"].agg(geometric_mean)
    best = means.idxmin() if len(means) else ""
    pairs = _pairs(
        by_case,
        lambda rows: row_of(rows, best),
        lambda rows: _at_least_as_balanced(rows, row_of(rows, best)),
    )
    if not pairs:
        return "The paper's RRCB was not measured beside a setting of RRCB at least as balanced."
    number = f"{len(means)} measured setting" + "s" * (len(means) > 1)
    left = {
        name: mean_of(value_of(row, "imbalance") for row in of.itertuples())
        for name, of in rows.groupby("method", sort=False)
    }
    rivals = sum(name != best and not left[name].is_apart(left[best]) for name in left)
    same = f" ({NOT_TOLD_APART} from {rivals} over the seeds)" * (rivals > 0)
    return (
        f"Of the {number} of the paper's RRCB, {best} was the most accurate{same} and left an imbalance"
        f" of {_mean((paper.imbalance for paper, _ in pairs), 5)}; RRCB at least as balanced took"
        f" {_time_ratio(pairs, 'its time')} and left"
        f" {_mean((ours.imbalance for _, ours in pairs), 5)}{_of(pairs, by_case)}."
    )


def _ours(rows: pd.DataFrame) -> pd.DataFrame:
    return rows[rows["method"].map(is_ours)]


def _fastest_exact_rrcb(rows: pd.DataFrame) -> object | None:
    return fastest(_ours(rows), "exact")


def _fewest_bytes_exactly(rows: pd.DataFrame) -> object | None:
    """RRCB where others move as few."""
    ours = getattr(_fastest_exact_rrcb(rows), "Index", None)
    exact = rows[is_within(rows, "exact")].itertuples()
    return min(exact, key=lambda row: (row.bytes, row.Index != ours), default=None)


def _at_least_as_balanced(rows: pd.DataFrame, paper: object | None) -> object | None:
    return paper and fastest(_ours(rows), str(paper.imbalance))


def _pairs(by_case: Cases, first: Callable, second: Callable) -> Pairs:
    found = [(first(rows), second(rows)) for rows in by_case]
    return [(a, b) for a, b in found if a and b and a.time_ms > 0 and a.bytes > 0]


def _time_ratio(pairs: Pairs, what: str = "the time") -> str:
    """The second's time over the first's; the ratio of the means is the mean of the ratios."""
    ratio = geometric_mean([second.time_ms / first.time_ms for first, second in pairs])
    interval = mean_of(_quotient_of_times(first, second) for first, second in pairs)
    same = f" ({NOT_TOLD_APART})" * (not interval.is_apart(ONE))
    return f"{Value(ratio, interval.low, interval.high).text(2)} times {what}{same}"


def _quotient_of_times(first: object, second: object) -> Value:
    """Of the paired ratios where one of them is Zoltan's RCB, which all are measured beside."""
    if second.method == "zoltan-rcb":
        return ONE / value_of(first, "time_vs_zoltan_rcb")
    if first.method == "zoltan-rcb":
        return value_of(second, "time_vs_zoltan_rcb")
    return value_of(second, "time_ms") / value_of(first, "time_ms")


def _byte_ratio(pairs: Pairs) -> str:
    ratio = geometric_mean([second.bytes / first.bytes for first, second in pairs])
    return f"{in_digits(ratio, 3)} times"


def _mean(values: Iterable[float], digits: int = 2) -> str:
    return f"{geometric_mean(values):.{digits}f}"


def _list(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _of(pairs: Pairs, by_case: Cases) -> str:
    text = f" (geometric means over {len(pairs)} of {len(by_case)} workloads)"
    return text * (len(by_case) > 1)
