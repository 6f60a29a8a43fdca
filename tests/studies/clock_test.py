"""Ratios of factors and of equal runs, from rounds whose times are products of known effects."""

from __future__ import annotations

import sys
import unittest
from itertools import product
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import pandas as pd
from clock import FACTORS, counts, factors

EFFECTS = {"rrcb": 0.9, "fewest": 0.5, "learned": 0.8}


def runs_of(rounds: int) -> pd.DataFrame:
    """Each round on a machine of its own speed; a column of ghosts saves a half, the second run a tenth."""
    rows = []
    for number in range(rounds):
        arms = [(levels, 0, 1.0) for levels in product(*FACTORS.values())]
        arms += [(("rrcb", "fewest", "ghosts"), 0, 0.4), (("rrcb", "fewest", "count"), 1, 0.9)]
        for levels, again, effect in arms:
            for level in levels:
                effect *= EFFECTS.get(level, 1)
            seconds = {"wall_s": (number + 1) * effect, "calls_s": 0.1 * effect}
            rows.append({"scene": "splash", "round": number, **dict(zip(FACTORS, levels)), "again": again,
                         **seconds, "ghosts": 10, "moved": 2})  # fmt: skip
    return pd.DataFrame(rows)


class ClockTest(unittest.TestCase):
    def test_each_effect_is_found_whatever_the_others_are(self) -> None:
        found = {name: ratio for name, ratio in factors(runs_of(6))[1:]}
        self.assertEqual(found["call: rrcb / zoltan-rcb"][:5], "0.900")
        self.assertEqual(found["cuts: fewest / longest"][:5], "0.500")
        self.assertEqual(found["weights: learned / count"][:5], "0.800")
        self.assertEqual(found["column of ghosts: with / without"][:5], "0.500")
        self.assertEqual(found["A/A: rrcb / itself"][:5], "0.900")

    def test_ratios_that_vary_have_an_interval(self) -> None:
        runs = runs_of(6)
        runs.loc[(runs["again"] == 1) & (runs["round"] == 5), "wall_s"] *= 2
        self.assertEqual(factors(runs)[-1][1], "0.900 [0.900, 1.800]")

    def test_counts_have_a_line_for_each_combination(self) -> None:
        lines = counts(runs_of(1))
        self.assertEqual(len(lines), 1 + 9)
        self.assertIn(["splash", "zoltan-rcb", "longest", "count", "1.00", "10.00", "10", "2"], lines)


if __name__ == "__main__":
    unittest.main()
