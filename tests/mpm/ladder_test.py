"""The errors and fronts of examples/mpm/ladder, on files and numbers made by hand."""

import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "examples" / "mpm" / "plots"))

from ladder import with_method  # noqa: E402
from ladder_picture import front  # noqa: E402
from ladder_problems import PROBLEMS  # noqa: E402


class Ladder(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def error(self, problem: str, history: str) -> float:
        Path(self.folder.name, "history.csv").write_text(history)
        return PROBLEMS[problem].error(Path(self.folder.name))

    def test_bar_is_measured_by_its_mean_velocity(self) -> None:
        # At the start 0.2 / pi, after a quarter of the period of 10 s none, but here 0.1.
        rows = f"time,mass,momentum_x\n0,2,{0.4 / math.pi}\n2.5,2,0.2\n"
        self.assertAlmostEqual(self.error("axial_bar", rows), 0.1 / math.sqrt(2) / (0.2 / math.pi))

    def test_disks_are_measured_by_their_energy(self) -> None:
        rows = "time,kinetic_energy,strain_energy,dissipated_energy\n0,4,0,0\n3,2,1,1\n"
        self.assertAlmostEqual(self.error("two_disks", rows), 0.25)

    def test_block_is_measured_along_the_slope(self) -> None:
        # 9.81 (0.4067366 - 0.2679492 * 0.9135455) = 1.5887570 m/s^2 for 25/2 - 5/2 + 1/6 s^2.
        way = 1.5887570 * (10 + 1 / 6) * 1.01
        end = f"{1 + way * 0.9135455},{9 - way * 0.4067366}"
        rows = f"time,center_x,center_y\n0,1,9\n5,{end}\n"
        self.assertAlmostEqual(self.error("incline_block", rows), 0.01, 6)

    def test_front_has_what_nothing_beats(self) -> None:
        points = [(2, 0.5), (1, 0.9), (3, 0.5), (4, 0.1), (1, 0.8), (5, 0.2)]
        self.assertEqual(front(points), [(1, 0.8), (2, 0.5), (4, 0.1)])

    def test_method_of_a_scene_is_replaced_or_added(self) -> None:
        scene = "  method:\n    transfer: flip\n    courant_number: 0.1\n  points_per_cell: [4, 4]\n"
        expected = (
            "  method:\n    shape_function: gimp\n    transfer: apic\n    courant_number: 0.1\n"
            "  points_per_cell: [2, 2]\n"
        )
        self.assertEqual(with_method(scene, "gimp", "apic", 2), expected)
        modified = expected.replace("apic\n", "flip\n    time_integration: modified\n")
        self.assertEqual(with_method(expected, "gimp", "flip modified", 2), modified)
        self.assertEqual(with_method(modified, "gimp", "apic", 2), expected)


if __name__ == "__main__":
    unittest.main()
