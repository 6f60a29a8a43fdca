"""What rounds of simulations come to, from runs worked out by hand."""

from __future__ import annotations

import unittest
from math import isnan

import support  # noqa: F401, before the studies

import pandas as pd
from simulation import KEY, MEDIANS, limit_of, noise, summarise


def run(method: str, number: int, steps: float, balance: float = 0, **more: object) -> dict:
    """Seconds on the critical path, a quarter of the steps' network; by the clock ten times that."""
    row = dict.fromkeys([*KEY, *MEDIANS], 1) | {"method": method, "round": number, "seed": None}
    row |= {"step_path_s": 0.75 * steps, "step_network_s": 0.25 * steps, "error": None}
    row |= {"critical_path_s": steps + balance, "wall_s": 10 * (steps + balance), "scene": "slope"}
    return row | {"rebalances": 8, "moved_fraction": 0.25, "mean_imbalance": 1.5} | more


# Noise of the rounds cancels in the pairs.
RUNS = [
    *(run("none", i, path) for i, path in enumerate((8, 16, 12))),
    *(run("fast", i, path, path / 4) for i, path in enumerate((4, 8, 6))),
    *(run("slow", i, path, 2 * path, mean_imbalance=1 + path / 40) for i, path in enumerate((4, 8, 6))),
]
FAILED = dict.fromkeys(RUNS[0]) | {"method": "broken", "round": 1, "error": "no balance today"}


def summary(rows: list[dict]) -> pd.DataFrame:
    return summarise(pd.DataFrame(rows)).set_index("method")


class SummaryTest(unittest.TestCase):
    def test_takes_the_median_of_every_column(self) -> None:
        row = summary(RUNS).loc["slow"]
        found = row[["repeats", "wall_s", "mean_imbalance", "step_network_s", "critical_path_s"]]
        self.assertEqual(found.tolist(), [3, 180, 1.15, 1.5, 18])
        self.assertTrue(isnan(row["critical_path_s_low"]))

    def test_compares_with_no_rebalancing_of_the_same_round(self) -> None:
        rows = summary(RUNS)
        self.assertEqual(rows["speed_up_critical_path"].tolist(), [1, 8 / 5, 8 / 12])
        self.assertEqual(rows["ideal_speed_up"].tolist(), [2] * 3)  # 12 / 6 in the median
        self.assertEqual(rows["gain_kept"].tolist(), [0, (12 - 7.5) / (12 - 6), -1])

    def test_keeps_of_even_work_what_is_counted(self) -> None:
        counts = {"none": 8, "fast": 3, "slow": 5}  # of the busiest ranks; four ranks do 2 each
        rows = summary([r | {"counted": 8, "counted_path": counts[r["method"]], "ranks": 4} for r in RUNS])
        self.assertEqual(rows["gain_kept_work"].tolist(), [0, 5 / 6, 3 / 6])

    def test_keeps_no_gain_where_there_is_none(self) -> None:
        rows = summary([run("none", 1, 3), run("idle", 1, 3, 1)])
        self.assertEqual(rows["ideal_speed_up"].tolist(), [1, 1])
        self.assertTrue(rows["gain_kept"].isna().all())

    def test_has_intervals_from_six_rounds_on(self) -> None:
        rows = summary([run("rrcb", i, t, mean_imbalance=t) for i, t in enumerate((3, 6, 1, 4, 2, 5))])
        ends = rows.loc["rrcb", ["wall_s_low", "wall_s_high", "mean_imbalance_low", "mean_imbalance_high"]]
        self.assertEqual(ends.tolist(), [10, 60, 1, 6])

    def test_rounds_that_agree_without_a_seed_need_no_six_for_their_imbalance(self) -> None:
        rows = summary([run("rrcb", 1, 1), run("rrcb", 2, 2), run("none", 1, 1),
                        run("sampled", 1, 1, seed=1), run("sampled", 2, 1, seed=2)])  # fmt: skip
        self.assertEqual(rows.loc["rrcb", ["mean_imbalance_low", "mean_imbalance_high"]].tolist(), [1.5] * 2)
        self.assertTrue(rows.loc[["none", "sampled"], "mean_imbalance_low"].isna().all())

    def test_a_failure_leaves_the_others_alone(self) -> None:
        rows = summary([*RUNS, run("broken", 0, 1), FAILED])
        self.assertEqual(rows.loc["broken", "error"], "no balance today")
        self.assertTrue(rows.loc["broken"].drop("error").isna().all())
        self.assertEqual(rows["ideal_speed_up"].iloc[:3].tolist(), [2] * 3)
        rows = summary([row | {"error": "it fell"} if row["method"] == "none" else row for row in RUNS])
        self.assertTrue(rows["speed_up_critical_path"].isna().all())
        self.assertEqual(rows.loc["fast", "critical_path_s"], 7.5)


class NoiseTest(unittest.TestCase):
    def test_is_that_of_pairs(self) -> None:
        again = [run("fast again", i, path) for i, path in enumerate((5, 20, 7.5))]
        calls = pd.DataFrame(
            [(name, "fog", turn, time) for name, times in (("zoltan-rcb", (4, 8)), ("rrcb", (1, 1)),
                                                           ("zoltan-rcb again", (5, 8)))
             for turn, time in enumerate(times)], columns=["method", "workload", "turn", "time_ms"]
        )  # fmt: skip
        rows = noise(pd.DataFrame([*RUNS, *again]), calls)
        self.assertEqual(rows["workload"].tolist(), ["slope", "slope", "fog"])
        self.assertEqual(rows["what"].tolist(), ["fast", "fast critical path", "zoltan-rcb"])
        self.assertEqual(rows["ratio"].tolist(), [1, 1, 1.125])
        again[2] = FAILED | {"method": "fast again"}
        self.assertEqual(len(noise(pd.DataFrame([*RUNS, *again]), calls)), 1)


class MatterTest(unittest.TestCase):
    def test_the_limit_is_that_of_both_best_intervals(self) -> None:
        # r = 4: 200 (1 - 1/2) 8 / 2 steps, whichever of the two is slower.
        self.assertEqual([limit_of(8, 2, 2), limit_of(2, 8, 2)], [400, 400])
        self.assertEqual(limit_of(5, 5, 1), 0)


if __name__ == "__main__":
    unittest.main()
