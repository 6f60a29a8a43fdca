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
        found = scaling.fit("zoltan-rcb", COUNTS, "collectives")
        self.assertAlmostEqual(found["1"], 10)
        self.assertAlmostEqual(found["log"], 3)
        self.assertAlmostEqual(scaling.at(found, 1024), 40)

    def test_collectives_of_a_level_are_on_half_as_many_ranks_at_each(self) -> None:
        machine = scaling.Machine(latency=1, bandwidth=1e30, points=1)
        path = scaling.path("zoltan-rcb", COUNTS, 16, machine, VIRTUAL)
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
        paths = pd.DataFrame({"method": "rrcb", "ranks": ranks, "model_s": ranks, "messages": ranks,
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
