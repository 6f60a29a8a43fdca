"""What accuracy costs, from calls made by hand."""

from __future__ import annotations

import re
import tempfile
import unittest
from pathlib import Path
from unittest.mock import patch

from support import measured

import pandas as pd
import price

ROOT = Path(__file__).resolve().parents[2]

# Of 1000 points on 4 ranks, sent by Zoltan's RCB 8 ms.
METHODS = {  # time, imbalance, bytes, rounds
    "zoltan-rcb": (8, 1, 1000, None), "rrcb[refine=none]": (1, 1.2, 90, 0), "rrcb[tol=1.1]": (2, 1.05, 100, 1),
    "rrcb[tol=1.003]": (2, 1.002, 105, 1), "rrcb": (2, 1.01, 100, 1), "rrcb-exact": (4, 1, 200, 3),
}  # fmt: skip


def folder_of(out: Path, cloud: str, repeats: int, ranks: int = 4, again: float = 1) -> None:
    """Calls of all methods on a cloud, and of Zoltan's RCB again in `again` times its time."""
    rows = [
        measured(method, time, imbalance, bytes=sent, rounds=rounds, workload=cloud, repeats=repeats, ranks=ranks)
        for method, (time, imbalance, sent, rounds) in METHODS.items()
    ]
    rows += [rows[2] | {"method": price.TOLERANCES[name]} for name in ("1.05", "1.02")]
    rows += [rows[5] | {"method": price.TOLERANCES[name]} for name in ("1.001", "1.0003")]
    folder = out / f"{cloud}-{ranks}"
    folder.mkdir()
    pd.DataFrame(rows).to_csv(folder / "table.csv", index=False)
    second = rows[0] | {"method": "zoltan-rcb again", "time_ms_median": 8 * again}
    turns = [
        {"method": row["method"], "workload": cloud, "turn": turn, "time_ms": row["time_ms_median"] * (1 + turn)}
        for row in [*rows, second] for turn in range(repeats)
    ]  # fmt: skip
    pd.DataFrame(turns).to_csv(folder / "call_times.csv", index=False)


class PriceTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.out = Path(temporary.name)

    def rows(self, repeats: int) -> pd.DataFrame:
        for cloud in ("slope", "shell"):
            folder_of(self.out, cloud, repeats)
        return price.rows_of(self.out)

    def test_times_are_ratios_of_a_turn_with_intervals(self) -> None:
        rows = self.rows(6)
        found = rows[rows["method"] == "rrcb"].iloc[0]
        self.assertEqual(found["time"].reach, (0.25, 0.25))  # however the turns slow down
        self.assertEqual(found["bytes_over_zoltan"], 0.1)

    def test_turns_of_a_run_are_one_value_of_the_noise(self) -> None:
        for number, again in enumerate((0.97, 0.97, 0.97, 0.97, 0.97, 1.01)):
            folder_of(self.out, f"cloud{number}", 6, again=again)
        found = price.noise_of(self.out)
        self.assertEqual(found.reach, (0.97, 1.01))  # of 36 turns it would be told apart from itself
        self.assertFalse(found.is_apart(price.ONE))

    def test_many_ranks_a_core_are_counted_and_not_timed(self) -> None:
        self.rows(6)
        for cloud in ("slope", "shell"):
            folder_of(self.out, cloud, 1, ranks=64)
        rows = price.rows_of(self.out)
        self.assertNotIn("time / exact", price.table_of(rows, 64, price.Value(25)))
        texts = [[text.get_text() for text in axes.texts] for axes in price.draw(rows).axes]
        self.assertEqual([i for i, found in enumerate(texts) if "too many ranks a core\nto be timed" in found], [1])
        self.assertTrue(pd.isna(price.noise_of(self.out).low))  # of two runs

    @patch.object(price, "GAIN", price.Value(0.66, -0.91, 2.14))
    def test_exact_cuts_pay_from_what_they_cost_over_what_they_save(self) -> None:
        rows = self.rows(6)
        of = {name: rows[rows["method"] == name].iloc[0] for name in ("rrcb", "rrcb-exact", "rrcb[refine=none]")}
        cores = min(price.CORES, 4)
        # Turns of 2, 4 ... 12 ms more against 1 % of 1000 points of 1 us, shared by the cores.
        turns, step = of["rrcb"]["turns"], price.Value(1000)
        found = price.break_even(of["rrcb"], of["rrcb-exact"], turns, step)
        self.assertAlmostEqual(found.number, 7 / 0.0066 * cores)
        self.assertAlmostEqual(found.low, 2 / 0.0214 * cores)
        self.assertEqual(found.high, float("inf"))  # evener points may not make a step shorter
        self.assertEqual(price.break_even(of["rrcb-exact"], of["rrcb"], turns, step).number, 0)
        table = price.table_of(rows, 4, step).set_index("setting")
        self.assertEqual(table.loc["1.01", "exact pays from, steps"], f"{700 * cores / 0.66:.0f} [{200 * cores / 2.14:.0f}, inf]")
        self.assertEqual(table.loc["1.01", "time / exact"], "0.50")
        self.assertEqual(table.loc["none", "imbalance left, %"], "20.000 (20.000)")
        self.assertEqual(table.loc["Zoltan's RCB", "rounds"], "–")

    def test_a_tolerance_costs_what_it_leaves_and_its_share_of_a_call(self) -> None:
        costs = price.cost_rows(self.rows(6), 4, 1000).set_index(["every", "setting"])
        cores = min(price.CORES, 4)
        # A step takes 1 ms over the cores, the call 2 ms.
        self.assertAlmostEqual(costs.loc[(100, "1.01"), "cost"], 1 + 2 * cores)
        self.assertAlmostEqual(costs.loc[(1000, "Zoltan's RCB"), "most"], 0.8 * cores)
        lines = price.cost_table(costs.reset_index()).set_index("setting")
        found = lines.loc[["1.003", "exact"], "easy, every 1,000 steps"].tolist()
        self.assertEqual(found, [f"**{0.2 + 0.2 * cores:g}**", f"{0.4 * cores:g}"])

    def test_counts_alone_need_no_times(self) -> None:
        rows = self.rows(1)
        self.assertNotIn("time / exact", price.table_of(rows, 4, price.Value(25)))
        self.assertEqual(price.draw(rows).axes[0].get_ylabel(), "rounds of counting")
        found = price.choice_table(rows, 4).iloc[0]
        self.assertEqual(found["costs no more than 1.1"], "1.003")
        self.assertEqual(found["bytes of exact / of 1.01"], "2")


class DocumentTest(unittest.TestCase):
    def test_choosing_has_the_counts_of_price_csv(self) -> None:
        counts = pd.read_csv(ROOT / "comparisons/price.csv").set_index(["cloud", "dim", "ranks"])
        exact = counts[counts["method"] == price.EXACT]
        text = (ROOT / "docs/choosing.md").read_text().partition("| setting | imbalance left")[2]
        methods = {name: price.TOLERANCES[name] for name in ("1.1", "1.01", "1.001", "exact")}
        for name, method in (methods | {"Zoltan's RCB": price.ZOLTAN}).items():
            (row,) = re.findall(rf"^\| {re.escape(name)} \|" + r"([^|]*)\|" * 6, text, re.M)
            of = counts[counts["method"] == method].xs(16, level="ranks")
            ratios = of["bytes"] / exact["bytes"].xs(16, level="ranks")
            columns = (100 * (of["imbalance"] - 1), of["rounds"], ratios)
            found = [value for values in columns for value in (values.median(), values.max())]
            for written, value in zip(map(str.strip, row), found):
                digits = len(written.partition(".")[2])
                self.assertEqual(f"{value:.{digits}f}" if written else "", written, (name, row))
        of = counts[counts["method"] == "rrcb"].xs(64, level="ranks")["bytes"] / exact["bytes"].xs(64, level="ranks")
        self.assertIn(f"1.01 sends {of.median():.2f} of exact's bytes, at worst {of.max():.2f}.", " ".join(text.split()))


if __name__ == "__main__":
    unittest.main()
