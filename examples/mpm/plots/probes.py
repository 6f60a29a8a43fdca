"""Draws displacement, stress and strain of a run's probes over time: probes.py FOLDER PICTURE

FOLDER has the probes.csv of rrcb_mpm. Components that stay 0, but for
round-off, are left out."""

from __future__ import annotations

import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

PANELS = [
    ("displacement", "displacement, m", ["x", "y", "z"]),
    ("stress", "stress, Pa (tension positive)", ["xx", "yy", "zz", "xy", "yz", "zx"]),
    ("strain", "strain", ["xx", "yy", "zz", "xy", "yz", "zx"]),
]
ROUND_OFF = 1e-9
STYLES = ["-", "--", ":", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 3))]


def read_probes(path: Path) -> dict[str, dict[str, np.ndarray]]:
    """Columns of each probe, in the order of the file."""
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
    figure, panels = plt.subplots(3, 1, figsize=(7, 8), sharex=True, layout="constrained")
    for axes, (prefix, label, components) in zip(panels, PANELS):
        largest = max(
            np.abs(columns[f"{prefix}_{component}"]).max()
            for columns in probes.values()
            for component in components
        )
        for number, (name, columns) in enumerate(probes.items()):
            for style, component in zip(STYLES, components):
                values = columns[f"{prefix}_{component}"]
                if np.abs(values).max() > ROUND_OFF * largest:
                    axes.plot(
                        columns["time"],
                        values,
                        color=f"C{number}",
                        ls=style,
                        lw=1,
                        label=f"{name}, {component}",
                    )
        axes.set_ylabel(label)
        axes.grid(lw=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=7, ncols=2)
    panels[-1].set_xlabel("time, s")
    panels[-1].set_xlim(left=0)
    figure.savefig(picture, dpi=150, metadata={"Software": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("probes.py FOLDER PICTURE")
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
