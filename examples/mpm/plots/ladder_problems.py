"""Problems with an analytic answer, and how far a run is from it."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from vtk_files import frames_of, points_of

GRAVITY = 9.81


@dataclass(frozen=True)
class Problem:
    name: str  # of its scene
    says: str  # what the error is
    cell_sizes: list[float]  # m, falling
    error: Callable[[Path], float]  # of the files in a folder


def history_of(folder: Path) -> list[dict[str, float]]:
    with (folder / "history.csv").open(newline="") as file:
        return [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]


def error_of_bar(folder: Path) -> float:
    """Of the mean velocity, the root of the mean square over a period, by the amplitude."""
    amplitude, omega = 0.2 / math.pi, 0.2 * math.pi
    errors = [
        row["momentum_x"] / row["mass"] - amplitude * math.cos(omega * row["time"])
        for row in history_of(folder)
    ]
    return math.sqrt(sum(e * e for e in errors) / len(errors)) / amplitude


def error_of_column(folder: Path) -> float:
    """Of the stress in each point, the root of the mean square, by the stress at the base.

    The weight above a point is that above it at the start, however the column is compressed."""
    density, height = 1800, 0.1
    points = points_of(frames_of(folder, "points")[-1][1])
    start = points["position"][:, 1] - points["displacement"][:, 1]
    errors = points["stress_yy"] + density * GRAVITY * (height - start)
    return float(np.sqrt(np.mean(errors**2))) / (density * GRAVITY * height)


def error_of_disks(folder: Path) -> float:
    """Kinetic and strain energy that are gone, or too much, after the impact."""
    history = history_of(folder)
    first, last = (row["kinetic_energy"] + row["strain_energy"] for row in (history[0], history[-1]))
    return abs(last / first - 1)


def error_of_block(folder: Path) -> float:
    """Of the way down the slope."""
    angle, friction, ramp = math.radians(24), math.tan(math.radians(15)), 1
    history = history_of(folder)
    first, last = history[0], history[-1]
    way = (last["center_x"] - first["center_x"]) * math.cos(angle)
    way -= (last["center_y"] - first["center_y"]) * math.sin(angle)
    time = last["time"]
    acceleration = GRAVITY * (math.sin(angle) - friction * math.cos(angle))
    return abs(way / (acceleration * (time**2 / 2 - ramp * time / 2 + ramp**2 / 6)) - 1)


PROBLEMS = {
    problem.name: problem
    for problem in (
        Problem("axial_bar", "error of the mean velocity", [1, 0.5, 0.25], error_of_bar),
        Problem(
            "hydrostatic_column",
            "error of the stress",
            [0.025, 0.0125, 0.00625, 0.003125],
            error_of_column,
        ),
        Problem("two_disks", "error of the energy", [0.1, 0.05, 0.025], error_of_disks),
        Problem("incline_block", "error of the way", [0.5, 0.25, 0.125], error_of_block),
    )
}
