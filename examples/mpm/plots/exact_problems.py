"""Five problems with exact answers, for accuracy.py: scenes, and errors of their runs."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from vtk_files import frames_of, points_of

G = 9.81


@dataclass(frozen=True)
class Problem:
    name: str
    error_of: Callable[[Path], float]  # of the folder of a run, by the size of what is compared
    measure: str  # what the error is of
    cells: tuple[float, ...]  # sizes, m
    points: int  # along a cell
    text: Callable[[float], str]  # of the scene but for its method and output

    def scene(self, cell: float, function: str, courant_number: float, end: str) -> str:
        return (
            f"scene:\n  dimension: 2\n{self.text(cell)}"
            f"  method:\n    shape_function: {function}\n    courant_number: {courant_number}\n"
            f"{end}"
        )


def domain(lower: tuple[float, float], upper: tuple[float, float], cell: float) -> str:
    cells = [round((high - low) / cell) for low, high in zip(lower, upper)]
    return (
        f"  domain:\n    lower: [{lower[0]}, {lower[1]}]\n    cells: {cells}\n    cell_size: {cell}\n"
    )


def elastic(density: float, modulus: float, ratio: float) -> str:
    return (
        "  materials:\n    solid:\n      model: elastic\n"
        f"      density: {density}\n      youngs_modulus: {modulus}\n      poissons_ratio: {ratio}\n"
    )


def body(name: str, points: int, shape: str, velocity: str = "") -> str:
    return (
        f"    {name}:\n      material: solid\n      points_per_cell: [{points}, {points}]\n"
        f"      shapes:\n        all:\n{shape}{velocity}"
    )


def box(lower: tuple[float, float], upper: tuple[float, float]) -> str:
    return (
        f"          shape: box\n          lower: [{lower[0]}, {lower[1]}]\n"
        f"          upper: [{upper[0]}, {upper[1]}]\n"
    )


def ball(centre: tuple[float, float], radius: float) -> str:
    return (
        f"          shape: ball\n          centre: [{centre[0]}, {centre[1]}]\n"
        f"          radius: {radius}\n"
    )


def gravity(acceleration: float) -> str:
    return f"  effects:\n    gravity:\n      acceleration: [0, {-acceleration}]\n"


def history_of(folder: Path) -> dict[str, np.ndarray]:
    with (folder / "history.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def end_of(folder: Path) -> dict[str, np.ndarray]:
    return points_of(frames_of(folder, "points")[-1][1])


# A wave between a wall and a free end, mode 1 of a bar.
BAR, BAR_MODULUS, BAR_SPEED = 25.0, 100.0, 0.01


def bar_text(cell: float) -> str:
    velocity = (
        f"      velocity:\n        sine_amplitude: [{BAR_SPEED}, 0]\n"
        f"        sine_wave_number: [{np.pi / (2 * BAR)}, 0]\n"
    )
    return (
        "  end_time: 10\n" + domain((0, 0), (BAR + 4 * cell, cell), cell)
        + "  walls:\n    left: roller\n    bottom: roller\n    top: roller\n"
        + elastic(1, BAR_MODULUS, 0)
        + "  bodies:\n" + body("bar", 2, box((0, 0), (BAR, cell)), velocity)
    )  # fmt: skip


def bar_error(folder: Path) -> float:
    history = history_of(folder)
    rate = np.pi / (2 * BAR) * np.sqrt(BAR_MODULUS)
    amplitude = 2 / np.pi * BAR_SPEED / rate
    way = history["center_x"] - history["center_x"][0]
    return np.sqrt(np.mean((way - amplitude * np.sin(rate * history["time"])) ** 2)) / amplitude


# A cantilever that its weight, there at once, lets vibrate.
BEAM, BEAM_MODULUS, BEAM_DENSITY = 6.0, 1e6, 1e3


def timoshenko_rate() -> float:
    """The first of a cantilever with shear, rad/s (Huang 1961): height 1, Poisson's ratio 0."""
    bend = 1 / (12 * BEAM**2)
    shear = bend * 2 / (5 / 6)

    def determinant(b: float) -> float:
        root = np.sqrt((bend - shear) ** 2 + 4 / b**2)
        grow, turn = (np.sqrt((root + sign * (bend + shear)) / 2) for sign in (-1, 1))
        return (
            2 + (b**2 * (bend - shear) ** 2 + 2) * np.cosh(b * grow) * np.cos(b * turn)
            - b * (bend + shear) / np.sqrt(1 - b**2 * bend * shear)
            * np.sinh(b * grow) * np.sin(b * turn)
        )  # fmt: skip

    low, high = 2.0, 4.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if determinant(middle) > 0 else (low, middle)
    return low * np.sqrt(BEAM_MODULUS / (12 * BEAM_DENSITY)) / BEAM**2


def beam_text(cell: float) -> str:
    end_time = 1.5 * 2 * np.pi / timoshenko_rate()
    return (
        f"  end_time: {end_time}\n" + domain((0, -1), (BEAM + 1, 2), cell)
        + "  walls:\n    left: fixed\n" + elastic(BEAM_DENSITY, BEAM_MODULUS, 0)
        + "  bodies:\n" + body("beam", 2, box((0, 0), (BEAM, 1))) + gravity(0.01)
    )  # fmt: skip


