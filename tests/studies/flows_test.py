"""Costs of policies along a flow, from two calls made by hand."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

import support  # noqa: F401

import flows
import pandas as pd

# 100 points; at the second call so many move, and at both so many are ghosts.
POLICIES = {"fresh": (60, 10), "kept axes": (0, 40)}


def calls(*policies: str) -> pd.DataFrame:
    return pd.DataFrame([
        {"flow": "rod", "dim": 2, "parts": 4, "policy": policy, "call": call, "points": 100,
         "moved": call * POLICIES[policy][0], "turned": 0, "ghosts_near": POLICIES[policy][1],
         "ghosts_wide": 2 * POLICIES[policy][1], "imbalance": 1 + 0.01 * call, "rounds": 1, "messages": 8,
         "bytes": 80}
        for policy in policies for call in (0, 1)
    ])  # fmt: skip


def ratios(rows: pd.DataFrame, factor: float) -> list[float]:
    return list(rows[flows.ratio_name(factor, "near")])


class FlowsTest(unittest.TestCase):
    def test_costs_are_those_of_ghosts_and_moves_over_the_least(self) -> None:
        rows = flows.with_ratios(flows.summary(calls("fresh", "kept axes")))
        # 20 H + 60 and 80 H: equal at H = 1.
        self.assertEqual(ratios(rows, 0.3), [66 / 24, 1])
        self.assertEqual(ratios(rows, 1), [1, 1])
        self.assertEqual(ratios(rows, 3), [1, 2])
        self.assertEqual(list(rows["ghosts_wide"]), [20, 80])
        self.assertEqual(list(rows["imbalance"]), [1.01, 1.01])

    def test_policies_that_are_not_run_come_from_an_earlier_run_of_the_same_flow(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "flows.csv"
            earlier = flows.summary(calls("fresh", "kept axes"))
            pd.concat([earlier, earlier.assign(flow="jet")]).drop(columns="turned").to_csv(file, index=False)
            rows = flows.with_ratios(flows.with_others(flows.summary(calls("fresh")), file))
        self.assertEqual(list(rows["policy"]), ["fresh", "kept axes"])
        self.assertEqual(ratios(rows, 3), [1, 2])

    def test_the_worst_case_is_named(self) -> None:
        rows = flows.summary(calls("fresh", "kept axes"))
        worse = rows.assign(flow="jet", ghosts_near=[10, 80])
        line = flows.cost_table(flows.with_ratios(pd.concat([rows, worse], ignore_index=True)), "near")[2]
        self.assertEqual(line[0], "kept axes")
        self.assertEqual(line[7:10], ["3.000", "4.000", "jet, 4 parts"])

    def test_traffic_is_that_of_a_call_and_over_that_of_cuts_from_scratch(self) -> None:
        rows = flows.summary(calls("fresh", "kept axes"))
        rows.loc[1, "messages"] = 4
        self.assertEqual(flows.traffic_table(rows)[2][:6], ["4", "kept axes", "1.00", "2", "0.25", "0.25"])


if __name__ == "__main__":
    unittest.main()
