"""The model of cuts that alternate against masses summed box by box; claims from small files."""

from __future__ import annotations

import tempfile
import unittest
from math import sqrt
from pathlib import Path

from support import simulated

import claims
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
        # The first call moves a half, the second a quarter.
        moved = [{"method": name, "step": step, "moved_fraction": 0.5 / (1 + step)} for name in times for step in (0, 1)]
        pd.DataFrame(moved).to_csv(self.directory / folder / "history.csv", index=False)

    def rows(self) -> dict[str, tuple[str, str]]:
        """What is measured and the verdict, by the number of the claim."""
        table = claims.claim_table(self.directory)
        return {row.iloc[0]: (row["measured here"], row["verdict"]) for _, row in table.iterrows()}

    def test_name_no_winner_within_the_noise(self) -> None:
        times = {
            "serial": [10.0] * 6,
            "root-rcb": [5.0, 5.1, 5.2, 5.3, 5.4, 5.5],
            WINNERS[0]: [4.0, 4.1, 4.2, 4.3, 4.4, 4.5],
            WINNERS[1]: [8.0, 8.1, 8.2, 8.3, 8.4, 8.5],
        }
        self.write("simulations", times)
        found = self.rows()
        self.assertEqual(found["4"][1], "partly")
        self.assertIn("speed-ups are 2.35 [2.22, 2.50] and 1.21 [1.18, 1.25]; RCB's is 1.90 [1.82, 2.00].", found["4"][0])
        self.assertEqual(found["5"][1], "confirmed")
        del times[WINNERS[1]]
        self.write("simulations", times)
        self.assertEqual(self.rows()["4"][1], "confirmed")
        self.write("simulations", times | {WINNERS[0]: [3.0, 5.1, 5.2, 5.3, 5.4, 9.0]})
        self.assertEqual(self.rows()["4"][1], "not told apart")

    def test_serial_and_parallel_of_a_round_are_compared(self) -> None:
        slow = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0]  # a machine of another speed in each round
        self.write("simulations", {"serial": slow, "root-rcb": [2 * t for t in slow], WINNERS[0]: slow})
        found = self.rows()
        self.assertIn("Its speed-up is 0.50. ", found["11"][0])
        self.assertEqual(found["11"][1], claims.BY_COST)
        self.assertEqual(found["5"][1], "not told apart")

    def test_unbalance_is_greater_but_small_only_in_several_runs(self) -> None:
        for runs, verdicts in ((1, ("not told apart", "not told apart")), (10, ("confirmed", "refuted"))):
            self.write("simulations", {name: [5.0] * runs for name in ("root-rcb", *WINNERS)})
            found = self.rows()
            self.assertEqual((found["6"][1], found["17"][1]), verdicts)  # 20 % above the mean are not small
        self.assertIn("20.00, 20.00, 20.00 and 20.00 % with the four settings, 0.40 % with RCB", found["6"][0])

    def test_the_fastest_settings_are_those_of_the_charts(self) -> None:
        fine, coarse = "rrcb-sampled[mesh=10,k=1,fraction=1]", "rrcb-sampled[mesh=2,k=1,fraction=1]"
        times = {"root-rcb": [7.0] * 6, "rrcb": [4.0] * 6, fine: [5.0] * 6, coarse: [6.0] * 6}
        self.write("grid", {"serial": [10.0] * 6, **times, **{name: [8.0] * 6 for name in WINNERS}})
        found = self.rows()
        self.assertEqual(found["12"][1], "refuted")
        self.assertIn("has a speed-up of 1.25; mesh 10, k = 1 and 100 % has 2.00. A call moves 25 and 25 %", found["12"][0])
        self.assertEqual(found["14"][0], "2 of 6 settings are faster than RCB.")
        self.assertIn("Mesh 2 has 0.83 with k = 1 of", found["18"][0])
        figure = paper_figures.draw_speed_ups(self.directory)
        self.assertEqual([axes.get_title() for axes in figure.axes], ["1,000 points drawn", "250 points drawn",
                                                                      "125 points drawn"])  # fmt: skip
        self.assertEqual(figure.axes[0].get_ylim()[0], 0)
        self.assertEqual(paper_figures.grid_table(self.directory).iloc[2].tolist(), [fine, "2.00", "10", "25", "1.2000"])

    def test_rcb_wins_from_the_cost_of_a_point_that_pays_for_its_call(self) -> None:
        self.write("simulations", {"root-rcb": [5.0] * 6, "serial": [10.0] * 6, WINNERS[0]: [5.0] * 6})
        # 20 ms a call over three quarters of 1000 points; a step takes 110 us a point.
        self.assertIn("at least 26667 ns a step; here it costs 110000 ns.", self.rows()["11"][0])

    def test_other_numbers_of_processes_have_speed_and_quality(self) -> None:
        for ranks, path in ((2, 6.0), (4, 5.0), (8, 4.0)):
            self.write(f"ranks-{ranks}", {"root-rcb": [path] * 6, "serial": [10.0] * 6})
        self.assertEqual(self.rows()["13"][0], "The speed-up on 2, 4 and 8 processes is 1.67, 2.00 and 2.50.")
        table = paper.rank_table(self.directory)
        self.assertEqual(table.values.tolist()[1], ["4", "root-rcb", "2.00", "1.0000"])


class PageTest(unittest.TestCase):
    def test_counts_of_the_page_are_those_of_paper_csv(self) -> None:
        rows = pd.read_csv(paper.COUNTS)
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            rows = rows.assign(time_ms_median=1.0, ranks=4, dim=2, layout="simulation", error=None)
            for points, of in rows[rows["workload"] == "slope"].groupby("points"):
                (out / f"points-{points}").mkdir()
                of.to_csv(out / f"points-{points}/table.csv", index=False)
            (out / "snapshots").mkdir()
            rows[rows["workload"] != "slope"].to_csv(out / "snapshots/table.csv", index=False)
            found = claims.claim_table(out)
        lines = [line for line in paper.PAGE.read_text().splitlines() if line.startswith("| ")]
        numbers = []
        for row in found.values.tolist():
            numbers.append(row[0])
            self.assertIn("| " + " | ".join(row) + " |", lines)
        self.assertEqual(numbers, ["1", "2", "3", "10", "16"])


if __name__ == "__main__":
    unittest.main()
