"""Tells how many points change rank, of a few cases with known answers."""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import migration  # noqa: E402
from results import read_all  # noqa: E402

COLUMNS = (
    "scene,ranks,seed,between,method,calls,points,moved_points,crossed_points,moved_fraction,"
    "crossed_fraction,mean_imbalance,worst_imbalance"
)
MOVED = {"zoltan-rcb": 500, "rrcb": 40, "rrcb[reuse]": 10}  # of 1000 in 10 calls, by seed 1


class MigrationTest(unittest.TestCase):
    def setUp(self) -> None:
        lines = [COLUMNS]
        for between in ("follow", "stay"):
            for method, moved in MOVED.items():
                for seed in range(1, 8):
                    count = moved + seed - 1
                    lines.append(
                        f"cube,4,{seed},{between},{method},10,1000,{count},7,{count / 10000},"
                        "0.0007,1,1"
                    )
                still = 0 if between == "stay" else moved
                lines.append(
                    f"pile,4,,{between},{method},10,1000,{still},9,{still / 10000},0.0009,1,1"
                )
        with tempfile.TemporaryDirectory() as directory:
            path = Path(directory) / "migration.csv"
            path.write_text("\n".join(lines) + "\n")
            self.rows = read_all(path)

    def test_table_has_a_row_per_case(self) -> None:
        lines = migration.table_of(self.rows, "follow").splitlines()
        self.assertEqual(len(lines), 2 + 2)
        self.assertEqual(
            lines[2],
            "| cube | 4 | 5.030 [5.000, 5.060] | 0.430 [0.400, 0.460] | 0.130 [0.100, 0.160]"
            " | 0.070 | 0.30 |",
        )
        self.assertEqual(lines[3], "| pile | 4 | 5.000 | 0.400 | 0.100 | 0.090 | 0.25 |")

    def test_there_is_no_ratio_to_nothing(self) -> None:
        lines = migration.table_of(self.rows, "stay").splitlines()
        self.assertTrue(lines[3].endswith("| 0.090 | - |"))


if __name__ == "__main__":
    unittest.main()
