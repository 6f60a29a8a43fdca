"""Histories and rules worked out by hand, and the regrets of the library's controller."""

from __future__ import annotations

import os
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

import support  # noqa: F401, before the studies

import numpy as np
import pandas as pd
import plot
import rebalancing
from load_histories import NOISES, History, false_starts, foreign, generated, noise, recorded, strangers

GROWTH = np.arange(6)[:, None] * np.array([0.1, -0.1])


def rows(*values: tuple[str, float, str, float, int]) -> pd.DataFrame:
    names = ["history", "level", "rule", "regret", "calls"]
    return pd.DataFrame(values, columns=names).assign(group="recorded")


class HistoryTest(unittest.TestCase):
    def test_loads_count_from_the_rebalance(self) -> None:
        history = History("growth", GROWTH, 0.5)
        loads, points = history.loads(2, np.array([2, 4]))
        np.testing.assert_allclose(loads, [[1, 1], [1.2, 0.8]])
        np.testing.assert_allclose(points, loads)
        self.assertAlmostEqual(rebalancing.cost_of(history, np.ones((6, 2)), [3]), 6 + 2 * 0.3 + 0.5)

    def test_loads_show_in_some_steps_and_are_slow_after_a_rebalance(self) -> None:
        shows = np.array([1, 0, 0, 0, 1, 0])
        history = History("multirate", GROWTH, 1, shows=shows, base=1 + shows, slow=2, fade=0.5)
        loads, points = history.loads(3, np.array([3, 4]))
        np.testing.assert_allclose(loads, [[3, 3], [2 * 1.1 * 2, 2 * 0.9 * 2]])
        np.testing.assert_allclose(points, [[1, 1], [1.1, 0.9]])

    def test_noise_is_the_same_for_a_seed_and_as_large_as_its_level(self) -> None:
        history = History("even", np.zeros((2000, 8)), 1)
        for kind in NOISES:
            factors = noise(kind, 0.1, history, 3)
            np.testing.assert_array_equal(factors, noise(kind, 0.1, history, 3))
            self.assertAlmostEqual(np.median(factors), 1, delta=0.02)
        self.assertAlmostEqual(noise("white", 0.1, history, 3).std(), 0.1, delta=0.005)

    def test_recorded_drift_goes_on_across_rebalances(self) -> None:
        lines = [f"rrcb,{step},{part},{100 + (1 - 2 * part) * 10 * (step % 2)}" for step in range(4) for part in (0, 1)]
        with TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "history.csv").write_text("method,step,part,points\n" + "\n".join(lines) + "\n")
            row = "rrcb,4,2,2,0.4,1.0,0.08,0.02"
            (folder / "simulation_runs.csv").write_text(
                "method,steps,every,rebalances,step_path_s,mean_imbalance,balance_path_s,balance_network_s\n" + row + "\n"
            )
            (history,) = recorded(folder)
        np.testing.assert_allclose(history.drift, np.array([[0, 0], [0.1, -0.1], [0.2, -0.2], [0.3, -0.3]]))
        self.assertAlmostEqual(history.cost_of[0], 0.5)  # 0.05 s of steps of 0.1 s


    def test_strangers_have_loads_of_their_own(self) -> None:
        histories = strangers(1)
        self.assertEqual(len({history.name for history in histories}), 60)
        slow = next(h for h in histories if h.name.startswith("a slow core"))
        loads, points = slow.loads(0, np.array([slow.steps // 3 - 1, slow.steps // 3]))
        self.assertGreater(np.ptp(loads - points, axis=1)[1], 0.05)
        np.testing.assert_allclose(loads[0], points[0])


    def test_false_starts_are_slow_or_dear_at_first(self) -> None:
        slow, dear = false_starts(1)[0], false_starts(1)[20]
        self.assertGreater(slow.base_of[0], 2.9)
        self.assertEqual(slow.base_of[8], 1)
        self.assertAlmostEqual(dear.cost_of[0], 10 * dear.cost_of[1])


class RuleTest(unittest.TestCase):
    def test_waste_is_cost_after_a_few_steps(self) -> None:
        history = History("growth", GROWTH, 0.3)  # waste 0, 0.1, 0.3
        self.assertEqual(rebalancing.when_waste_is_cost(history, np.ones((6, 2))), [3])

    def test_intervals_reach_from_one_to_never(self) -> None:
        self.assertEqual(rebalancing.intervals(6), [1, 2, 3, 4, 5, 6])
        self.assertEqual(rebalancing.intervals(1000)[-1], 1000)

    @unittest.skipUnless("RRCB_RULE_REPLAY" in os.environ, "needs the library of the rule")
    def test_controller_has_little_regret(self) -> None:
        replay = rebalancing.Replay(Path(os.environ["RRCB_RULE_REPLAY"]))
        names = {"growth", "jumps", "nothing", "in one step of 3", "iterations vary", "slow by 4 after"}
        some = [h for h in generated(3) + foreign(3) if h.steps <= 2000 and any(h.name.startswith(n) for n in names)]
        self.assertGreater(len(some), 12)
        found = []
        for seed, history in enumerate(some):
            for level in (0.0, 0.06):
                factors = noise("white", level, history, seed) if level else np.ones(history.drift.shape)
                found += [row for row in rebalancing.rows_of(replay, "", history, factors) if row["rule"] == rebalancing.OURS]
        regrets = [row["regret"] for row in found if row["cost"] > 0]
        self.assertLess(np.mean(regrets), 0.01)
        self.assertLess(np.quantile(regrets, 0.9), 0.05)


class ReportTest(unittest.TestCase):
    def setUp(self) -> None:
        rules = (rebalancing.OURS, rebalancing.LOAD_ONLY, "waste is cost", "never")
        values = [("slope", level, rule, regret, 3) for level, regret in ((0, 0.02), (0.1, 0.06)) for rule in rules]
        self.rows = rows(*values, ("slope", 0, "every 5", 0.5, 0), ("slope", 0, "every 9", 0.0, 0))

    def test_table_has_a_row_per_level(self) -> None:
        lines = rebalancing.table_of(self.rows).splitlines()
        self.assertEqual(lines[2].split(" | ")[1:3], ["0%", "2.0, 2.0 %"])
        self.assertEqual(len(lines), 4)

    def test_summary_names_the_worst(self) -> None:
        text = rebalancing.summary(self.rows)
        self.assertIn("Above 5 % at any noise: 1 of 1: slope (6 %)", text)
        self.assertIn("Calls within 1: 1 of 1, at most 0 apart", text)

    def test_pictures_are_drawn(self) -> None:
        plot.use_style()
        self.assertEqual(len(rebalancing.draw_regrets(self.rows).axes[0].lines), 5)
        self.assertEqual(rebalancing.draw_intervals(self.rows).axes[0].get_title(), "slope")


if __name__ == "__main__":
    unittest.main()
