"""Draws a run as an animation: animate.py FOLDER GIF SCENE

FOLDER has the VTK files of rrcb_mpm, SCENE is the scene file (views.py). Where a penetrator falls, its
depth over time stands beside the section."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from PIL import Image  # noqa: E402

from draw import Frame, Painter, read_frames  # noqa: E402
from views import STEEL, VIEWS, read_fall  # noqa: E402

FRAME_MS, LAST_MS = 80, 2000
NUM_COLOURS = 48


def draw_fall(axes: Axes, folder: Path, now: float) -> None:
    time, tip = read_fall(folder)
    axes.plot(time, tip, color="#999999")
    axes.plot(now, np.interp(now, time, tip), "o", color=STEEL)
    axes.set_xlabel("time, s", fontsize=8)
    axes.set_ylabel("tip, m", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(lw=0.3)


def image_of(painter: Painter, frame: Frame) -> Image.Image:
    """One frame, as large as all others."""
    falls = painter.view.is_mirrored
    width, height = painter.size
    inches = (5.2, 5.6) if falls else (7.0, 6.2 * height / width + 0.9)
    figure = plt.figure(figsize=inches, dpi=150, layout="constrained")
    columns = figure.add_gridspec(1, 2 if falls else 1, width_ratios=[1, 1.4] if falls else [1])
    axes = figure.add_subplot(columns[0])
    painter.draw(axes, frame, 4.6 / height if falls else 5.6 / width)
    if falls:
        draw_fall(figure.add_subplot(columns[1]), painter.folder, frame.time)
    bar = figure.colorbar(painter.shown, ax=axes, extend="max", aspect=18, pad=0.02)
    bar.set_label(painter.view.label, fontsize=8)
    bar.ax.tick_params(labelsize=7)
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    plt.close(figure)
    return image


def animate(folder: Path, picture: Path, scene_file: Path) -> None:
    view = VIEWS[scene_file.stem]
    frames = read_frames(folder, view)
    painter = Painter(frames, view, scene_file.read_text(), folder)
    images = [image_of(painter, frame) for frame in frames]
    palette = images[-1].quantize(NUM_COLOURS)
    shown = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    durations = [FRAME_MS] * (len(shown) - 1) + [LAST_MS]
    shown[0].save(
        picture, save_all=True, append_images=shown[1:], duration=durations, loop=0, optimize=True
    )


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("animate.py FOLDER GIF SCENE")
    animate(*(Path(word) for word in sys.argv[1:]))
