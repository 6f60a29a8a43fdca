"""Draws the start, the middle and the end of a run: draw.py FOLDER PICTURE

FOLDER has the VTK files of rrcb_mpm. Points are coloured by how far they have moved; lines are the
boxes of the ranks. In three dimensions the layer of points at the smallest z is shown."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

from vtk_files import arrays_in, frames_of, points_of  # noqa: E402


def points_in(path: Path) -> tuple[np.ndarray, np.ndarray, float]:
    """Positions and distances moved of the points of all ranks, and how far points are apart."""
    points = points_of(path)
    position, displacement = points["position"], points["displacement"]
    moved = np.linalg.norm(displacement, axis=1)
    start_z = position[:, 2] - displacement[:, 2]
    layer = start_z <= start_z.min() + 1e-9
    volume = np.median(points["volume"])
    spacing = np.cbrt(volume) if np.ptp(start_z) > 0 else np.sqrt(volume)
    return position[layer], moved[layer], spacing


def three_of(frames: list[tuple[float, Path]]) -> list[int]:
    """The first, the one nearest to half the time, and the last."""
    half = 0.5 * frames[-1][0]
    middle = min(range(len(frames)), key=lambda i: abs(frames[i][0] - half))
    return [0, middle, len(frames) - 1]


def draw_boxes(axes: plt.Axes, path: Path) -> None:
    arrays = arrays_in(path)
    corners = arrays["corner"].reshape(arrays["part"].size, -1, 3)
    for box in corners:
        (left, low), (right, high) = box[:, :2].min(axis=0), box[:, :2].max(axis=0)
        axes.plot(
            [left, right, right, left, left], [low, low, high, high, low], color="black", lw=0.6
        )


def size_of(width: float, height: float, is_wide: bool) -> tuple[float, float]:
    """Inches of three panels, below one another or side by side, and a bar of colours."""
    if is_wide:
        least_height = 3.5  # room for the labels of three flat panels
        return 7, max(17 * height / width + 1, least_height)
    across = min(2.5, 7 * width / height)
    return 3 * (across + 0.4) + 1.3, across * height / width + 1


def draw(folder: Path, picture: Path) -> None:
    points, boxes = frames_of(folder, "points"), frames_of(folder, "boxes")
    chosen = [(points[i][0], *points_in(points[i][1]), boxes[i][1]) for i in three_of(points)]
    farthest = max(moved.max() for _, _, moved, _, _ in chosen)
    extent = np.concatenate([position for _, position, _, _, _ in chosen])[:, :2]
    width, height = np.ptp(extent, axis=0)
    is_wide = width > 1.5 * height
    figure, panels = plt.subplots(
        3 if is_wide else 1,
        1 if is_wide else 3,
        figsize=size_of(width, height, is_wide),
        layout="constrained",
        squeeze=False,
    )
    margin = 0.03 * max(width, height)
    inches_per_metre = (5.6 if is_wide else 2.2) / (width + 2 * margin)
    for axes, (time, position, moved, spacing, box_file) in zip(panels.flat, chosen):
        draw_boxes(axes, box_file)
        side = 1.25 * 72 * inches_per_metre * spacing
        shown = axes.scatter(
            *position[:, :2].T, c=moved, s=side**2, marker="s", lw=0, vmin=0, vmax=farthest or 1
        )
        axes.set_title(f"{time:.3g} s", fontsize=9)
        axes.set_aspect("equal")
        axes.set_xlim(extent[:, 0].min() - margin, extent[:, 0].max() + margin)
        axes.set_ylim(extent[:, 1].min() - margin, extent[:, 1].max() + margin)
        axes.tick_params(labelsize=7)
    figure.colorbar(shown, ax=panels, label="moved, m", shrink=0.8)
    figure.savefig(picture, dpi=80, metadata={"Software": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("draw.py FOLDER PICTURE")
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
