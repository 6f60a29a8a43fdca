"""The model of a call: fits to counts of a known growth, and what a call takes on more ranks."""

from __future__ import annotations

import tempfile
import unittest
from math import log2
from pathlib import Path

import support  # noqa: F401, before the studies

import pandas as pd
import plot
import scaling

RANKS = (2, 4, 8, 16)
COUNTS = pd.DataFrame(
    {
        "ranks": RANKS,
        "collectives": [10 + 3 * log2(ranks) for ranks in RANKS],
        "messages": [0.0] * 4,
        "bytes": [100.0 * ranks for ranks in RANKS],
        "point bytes": [0.0] * 4,
        "root bytes": [0.0] * 4,
    }
)
VIRTUAL = pd.DataFrame(
    {"ranks": [256], "tolerance": [1.01], "rounds": [16], "bytes_in_a_row": [25600], "most_into_rank": [50]}
)


class ScalingTest(unittest.TestCase):
    def test_fit_finds_the_growth_of_the_counts(self) -> None:
        (found,) = scaling.fits("zoltan-rcb", COUNTS, "collectives")
        self.assertAlmostEqual(found["1"], 10)
        self.assertAlmostEqual(found["log"], 3)
        self.assertAlmostEqual(scaling.at(found, 1024), 40)

    def test_bytes_have_the_terms_of_the_least_error_and_those_as_good(self) -> None:
        counts = COUNTS.assign(bytes=[300 + 100.0 * ranks for ranks in RANKS])
        (found,) = scaling.fits("zoltan2-mj", counts, "bytes")
        self.assertEqual([*found], ["1", "ranks"])
        self.assertAlmostEqual(scaling.at(found, 1024), 300 + 102400)
        # As counted of multijagged: twice the least error does not tell five growths apart.
        ranks, bytes_each = [2, 3, 4, 8, 16, 32, 64], [496.0, 970.7, 1560.0, 2896.0, 4584.0, 8580.0, 16794.0]
        counted = pd.DataFrame({"ranks": ranks, "bytes": bytes_each})
        found = scaling.fits("zoltan2-mj", counted, "bytes")
        self.assertEqual([[*of] for of in found], [["log", "ranks log"], ["log", "ranks"], ["root", "ranks"], ["ranks"],
                                                   ["root", "ranks log"]])  # fmt: skip
        columns = dict.fromkeys(("collectives", "messages", "point bytes", "root bytes"), [1.0] * len(ranks))
        paths = scaling.all_paths({"zoltan2-mj": counted.assign(**columns)}, scaling.Machine(), VIRTUAL)
        row = paths.iloc[-1]
        self.assertLess(row["low_s"], row["model_s"])
        self.assertLess(row["model_s"], row["high_s"])
        cells = scaling.time_table(paths)[-1]
        self.assertEqual(cells[:2], ["1,048,576", "many ranks"])
        self.assertRegex(cells[2], r"^\d+ \[\d+, \d+\]$")

    def test_collectives_of_a_level_are_on_half_as_many_ranks_at_each(self) -> None:
        machine = scaling.Machine(latency=1, bandwidth=1e30, points=1)
        terms = {column: scaling.fits("zoltan-rcb", COUNTS, column)[0] for column in COUNTS.columns[1:]}
        path = scaling.path("zoltan-rcb", terms, 16, machine, VIRTUAL)
        self.assertAlmostEqual(path["messages"], 4 * 10 + 3 * (4 + 3 + 2 + 1))
        self.assertAlmostEqual(path["bytes"], 1600)

    def test_search_of_many_ranks_takes_two_passes_a_round(self) -> None:
        # With 256 ranks 2 rounds for each of 8 levels.
        messages, size, into_rank = scaling._search(VIRTUAL, 1.01, 1024)
        self.assertAlmostEqual(messages, (2 * 20 + 3) * 10)
        self.assertAlmostEqual(size, 2 * 20 * 10 * 100)
        self.assertAlmostEqual(into_rank, 20 * 50)

    def test_digits_of_the_picture_are_apart_and_large_enough_on_a_page(self) -> None:
        ranks = [1 << power for power in range(1, 21)]
        paths = pd.DataFrame({"method": "rrcb", "ranks": ranks, "model_s": ranks, "low_s": ranks, "high_s": ranks, "messages": ranks,
                              "bytes_into_root": [1e4 * number for number in ranks]})  # fmt: skip
        plot.use_style()
        figure = scaling.draw(paths)
        with tempfile.TemporaryDirectory() as folder:
            plot.save(figure, Path(folder) / "scaling.png")
        figure.draw_without_rendering()
        labels = 0
        for axes in figure.axes:
            for axis, side in (axes.xaxis, 0), (axes.yaxis, 1):
                boxes = [text.get_window_extent() for text in axis.get_ticklabels() if text.get_text() and axes.axison]
                ends = sorted((box.intervalx, box.intervaly)[side].tolist() for box in boxes)
                self.assertTrue(all(a[1] < b[0] for a, b in zip(ends, ends[1:])), ends)
                labels += len(ends)
        self.assertGreater(labels, 15)
        # Pages are 7 inches wide.
        self.assertGreater(7 / figure.get_figwidth() * figure.axes[0].get_xticklabels()[0].get_fontsize(), 8)


if __name__ == "__main__":
    unittest.main()
