"""Draws and tells what rebalances cost over the interval, of a few cases with known answers."""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import interval_map
from results import read_all

COLUMNS = (
    "scene,ranks,method,best_every,overhead,predicted_every,predicted_overhead,auto_overhead,"
    "overhead_low,overhead_high,cost_ms,call_ms,cost_steps,floor,growth"
)
MODEL = "100,0.041,0.05,{low},{high},2,1,2,0.001,0.0004"  # predicted every 100
# The best overhead and its interval.
BESTS = {
    ("pile", 4, "zoltan-rcb"): (0.08, 0.07, 0.09),
    ("pile", 4, "rrcb"): (0.05, 0.04, 0.06),  # apart
    ("pile", 4, "rrcb-arrays"): (0.06, 0.05, 0.075),  # within the spread
    ("pile", 8, "zoltan-rcb"): (0.08, 0.079, 0.081),
    ("pile", 8, "rrcb"): (0.0715, 0.071, 0.072),  # less than 1 %
    ("pile", 8, "rrcb-arrays"): (0.1, 0.099, 0.101),  # worse
}


class IntervalMapTest(unittest.TestCase):
    def setUp(self) -> None:
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        optima, overheads = [COLUMNS], ["scene,ranks,method,every,overhead"]
        steps = ["scene,ranks,method,every,step,imbalance,rebalanced,lost"]
        for ranks in (4, 8):
            overheads.append(f"pile,{ranks},none,,0.3")
            steps += [f"pile,{ranks},none,,{i},1.3,0,{i}" for i in range(3)]
        for (scene, ranks, method), (best, low, high) in BESTS.items():
            key = f"{scene},{ranks},{method}"
            optima.append(f"{key},10,{best}," + MODEL.format(low=low, high=high))
            overheads += [f"{key},{every},{best + 0.01}" for every in (1, 100)]
            overheads += [f"{key},10,{best}", f"{key},auto,0.05"]
            for every in (10, "auto"):
                steps += [f"{key},{every},{i},1.0{i},{int(i == 1)},{i}.5" for i in range(3)]
        self.bests = self.table("intervals_optimum.csv", optima)
        self.overheads = self.table("intervals.csv", overheads)
        self.steps = self.table("intervals_steps.csv", steps)

    def table(self, name: str, lines: list[str]):
        (self.directory / name).write_text("\n".join(lines) + "\n")
        return read_all(self.directory / name)

    def test_prediction_is_the_formula_of_the_documentation(self) -> None:
        best = self.bests.iloc[1]
        self.assertAlmostEqual(interval_map.predicted(best, 100), 0.02 + 0.001 + 0.0004 * 99 / 2)
        self.assertAlmostEqual(interval_map.misses(self.bests).max(), 1 - 0.041 / 0.1)

    def test_table_has_a_row_per_case(self) -> None:
        lines = interval_map.table_of(self.bests, self.overheads).splitlines()
        self.assertEqual(len(lines), 2 + 2)
        self.assertEqual(
            lines[2],
            "| pile | 4 | 2.00 | 2.00 | 2.00 | 8.00 | 5.00 | 6.00 | 5.00 | 5.00 | 5.00 | 30.0 |",
        )

    def test_map_has_a_panel_per_case_with_all_marks(self) -> None:
        figure = interval_map.draw_map(self.bests, self.overheads)
        panels = [axes for axes in figure.axes if axes.get_visible()]
        titles = [axes.get_title() for axes in panels]
        self.assertEqual(titles, ["pile, 4 ranks", "pile, 8 ranks"])
        for axes in panels:  # none; of each method two lines and three marks
            self.assertEqual(len(axes.lines), 1 + 3 * 5)
        self.assertEqual(list(panels[0].lines[1].get_xdata()), [1, 100, 10])

    def test_steps_are_those_of_the_fewest_ranks(self) -> None:
        above, below = interval_map.draw_steps(self.steps).axes
        self.assertEqual(above.get_title(), "pile, 4 ranks; marks: rebalances")
        labels = [text.get_label() for text in below.lines if text.get_label()[0] != "_"]
        self.assertEqual(
            sorted(labels),
            ["none", "rrcb, auto", "rrcb, every 10", "zoltan-rcb, auto", "zoltan-rcb, every 10"],
        )


if __name__ == "__main__":
    unittest.main()
