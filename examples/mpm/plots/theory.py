"""Draws a run beside its theory: theory.py FOLDER PICTURE SCENE

FOLDER has history.csv and the VTK files of rrcb_mpm; SCENE is the scene file, whose name is a key of
DRAWINGS."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from scene_text import list_in, number_in
from vtk_files import frames_of, history_of, points_of

G = 9.81


def compare(axes: Axes, at: np.ndarray, got: np.ndarray, theory: np.ndarray, name: str) -> None:
    """Draws points of a run and a line of theory. The legend has their largest difference, divided
    by the range of the line."""
    order = np.argsort(at)
    line = axes.plot(at[order], theory[order], lw=1, label=f"{name}, theory")[0]
    difference = np.abs(got - theory).max() / np.ptp(theory)
    shown = order[:: max(1, order.size // 400)]
    axes.plot(
        at[shown], got[shown], ".", ms=3, color=line.get_color(),
        label=f"{name}, within {100 * difference:.2g} % of the range",
    )  # fmt: skip


def hydrostatic_column(axes: Axes, folder: Path, scene: str) -> None:
    points = points_of(frames_of(folder, "points")[-1][1])
    y = points["position"][:, 1]
    depth = list_in(scene, "upper")[1] - y
    weight = number_in(scene, "density") * G / 1e3
    compare(axes, depth, points["stress_yy"] / 1e3, -weight * depth, "vertical")
    axes.plot(depth, points["stress_xx"] / 1e3, ".", ms=3, color="C1", label="horizontal")
    axes.axhline(0, lw=1, color="C1", label="horizontal, theory")
    axes.set(xlabel="depth [m]", ylabel="stress [kPa], tension positive")


def axial_bar(axes: Axes, folder: Path, scene: str) -> None:
    modulus, density = number_in(scene, "youngs_modulus"), number_in(scene, "density")
    speed, wave_number = list_in(scene, "sine_amplitude")[0], list_in(scene, "sine_wave_number")[0]
    wave_speed = np.sqrt(modulus / density)
    frames = frames_of(folder, "points")
    for share in (0.25, 0.75):
        wanted = share * 2 * np.pi / (wave_number * wave_speed)
        time, files = min(frames, key=lambda frame: abs(frame[0] - wanted))
        points = points_of(files)
        start = points["position"][:, 0] - points["displacement"][:, 0]
        phase = np.sin(wave_number * wave_speed * time)
        theory = modulus * speed / wave_speed * np.cos(wave_number * start) * phase
        compare(axes, start, points["stress_xx"], theory, f"{time:.3g} s")
    axes.set(xlabel="x at the start [m]", ylabel="stress [Pa], tension positive")


def incline_block(axes: Axes, folder: Path, scene: str) -> None:
    sine, cosine = list_in(scene, "normal")
    pull = G * (sine - number_in(scene, "friction") * cosine)
    ramp = number_in(scene, "ramp")
    history = history_of(folder)
    time = history["time"]
    way = (history["center_x"] - history["center_x"][0]) * cosine
    way -= (history["center_y"] - history["center_y"][0]) * sine
    late = np.maximum(time, ramp)
    theory = pull * np.where(
        time < ramp, time**3 / (6 * ramp), late**2 / 2 - ramp * late / 2 + ramp**2 / 6
    )
    compare(axes, time, way, theory, "way along the plane")
    axes.set(xlabel="time [s]", ylabel="way [m]")


DRAWINGS = {
    drawing.__name__: drawing
    for drawing in (hydrostatic_column, axial_bar, incline_block)
}


def draw(folder: Path, picture: Path, scene_file: Path) -> None:
    figure, axes = plt.subplots(figsize=(6, 3.6), layout="constrained")
    DRAWINGS[scene_file.stem](axes, folder, scene_file.read_text())
    axes.grid(lw=0.3)
    axes.legend(fontsize=8)
    figure.savefig(picture, dpi=150, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("theory.py FOLDER PICTURE SCENE")
    draw(*(Path(word) for word in sys.argv[1:]))
