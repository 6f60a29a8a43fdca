"""Draws the start, the middle and the end of a run: draw.py FOLDER PICTURE [SCENE]

FOLDER has the VTK files of rrcb_mpm. SCENE is the scene file, whose name tells how it is shown
(views.py). Without one points are coloured by how far they have moved. In three dimensions the layer
of points at the smallest z is shown."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from views import VIEWS, Moment, View
from vtk_files import arrays_in, frames_of, points_of

POINTS_PER_INCH = 72
SMALLEST_MARKER = 1.5  # printer's points
MARGIN = 0.015  # relative to the larger side
BOX = {"color": "black", "lw": 0.6}
START = {"color": "black", "lw": 0.8, "ls": "--"}


@dataclass(frozen=True)
class Frame:
    time: float
    position: np.ndarray  # rows of x and y of the points shown
    value: np.ndarray  # determines their colours
    spacing: float  # distance of points at the start, m
    boxes: list[tuple[float, float, float, float]]  # left, low, right, high of each rank's box


def with_image(left: float, low: float, right: float, high: float) -> list[tuple]:
    """Returns a box and its mirror image at x = 0, or only the box if it is at x = 0."""
    if left <= 0:
        return [(-right, low, right, high)]
    return [(left, low, right, high), (-right, low, -left, high)]


def read_frame(time: float, point_files: list[Path], box_files: list[Path], view: View) -> Frame:
    points = points_of(point_files)
    position, displacement = points["position"], points["displacement"]
    value = view.value(points)
    start_z = position[:, 2] - displacement[:, 2]
    layer = start_z <= start_z.min() + 1e-9
    volume = np.median(points["volume"])
    spacing = np.cbrt(volume) if np.ptp(start_z) > 0 else np.sqrt(volume)
    shown, value = position[layer, :2], value[layer]
    if view.is_mirrored:
        shown, value = np.concatenate([shown, shown * (-1, 1)]), np.concatenate([value, value])
    arrays = arrays_in(box_files[0])
    corners = arrays["corner"].reshape(arrays["part"].size, -1, 3)[:, :, :2]
    boxes = [(*box.min(axis=0), *box.max(axis=0)) for box in corners]
    if view.is_mirrored:
        boxes = [side for box in boxes for side in with_image(*box)]
    return Frame(time, shown, value, spacing, boxes)


def read_frames(folder: Path, view: View) -> list[Frame]:
    pairs = zip(frames_of(folder, "points"), frames_of(folder, "boxes"))
    return [read_frame(time, points, boxes, view) for (time, points), (_, boxes) in pairs]


def three_of(frames: list[tuple[float, Path]]) -> list[int]:
    """Returns the first frame, the one nearest to half the time, and the last."""
    half = 0.5 * frames[-1][0]
    middle = min(range(len(frames)), key=lambda i: abs(frames[i][0] - half))
    return [0, middle, len(frames) - 1]


def surface_of(frame: Frame) -> tuple[np.ndarray, np.ndarray]:
    """Returns the highest points along x."""
    x, y = frame.position.T
    column = np.round(x / frame.spacing).astype(int)
    tops = np.full(np.ptp(column) + 1, -np.inf)
    np.maximum.at(tops, column - column.min(), y + 0.5 * frame.spacing)
    filled = np.isfinite(tops)
    return (np.arange(tops.size)[filled] + column.min()) * frame.spacing, tops[filled]


class Painter:
    """Draws frames of a run into axes with the same extent and the same scale of colours."""

    def __init__(self, frames: list[Frame], view: View, scene: str, folder: Path):
        self.first, self.view, self.scene, self.folder = frames[0], view, scene, folder
        extent = np.concatenate([frame.position for frame in frames])
        margin = MARGIN * np.ptp(extent, axis=0).max()
        self.low, self.high = extent.min(axis=0) - margin, extent.max(axis=0) + margin
        self.high = self.high + (0, view.space)
        self.most = view.most or max(frame.value.max() for frame in frames) or 1

    @property
    def size(self) -> np.ndarray:
        return self.high - self.low

    def draw(self, axes: Axes, frame: Frame, inches_per_metre: float) -> list[Patch | Line2D]:
        """Draws a frame. Returns what the legend must explain."""
        axes.set_aspect("equal")
        axes.set_xlim(self.low[0], self.high[0])
        axes.set_ylim(self.low[1], self.high[1])
        key = self.view.backdrop(axes, Moment(self.scene, self.folder, frame.time))
        side = self.view.marker * POINTS_PER_INCH * inches_per_metre * self.first.spacing
        side = max(side, SMALLEST_MARKER)
        self.shown = axes.scatter(
            *frame.position.T,
            c=frame.value,
            s=side**2,
            marker="s",
            lw=0,
            vmin=0,
            vmax=self.most,
            cmap=self.view.colours,
        )
        for left, low, right, high in frame.boxes:
            axes.plot([left, right, right, left, left], [low, low, high, high, low], **BOX)
        key.append(Line2D([], [], **BOX, label="box of a rank"))
        if self.view.shows_start:
            axes.plot(*surface_of(self.first), **START)
            key.append(Line2D([], [], **START, label="surface at the start"))
        axes.set_title(f"{frame.time:.3g} s", fontsize=9)
        axes.tick_params(labelsize=7)
        axes.set_xlabel("x [m]", fontsize=8)
        axes.set_ylabel("y [m]", fontsize=8)
        return key

    def finish(self, figure: plt.Figure, panels, key: list[Patch | Line2D]) -> None:
        """Adds the colour bar, and the legend below everything."""
        bar = figure.colorbar(
            self.shown, ax=panels, extend="max" if self.view.most else "neither", aspect=30, pad=0.02
        )
        bar.set_label(self.view.label, fontsize=8)
        bar.ax.tick_params(labelsize=7)
        figure.legend(
            handles=key,
            loc="upper center",
            bbox_to_anchor=(0.5, 0),
            ncols=len(key),
            fontsize=7,
            frameon=False,
        )


def layout_of(size: np.ndarray) -> tuple[bool, tuple[float, float], float]:
    """Returns whether panels are stacked, the size of the figure in inches, and inches per metre.
    """
    is_wide = size[0] > 1.5 * size[1]
    if is_wide:
        across = 6.0
        return True, (7.2, 3 * (across * size[1] / size[0] + 0.45) + 0.35), across / size[0]
    high = min(5.5, 2.2 * size[1] / size[0])
    across = high * size[0] / size[1]
    return False, (3 * (across + 0.55) + 0.9, high + 0.95), high / size[1]


def draw(folder: Path, picture: Path, scene_file: Path | None) -> None:
    view = VIEWS.get(scene_file.stem, View()) if scene_file else View()
    scene = scene_file.read_text() if scene_file else ""
    points, boxes = frames_of(folder, "points"), frames_of(folder, "boxes")
    frames = [read_frame(*points[i], boxes[i][1], view) for i in three_of(points)]
    painter = Painter(frames, view, scene, folder)
    is_wide, inches, inches_per_metre = layout_of(painter.size)
    figure, panels = plt.subplots(
        *((3, 1) if is_wide else (1, 3)),
        figsize=inches,
        layout="constrained",
        sharex=True,
        sharey=True,
    )
    for axes, frame in zip(panels, frames):
        key = painter.draw(axes, frame, inches_per_metre)
        axes.label_outer()
    painter.finish(figure, panels, key)
    figure.savefig(
        picture, dpi=150, bbox_inches="tight", pad_inches=0.05, metadata={"Software": None}
    )
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("draw.py FOLDER PICTURE [SCENE]")
    draw(Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]) if sys.argv[3:] else None)
