"""The model of cuts that alternate against masses summed box by box; claims from small files."""

from __future__ import annotations

import sys
import tempfile
import unittest
from math import sqrt
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import claims  # noqa: E402
import cycle  # noqa: E402
import paper_methods  # noqa: E402
import pandas as pd  # noqa: E402
import speed_up  # noqa: E402
from intervals import Value  # noqa: E402
from methods import WINNERS  # noqa: E402
from results import Results  # noqa: E402


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
                    found = cycle.next_offset(offset, mesh, multiplier)
                    self.assertAlmostEqual(found, expected, places=9)

    def test_alternating_cuts_lie_at_the_same_distance(self) -> None:
        for multiplier in (1.0, 1.5, 1.7):
            offset = cycle.alternating_offset(4, multiplier)
            self.assertAlmostEqual(cycle.next_offset(offset, 4, multiplier), -offset)
            self.assertAlmostEqual(cycle.next_offset(-offset, 4, multiplier), offset)

    def test_lasting_values_leave_the_first_calls_out(self) -> None:
        calls = [
            ("rrcb", float("nan"), n, 1.5 if n <= 10 else 1 + n % 2 / 10, n) for n in range(1, 13)
        ]
        columns = ["method", "seed", "call", "imbalance", "moved"]
        found = cycle.lasting(pd.DataFrame(calls, columns=columns))["rrcb"]
        self.assertEqual((found["least"].number, found["most"].number), (1.0, 1.1))
        self.assertAlmostEqual(found["moved"].number, 11.5)

    def test_pictures_of_the_methods_and_the_map_are_drawn(self) -> None:
        with tempfile.TemporaryDirectory() as directory:
            sys.argv = ["paper_methods.py", directory]
            self.assertEqual(paper_methods.main(), 0)
            names = sorted(path.name for path in Path(directory).glob("*.png"))
        self.assertEqual(names, ["paper_cycle_map.png", "paper_methods.png"])


RUN = (
    "repeat,method,ranks,points,steps,every,wall_s,balance_s,step_s,mean_imbalance,worst_imbalance,"
    "path_points,step_work_s,step_path_s,step_network_s,balance_path_s,balance_network_s,error\n"
)


def runs(method: str, ranks: int, paths: list[float], imbalance: float = 1.0) -> str:
    return "".join(
        f'{n},"{method}",{ranks},100,10,1,{path},0,0,{imbalance},{imbalance},300,0,{path},0,0,0,\n'
        for n, path in enumerate(paths, 1)
    )


class ClaimsTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)

    def write(self, *rows: str) -> None:
        (self.directory / "sweep_simulation.csv").write_text(RUN + "".join(rows))

    def claims(self) -> list[dict[str, str]]:
        return claims.claim_table(Results(self.directory))

    def verdicts(self) -> dict[str, str]:
        return {row["the paper says"]: row["verdict"] for row in self.claims()}

    def test_are_none_without_files(self) -> None:
        self.assertEqual(self.claims(), [])

    def test_name_no_winner_within_the_noise(self) -> None:
        slow, fast = [8.0, 8.1, 8.2, 8.3, 8.4, 8.5], [4.0, 4.1, 4.2, 4.3, 4.4, 4.5]
        self.write(
            runs("serial", 1, [10.0] * 6),
            runs("root-rcb", 4, [5.0, 5.1, 5.2, 5.3, 5.4, 5.5]),
            runs(WINNERS[0], 4, fast, 1.2),
            runs(WINNERS[1], 4, slow, 1.2),
            runs(WINNERS[2], 4, [3.0, 5.1, 5.2, 5.3, 5.4, 9.0], 1.2),
            runs(WINNERS[3], 4, [1.0], 1.2),
        )
        found = self.verdicts()
        self.assertEqual(found["mesh 2 × 2, 1.5 σ, 25 % is faster than RCB"], "confirmed")
        self.assertEqual(found["mesh 4 × 4, 2 σ, 12.5 % is faster than RCB"], "refuted")
        self.assertEqual(found["mesh 6 × 6, 2 σ, 12.5 % is faster than RCB"], "not told apart")
        self.assertEqual(found["mesh 8 × 8, 2 σ, 12.5 % is faster than RCB"], "not told apart")
        self.assertEqual(found["RRCB's unbalance is clearly worse than RCB's"], "confirmed")

    def test_four_processes_are_best_only_where_no_other_number_is(self) -> None:
        serial = runs("serial", 1, [10.0] * 6)
        four = runs("root-rcb", 4, [5.0] * 6)
        self.write(serial, runs("root-rcb", 2, [6.0] * 6), four)
        self.assertEqual(self.verdicts()["4 processes are best"], "confirmed")
        self.write(serial, runs("root-rcb", 2, [6.0] * 6), four, runs("root-rcb", 8, [4.0] * 6))
        self.assertEqual(self.verdicts()["4 processes are best"], "refuted")

    def test_comparison_needs_intervals_apart(self) -> None:
        low, high = Value(1, 0.9, 1.1), Value(2, 1.9, 2.1)
        self.assertEqual(claims.compare(high, low), "confirmed")
        self.assertEqual(claims.compare(low, high), "refuted")
        self.assertEqual(claims.compare(high, Value(1)), "not told apart")

    def test_speed_ups_are_medians_over_the_repeats(self) -> None:
        self.write(runs("serial", 1, [9.0, 10.0, 11.0]), runs("rrcb", 4, [4.0, 5.0, 2.0]))
        runs_of = Results(self.directory).swept_runs
        found = {s.run.method: s for s in speed_up.read_speed_ups(runs_of)}["rrcb"]
        self.assertAlmostEqual(found.kinds["critical_path"].number, 2.5)
        self.assertAlmostEqual(found.run.step_path_s, 4.0)
        self.assertEqual(found.kinds["critical_path"].count, 3)


if __name__ == "__main__":
    unittest.main()
