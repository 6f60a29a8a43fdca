"""What accuracy costs, from calls made by hand."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from support import measured

import pandas as pd
import price

# Of 1000 points on 4 ranks, sent by Zoltan's RCB 8 ms.
METHODS = {  # time, imbalance, bytes, rounds
    "zoltan-rcb": (8, 1, 1000, None), "rrcb[refine=none]": (1, 1.2, 90, 0), "rrcb[tol=1.1]": (2, 1.05, 100, 1),
    "rrcb[tol=1.003]": (2, 1.002, 105, 1), "rrcb": (2, 1.01, 100, 1), "rrcb-exact": (4, 1, 200, 3),
}  # fmt: skip


def folder_of(out: Path, cloud: str, repeats: int) -> None:
    rows = [
        measured(method, time, imbalance, bytes=sent, rounds=rounds, workload=cloud, repeats=repeats)
        for method, (time, imbalance, sent, rounds) in METHODS.items()
    ]
    rows += [rows[2] | {"method": price.TOLERANCES[name]} for name in ("1.05", "1.02")]
    rows += [rows[5] | {"method": price.TOLERANCES[name]} for name in ("1.001", "1.0003")]
    rows += [rows[4] | {"method": f"rrcb[mesh={mesh}]", "bytes": 100 * mesh} for mesh in price.MESHES]
    (out / cloud).mkdir()
    pd.DataFrame(rows).to_csv(out / cloud / "table.csv", index=False)
    again = rows[0] | {"method": "zoltan-rcb again"}
    turns = [
        {"method": row["method"], "workload": cloud, "turn": turn, "time_ms": row["time_ms_median"] * (1 + turn)}
        for row in [*rows, again] for turn in range(repeats)
    ]  # fmt: skip
    pd.DataFrame(turns).to_csv(out / cloud / "call_times.csv", index=False)


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
        self.assertFalse(price.noise_of(self.out).is_apart(price.ONE))

    def test_exact_cuts_pay_from_what_they_cost_over_what_they_save(self) -> None:
        rows = self.rows(6).set_index("method")
        of = {name: rows.loc[name].iloc[0] for name in ("rrcb", "rrcb-exact", "rrcb[refine=none]")}
        cores = min(price.CORES, 4)
        # 2 ms against 1 % of 1000 points of 1 us, shared by the cores.
        self.assertAlmostEqual(price.break_even(of["rrcb"], of["rrcb-exact"], 1000), 2 / 0.01 * cores)
        self.assertEqual(price.break_even(of["rrcb-exact"], of["rrcb"], 25), 0)
        table = price.table_of(rows.reset_index(), 4, 1000).set_index("setting")
        self.assertEqual(table.loc["1.01", "exact pays from, steps"], f"{200 * cores} ({200 * cores})")
        self.assertEqual(table.loc["1.01", "time / exact"], "0.50")
        self.assertEqual(table.loc["none", "imbalance left, %"], "20.000 (20.000)")
        self.assertEqual(table.loc["Zoltan's RCB", "rounds"], "–")

    def test_labels_too_near_for_a_line_each_share_one_in_their_order(self) -> None:
        levels = {"b": -1.80, "a": -1.95, "d": -1.0, "c": -1.70}
        self.assertEqual(price.labels_of(levels), [(-1.70, ["a", "b", "c"]), (-1.0, ["d"])])

    def test_counts_alone_need_no_times(self) -> None:
        rows = self.rows(1)
        self.assertNotIn("time / exact", price.table_of(rows, 4, 25))
        self.assertEqual(price.draw(rows).axes[0].get_ylabel(), "rounds of counting")
        found = price.choice_table(rows, 4).iloc[0]
        self.assertEqual(found["costs no more than 1.1"], "1.003")
        self.assertEqual(found["bytes of exact / of 1.01"], "2")


if __name__ == "__main__":
    unittest.main()
