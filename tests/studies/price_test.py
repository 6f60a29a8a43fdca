"""The picture and the sentences that a report begins with, from tables made by hand."""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import headline  # noqa: E402
import pandas as pd  # noqa: E402
import price  # noqa: E402
import rounds  # noqa: E402
from results import Results, measurements  # noqa: E402

COLUMNS = (
    "method,ranks,points,dim,workload,layout,time_ms_median,time_ms_min,time_ms_max,imbalance,"
    "lu_max_percent,messages,bytes,root_bytes_in,collectives,communicators,moved_fraction,"
    "time_vs_zoltan_rcb,time_vs_zoltan_rcb_low,time_vs_zoltan_rcb_high,error\n"
)


def row(method: str, workload: str, time: str, imbalance: str, share: str, size: int = 1) -> str:
    counts = f"0,1,{size},1,1,0,0"
    return f'"{method}",4,1000,2,{workload},scene,{time},1,9,{imbalance},{counts},{share},\n'


TABLE = (
    COLUMNS
    + row("zoltan-rcb", "fog", "8", "1", "1,,")
    + row("rrcb[tol=1.1]", "fog", "2.1", "1.01", "0.26,,", 5)
    + row("rrcb", "fog", "2", "1.01", "0.25,0.2,0.3", 5)
    + row("rrcb[tol=1.001]", "fog", "3", "1.0005", "0.4,,", 7)
    + row("rrcb-exact", "fog", "4", "1", "0.5,0.4,0.6", 10)
    + row("rrcb-arrays", "fog", "1", "1.01", "0.125,,")
)


def simulated(method: str, number: int, path: float, **more: float) -> dict:
    """Ten steps of 1000 points on 4 ranks: 4 s of work in all."""
    return {
        "method": method, "round": number, "ranks": 4, "points": 1000, "steps": 10,
        "critical_path_s": path, "step_work_s": 4, "step_path_s": 1.1, "path_points": 2500,
        "balance_path_s": 0.1, "balance_network_s": 0.1, "rebalances": 2,
    } | more  # fmt: skip


# Noise slows a whole round down by up to five times, and no ratio by more than 2 %.
NOISE = (1, 5, 2, 3, 1.5, 4)
ROUNDS = pd.DataFrame(
    run
    for i, noise in enumerate(NOISE)
    for run in (
        simulated("none", i, 2 * noise, rebalances=0, path_points=4000, step_path_s=1.58),
        simulated("zoltan-rcb", i, noise * (1 + 0.01 * (-1) ** i), balance_path_s=0.5),
        simulated("rrcb", i, noise),
        simulated("rrcb-exact", i, 0.5 * noise),
    )
)


def calls(rows: pd.DataFrame) -> pd.DataFrame:
    """Six turns of noise as in the rounds."""
    turns = [rows.assign(turn=turn, time_ms=rows.get("time_ms", 0) * noise)
             for turn, noise in enumerate(NOISE)]  # fmt: skip
    return pd.concat(turns, ignore_index=True)


class PictureTest(unittest.TestCase):
    def results(self, table: str) -> Results:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        folder = Path(temporary.name)
        (folder / "table.csv").write_text(table)
        return Results(folder)

    def test_names_each_mark_and_has_no_legend(self) -> None:
        figure = price.draw_price(self.results(TABLE))
        (axes,) = figure.axes
        names = [text.get_text() for text in axes.texts]
        self.assertEqual(names, ["one point\nor less", "zoltan-rcb", "rrcb, tolerance 1.1, 1.01",
                                 "rrcb[tol=1.001]", "rrcb-exact", "rrcb-arrays"])
        self.assertIsNone(axes.get_legend())
        self.assertEqual(len(figure.legends), 0)

    def test_stands_at_the_imbalance_that_was_left(self) -> None:
        axes = price.draw_price(self.results(TABLE)).axes[0]
        marks = [(line.get_xdata()[0], line.get_ydata()[0])
                 for line in axes.lines if line.get_marker() == "o"]  # fmt: skip
        self.assertEqual([(round(x, 6), y) for x, y in marks], [(1.0, 2.0), (0.4, 3.0)])

    def test_is_of_the_workload_in_the_middle(self) -> None:
        more = row("rrcb", "mist", "2", "1", "1,,") + row("rrcb", "rain", "2", "1", "1,,")
        title = price.draw_price(self.results(TABLE + more)).axes[0].get_title()
        self.assertTrue(title.startswith("mist"))

    def test_needs_a_table(self) -> None:
        self.assertIsNone(price.draw_price(self.results(COLUMNS)))