def fitted_rate(time: np.ndarray, value: np.ndarray, low: float, high: float) -> float:
    """Rate of the cosine and sine that, with a constant, leave the least squares."""

    def rest(rate: float) -> float:
        columns = np.stack([np.ones_like(time), np.cos(rate * time), np.sin(rate * time)], axis=1)
        return np.linalg.norm(columns @ np.linalg.lstsq(columns, value, rcond=None)[0] - value)

    for _ in range(12):
        rates = np.linspace(low, high, 9)
        best = rates[np.argmin([rest(rate) for rate in rates])]
        step = (high - low) / 8
        low, high = best - step, best + step
    return best


def beam_error(folder: Path) -> float:
    history, rate = history_of(folder), timoshenko_rate()
    found = fitted_rate(history["time"], history["center_y"], 0.5 * rate, 1.5 * rate)
    return abs(rate / found - 1)


# A layer under water, at rest.
LAYER, LAYER_DENSITY, WATER = 0.1, 1800.0, 1000.0


def layer_text(cell: float) -> str:
    return (
        "  end_time: 0.1\n" + domain((0, 0), (2 * cell, LAYER + 2 * cell), cell)
        + "  walls:\n    left: roller\n    right: roller\n    bottom: fixed\n"
        + elastic(LAYER_DENSITY, 1e6, 0)
        + "  bodies:\n" + body("layer", 2, box((0, 0), (2 * cell, LAYER))) + gravity(G)
        + f"    buoyancy:\n      water_density: {WATER}\n"
        + "    damping:\n      rate: 740\n      until: 1\n"
    )  # fmt: skip


def layer_error(folder: Path) -> float:
    points = end_of(folder)
    weight = (LAYER_DENSITY - WATER) * G
    exact = -weight * (LAYER - points["position"][:, 1])
    return np.sqrt(np.mean((points["stress_yy"] - exact) ** 2)) / (weight * LAYER)


# Half a disk of radius 1 at rest on rigid ground without friction, by its weight.
DISK_MODULUS, DISK_RATIO, DISK_DENSITY, DISK_WEIGHT = 1e6, 0.3, 1e3, 6.0


def disk_text(cell: float) -> str:
    return (
        "  end_time: 0.6\n" + domain((0, 0), (1.25, 2.25), cell)
        + "  walls:\n    left: roller\n    bottom: frictional\n    bottom_friction: 0\n"
        + elastic(DISK_DENSITY, DISK_MODULUS, DISK_RATIO)
        + "  bodies:\n" + body("half", 4, ball((0, 1), 1)) + gravity(DISK_WEIGHT)
        + "    damping:\n      rate: 25\n      until: 1\n"
    )  # fmt: skip


def disk_error(folder: Path) -> float:
    """Stress up to half the contact's width above it (McEwen 1949), by the largest pressure."""
    points = end_of(folder)
    x, z = points["position"][:, 0], points["position"][:, 1]
    weight = DISK_DENSITY * DISK_WEIGHT * np.pi
    stiffness = DISK_MODULUS / (1 - DISK_RATIO**2)
    half = np.sqrt(4 * weight / (np.pi * stiffness))
    pressure = 2 * weight / (np.pi * half)
    first = half**2 - x**2 + z**2
    root = np.sqrt(first**2 + 4 * x**2 * z**2)
    m, n2 = np.sqrt((root + first) / 2), (root - first) / 2
    exact = -pressure / half * m * (1 - (z**2 + n2) / (m**2 + n2))
    near = (x < 2 * half) & (z < half)
    return np.sqrt(np.mean((points["stress_yy"][near] - exact[near]) ** 2)) / pressure


# Two disks meet and part (Sulsky, Chen and Schreyer 1994).
def disks_text(cell: float) -> str:
    def moving(name: str, at: float, speed: float) -> str:
        return body(
            name, 4, ball((at, at), 0.2), f"      velocity:\n        constant: [{speed}, {speed}]\n"
        )

    return (
        "  end_time: 3.0\n" + domain((0, 0), (1, 1), cell) + elastic(1000, 1000, 0.3)
        + "  bodies:\n" + moving("lower", 0.2, 0.1) + moving("upper", 0.8, -0.1)
    )  # fmt: skip


def disks_error(folder: Path) -> float:
    history = history_of(folder)
    energy = history["kinetic_energy"] + history["strain_energy"]
    return abs(energy[-1] / energy[0] - 1)


PROBLEMS = (
    Problem("wave", bar_error, "way of the centre", (2.5, 1.25, 0.625), 2, bar_text),
    Problem("cantilever", beam_error, "period", (0.5, 0.25, 0.125), 2, beam_text),
    Problem("layer", layer_error, "stress", (0.0125, 0.00625, 0.003125), 2, layer_text),
    Problem("hertz", disk_error, "stress at the contact", (0.125, 0.0625, 0.03125), 4, disk_text),
    Problem("disks", disks_error, "energy", (0.1, 0.05, 0.025), 4, disks_text),
)
