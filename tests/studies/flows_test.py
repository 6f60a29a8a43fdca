"""Costs of policies along a flow, from two calls made by hand."""

from __future__ import annotations

import unittest

import support  # noqa: F401

import flows
import pandas as pd

# 100 points; at the second call so many move, and at both so many are ghosts.
POLICIES = {"fresh": (60, 10), "kept axes": (0, 40)}


def calls(*policies: str) -> pd.DataFrame:
    return pd.DataFrame([
        {"flow": "rod", "dim": 2, "parts": 4, "policy": policy, "call": call, "points": 100,
         "moved": call * POLICIES[policy][0], "ghosts_near": POLICIES[policy][1],
         "ghosts_wide": 2 * POLICIES[policy][1], "messages": 8}
        for policy in policies for call in (0, 1)
    ])  # fmt: skip


def ratios(rows: pd.DataFrame, factor: float) -> list[float]:
    return list(rows[flows.ratio_name(factor, "near")])


class FlowsTest(unittest.TestCase):
    def test_costs_are_those_of_ghosts_and_moves_over_the_least(self) -> None:
        rows = flows.summary(calls("fresh", "kept axes"))
        # 20 H + 60 and 80 H: equal at H = 1.
        self.assertEqual(ratios(rows, 1), [1, 1])
        self.assertEqual(ratios(rows, 10), [1, 80 / 26])
        self.assertEqual(list(rows["ghosts_wide"]), [20, 80])

    def test_the_worst_case_is_named(self) -> None:
        rows = calls("fresh", "kept axes")
        worse = rows.assign(flow="jet", ghosts_near=[10, 10, 85, 85])
        line = flows.cost_table(flows.summary(pd.concat([rows, worse])), "near")[2]
        self.assertEqual(line, ["kept axes", "1.562", "2.125", "jet, 4 parts", "4.808", "6.538", "jet, 4 parts"])

    def test_traffic_is_that_of_a_call_and_over_that_of_cuts_from_scratch(self) -> None:
        rows = flows.summary(calls("fresh", "kept axes"))
        rows.loc[1, "messages"] = 4
        self.assertEqual(flows.traffic_table(rows)[2], ["4", "kept axes", "0.25", "0.25"])


if __name__ == "__main__":
    unittest.main()
