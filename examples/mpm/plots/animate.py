"""Draws a run as an animation: animate.py FOLDER GIF SCENE [FIXED]

FOLDER has the VTK files of rrcb_mpm, SCENE is the scene file (views.py). Where a penetrator falls, its
depth over time stands beside the section. FIXED has the same run with `--balancer=none`, drawn below,
with the imbalance of both over time and marks where boxes have moved."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from PIL import Image

from draw import Frame, Painter, read_frames
from views import STEEL, VIEWS
from vtk_files import history_of

FRAME_MS, LAST_MS = 80, 2000
NUM_COLOURS = 48


def draw_fall(axes: Axes, folder: Path, now: float) -> None:
    history = history_of(folder)
    time, tip = history["time"], history["penetrator_tip_y"]
    axes.plot(time, tip, color="#999999")
    axes.plot(now, np.interp(now, time, tip), "o", color=STEEL)
    axes.set_xlabel("time [s]", fontsize=8)
    axes.set_ylabel("tip [m]", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(lw=0.3)


def draw_imbalance(axes: Axes, painters: list[Painter], frames: list[Frame], now: float) -> None:
    moved = [b.time for a, b in zip(frames, frames[1:]) if a.boxes != b.boxes]
    axes.vlines(moved, 0, 0.1, transform=axes.get_xaxis_transform(), color="C0", lw=0.8)
    for painter, name in zip(painters, ("rebalanced (marks)", "never rebalanced")):
        history = history_of(painter.folder)
        time, imbalance = history["time"][1:], history["imbalance"][1:]
        line = axes.plot(time, imbalance, lw=1, label=name)[0]
        axes.plot(now, np.interp(now, time, imbalance), "o", ms=4, color=line.get_color())
    axes.set_xlabel("time [s]", fontsize=8)
    axes.set_ylabel("most / mean\npoints of ranks", fontsize=8)
    axes.set_ylim(bottom=0.9)
    axes.tick_params(labelsize=7)
    axes.legend(fontsize=7, loc="center right")
    axes.grid(lw=0.3)


def rendered(figure: plt.Figure) -> Image.Image:
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    plt.close(figure)
    return image


def add_bar(figure: plt.Figure, painter: Painter, axes: list[Axes]) -> None:
    bar = figure.colorbar(painter.shown, ax=axes, extend="max", aspect=18, pad=0.02)
    bar.set_label(painter.view.label, fontsize=8)
    bar.ax.tick_params(labelsize=7)


def image_of_fall(painter: Painter, frame: Frame) -> Image.Image:
    figure = plt.figure(figsize=(5.2, 5.6), dpi=150, layout="constrained")
    columns = figure.add_gridspec(1, 2, width_ratios=[1, 1.4])
    axes = figure.add_subplot(columns[0])
    painter.draw(axes, frame, 4.6 / painter.size[1])
    draw_fall(figure.add_subplot(columns[1]), painter.folder, frame.time)
    add_bar(figure, painter, [axes])
    return rendered(figure)


def image_of_both(
    painters: list[Painter], shown: tuple[Frame, Frame], frames: list[Frame]
) -> Image.Image:
    """Draws the run, and below it the run without rebalancing."""
    width, height = painters[0].size
    section = 5.6 * height / width
    figure, panels = plt.subplots(
        3, 1, figsize=(6.6, 2 * section + 2.4), dpi=120, layout="constrained",
        height_ratios=[section, section, 1.1],
    )  # fmt: skip
    for axes, painter, frame, name in zip(panels, painters, shown, ("rrcb", "none")):
        painter.draw(axes, frame, 5.4 / width)
        axes.set_title(f"{name}, {frame.time:.1f} s", fontsize=9)
        axes.set_xlabel("")
    add_bar(figure, painters[0], list(panels[:2]))
    draw_imbalance(panels[2], painters, frames, shown[0].time)
    return rendered(figure)


def animate(folder: Path, picture: Path, scene_file: Path, fixed: Path | None) -> None:
    view, scene = VIEWS[scene_file.stem], scene_file.read_text()
    frames = read_frames(folder, view)
    painter = Painter(frames, view, scene, folder)
    if fixed:
        beside = read_frames(fixed, view)
        painters = [painter, Painter(beside, view, scene, fixed)]
        images = [image_of_both(painters, both, frames) for both in zip(frames, beside)]
    else:
        images = [image_of_fall(painter, frame) for frame in frames]
    palette = images[-1].quantize(NUM_COLOURS)
    shown = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    durations = [FRAME_MS] * (len(shown) - 1) + [LAST_MS]
    shown[0].save(
        picture, save_all=True, append_images=shown[1:], duration=durations, loop=0, optimize=True
    )


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit("animate.py FOLDER GIF SCENE [FIXED]")
    folder, picture, scene_file, *fixed = (Path(word) for word in sys.argv[1:])
    animate(folder, picture, scene_file, fixed[0] if fixed else None)
