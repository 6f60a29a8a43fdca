"""The model of cuts that alternate against masses summed box by box; claims from small files."""

from __future__ import annotations

import tempfile
import unittest
from math import sqrt
from pathlib import Path

from support import simulated

import boxes
import claims
import numpy as np
import pandas as pd
import paper
import paper_figures
from methods import WINNERS


def mass_below(x: float, cut: float, mesh: int, multiplier: float) -> float:
    """Of the boxes of evenly spread points on [0, 1], `mesh` cells on each side of the cut."""
    mass = 0.0
    for begin, end in ((0.0, cut), (cut, 1.0)):
        width = (end - begin) / mesh
        half = multiplier * width / sqrt(12)
        for cell in range(mesh):
            mean = begin + (cell + 0.5) * width
            share = (x - (mean - half)) / (2 * half)
            mass += width * min(max(share, 0.0), 1.0)
    return mass


def median_cut(cut: float, mesh: int, multiplier: float) -> float:
    lower, upper = 0.0, 1.0
    for _ in range(60):
        middle = (lower + upper) / 2
        if mass_below(middle, cut, mesh, multiplier) < 0.5:
            lower = middle
        else:
            upper = middle
    return lower


class CycleTest(unittest.TestCase):
    def test_model_tells_where_the_boxes_have_their_median(self) -> None:
        for mesh in (2, 4, 8):
            for multiplier in (1.0, 1.5, sqrt(3), 2.0, 2.5):
                for offset in (-0.004, -0.001, 0.001, 0.004):
                    expected = median_cut(0.5 + offset, mesh, multiplier) - 0.5
                    found = paper_figures.next_offset(offset, mesh, multiplier)
                    self.assertAlmostEqual(found, expected, places=9)


class BoxesTest(unittest.TestCase):
    def test_of_an_even_square_divide_it_evenly(self) -> None:
        middles = (np.arange(8) + 0.5) / 8
        points = np.array([(x, 2 * y) for x in middles for y in middles])
        half = np.array([1, 2]) / 16
        found = boxes.divide(points - half, points + half, np.ones(64), points, 4)
        self.assertEqual(np.bincount(found).tolist(), [16, 16, 16, 16])

    def test_narrower_than_their_cells_miss_by_the_gap(self) -> None:
        lower, upper = np.array([[0.0, 0], [3, 0]]), np.array([[1.0, 1], [4, 1]])
        points = np.array([(x, 0.5) for x in (0.2, 0.4, 0.6, 2.9)])
        found = boxes.divide(lower, upper, np.array([3.0, 1]), points, 2)
        self.assertEqual(found.tolist(), [0, 0, 0, 1])

    def test_moments_of_cells_are_those_of_their_points(self) -> None:
        points = np.array([(0.0, 0), (1, 1), (3, 0), (3, 4), (4, 4)])
        count, center, sigma = boxes.cells_of(points, 2)
        self.assertEqual(count.tolist(), [2, 1, 2])
        self.assertEqual(center.tolist(), [[0.5, 0.5], [3, 0], [3.5, 4]])
        self.assertEqual(sigma.tolist(), [[0.5, 0.5], [0, 0], [0.5, 0]])


class ClaimsTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)

    def write(self, folder: str, times: dict[str, list[float]]) -> None:
        """Runs of these critical paths; of the paper's methods 20 % above the mean."""
        runs = [
            simulated(method, n, path, mean_imbalance=1.2 if "[" in method else 1)
            for method, paths in times.items()
            for n, path in enumerate(paths, 1)
        ]
        (self.directory / folder).mkdir(exist_ok=True)
        pd.DataFrame(runs).to_csv(self.directory / folder / "simulation_runs.csv", index=False)

    def verdicts(self) -> dict[str, str]:
        table = claims.claim_table(self.directory)
        return dict(zip(table["the paper says"], table["verdict"]))

    def test_name_no_winner_within_the_noise(self) -> None:
        times = {
            "root-rcb": [5.0, 5.1, 5.2, 5.3, 5.4, 5.5],
            WINNERS[0]: [4.0, 4.1, 4.2, 4.3, 4.4, 4.5],
            WINNERS[1]: [8.0, 8.1, 8.2, 8.3, 8.4, 8.5],
            WINNERS[2]: [3.0, 5.1, 5.2, 5.3, 5.4, 9.0],
            WINNERS[3]: [1.0],
        }
        self.write("simulations", times)
        self.write("serial", {"none": [10.0] * 6})
        found = self.verdicts()
        self.assertEqual(found["mesh 2 × 2, 1.5 σ, 25 % is faster than RCB"], "confirmed")
        self.assertEqual(found["mesh 4 × 4, 2 σ, 12.5 % is faster than RCB"], "refuted")
        self.assertEqual(found["mesh 6 × 6, 2 σ, 12.5 % is faster than RCB"], "not told apart")
        self.assertEqual(found["mesh 8 × 8, 2 σ, 12.5 % is faster than RCB"], "not told apart")
        self.assertEqual(found["RCB on 4 processes is faster than serial"], "confirmed")

    def test_unbalance_is_greater_but_small_only_in_several_runs(self) -> None:
        greater, small = "RRCB's unbalance is “considerably greater” than RCB's", "its unbalance is a “small increase”"
        for runs, verdicts in ((1, ("not told apart", "not told apart")), (10, ("confirmed", "refuted"))):
            self.write("simulations", {name: [5.0] * runs for name in ("root-rcb", *WINNERS)})
            found = self.verdicts()
            self.assertEqual((found[greater], found[small]), verdicts)  # 20 % above the mean are not small

    def test_the_fastest_settings_are_those_of_the_charts(self) -> None:
        other = "rrcb-sampled[mesh=10,k=1,fraction=1]"
        self.write("grid-serial", {"none": [10.0] * 6})
        self.write("grid", {"root-rcb": [20.0] * 6, other: [5.0] * 6, **{name: [8.0] * 6 for name in WINNERS}})
        table = claims.claim_table(self.directory)
        self.assertEqual(table["verdict"].tolist(), ["refuted"])
        self.assertIn("mesh 10 × 10, 1 σ, 100 %; 3 in both", table["measured here"][0])
        figure = paper_figures.draw_speed_ups(self.directory)
        self.assertEqual([axes.get_title() for axes in figure.axes], ["1,000 points drawn", "250 points drawn",
                                                                      "125 points drawn"])  # fmt: skip

    def test_rcb_wins_from_the_cost_of_a_point_that_pays_for_its_call(self) -> None:
        self.write("simulations", {"root-rcb": [5.0] * 6})
        self.write("serial", {"none": [10.0] * 6})
        # 20 ms a call over three quarters of 1000 points; a step takes 110 us a point.
        row = claims.claim_table(self.directory).iloc[-1]
        self.assertIn("wins from 26667 ns a point-step, here 110000", row["measured here"])

    def test_four_processes_are_best_only_if_no_other_number_is(self) -> None:
        self.write("ranks-1", {"none": [10.0] * 6})
        self.write("ranks-2", {"root-rcb": [6.0] * 6})
        self.write("ranks-4", {"root-rcb": [5.0] * 6})
        self.assertEqual(self.verdicts(), {"4 processes are best": "confirmed"})
        self.write("ranks-8", {"root-rcb": [4.0] * 6})
        self.assertEqual(self.verdicts(), {"4 processes are best": "refuted"})
        table = paper.rank_table(self.directory)
        self.assertEqual(table.values.tolist(), [["2", "1.67"], ["4", "2.00"], ["8", "2.50"]])


if __name__ == "__main__":
    unittest.main()
