"""Free vibration of a plane portal frame by beam elements, to hold a simulated one against."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

ELEMENTS = 12  # of a member
SHEAR_AREA = 5 / 6  # of a rectangle's area


@dataclass(frozen=True)
class Section:
    modulus: float  # Pa, in plane strain
    shear_modulus: float  # Pa
    density: float  # kg/m^3
    thickness: float  # m


def element(section: Section, length: float) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and consistent mass of a beam along x, with shear (Timoshenko) and rotary inertia
    (Przemieniecki 1968, 5.6 and 11.3), by (along, across, turn) of its ends."""
    area, inertia = section.thickness, section.thickness**3 / 12
    bending = section.modulus * inertia
    phi = 12 * bending / (section.shear_modulus * SHEAR_AREA * area * length**2)
    stiffness, mass = np.zeros((6, 6)), np.zeros((6, 6))
    along, across = np.ix_([0, 3], [0, 3]), np.ix_([1, 2, 4, 5], [1, 2, 4, 5])
    stiffness[along] = section.modulus * area / length * np.array([[1, -1], [-1, 1]])
    a, near, far = 6 * length, (4 + phi) * length**2, (2 - phi) * length**2
    stiffness[across] = (
        bending
        / (length**3 * (1 + phi))
        * np.array([[12, a, -12, a], [a, near, -a, far], [-12, -a, 12, -a], [a, far, -a, near]])
    )
    mass[along] = section.density * area * length / 6 * np.array([[2, 1], [1, 2]])
    b, c, d = 22 * length, 13 * length, length**2
    shape = np.array(
        [[156, b, 54, -c], [b, 4 * d, c, -3 * d], [54, c, 156, -b], [-c, -3 * d, -b, 4 * d]]
    )
    b = 3 * length
    turning = np.array([[36, b, -36, b], [b, 4 * d, -b, -d], [-36, -b, 36, -b], [b, -d, -b, 4 * d]])
    mass[across] = section.density * (
        area * length / 420 * shape + inertia / (30 * length) * turning
    )
    return stiffness, mass


class Portal:
    """Two columns, clamped at their feet, and a beam on them, by the lines of their centres."""

    def __init__(self, section: Section, width: float, height: float):
        corners = np.array([[0, 0], [0, height], [width, height], [width, 0]])
        shares = np.arange(ELEMENTS)[:, None] / ELEMENTS
        lines = [a + shares * (b - a) for a, b in zip(corners, corners[1:])]
        self.nodes = np.concatenate([*lines, corners[-1:]])
        size = 3 * len(self.nodes)
        self.stiffness, self.mass = np.zeros((size, size)), np.zeros((size, size))
        for first, (a, b) in enumerate(zip(self.nodes, self.nodes[1:])):
            length = np.hypot(*(b - a))
            c, s = (b - a) / length
            turn = np.kron(np.eye(2), [[c, s, 0], [-s, c, 0], [0, 0, 1]])
            of_both = slice(3 * first, 3 * first + 6)
            for whole, part in zip((self.stiffness, self.mass), element(section, length)):
                whole[of_both, of_both] += turn.T @ part @ turn
        self.free = np.arange(3, size - 3)

    def modes(self) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies, rad/s, from the lowest on, and modes of mass 1 as columns."""
        free = np.ix_(self.free, self.free)
        root = np.linalg.inv(np.linalg.cholesky(self.mass[free]))
        squares, vectors = np.linalg.eigh(root @ self.stiffness[free] @ root.T)
        modes = np.zeros((len(self.mass), len(squares)))
        modes[self.free] = root.T @ vectors
        return np.sqrt(squares), modes

    def sway(self, speed_at, time: np.ndarray, num_modes: int = 8) -> np.ndarray:
        """Displacement along x of the middle of the beam, from rest with the speed along x at a
        height."""
        frequencies, modes = self.modes()
        start = np.zeros(len(self.mass))
        start[0::3] = speed_at(self.nodes[:, 1])
        # A column turns by as much as its speed grows with height, clockwise.
        step = 1e-6
        slope = (speed_at(self.nodes[:, 1] + step) - speed_at(self.nodes[:, 1] - step)) / (2 * step)
        is_in_beam = self.nodes[:, 1] >= self.nodes[:, 1].max()
        start[2::3] = np.where(is_in_beam, 0, -slope)
        middle = 3 * (len(self.nodes) // 2)
        parts = modes.T @ self.mass @ start * modes[middle] / frequencies
        waves = np.sin(np.outer(time, frequencies[:num_modes]))
        return waves @ parts[:num_modes]
