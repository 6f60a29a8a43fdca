"""Defines five problems with exact solutions for accuracy.py: scenes, and the errors of their runs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from vtk_files import frames_of, history_of, points_of

G = 9.81
CELLS_FLOWN = 4
FRAMES = 40  # of points, besides that at the start


Tree = dict[str, object]  # a tree of lists, as in scene files


@dataclass(frozen=True)
class Problem:
    name: str
    error_of: Callable[[Path], float]  # error of the run in a folder, relative to the compared quantity
    measure: str  # name of the compared quantity
    cells: tuple[float, ...]  # sizes, m
    end_time: float  # s
    tree: Callable[[float, int, float], Tree]  # of a cell, the points along it and a speed

    def scene(self, cell: float, points: int, flies: bool, function: str) -> str:
        """Returns the text of a scene. Flying bodies cross CELLS_FLOWN coarse cells at a constant speed."""
        speed = CELLS_FLOWN * self.cells[0] / self.end_time if flies else 0.0
        return written({"scene": {
            "dimension": 2, "end_time": self.end_time, **self.tree(cell, points, speed),
            "method": {"shape_function": function, "courant_number": 0.4},
            "output": {"vtk_every": 1, "every_time": self.end_time / FRAMES},
        }})  # fmt: skip


def written(tree: Tree, indent: str = "") -> str:
    """Returns a tree of lists as YAML."""
    text = ""
    for name, value in tree.items():
        is_list = isinstance(value, dict)
        text += f"{indent}{name}:" + ("\n" if is_list else f" {value}\n")
        text += written(value, indent + "  ") if is_list else ""
    return text


def solid(upper: tuple[float, float], cell: float, material: tuple[float, float, float]) -> Tree:
    """Returns cells, and an elastic material of a density, a modulus and Poisson's ratio."""
    keys = ("density", "youngs_modulus", "poissons_ratio")
    return {
        "domain": {"lower": [0, 0], "cells": [round(at / cell) for at in upper], "cell_size": cell},
        "materials": {"solid": {"model": "elastic", **dict(zip(keys, material))}},
    }


def body(points: int, velocity: Tree | None = None, **shape: object) -> Tree:
    return {"material": "solid", "points_per_cell": [points, points], "shapes": {"all": shape},
            **({"velocity": velocity} if velocity else {})}  # fmt: skip


def weight(acceleration: float, rate: float, speed: float) -> Tree:
    """Returns gravity and damping. Gravity along x makes up for what damping takes from a speed."""
    return {"gravity": {"acceleration": [rate * speed, -acceleration]},
            "damping": {"rate": rate, "until": 1e9}}  # fmt: skip


def end_of(folder: Path) -> dict[str, np.ndarray]:
    return points_of(frames_of(folder, "points")[-1][1])


def motion_of(folder: Path, is_shown: Callable[[np.ndarray], np.ndarray], axis: int,
              ) -> tuple[np.ndarray, np.ndarray]:
    """Returns times, and the way of a part of a body along an axis, less that of the whole body.

    The part is chosen by the places at the start, seen from the centre."""
    times, ways = [], []
    for time, files in frames_of(folder, "points"):
        points = points_of(files)
        way = points["displacement"][:, axis]
        start = points["position"] - points["displacement"]
        part = is_shown(start[:, 0] - start[:, 0].mean())
        times.append(time)
        ways.append(way[part].mean() - way.mean())
    return np.array(times), np.array(ways)


# Problem 1: mode 1 of a bar with free ends.
BAR, BAR_MODULUS, BAR_SPEED = 50.0, 100.0, 0.01
BAR_RATE = np.pi / BAR * np.sqrt(BAR_MODULUS)


def bar(cell: float, points: int, speed: float) -> Tree:
    number = np.pi / BAR
    begin = 5.0
    wave = {"constant": [speed, 0], "sine_amplitude": [BAR_SPEED, 0],
            "sine_wave_number": [number, 0], "sine_phase": -number * (begin + BAR / 2)}  # fmt: skip
    return {
        **solid((BAR + 20, cell), cell, (1, BAR_MODULUS, 0)),
        "walls": {"bottom": "roller", "top": "roller"},
        "bodies": {"bar": body(points, wave, shape="box", lower=[begin, 0], upper=[begin + BAR, cell])},
    }  # fmt: skip


def bar_error(folder: Path) -> float:
    amplitude = 2 / np.pi * BAR_SPEED / BAR_RATE
    time, way = motion_of(folder, lambda x: x > 0, 0)
    return np.sqrt(np.mean((way - amplitude * np.sin(BAR_RATE * time)) ** 2)) / amplitude


# Problem 2: a beam with free ends that bends to and fro.
BEAM, BEAM_MODULUS, BEAM_DENSITY = 6.0, 1e6, 1e3


def timoshenko_rate() -> float:
    """Returns the first frequency of a free beam with shear, rad/s (Huang 1961), for height 1 and
    Poisson's ratio 0."""
    bend = 1 / (12 * BEAM**2)
    shear = bend * 2 / (5 / 6)

    def determinant(b: float) -> float:
        root = np.sqrt((bend - shear) ** 2 + 4 / b**2)
        grow, turn = (np.sqrt((root + sign * (bend + shear)) / 2) for sign in (-1, 1))
        return (
            2 - 2 * np.cosh(b * grow) * np.cos(b * turn)
            + b / np.sqrt(1 - b**2 * bend * shear)
            * (b**2 * bend * (bend - shear) ** 2 + 3 * bend - shear)
            * np.sinh(b * grow) * np.sin(b * turn)
        )  # fmt: skip

    low, high = 15.0, 24.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if determinant(middle) > 0 else (low, middle)
    return low * np.sqrt(BEAM_MODULUS / (12 * BEAM_DENSITY)) / BEAM**2


