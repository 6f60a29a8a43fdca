"""Draws the sway of the frame beside that of beams: sway.py FOLDER PICTURE SCENE

FOLDER has the probes.csv of a run of elastic_structure, SCENE is its scene file. Prints the periods."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

from beams import Portal, Section  # noqa: E402
from probes import read_probes  # noqa: E402
from scene_text import NUMBER, number_in  # noqa: E402


def boxes_in(scene: str) -> np.ndarray:
    """Left, low, right and high side of each box."""
    number = rf"({NUMBER})"
    box = rf"shape: box\n +lower: \[{number}, {number}\]\n +upper: \[{number}, {number}\]"
    return np.array(re.findall(box, scene), dtype=float)


def portal_in(scene: str) -> Portal:
    boxes = boxes_in(scene)
    across, up = boxes[:, 2] - boxes[:, 0], boxes[:, 3] - boxes[:, 1]
    columns, beam = boxes[across < up], boxes[across > up][0]
    modulus, ratio = number_in(scene, "youngs_modulus"), number_in(scene, "poissons_ratio")
    section = Section(
        modulus / (1 - ratio**2),
        modulus / (2 * (1 + ratio)),
        number_in(scene, "density"),
        across.min(),
    )
    centres = 0.5 * (columns[:, 0] + columns[:, 2])
    return Portal(section, np.ptp(centres), 0.5 * (beam[1] + beam[3]))


def speed_in(scene: str):
    """Speed along x by height, as the scene writes it: FACTOR * sin(pi * y / LENGTH)^2."""
    factor, length = re.search(rf"({NUMBER}) \* sin\(pi \* y / ({NUMBER})\)\^2", scene).groups()
    return lambda y: float(factor) * np.sin(np.pi * y / float(length)) ** 2


def period_of(time: np.ndarray, sway: np.ndarray) -> float:
    """Mean, between the first and the last upward zero."""
    up = np.flatnonzero((sway[:-1] < 0) & (sway[1:] >= 0))
    zeros = time[up] - sway[up] * (time[up + 1] - time[up]) / (sway[up + 1] - sway[up])
    return (zeros[-1] - zeros[0]) / (len(zeros) - 1)


def draw(folder: Path, picture: Path, scene: str) -> None:
    probe = next(iter(read_probes(folder / "probes.csv").values()))
    time, sway = probe["time"], probe["displacement_x"]
    theory = portal_in(scene).sway(speed_in(scene), time)
    figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
    for values, style, name in ((sway, "-", "simulation"), (theory, "--", "beam theory")):
        period = period_of(time, values)
        axes.plot(time, values, style, lw=1.2, label=f"{name}, {1 / period:.3f} Hz")
        print(f"{name}: period {period:.3f} s, largest sway {np.abs(values).max():.4f} m")
    axes.set_xlabel("time, s")
    axes.set_ylabel("sway of the beam, m")
    axes.set_xlim(0, time[-1])
    axes.grid(lw=0.3)
    axes.legend(fontsize=8, ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1), frameon=False)
    figure.savefig(
        picture, dpi=150, bbox_inches="tight", pad_inches=0.05, metadata={"Software": None}
    )


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("sway.py FOLDER PICTURE SCENE")
    draw(Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]).read_text())
