"""Tabulates and draws the errors of a few standard deviations."""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import moments  # noqa: E402

ERRORS = """\
cloud,offset,points,method,error
uniform,1,100,"naive sums",5.1e-13
uniform,1,100,"Chan, pairwise",0
uniform,1e+09,100,"naive sums",-nan
uniform,1e+09,100,"Chan, pairwise",1.2e-09
two values,1e+06,10,"naive sums",8e-04
two values,1e+06,10,"Chan, pairwise",3e-11
"""


class MomentsTest(unittest.TestCase):
    def setUp(self) -> None:
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        (self.directory / "moments_error.csv").write_text(ERRORS)
        self.errors = moments.read_all(self.directory / "moments_error.csv")

    def test_table_has_a_row_per_cloud_and_a_column_per_method(self) -> None:
        self.assertEqual(
            moments.table_of(self.errors).splitlines(),
            [
                "| points | offset | number | naive sums | Chan, pairwise |",
                "|---|---|---|---|---|",
                "| uniform | 1e+00 | 100 | 5e-13 | 0 |",
                "| uniform | 1e+09 | 100 | no number | 1e-09 |",
                "| two values | 1e+06 | 10 | 8e-04 | 3e-11 |",
            ],
        )

    def test_picture_is_drawn_with_what_is_no_number_left_out(self) -> None:
        figure = moments.draw_errors(self.errors)
        lines = {line.get_label(): line.get_xydata().tolist() for line in figure.axes[0].lines}
        self.assertEqual(lines["naive sums"], [[1, 5.1e-13]])
        self.assertEqual(lines["Chan, pairwise"], [[1, moments.FLOOR], [1e9, 1.2e-9]])


if __name__ == "__main__":
    unittest.main()