def beam(cell: float, points: int, speed: float) -> Tree:
    begin, number = 1.0, 2 * np.pi / BEAM
    bend = {"constant": [speed / np.sqrt(2), speed / np.sqrt(2)], "sine_amplitude": [0, 0.005],
            "sine_wave_number": [number, 0],
            "sine_phase": np.pi / 2 - number * (begin + BEAM / 2)}  # fmt: skip
    box = {"shape": "box", "lower": [begin, 1], "upper": [begin + BEAM, 2]}
    return {
        **solid((BEAM + 4, 5), cell, (BEAM_DENSITY, BEAM_MODULUS, 0)),
        "bodies": {"beam": body(points, bend, **box)},
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
    rate = timoshenko_rate()
    time, way = motion_of(folder, lambda x: abs(x) < BEAM / 4, 1)
    return abs(rate / fitted_rate(time, way, 0.5 * rate, 1.5 * rate) - 1)


# Problem 3: a layer under water, at rest on a smooth bed or sliding along it.
LAYER, LAYER_DENSITY, WATER = 0.1, 1800.0, 1000.0


def layer(cell: float, points: int, speed: float) -> Tree:
    width, share = 0.05, 1 - WATER / LAYER_DENSITY
    loads = weight(G, 740, speed)
    # Buoyancy takes a share of all of gravity.
    loads["gravity"]["acceleration"][0] /= share
    velocity = {"constant": [speed, 0]}
    return {
        **solid((width + 0.1, LAYER + 0.025), cell, (LAYER_DENSITY, 1e6, 0)),
        "walls": {"bottom": "roller"},
        "bodies": {"layer": body(points, velocity, shape="box", lower=[0.025, 0],
                                 upper=[0.025 + width, LAYER])},
        "effects": {**loads, "buoyancy": {"water_density": WATER}},
    }  # fmt: skip


def layer_error(folder: Path) -> float:
    points = end_of(folder)
    unit_weight = (LAYER_DENSITY - WATER) * G
    exact = -unit_weight * (LAYER - points["position"][:, 1])
    return np.sqrt(np.mean((points["stress_yy"] - exact) ** 2)) / (unit_weight * LAYER)


# Problem 4: a disk of radius 1 under its weight on rigid ground without friction, at rest or sliding.
DISK_MODULUS, DISK_RATIO, DISK_DENSITY, DISK_WEIGHT = 1e6, 0.3, 1e3, 6.0


def disk(cell: float, points: int, speed: float) -> Tree:
    velocity = {"constant": [speed, 0]}
    return {
        **solid((3, 2.25), cell, (DISK_DENSITY, DISK_MODULUS, DISK_RATIO)),
        "walls": {"bottom": "frictional", "bottom_friction": 0},
        "bodies": {"disk": body(points, velocity, shape="ball", centre=[1.125, 1], radius=1)},
        "effects": weight(DISK_WEIGHT, 25, speed),
    }


def disk_error(folder: Path) -> float:
    """Returns the error of the stress up to half the contact's width above the contact (McEwen
    1949), divided by the largest pressure."""
    points = end_of(folder)
    x, z = points["position"][:, 0], points["position"][:, 1]
    x = x - x.mean()
    load = DISK_DENSITY * DISK_WEIGHT * np.pi
    stiffness = DISK_MODULUS / (1 - DISK_RATIO**2)
    half = np.sqrt(4 * load / (np.pi * stiffness))
    pressure = 2 * load / (np.pi * half)
    first = half**2 - x**2 + z**2
    root = np.sqrt(first**2 + 4 * x**2 * z**2)
    m, n2 = np.sqrt((root + first) / 2), (root - first) / 2
    exact = -pressure / half * m * (1 - (z**2 + n2) / (m**2 + n2))
    near = (abs(x) < 2 * half) & (z < half)
    return np.sqrt(np.mean((points["stress_yy"][near] - exact[near]) ** 2)) / pressure


# Problem 5: two disks collide and separate (Sulsky, Chen and Schreyer 1994); both may fly.
def disks(cell: float, points: int, speed: float) -> Tree:
    def moving(at: float, own: float) -> Tree:
        velocity = {"constant": [own + speed / np.sqrt(2)] * 2}
        return body(points, velocity, shape="ball", centre=[at, at], radius=0.2)

    bodies = {"lower": moving(0.3, 0.1), "upper": moving(0.9, -0.1)}
    return {**solid((1.6, 1.6), cell, (1000, 1000, 0.3)), "bodies": bodies}


def disks_error(folder: Path) -> float:
    """Returns the relative change of the energy, without that of the flight of both together."""
    history = history_of(folder)
    flight = (history["momentum_x"] ** 2 + history["momentum_y"] ** 2) / (2 * history["mass"])
    energy = history["kinetic_energy"] + history["strain_energy"] - flight
    return abs(energy[-1] / energy[0] - 1)


PROBLEMS = (
    Problem("wave", bar_error, "way of a half", (2.5, 1.25, 0.625), 10, bar),
    Problem("beam", beam_error, "period", (0.5, 0.25, 0.125), 3 * np.pi / timoshenko_rate(), beam),
    Problem("layer", layer_error, "stress", (0.0125, 0.00625, 0.003125), 0.1, layer),
    Problem("hertz", disk_error, "stress at the contact", (0.125, 0.0625, 0.03125), 0.6, disk),
    Problem("disks", disks_error, "energy", (0.1, 0.05, 0.025), 3, disks),
)
