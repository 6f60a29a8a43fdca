"""The model of a call: fits to counts of a known growth, and what a call takes on more ranks."""

from __future__ import annotations

import unittest
from math import log2

import support  # noqa: F401, before the studies

import pandas as pd
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


if __name__ == "__main__":
    unittest.main()
