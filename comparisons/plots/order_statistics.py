"""Medians and how sure they are, whatever the distribution of the values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb
from statistics import median

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Spread:
    """A median and where the true one lies; no interval where the values are too few for one."""

    median: float
    interval: tuple[float, float] | None
    count: int

    @property
    def low(self) -> float:
        return self.interval[0] if self.interval else self.median

    @property
    def high(self) -> float:
        return self.interval[1] if self.interval else self.median

    def text(self, digits: int) -> str:
        """As in 1.50 [1.40, 1.60]."""
        middle = f"{self.median:.{digits}f}"
        if self.interval is None:
            return middle
        return f"{middle} [{self.low:.{digits}f}, {self.high:.{digits}f}]"


def interval95(values: Sequence[float]) -> tuple[float, float] | None:
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
