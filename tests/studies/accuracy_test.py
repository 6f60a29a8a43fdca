"""Chooses settings from small tables."""

from __future__ import annotations

import unittest

from support import measured, table

import accuracy
import pandas as pd

ROWS = [
    measured("zoltan-rcb", 8, 1.0),
    measured("rrcb-sampled", 2, 1.2),
    measured("rrcb[tol=1.05]", 1, 1.04),
    measured("rrcb", 3, 1.009),
    measured("rrcb-exact", 2, 1.004),
]


class AccuracyTest(unittest.TestCase):
    def choice(self, tolerance: str, rows: list[dict], case: str = "fog 2-D sorted") -> pd.Series:
        return accuracy.choices(table(*rows)).set_index(["case", "tolerance"]).loc[(case, tolerance)]

    def test_takes_the_fastest_within_the_tolerance(self) -> None:
        found = self.choice("1.05", ROWS)
        self.assertEqual((found["setting"], found["time_ms"]), ("rrcb[tol=1.05]", 1))
        self.assertAlmostEqual(found["times_as_fast"], 8)
        self.assertEqual(self.choice("1.01", ROWS)["setting"], "rrcb-exact")
        self.assertEqual(self.choice("1.001", ROWS)["setting"], "zoltan-rcb")
        self.assertEqual(self.choice("1.01", [measured("rrcb", 2, 1.2)])["setting"], "")

    def test_calls_exact_what_is_one_point_above_the_mean(self) -> None:
        self.assertEqual(self.choice("exact", ROWS)["setting"], "rrcb-exact")
        self.assertFalse(accuracy.is_within(table(measured("a", 1, 1.005)), "exact").any())

    def test_wants_the_tolerance_on_every_cloud(self) -> None:
        imbalances = {"rrcb[tol=1.05]": 1.2, "rrcb-exact": 1, "zoltan-rcb": 1}
        mist = [measured(name, 2, value, workload="mist") for name, value in imbalances.items()]
        found = self.choice("1.10", ROWS + mist, accuracy.EVERYWHERE)
        self.assertEqual(found["setting"], "rrcb-exact")
        self.assertAlmostEqual(found["times_as_fast"], 2)  # of 4 and 1

    def test_names_rivals_within_the_noise(self) -> None:
        for spread, rivals in ((0.1, "b"), (0.05, "")):
            rows = [measured("a", 2.0, 1.0, spread=spread), measured("b", 2.3, 1.0, spread=spread)]
            self.assertEqual(self.choice("exact", rows)["not_told_apart_from"], rivals)

    def test_judges_the_automatic_mesh_by_the_best_setting_of_rrcb(self) -> None:
        found = accuracy.judgements(table(*ROWS)).set_index("tolerance")
        self.assertEqual(found.loc["1.01", ["best", "time_ratio"]].tolist(), ["rrcb-exact", "1.500"])
        self.assertEqual(found["within_20_percent"].to_dict(), {"1.05": "yes", "1.01": "no", "exact": "yes"})


if __name__ == "__main__":
    unittest.main()
