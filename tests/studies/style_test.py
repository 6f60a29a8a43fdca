"""Colours that no two things share, and axes that a reader can read."""

from __future__ import annotations

import itertools
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import numpy as np  # noqa: E402
import plot  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402


def cielab(colour: str) -> np.ndarray:
    """ISO/CIE 11664-4, of sRGB (IEC 61966-2-1) under D65."""
    rgb = np.array([int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    linear = np.where(rgb > 0.04045, ((rgb + 0.055) / 1.055) ** 2.4, rgb / 12.92)
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    xyz = np.array(to_xyz) @ linear / (0.9505, 1, 1.089)
    x, y, z = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


class StyleTest(unittest.TestCase):
    def test_no_two_colours_are_alike(self) -> None:
        colours = [method.colour for method in plot._METHODS.values()]
        colours += [*plot.PART_COLOURS]
        for first, second in itertools.combinations(colours, 2):
            with self.subTest(first=first, second=second):
                self.assertGreater(np.linalg.norm(cielab(first) - cielab(second)), 14)

    def test_a_setting_without_a_style_has_that_of_its_method(self) -> None:
        self.assertEqual(plot.method_style("rrcb[mesh=8]"), plot.method_style("rrcb"))
        self.assertNotEqual(plot.method_style("rrcb[tol=1.1]"), plot.method_style("rrcb"))

    def test_settings_that_share_a_style_are_told_apart(self) -> None:
        methods = ["rrcb", *(f"rrcb[mesh={mesh}]" for mesh in range(2, 40))]
        styles = plot.distinct_styles(methods)
        self.assertEqual(styles["rrcb"], plot.method_style("rrcb"))
        self.assertEqual(len(set(styles.values())), len(methods))
        self.assertEqual({found.colour for found in styles.values()}, {styles["rrcb"].colour})

    def test_numbers_are_plain(self) -> None:
        texts = [plot.plain_number(x) for x in (0.001, 0.5, 1, 2000, 1e6, 2e7, 1e9)]
        self.assertEqual(texts, ["0.001", "0.5", "1", "2,000", "1,000,000", "20 M", "1 G"])

    def test_logarithmic_axes_have_two_numbers_at_least(self) -> None:
        for low, high in ((1.2, 1.9), (2, 7), (0.02, 30), (1e-5, 1)):
            with self.subTest(low=low, high=high):
                figure, axes = plt.subplots()
                axes.set_yscale("log")
                axes.set_ylim(low, high)
                plot._label_plainly(axes.yaxis)
                ticks = axes.yaxis.get_majorticklocs()
                self.assertGreaterEqual(sum((ticks >= low) & (ticks <= high)), 2)
                plt.close(figure)


if __name__ == "__main__":
    unittest.main()
