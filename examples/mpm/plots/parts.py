"""Draws the start, the middle and the end of a run in three dimensions, coloured by rank: parts.py FOLDER
PICTURE

FOLDER has the VTK files of rrcb_mpm. Every rank has a colour of its own; y points up."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib import colormaps
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from draw import three_of
from vtk_files import frames_of, history_of, points_of

COLOURS = colormaps["tab10"].colors
VIEW = {"elev": 28, "azim": 35}


def draw_frame(axes: Axes, position: np.ndarray, part: np.ndarray, high: np.ndarray) -> None:
    # Matplotlib's third axis points up.
    x, up, z = position.T
    axes.scatter(x, z, up, c=np.take(COLOURS, part % len(COLOURS), axis=0), s=1.2, lw=0, alpha=1)
    axes.set_xlim(0, high[0])
    axes.set_ylim(0, high[2])
    axes.set_zlim(0, high[1])
    axes.set_box_aspect([high[0], high[2], high[1]], zoom=1.05)
    axes.view_init(**VIEW)
    axes.patch.set_alpha(0)
    axes.tick_params(labelsize=6, pad=-3)
    axes.set_xlabel("x [m]", fontsize=7, labelpad=-6)
    axes.set_ylabel("z [m]", fontsize=7, labelpad=-6)
    axes.set_zlabel("y [m]", fontsize=7, labelpad=-8)


def draw(folder: Path, picture: Path) -> None:
    frames = frames_of(folder, "points")
    shown = [(frames[i][0], points_of(frames[i][1])) for i in three_of(frames)]
    high = np.max([points["position"].max(axis=0) for _, points in shown], axis=0)
    history = history_of(folder)
    figure, panels = plt.subplots(
        1, 3, figsize=(10, 3.3), layout="constrained", subplot_kw={"projection": "3d"}
    )
    for axes, (time, points) in zip(panels, shown):
        draw_frame(axes, points["position"], points["part"], high)
        row = np.argmin(abs(history["time"] - time))
        axes.set_title(f"{time:.2f} s, imbalance {history['imbalance'][row]:.2f}", fontsize=8, y=0.92)
    parts = np.unique(shown[-1][1]["part"])
    keys = [
        Line2D([], [], ls="", marker="o", color=COLOURS[part % len(COLOURS)], label=f"rank {part}")
        for part in parts
    ]
    figure.legend(
        handles=keys, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=len(keys), fontsize=7,
        frameon=False,
    )  # fmt: skip
    figure.savefig(
        picture, dpi=120, bbox_inches="tight", pad_inches=0.05, metadata={"Software": None}
    )
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("parts.py FOLDER PICTURE")
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
