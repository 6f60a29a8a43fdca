"""The beams that the frame is held against, beside closed forms."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "mpm" / "plots"))

import numpy as np  # noqa: E402
from beams import Portal, Section, element  # noqa: E402

SECTION = Section(modulus=6e6, shear_modulus=2e6, density=900, thickness=0.3)
BENDING = 6e6 * 0.3**3 / 12


def sway_determinant(x: float) -> float:
    """Of the dynamic stiffness of a square clamped portal against sway and turn of a corner, by
    Euler's beams of length 1: zero at the wave number of a free vibration. The beam turns the same
    way at both ends, so its middle is a hinge; each column carries half its mass."""
    sin, cos, sinh, cosh = np.sin(x), np.cos(x), np.sinh(x), np.cosh(x)
    scale = 1 - cos * cosh
    sway = x**3 * (cos * sinh + sin * cosh) / scale - x**4 / 2
    both = x**2 * sin * sinh / scale
    turn = x * (sin * cosh - cos * sinh) / scale
    sin, cos, sinh, cosh = np.sin(x / 2), np.cos(x / 2), np.sinh(x / 2), np.cosh(x / 2)
    turn += x * 2 * sin * sinh / (sin * cosh - cos * sinh)
    return sway * turn - both**2


class BeamsTest(unittest.TestCase):
    def test_a_cantilever_gives_way_by_bending_and_shear(self) -> None:
        length = 2.0
        stiffness, _ = element(SECTION, length)
        tip = np.linalg.solve(stiffness[3:, 3:], [0, 1, 0])
        shear = length / (2e6 * 5 / 6 * 0.3)
        self.assertAlmostEqual(tip[1] / (length**3 / (3 * BENDING) + shear), 1, 12)

    def test_masses_move_and_turn_as_a_bar(self) -> None:
        _, mass = element(SECTION, 2.0)
        across, turn = np.array([0, 1, 0, 0, 1, 0]), np.array([0, 0, 1, 0, 2, 1])
        self.assertAlmostEqual(across @ mass @ across, 900 * 0.3 * 2, 9)
        about_its_end = 900 * (0.3 * 2**3 / 3 + 0.3**3 / 12 * 2)
        self.assertAlmostEqual(turn @ mass @ turn, about_its_end, 9)

    def test_a_slender_frame_sways_as_its_members_do_exactly(self) -> None:
        thin = Section(modulus=6e6, shear_modulus=2e6, density=900, thickness=0.01)
        frequencies, _ = Portal(thin, 1.0, 1.0).modes()
        unit = np.sqrt(6e6 * 0.01**2 / 12 / 900)
        wave_number = np.sqrt(frequencies[0] / unit)
        low, high = 0.99 * wave_number, 1.01 * wave_number
        self.assertLess(sway_determinant(low) * sway_determinant(high), 0)
        while high - low > 1e-9:
            middle = 0.5 * (low + high)
            is_below = sway_determinant(low) * sway_determinant(middle) > 0
            low, high = (middle, high) if is_below else (low, middle)
        self.assertAlmostEqual(wave_number / low, 1, 3)

    def test_starts_with_the_speed_it_is_given(self) -> None:
        frame = Portal(SECTION, 4.0, 4.0)
        time = np.array([0, 1e-4])
        sway = frame.sway(lambda y: 0.1 * np.sin(np.pi * y / 8) ** 2, time, 1000)
        self.assertAlmostEqual(sway[1] / 1e-4, 0.1, 3)


if __name__ == "__main__":
    unittest.main()
