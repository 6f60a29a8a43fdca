"""Options, sentences, tables and pictures of comparisons/run, from tables made by hand."""

from __future__ import annotations

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from support import measured, simulated, table

import compare
import numpy as np
import pandas as pd
import pictures
import report
from results import Results

# Noise slows a whole round down by up to five times, and no ratio by more than 2 %.
NOISE = (1, 5, 2, 3, 1.5, 4)
ROUNDS = [
    run
    for i, noise in enumerate(NOISE)
    for run in (
        simulated("none", i, 2 * noise, rebalances=0, path_points=4000, counted_path=1.58),
        simulated("zoltan-rcb", i, noise * (1 + 0.01 * (-1) ** i), balance_path_s=0.5),
        simulated("rrcb", i, noise),
        simulated("rrcb-exact", i, 0.5 * noise),
    )
]
ROWS = [
    measured("zoltan-rcb", 8, 1, spread=0, ghosts=50),
    measured("rrcb[tol=1.1]", 2.1, 1.01, bytes=5),
    measured("rrcb", 2, 1.01, spread=0.2, bytes=5, ghosts=150),
    measured("rrcb[tol=1.001]", 3, 1.0005, bytes=7),
    measured("rrcb-exact", 4, 1, bytes=10),
    measured("rrcb-arrays", 7.6, 1.01, spread=0.1),
]


class FolderTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def results(self, rows: list[dict], runs: list[dict] | None = None) -> Results:
        """With six turns of calls, of noise as in the rounds."""
        pd.DataFrame(rows).to_csv(self.folder / "table.csv", index=False)
        turns = [table(*rows).assign(turn=turn) for turn in range(len(NOISE))]
        for turn, noise in zip(turns, NOISE):
            turn["time_ms"] *= noise
        pd.concat(turns).to_csv(self.folder / "call_times.csv", index=False)
        if runs:
            pd.DataFrame(runs).to_csv(self.folder / "simulation_runs.csv", index=False)
        return Results(self.folder)


class OptionTest(unittest.TestCase):
    def test_a_wrong_number_of_ranks_is_refused_with_the_range(self) -> None:
        for text in ("0", "257", "many"):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as output:
                compare._read_options([f"--ranks={text}"])
            self.assertIn(f"must be an integer from 1 to 256, not '{text}'", output.getvalue())


class SentenceTest(FolderTest):
    def test_tell_costs_gains_and_when_they_matter(self) -> None:
        call, gain, matter = report.sentences(self.results(ROWS, ROUNDS))
        self.assertIn("left an imbalance of 1.01000 and had a speed-up of 4.00 [3.33, 5.00] over", call)
        self.assertIn("rrcb-exact took 2.00 times as long as rrcb and sent 2 times its bytes", call)
        self.assertNotIn("time of rrcb-arrays", call)  # whose exact setting is not there
        self.assertIn("had a speed-up of 2.00 over none", gain)
        self.assertIn("of 1.000 [0.990, 1.010] over zoltan-rcb (not told apart); medians of 6", gain)
        # A step takes 100 ms; r = 3: 200 (1 - 1 / sqrt 3) 300 / 100.
        self.assertIn("100 ms, 1 steps, under rrcb and 300 ms, 3 steps, under Zoltan's RCB", matter)
        self.assertIn("a rebalance pays every 254 steps or more often", matter)

    def test_say_that_methods_are_not_told_apart(self) -> None:
        rows = [measured("zoltan-rcb", 8, 1), measured("rrcb", 6, 1, spread=0.5)]
        call, _ = report.sentences(self.results(rows))
        self.assertIn("1.33 [0.89, 2.67] over zoltan-rcb (not told apart), which", call)

    def test_name_what_failed(self) -> None:
        self.assertEqual(report.failures(self.results(ROWS)), [])
        rows = [measured("zoltan-rcb", 0, 1, error="code -2"), *ROWS[1:]]
        runs = [simulated("none", i, 1) for i in range(2)]
        failed = [simulated("rrcb", i, None, error="it fell") for i in range(2)]
        found = report.failures(self.results(rows, runs + failed))
        self.assertEqual(found, ["zoltan-rcb failed on fog: code -2",
                                 "rrcb failed on the simulation: it fell"])  # fmt: skip

    def test_speak_of_ghosts_without_a_simulation(self) -> None:
        _, ghosts = report.sentences(self.results(ROWS))
        self.assertIn("15 % of the points, 3 times those of Zoltan's RCB", ghosts)

    def test_work_follows_points_by_the_slope_through_balanced_methods(self) -> None:
        balanced = [("a", 2500, 1.1), ("b", 2550, 1.12), ("c", 2600, 1.14)]
        rounds = [simulated(m, i, 1, path_points=n, counted_path=s) for i in range(6) for m, n, s in balanced]
        # Of 2 and 4 % more points 2 and 4 % of a second more; a run that does not balance has no say.
        text = report.work_sentence(pd.DataFrame(rounds + ROUNDS[::4]))
        self.assertIn("added 1.00 % of counted work to the steps.", text)
        self.assertEqual(report.work_sentence(pd.DataFrame(ROUNDS)), "")

    def test_a_step_pays_for_uneven_points_and_time(self) -> None:
        paid = report.paid_table(pd.DataFrame(ROUNDS)).set_index("method")
        self.assertEqual(paid.loc["none", ["uneven points %", "uneven work, counted %"]].tolist(), ["60.00", "58.00"])
        names = [f"{name} %" for name in ("uneven points", "uneven work, counted", "uneven seconds",
                                          "work at rest, counted", "seconds at rest")]  # fmt: skip
        self.assertEqual(paid.loc["rrcb", names].tolist(), ["0.00", "10.00", "20.00", "5.00", "15.00"])

    def test_counts_give_the_gain_on_any_machine(self) -> None:
        counted = report.counted_table(self.results(ROWS, ROUNDS).runs).set_index("method")
        # 4,000 points of the fullest rank over 2,500; 60 messages and 48 kB in ten steps, and 20
        # messages and 3 kB in two rebalances.
        gain = "work of the fullest rank: none / this"
        self.assertEqual(counted[gain][["none", "rrcb"]].tolist(), ["1.00", "1.60"])
        sent = ["messages in a step", "kB in a step", "messages in a rebalance", "kB in a rebalance"]
        self.assertEqual(counted.loc["rrcb", sent].tolist(), ["6.0", "4.8", "10.0", "1.5"])
        self.assertEqual(counted.loc["none", sent].tolist(), ["6.0", "4.8", "–", "–"])

    def test_a_step_pays_for_rank_0(self) -> None:
        run = simulated("rrcb", 0, 20, step_root_s=6, balance_root_s=4, decide_root_s=1)
        paid = report.paid_table(pd.DataFrame([run])).set_index("method")
        names = [f"{phase} of rank 0, of all %" for phase in ("steps", "rebalances", "deciding")]
        self.assertEqual(paid.loc["rrcb", names].tolist(), ["30.00", "20.00", "5.00"])


