"""Draws way and stress of a run's probes over time, a line for each: probes.py FOLDER PICTURE

FOLDER has the probes.csv of rrcb_mpm."""

from __future__ import annotations

import csv
import sys
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

PANELS: list[tuple[str, Callable]] = [
    ("way [m]", lambda probe: np.hypot(probe["displacement_x"], probe["displacement_y"])),
    ("vertical stress [kPa]\n(tension positive)", lambda probe: probe["stress_yy"] / 1e3),
    (
        "mean stress [kPa]\n(tension positive)",
        lambda probe: sum(probe[f"stress_{axis}"] for axis in ("xx", "yy", "zz")) / 3e3,
    ),
]


def read_probes(path: Path) -> dict[str, dict[str, np.ndarray]]:
    """Returns the columns of each probe, in the order of the file."""
    columns: dict[str, dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            name = row.pop("probe")
            for column, value in row.items():
                columns[name][column].append(float(value))
    return {
        name: {column: np.array(values) for column, values in of_probe.items()}
        for name, of_probe in columns.items()
    }


def draw(folder: Path, picture: Path) -> None:
    probes = read_probes(folder / "probes.csv")
    figure, panels = plt.subplots(3, 1, figsize=(7, 6.5), sharex=True, layout="constrained")
    for axes, (label, value) in zip(panels, PANELS):
        for name, columns in probes.items():
            axes.plot(columns["time"], value(columns), lw=1, label=name.replace("_", " "))
        axes.set_ylabel(label)
        axes.grid(lw=0.3)
    panels[0].legend(fontsize=8, ncols=len(probes))
    panels[-1].set_xlabel("time [s]")
    panels[-1].set_xlim(left=0)
    figure.savefig(picture, dpi=150, metadata={"Software": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("probes.py FOLDER PICTURE")
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
