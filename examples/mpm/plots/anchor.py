"""Depth of the torpedo anchor beside its equation of motion:
anchor.py PROGRAM SCENE PICTURE [--by-cells]

Pushes the anchor into the clay at constant speeds, from which follow the bearing capacity factor,
the adhesion factor, the factor of rate, the drag of the clay and its added mass as this method has
them; integrates the equation of motion with them (Runge and Kutta's fourth order); and sets the
anchor that falls freely beside it, as Markdown tables and a picture. --by-cells in place of all that:
the forces on tip and side of an anchor that is pushed at the speed of the fall, by cell size."""

from __future__ import annotations

import csv
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

from scene_text import number_in  # noqa: E402

GRAVITY = 9.81
SLOW, DEEPEST, WINDOW = 5, 10, 0.25  # m/s, m, m
SLOWING = 1.5 * GRAVITY
DEPTHS = np.arange(0, DEEPEST - WINDOW, 0.05)
SHOWN = np.array([2.0, 4.0, 6.0, 8.0])  # m
CELL_SIZES = [0.25, 1 / 6, 0.125, 0.1]  # m, --by-cells
PUSHED = {"mass": 1e12, "weight_share": 0, "fluid_density": None}
NO_RATE = {"rate_factor": None, "reference_rate": None}
SMOOTH = {"friction": 0, "adhesion_factor": None}


def with_keys(scene: str, keys: dict) -> str:
    """The text of a scene with some numbers in it replaced, left out (None) or given to the
    penetrator."""
    for key, value in keys.items():
        line = re.compile(rf"^( +){key}: .*\n", re.M)
        if value is None or line.search(scene):
            scene = line.sub("" if value is None else rf"\g<1>{key}: {value}\n", scene)
        else:
            scene = scene.replace("    penetrator:\n", f"    penetrator:\n      {key}: {value}\n")
    return scene + "  output:\n    history_every: 1\n"


@dataclass
class Fall:
    time: np.ndarray
    depth: np.ndarray
    speed: np.ndarray  # downwards
    force: np.ndarray

    def arrest(self) -> tuple[float, float]:
        last = int(np.argmax(self.speed <= 0)) or len(self.speed) - 1
        return self.depth[last], self.time[last]

    def forces_at(self, depths: np.ndarray) -> np.ndarray:
        """Mean force over a window of depth around each; nan where it did not get to."""
        sinks = np.diff(self.depth, prepend=-np.inf) > 0
        impulse = np.cumsum(self.force * np.diff(self.time, prepend=self.time[0]))
        ends = [
            np.interp(depths + side, self.depth[sinks], self.time[sinks])
            for side in (-WINDOW, WINDOW)
        ]
        gained = np.interp(ends[1], self.time, impulse) - np.interp(ends[0], self.time, impulse)
        took = ends[1] - ends[0]
        return np.divide(gained, took, out=np.full_like(gained, np.nan), where=took > 0)


