"""Defines five problems with exact solutions for accuracy.py: scenes, and the errors of their runs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from vtk_files import frames_of, history_of, points_of

G = 9.81


Tree = dict[str, object]  # a tree of lists, as in scene files


@dataclass(frozen=True)
class Problem:
    name: str
    error_of: Callable[[Path], float]  # error of the run in a folder, relative to the compared quantity
    measure: str  # name of the compared quantity
    cells: tuple[float, ...]  # sizes, m
    points: int  # along a cell
    tree: Callable[[float], Tree]  # the scene without its method and output

    def scene(self, cell: float, function: str, courant_number: float, end: str) -> str:
        method = {"shape_function": function, "courant_number": courant_number}
        return written({"scene": {"dimension": 2, **self.tree(cell), "method": method}}) + end


def written(tree: Tree, indent: str = "") -> str:
    """Returns a tree of lists as YAML."""
    text = ""
    for name, value in tree.items():
        is_list = isinstance(value, dict)
        text += f"{indent}{name}:" + ("\n" if is_list else f" {value}\n")
        text += written(value, indent + "  ") if is_list else ""
    return text


def solid(upper: tuple[float, float], cell: float, material: tuple[float, float, float],
          lower: tuple[float, float] = (0, 0)) -> Tree:
    """Returns cells, and an elastic material with a density, a modulus and Poisson's ratio."""
    cells = [round((high - low) / cell) for low, high in zip(lower, upper)]
    keys = ("density", "youngs_modulus", "poissons_ratio")
    return {
        "domain": {"lower": list(lower), "cells": cells, "cell_size": cell},
        "materials": {"solid": {"model": "elastic", **dict(zip(keys, material))}},
    }


def body(points: int, velocity: Tree | None = None, **shape: object) -> Tree:
    return {"material": "solid", "points_per_cell": [points, points], "shapes": {"all": shape},
            **({"velocity": velocity} if velocity else {})}  # fmt: skip


def gravity(acceleration: float) -> Tree:
    return {"gravity": {"acceleration": [0, -acceleration]}}


def end_of(folder: Path) -> dict[str, np.ndarray]:
    return points_of(frames_of(folder, "points")[-1][1])


# Problem 1: mode 1 of a bar, a wave between a wall and a free end.
BAR, BAR_MODULUS, BAR_SPEED = 25.0, 100.0, 0.01


def bar(cell: float) -> Tree:
    wave = {"sine_amplitude": [BAR_SPEED, 0], "sine_wave_number": [np.pi / (2 * BAR), 0]}
    return {
        "end_time": 10, **solid((BAR + 4 * cell, cell), cell, (1, BAR_MODULUS, 0)),
        "walls": {"left": "roller", "bottom": "roller", "top": "roller"},
        "bodies": {"bar": body(2, wave, shape="box", lower=[0, 0], upper=[BAR, cell])},
    }  # fmt: skip


def bar_error(folder: Path) -> float:
    history = history_of(folder)
    rate = np.pi / (2 * BAR) * np.sqrt(BAR_MODULUS)
    amplitude = 2 / np.pi * BAR_SPEED / rate
    way = history["center_x"] - history["center_x"][0]
    return np.sqrt(np.mean((way - amplitude * np.sin(rate * history["time"])) ** 2)) / amplitude


# Problem 2: a cantilever that vibrates because its weight is applied at once.
BEAM, BEAM_MODULUS, BEAM_DENSITY = 6.0, 1e6, 1e3


def timoshenko_rate() -> float:
    """Returns the first frequency of a cantilever with shear, rad/s (Huang 1961), for height 1 and
    Poisson's ratio 0."""
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


def beam(cell: float) -> Tree:
    return {
        "end_time": 1.5 * 2 * np.pi / timoshenko_rate(),
        **solid((BEAM + 1, 2), cell, (BEAM_DENSITY, BEAM_MODULUS, 0), lower=(0, -1)),
        "walls": {"left": "fixed"},
        "bodies": {"beam": body(2, shape="box", lower=[0, 0], upper=[BEAM, 1])},
        "effects": gravity(0.01),
    }


def fitted_rate(time: np.ndarray, value: np.ndarray, low: float, high: float) -> float:
    """Fits a constant, a cosine and a sine of one frequency to the values by least squares. Returns
    the frequency."""

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


# Problem 3: a layer at rest under water.
LAYER, LAYER_DENSITY, WATER = 0.1, 1800.0, 1000.0


def layer(cell: float) -> Tree:
    return {
        "end_time": 0.1,
        **solid((2 * cell, LAYER + 2 * cell), cell, (LAYER_DENSITY, 1e6, 0)),
        "walls": {"left": "roller", "right": "roller", "bottom": "fixed"},
        "bodies": {"layer": body(2, shape="box", lower=[0, 0], upper=[2 * cell, LAYER])},
        "effects": {**gravity(G), "buoyancy": {"water_density": WATER},
                    "damping": {"rate": 740, "until": 1}},
    }  # fmt: skip


def layer_error(folder: Path) -> float:
    points = end_of(folder)
    weight = (LAYER_DENSITY - WATER) * G
    exact = -weight * (LAYER - points["position"][:, 1])
    return np.sqrt(np.mean((points["stress_yy"] - exact) ** 2)) / (weight * LAYER)


# Problem 4: half a disk of radius 1, at rest under its weight on rigid ground without friction.
DISK_MODULUS, DISK_RATIO, DISK_DENSITY, DISK_WEIGHT = 1e6, 0.3, 1e3, 6.0


def disk(cell: float) -> Tree:
    return {
        "end_time": 0.6,
        **solid((1.25, 2.25), cell, (DISK_DENSITY, DISK_MODULUS, DISK_RATIO)),
        "walls": {"left": "roller", "bottom": "frictional", "bottom_friction": 0},
        "bodies": {"half": body(4, shape="ball", centre=[0, 1], radius=1)},
        "effects": {**gravity(DISK_WEIGHT), "damping": {"rate": 25, "until": 1}},
    }


def disk_error(folder: Path) -> float:
    """Returns the error of the stress up to half the contact's width above the contact (McEwen
    1949), divided by the largest pressure."""
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


# Problem 5: two disks collide and separate (Sulsky, Chen and Schreyer 1994).
def disks(cell: float) -> Tree:
    def moving(at: float, speed: float) -> Tree:
        return body(4, {"constant": [speed, speed]}, shape="ball", centre=[at, at], radius=0.2)

    bodies = {"lower": moving(0.2, 0.1), "upper": moving(0.8, -0.1)}
    return {"end_time": 3.0, **solid((1, 1), cell, (1000, 1000, 0.3)), "bodies": bodies}


def disks_error(folder: Path) -> float:
    history = history_of(folder)
    energy = history["kinetic_energy"] + history["strain_energy"]
    return abs(energy[-1] / energy[0] - 1)


PROBLEMS = (
    Problem("wave", bar_error, "way of the centre", (2.5, 1.25, 0.625), 2, bar),
    Problem("cantilever", beam_error, "period", (0.5, 0.25, 0.125), 2, beam),
    Problem("layer", layer_error, "stress", (0.0125, 0.00625, 0.003125), 2, layer),
    Problem("hertz", disk_error, "stress at the contact", (0.125, 0.0625, 0.03125), 4, disk),
    Problem("disks", disks_error, "energy", (0.1, 0.05, 0.025), 4, disks),
)
