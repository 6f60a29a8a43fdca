"""Numbers with intervals of 95 %: how they are found and written, and what they tell apart."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import comb, floor, isnan, log10, nan
from statistics import geometric_mean, median

NOT_TOLD_APART = "not told apart"
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Value:
    """A number and the ends of its interval, which are NaN where it has none."""

    number: float
    low: float = nan
    high: float = nan
    count: int = 1  # of the values it is the median of

    @property
    def has_interval(self) -> bool:
        return not isnan(self.low)

    @property
    def reach(self) -> tuple[float, float]:
        """The interval, else the number twice."""
        return (self.low, self.high) if self.has_interval else (self.number, self.number)

    def __truediv__(self, other: Value) -> Value:
        """Its interval is too wide where the two were measured in turns."""
        ends = (self.low / other.high, self.high / other.low) if other.low > 0 else (nan, nan)
        return Value(self.number / other.number, *ends)

    def is_apart(self, other: Value) -> bool:
        """False where the intervals overlap; where one was not measured the numbers count."""
        return not (self.low <= other.high and other.low <= self.high)

    def text(self, digits: int, kind: str = "f") -> str:
        """As in 17.5 [17.1, 18.0]; the number alone where it has no interval or it is a point."""
        number, low, high = (f"{v:.{digits}{kind}}" for v in (self.number, self.low, self.high))
        return f"{number} [{low}, {high}]" if self.low < self.high else number


ONE = Value(1, 1, 1)


def value_of(row: object, name: str) -> Value:
    """Of a row with the columns name, name_low and name_high."""
    return Value(*(getattr(row, name + end, nan) for end in ("", "_low", "_high")))


def in_digits(value: float, significant: int) -> str:
    """Rounded, without powers of ten."""
    return f"{float(f'{value:.{significant}g}'):g}"


def decimals(values: Iterable[float], significant: int) -> int:
    """Behind the point, for the least of these positive values to keep so many digits."""
    least = min((value for value in values if value > 0), default=1.0)
    return max(0, significant - 1 - floor(log10(least)))


def mean_of(values: Iterable[Value]) -> Value:
    """Geometric mean; its interval is as wide as if all erred to the same side."""
    values = list(values)
    known = all(v.low > 0 for v in values)
    ends = ([v.low for v in values], [v.high for v in values]) if known else ()
    return Value(*map(geometric_mean, ([v.number for v in values], *ends)), count=len(values))


def interval95(values: Iterable[float]) -> tuple[float, float]:
    """Two order statistics, equally far from both ends, that hold the median of what the values
    are drawn from with at least 95 %: the narrowest such pair, by the binomial distribution. NaN
    of fewer than 6 values, where even the least and the most hold it with less."""
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
