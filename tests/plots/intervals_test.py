"""Intervals of medians against the binomial distribution worked out by hand, and by trial."""

from __future__ import annotations

import random
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "plots"))

from intervals import interval95, spread_of  # noqa: E402


class IntervalTest(unittest.TestCase):
    def test_needs_six_values(self) -> None:
        # Five values lie on one side of the median with 2 / 2^5 = 6.25 %, six with 3.125 %.
        self.assertIsNone(interval95([1, 2, 3, 4, 5]))
        self.assertEqual(interval95([6, 2, 3, 4, 5, 1]), (1, 6))

    def test_leaves_out_as_many_at_each_end_as_it_may(self) -> None:
        # Ten: (1 + 10) / 1024 = 1.07 % at each end with one left out, 5.5 % with two.
        self.assertEqual(interval95(range(10)), (1, 8))
        # Twenty: the tables of the sign test leave out five.
        self.assertEqual(interval95(range(20)), (5, 14))

    def test_holds_the_median_of_a_skewed_distribution_often_enough(self) -> None:
        source = random.Random(1)
        true_median = 0.6931471805599453
        held = 0
        for _ in range(2000):
            low, high = interval95([source.expovariate(1) for _ in range(15)])
            held += low <= true_median <= high
        self.assertGreater(held / 2000, 0.95)  # 96.5 % of them

    def test_texts_name_the_interval_where_there_is_one(self) -> None:
        self.assertEqual(spread_of([1.0, 2.0]).text(1), "1.5")
        self.assertEqual(spread_of([1.0] * 5 + [2.0]).text(2), "1.00 [1.00, 2.00]")


if __name__ == "__main__":
    unittest.main()
