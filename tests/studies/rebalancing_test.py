"""Tabulates and draws the regrets of a few rules."""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import rebalancing
from results import read_all

REGRETS = {"growth 1": (0.01, 0.5), "jumps 2": (0.03, 0.04), '"slope, cost 5"': (0.06, 0.0)}


class RebalancingTest(unittest.TestCase):
    def setUp(self) -> None:
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        rows = ["trace,rule,cost,regret"]
        for trace, (ours, others) in REGRETS.items():
            rows += [f"{trace},optimum,100,0", f"{trace},controller,1,{ours}"]
            rules = [rule for rule in rebalancing.STYLES if rule != "controller"]
            rows += [f"{trace},{rule},1,{others}" for rule in rules]
        (self.directory / "controller.csv").write_text("\n".join(rows) + "\n")
        self.regrets = rebalancing.regrets_of(read_all(self.directory / "controller.csv"))

    def test_table_has_a_row_per_rule_but_the_optimum(self) -> None:
        lines = rebalancing.table_of(self.regrets).splitlines()
        self.assertEqual(len(lines), 2 + len(rebalancing.STYLES))
        self.assertEqual(lines[2], "| controller | 2.0 % | 3.0 % | 6.0 % | 6.0 % | 1 of 3 |")
        self.assertEqual(lines[3], "| plain criterion | 27.0 % | 50.0 % | 0.0 % | 0.0 % | 1 of 3 |")

    def test_picture_is_drawn(self) -> None:
        axes = rebalancing.draw_regrets(self.regrets).axes[0]
        labels = [text.get_text() for text in axes.get_yticklabels()]
        self.assertEqual(labels, list(self.regrets.index))
        self.assertEqual(len(axes.collections), len(rebalancing.STYLES))


if __name__ == "__main__":
    unittest.main()
