"""Finds, compares and formats numbers with 95 % intervals."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import comb, floor, isnan, log10, nan
from statistics import geometric_mean, median

NOT_TOLD_APART = "not told apart"
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Value:
    """A number and the ends of its interval. They are NaN if it has none."""

    number: float
    low: float = nan
    high: float = nan
    count: int = 1  # number of values of which it is the median

    @property
    def has_interval(self) -> bool:
        return not isnan(self.low)

    @property
    def reach(self) -> tuple[float, float]:
        """Returns the interval, or the number twice if it has none."""
        return (self.low, self.high) if self.has_interval else (self.number, self.number)

    def __truediv__(self, other: Value) -> Value:
        """Returns the ratio. Its interval is too wide if both numbers were measured in turns."""
        ends = (self.low / other.high, self.high / other.low) if other.low > 0 else (nan, nan)
        return Value(self.number / other.number, *ends)

    def is_apart(self, other: Value) -> bool:
        """Returns False if the intervals overlap. If one has no interval, compares the numbers."""
        return not (self.low <= other.high and other.low <= self.high)

    def text(self, digits: int, kind: str = "f") -> str:
        """Returns a text like 17.5 [17.1, 18.0], or the number alone if it has no interval or the interval is a point.
        """
        number, low, high = (f"{v:.{digits}{kind}}" for v in (self.number, self.low, self.high))
        return f"{number} [{low}, {high}]" if self.low < self.high else number


ONE = Value(1, 1, 1)


def value_of(row: object, name: str) -> Value:
    """Returns the value of a row with the columns name, name_low and name_high."""
    return Value(*(getattr(row, name + end, nan) for end in ("", "_low", "_high")))


def in_digits(value: float, significant: int) -> str:
    """Returns the value rounded to significant digits, without powers of ten."""
    return f"{float(f'{value:.{significant}g}'):g}"


def decimals(values: Iterable[float], significant: int) -> int:
    """Returns the number of decimals with which the smallest of these positive values keeps its significant digits."""
    least = min((value for value in values if value > 0), default=1.0)
    return max(0, significant - 1 - floor(log10(least)))


def mean_of(values: Iterable[Value]) -> Value:
    """Returns the geometric mean. Its interval is as wide as if all errors had the same sign."""
    values = list(values)
    known = all(v.low > 0 for v in values)
    ends = ([v.low for v in values], [v.high for v in values]) if known else ()
    return Value(*map(geometric_mean, ([v.number for v in values], *ends)), count=len(values))


def interval95(values: Iterable[float]) -> tuple[float, float]:
    """Returns a confidence interval of at least 95 % for the median of the distribution of the values. It is the
    narrowest one that leaves out equally many values at each end, by the binomial distribution. Returns NaN for
    fewer than 6 values, whose full range has less than 95 % confidence."""
    ordered = sorted(values)
    count = len(ordered)
    left_out = -1
    outside = 0.0  # probability that at most `left_out` of the values are below the median
    while (outside := outside + comb(count, left_out + 1) / 2**count) <= (1 - CONFIDENCE) / 2:
        left_out += 1
    return (nan, nan) if left_out < 0 else (ordered[left_out], ordered[count - 1 - left_out])


def median_of(values: Iterable[float]) -> Value:
    values = list(values)
    return Value(median(values), *interval95(values), len(values))
