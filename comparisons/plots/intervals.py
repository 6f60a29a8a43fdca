"""Intervals of 95 %: how they are found, how they are written, and what they tell apart."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import comb, floor, log10
from statistics import geometric_mean, median

from results import Interval

NOT_TOLD_APART = "not told apart"
CONFIDENCE = 0.95


def with_interval(value: float, interval: Interval | None, digits: int) -> str:
    """As in 17.5 [17.1, 18.0]; the value alone where there is no interval or it is one number."""
    if interval is None or interval[0] == interval[1]:
        return f"{value:.{digits}f}"
    low, high = interval
    return f"{value:.{digits}f} [{low:.{digits}f}, {high:.{digits}f}]"


def in_digits(value: float, significant: int) -> str:
    """Rounded, without powers of ten."""
    return f"{float(f'{value:.{significant}g}'):g}"


def decimals(values: Iterable[float], significant: int) -> int:
    """Behind the point, for the least of these positive values to keep so many digits."""
    least = min((value for value in values if value > 0), default=1.0)
    return max(0, significant - 1 - floor(log10(least)))


def are_apart(first: Interval | None, second: Interval | None) -> bool:
    """False where the intervals overlap; where one was not measured the values alone count."""
    if first is None or second is None:
        return True
    return first[1] < second[0] or second[1] < first[0]


def differs_from_one(ratio: Interval | None) -> bool:
    return are_apart(ratio, (1.0, 1.0))


def quotient(first: Interval | None, second: Interval | None) -> Interval | None:
    """Bounds of first / second; too wide where the two were measured in turns."""
    if first is None or second is None or min(second) <= 0:
        return None
    return first[0] / second[1], first[1] / second[0]


def inverse(interval: Interval | None) -> Interval | None:
    return quotient((1.0, 1.0), interval)


def mean_interval(intervals: Iterable[Interval | None]) -> Interval | None:
    """Bounds of a geometric mean; as wide as if all erred to the same side."""
    known = list(intervals)
    if not known or any(interval is None or min(interval) <= 0 for interval in known):
        return None
    low, high = zip(*known)
    return geometric_mean(low), geometric_mean(high)


@dataclass(frozen=True)
class Spread:
    """A median and where the true one lies; no interval where the values are too few for one."""

    median: float
    interval: Interval | None
    count: int

    @property
    def low(self) -> float:
        return self.interval[0] if self.interval else self.median

    @property
    def high(self) -> float:
        return self.interval[1] if self.interval else self.median

    def text(self, digits: int) -> str:
        return with_interval(self.median, self.interval, digits)


def interval95(values: Sequence[float]) -> Interval | None:
    """Two order statistics, equally far from both ends, that hold the median of what the values
    are drawn from with at least 95 %: the narrowest such pair, by the binomial distribution. None
    of fewer than 6 values, where even the least and the most hold it with less."""
    count = len(values)
    left_out = -1
    outside = 0.0  # probability that at most `left_out` of the values are below the median
    while (outside := outside + comb(count, left_out + 1) / 2**count) <= (1 - CONFIDENCE) / 2:
        left_out += 1
    if left_out < 0:
        return None
    ordered = sorted(values)
    return ordered[left_out], ordered[count - 1 - left_out]


def spread_of(values: Sequence[float]) -> Spread:
    return Spread(median(values), interval95(values), len(values))