class TableTest(FolderTest):
    def test_ratios_whose_interval_contains_one_are_not_told_apart(self) -> None:
        cells = report.method_table(table(*ROWS)).set_index("method")["speed-up"]
        self.assertEqual(cells["zoltan-rcb"], "1.00")
        self.assertEqual(cells["rrcb-arrays"], "1.05 [0.96, 1.17], not told apart")
        self.assertEqual(cells["rrcb"], "4.00 [3.33, 5.00]")

    def test_ghosts_are_shares_of_the_points(self) -> None:
        row = report.method_table(table(measured("rrcb", 1, 1))).iloc[0]
        self.assertEqual(row["ghosts":].tolist(), ["500", "50.0"])

    def test_a_simulation_is_compared_in_pairs(self) -> None:
        results = self.results(ROWS, ROUNDS)
        row = report.simulation_table(results.runs, results.rounds).set_index("method").loc["rrcb"]
        self.assertEqual(row["critical path s"], "2.500 [1.000, 5.000]")
        self.assertEqual(row["speed-up over none"], "2.00")
        self.assertEqual(row["speed-up over zoltan-rcb"], "1.00 [0.99, 1.01], not told apart")
        self.assertEqual((row["rebalances"], row["moved %"]), ("2", "12.5"))


class PictureTest(FolderTest):
    def test_ghosts_are_near_points_of_another_part(self) -> None:
        line = pd.DataFrame({"x": range(10), "y": [0] * 10, "part": [0] * 5 + [1] * 5})
        self.assertEqual(np.flatnonzero(pictures.are_near_others(line)).tolist(), [3, 4, 5, 6])


class ReportTest(FolderTest):
    def test_writes_what_it_computes_and_removes_old_pictures(self) -> None:
        self.results(ROWS, ROUNDS)
        (self.folder / "run.txt").write_text("rrcb 1\n")
        (self.folder / "ghosts.png").write_text("of an earlier run")
        with contextlib.redirect_stdout(io.StringIO()) as output:
            report.write_report(self.folder)
        text = (self.folder / "report.md").read_text()
        self.assertIn("rrcb 1\n", text)
        self.assertIn("| rrcb-exact | 1.00000 |", text)
        self.assertFalse((self.folder / "ghosts.png").exists())
        self.assertEqual(len(pd.read_csv(self.folder / "simulation.csv")), 4)
        self.assertLess(max(map(len, output.getvalue().split("Simulations")[1].splitlines())), 100)


if __name__ == "__main__":
    unittest.main()