class PairTest(unittest.TestCase):
    def ratio(self, method: str, reference: str) -> tuple[float, float, float]:
        found = rounds.paired(ROUNDS, rounds.path(ROUNDS), method, reference)
        return tuple(round(value, 4) for value in (found.number, found.low, found.high))

    def test_noise_of_a_whole_round_widens_no_interval(self) -> None:
        self.assertEqual(self.ratio("rrcb", "none"), (0.5, 0.5, 0.5))
        self.assertEqual(self.ratio("zoltan-rcb", "rrcb"), (1.0, 0.99, 1.01))

    def test_rounds_are_paired_by_their_numbers(self) -> None:
        one_less = ROUNDS[(ROUNDS["method"] != "rrcb") | (ROUNDS["round"] != 1)]
        found = rounds.paired(one_less, rounds.path(one_less), "rrcb", "none")
        self.assertEqual((found.number, found.count), (0.5, 5))
        self.assertIsNone(rounds.paired(ROUNDS, rounds.path(ROUNDS), "rrcb", "nobody"))

    def test_cost_of_uneven_points_is_a_slope_of_measured_times(self) -> None:
        # The slowest rank: 1.58 of the mean with 1.6 of the points, 1.1 with 1.
        self.assertAlmostEqual(rounds.slope_of_work(ROUNDS).number, 0.8)
        text = headline.work_paragraph(ROUNDS)
        self.assertIn("made the steps 0.80 % longer", text)
        self.assertIn("held 0.0 % more points", text)
        self.assertIn("took 10.0 % longer than the mean", text)

    def test_even_points_tell_no_cost(self) -> None:
        self.assertEqual(headline.work_paragraph(ROUNDS[ROUNDS["method"] != "none"]), "")
        self.assertEqual(headline.work_paragraph(pd.DataFrame()), "")


class HeadlineTest(unittest.TestCase):
    def sentences(self, simulations: pd.DataFrame, table: str = TABLE) -> list[str]:
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write(table)
            file.flush()
            rows = measurements(pd.read_csv(file.name))
        return headline.headline(rows, calls(rows), simulations)

    def test_has_three_sentences(self) -> None:
        call, gain, matter = self.sentences(ROUNDS)
        self.assertIn("left an imbalance of 1.01000 and took 0.250 [0.200, 0.300] of the", call)
        self.assertIn("rrcb-exact took 2.00 times the time of rrcb and 2 times its bytes", call)
        self.assertIn("took 0.500 of the time without rebalancing", gain)
        self.assertIn("(not told apart: they differ by 1 % at most)", gain)
        self.assertIn("rebalances took 200 ms against 600 (pairs of 6 rounds).", gain)
        # A step takes 100 ms; the 200 ms between the two are 1 % of 200 steps.
        self.assertIn("took 100 ms under rrcb and 300 ms under Zoltan's RCB", matter)
        self.assertIn("as long as 1 and 3 steps", matter)
        self.assertIn("one every 200 steps or more often; here rrcb made 2 in 10.", matter)

    def test_compares_exact_cuts_by_the_same_interface_only(self) -> None:
        (call,) = self.sentences(pd.DataFrame())
        self.assertNotIn("rrcb-arrays", call)
        arrays = row("rrcb-arrays[refine=exact]", "fog", "3", "1", "0.4,,", 4)
        (call,) = self.sentences(pd.DataFrame(), TABLE + arrays)
        self.assertIn("rrcb-arrays[refine=exact] took 3.00 times the time of rrcb-arrays", call)

    def test_without_a_simulation_speaks_of_ghosts(self) -> None:
        lines = TABLE.splitlines()
        table = "\n".join([lines[0] + ",ghosts", *(f"{line},{i * 50}" for i, line in
                                                    enumerate(lines[1:], 1))]) + "\n"  # fmt: skip
        _, ghosts = self.sentences(pd.DataFrame(), table)
        self.assertIn("15 % of the points, 3 times those of Zoltan's RCB", ghosts)

    def test_is_nothing_without_measurements(self) -> None:
        self.assertEqual(self.sentences(pd.DataFrame(), COLUMNS), [])


if __name__ == "__main__":
    unittest.main()