def simulate(program: str, scene: str, keys: dict, cell_size: float | None = None) -> Fall:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "anchor.yaml"
        file.write_text(with_keys(scene, keys))
        options = [f"--scene={file}", f"--out={folder}", "--balancer=none"]
        options += [f"--cell-size={cell_size}"] if cell_size else []
        done = subprocess.run([program, *options], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        with open(Path(folder) / "history.csv", newline="") as rows:
            table = list(csv.DictReader(rows))
    names = ["time", "penetrator_tip_y", "penetrator_velocity", "penetrator_force"]
    time, tip, velocity, force = (np.array([float(row[name]) for row in table]) for name in names)
    return Fall(time, -tip, -velocity, force)


class Anchor:
    """What a scene says of the anchor and the clay."""

    def __init__(self, scene: str):
        number = lambda key: number_in(scene, key)  # noqa: E731
        self.mass, self.speed = number("mass"), -number("velocity")
        self.radius, self.cone, self.length = (
            number("radius"),
            number("cone_height"),
            number("length"),
        )
        self.density, self.strength = number("density"), number("strength")
        self.water = number("fluid_density")
        self.gradient = number("strength_gradient")
        self.rate_factor, self.reference_rate = number("rate_factor"), number("reference_rate")
        self.start = -float(re.search(r"tip: \[[^,]+, ([^,]+),", scene)[1])
        self.section = np.pi * self.radius**2 / 4

    def weight(self) -> float:
        """In water, which is above the clay and in the hole, too."""
        volume = self.section * (self.length - 2 * self.cone / 3)
        return (self.mass - self.water * volume) * GRAVITY

    def buoyancy(self, depth):
        """What the clay that the anchor and the hole above it take the place of weighs in water."""
        in_cone = np.clip(depth, 0, self.cone)
        volume = in_cone**3 / self.cone**2 / 3 + np.clip(depth - self.cone, 0, None)
        return (self.density - self.water) * GRAVITY * self.section * volume

    def strength_at_cone(self, depth):
        return self.strength + self.gradient * np.clip(depth - self.cone / 2, 0, None)

    def strength_on_side(self, depth):
        """Strength times area of side and cone."""
        below = np.linspace(0, 1, 201)[None, :] * np.minimum(depth, self.length)[:, None]
        level = depth[:, None] - below
        width = np.pi / 2 * self.radius * np.minimum(below / self.cone, 1)
        stress = width * (self.strength + self.gradient * level)
        return np.sum(0.5 * (stress[:, 1:] + stress[:, :-1]) * np.diff(below), axis=1)

    def log_rate(self, speed: float) -> float:
        rate = speed / (2 * self.radius) / self.reference_rate
        return self.rate_factor * np.log10(max(rate, 1))


@dataclass
class Measured:
    resistance: np.ndarray  # slow, by depth, without buoyancy, N
    drag: np.ndarray  # by depth, N / (m/s)^2
    rate_share: float  # of the gain at a rate of speed / diameter
    added_mass: float  # kg


def measure(anchor: Anchor, pushes: dict[str, Fall]) -> Measured:
    slow, fast = (pushes[name].forces_at(DEPTHS) for name in ("slow", "fast"))
    drag = (fast - slow) / (anchor.speed**2 - SLOW**2)
    resistance = slow - drag * SLOW**2 - anchor.buoyancy(DEPTHS)
    deep = DEPTHS > anchor.cone
    gain = np.mean((pushes["fast, rate"].forces_at(DEPTHS) - fast)[deep])
    rate_share = gain / np.mean(resistance[deep]) / anchor.log_rate(anchor.speed)
    slowed = pushes["slowed"]
    end = int(np.argmax(slowed.depth))
    speed = np.interp(DEPTHS, slowed.depth[:end], slowed.speed[:end])
    steady = resistance + anchor.buoyancy(DEPTHS) + drag * speed**2
    fits = deep & (speed > 0.4 * anchor.speed)
    added_mass = np.mean((steady - slowed.forces_at(DEPTHS))[fits]) / SLOWING
    return Measured(resistance, drag, rate_share, added_mass)


def integrate(anchor: Anchor, measured: Measured) -> Fall:
    def acceleration(depth: float, speed: float) -> float:
        resistance = np.interp(depth, DEPTHS, measured.resistance)
        rate = 1 + measured.rate_share * anchor.log_rate(speed)
        drag = np.interp(depth, DEPTHS, measured.drag) * speed**2
        if depth < 0:
            resistance = drag = 0
        inertia = anchor.mass + measured.added_mass * np.clip(depth / anchor.cone, 0, 1)
        force = anchor.weight() - anchor.buoyancy(depth) - rate * resistance - drag
        return force / inertia

    step, states = 5e-4, [np.array([anchor.start, anchor.speed])]
    slope = lambda state: np.array([state[1], acceleration(*state)])  # noqa: E731
    while states[-1][1] > 0:
        state = states[-1]
        first = slope(state)
        second = slope(state + step / 2 * first)
        third = slope(state + step / 2 * second)
        fourth = slope(state + step * third)
        states.append(state + step / 6 * (first + 2 * second + 2 * third + fourth))
    depth, speed = np.array(states).T
    return Fall(step * np.arange(len(depth)), depth, speed, np.zeros_like(depth))


def print_constants(anchor: Anchor, measured: Measured, smooth: np.ndarray) -> None:
    bearing = smooth - anchor.buoyancy(DEPTHS) - measured.drag * SLOW**2
    factor = bearing / (anchor.section * anchor.strength_at_cone(DEPTHS))
    side = (measured.resistance - bearing)[1:] / anchor.strength_on_side(DEPTHS)[1:]
    drag = measured.drag / (0.5 * anchor.density * anchor.section)
    print("| depth, m | Nc | alpha | Cd |\n|---|---|---|---|")
    for depth in SHOWN:
        i = int(np.argmin(abs(DEPTHS - depth)))
        print(f"| {depth:g} | {factor[i]:.1f} | {side[i - 1]:.2f} | {drag[i]:.2f} |")
    print(f"\nrate factor: {measured.rate_share:.2f} of the gain at speed / diameter")
    print(f"added mass: {measured.added_mass:.0f} kg\n")


def draw(runs: dict[str, Fall], other_cells: dict[str, Fall], picture: str) -> None:
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    styles = [{"lw": 1.5}, {"ls": "--"}, {"ls": ":"}]
    greys = [{"color": str(0.75 - 0.2 * i), "lw": 0.9} for i in range(len(other_cells))]
    for (name, run), style in zip((runs | other_cells).items(), styles + greys):
        last = int(np.argmax(run.speed <= 0)) or len(run.speed)
        panels[0].plot(run.time[:last], -run.depth[:last], **style, label=name)
        panels[1].plot(run.time[:last], run.speed[:last], **style, label=name)
    panels[0].set(xlabel="time, s", ylabel="tip, m")
    panels[1].set(xlabel="time, s", ylabel="speed, m/s")
    for axes in panels:
        axes.grid(lw=0.3)
    panels[0].legend(fontsize=7, frameon=False)
    figure.savefig(
        picture, dpi=150, bbox_inches="tight", pad_inches=0.05, metadata={"Software": None}
    )


def print_by_cells(program: str, scene: str) -> None:
    """The push without friction has the force on the tip, what friction adds is the side's."""
    push = PUSHED | {"end_time": DEEPEST / Anchor(scene).speed}
    plan = [(push | keys, size) for size in CELL_SIZES for keys in (SMOOTH, {})]
    with ThreadPoolExecutor(2) as pool:
        runs = pool.map(lambda run: simulate(program, scene, *run).forces_at(SHOWN), plan)
        forces = [run / 1000 for run in runs]
    shown = ", ".join(f"{depth:g}" for depth in SHOWN)
    print(f"| cells, m | tip at {shown} m, kN | side, kN |\n|---|---|---|")
    for size, smooth, rough in zip(CELL_SIZES, forces[::2], forces[1::2]):
        tip, side = (", ".join(f"{force:.1f}" for force in all) for all in (smooth, rough - smooth))
        print(f"| {size:.3g} | {tip} | {side} |")


def main(program: str, scene_file: str, picture: str) -> None:
    scene = Path(scene_file).read_text()
    anchor = Anchor(scene)
    slow = PUSHED | NO_RATE | {"velocity": -SLOW, "end_time": DEEPEST / SLOW}
    fast = PUSHED | {"end_time": DEEPEST / anchor.speed}
    slowed = {"weight_share": -SLOWING / GRAVITY, "end_time": anchor.speed / SLOWING}
    plan = {
        "slow": (slow,),
        "smooth": (slow | SMOOTH,),
        "fast": (fast | NO_RATE,),
        "fast, rate": (fast,),
        "slowed": (PUSHED | NO_RATE | slowed,),
        "as shipped": ({},),
        "2.33 m wide": ({"cells": "[14, 81, 14]"},),
        "cells of 0.25 m": ({}, 0.25),
        "cells of 0.2 m": ({}, 0.2),
        "cells of 0.125 m": ({}, 0.125),
    }
    with ThreadPoolExecutor(2) as pool:
        done = dict(zip(plan, pool.map(lambda run: simulate(program, scene, *run), plan.values())))
    measured = measure(anchor, done)
    print_constants(anchor, measured, done["smooth"].forces_at(DEPTHS))
    at_diameter = Measured(measured.resistance, measured.drag, 1, measured.added_mass)
    runs = {
        "simulation": done["as shipped"],
        "equation, all measured": integrate(anchor, measured),
        "equation, rate at speed / diameter": integrate(anchor, at_diameter),
    }
    others = {name: done[name] for name in list(plan)[6:]}
    print("| | depth, m | at rest after, s |\n|---|---|---|")
    for name, run in (runs | others).items():
        print("| {} | {:.2f} | {:.2f} |".format(name, *run.arrest()))
    draw(runs, {name: run for name, run in others.items() if name.startswith("cells")}, picture)


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--by-cells"]
    if len(words) != 3:
        sys.exit("anchor.py PROGRAM SCENE PICTURE [--by-cells]")
    if len(words) == len(sys.argv) - 1:
        main(*words)
    else:
        print_by_cells(words[0], Path(words[1]).read_text())
