"""Intervals of medians against the binomial distribution worked out by hand, and by trial."""

from __future__ import annotations

import random
import sys
import unittest
from math import isnan
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

from intervals import Value, interval95, mean_of, median_of


class IntervalTest(unittest.TestCase):
    def test_needs_six_values(self) -> None:
        # Five values lie on one side of the median with 2 / 2^5 = 6.25 %, six with 3.125 %.
        self.assertTrue(all(map(isnan, interval95([1, 2, 3, 4, 5]))))
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
        self.assertEqual(median_of([1.0, 2.0]).text(1), "1.5")
        self.assertEqual(median_of([1.0] * 5 + [2.0]).text(2), "1.00 [1.00, 2.00]")

    def test_a_ratio_reaches_as_far_as_both_allow(self) -> None:
        ratio = Value(6, 4, 8) / Value(2, 1, 4)
        self.assertEqual((ratio.number, ratio.low, ratio.high), (3, 1, 8))
        self.assertFalse((Value(6, 4, 8) / Value(2)).has_interval)

    def test_a_mean_has_an_interval_where_all_values_have(self) -> None:
        mean = mean_of([Value(2, 1, 4), Value(8, 4, 16)])
        for found, wanted in zip((mean.number, *mean.reach), (4, 2, 8), strict=True):
            self.assertAlmostEqual(found, wanted)
        self.assertFalse(mean_of([Value(2, 1, 4), Value(8)]).has_interval)
        self.assertFalse(mean_of([Value(2, 1, 4), Value(8, 0, 16)]).has_interval)

    def test_values_are_apart_where_their_intervals_do_not_meet_or_are_not_known(self) -> None:
        self.assertTrue(Value(1, 0.9, 1.1).is_apart(Value(2, 1.9, 2.1)))
        self.assertFalse(Value(1, 0.9, 1.9).is_apart(Value(2, 1.9, 2.1)))
        self.assertTrue(Value(1, 0.9, 1.9).is_apart(Value(1)))


if __name__ == "__main__":
    unittest.main()
