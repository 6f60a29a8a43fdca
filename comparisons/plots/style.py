"""One look for all pictures: colours, lines, axes, and labels that keep clear of each other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.text import Annotation  # noqa: E402
from matplotlib.transforms import Bbox  # noqa: E402

# K. L. Kelly: Twenty-two colors of maximum contrast (1965), without white and black.
PART_COLOURS = (
    "#0067A5 #F3C300 #BE0032 #8DB600 #875692 #F38400 #A1CAF1 #882D17 #008856 #E68FAC "
    "#604E97 #DCD300 #654522 #F99379 #2B3D26 #C2B280 #B3446C #F6A600 #848482 #E25822"
).split()


MAX_POINTS = 60_000


@dataclass(frozen=True)
class MethodStyle:
    colour: str
    line: str
    marker: str


# M. Okabe and K. Ito: Color universal design (2008); the line style and the marker tell the
# methods apart without the colour.
_METHODS = {
    "none": MethodStyle("#888888", (0, (1, 1)), "x"),
    "zoltan-rcb": MethodStyle("#000000", "--", "s"),
    "zoltan-rib": MethodStyle("#CC79A7", (0, (5, 1, 1, 1)), "P"),
    "zoltan-hsfc": MethodStyle("#E69F00", (0, (3, 1, 1, 1, 1, 1)), "X"),
    "zoltan2-mj": MethodStyle("#B8A900", (0, (6, 2)), "p"),
    "root-rcb": MethodStyle("#009E73", "-.", "D"),
    "rrcb-sampled": MethodStyle("#D55E00", ":", "^"),
    "rrcb": MethodStyle("#0072B2", "-", "o"),
    "rrcb-exact": MethodStyle("#56B4E9", (0, (4, 1)), "v"),
}


def method_style(method: str) -> MethodStyle:
    return _METHODS.get(method.split("[")[0], MethodStyle("#444444", "-", "h"))


def part_colours(parts: np.ndarray) -> np.ndarray:
    return np.array(PART_COLOURS)[parts.astype(int) % len(PART_COLOURS)]


def use_style() -> None:
    plt.rcParams.update(
        {
            "font.size": 9,
            "axes.titlesize": 10,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": False,
            "grid.color": "#DDDDDD",
            "grid.linewidth": 0.6,
            "lines.linewidth": 1.4,
            "legend.frameon": False,
            "figure.constrained_layout.use": True,
            "savefig.dpi": 150,
        }
    )


def save(figure: Figure, path: Path) -> None:
    figure.savefig(path)
    plt.close(figure)


def show_lengths(axes: Axes, x_label: bool = True, y_label: bool = True) -> None:
    """Equal scales on both axes, in metres."""
    axes.set_aspect("equal")
    axes.margins(0.02)
    if x_label:
        axes.set_xlabel("x [m]")
    if y_label:
        axes.set_ylabel("y [m]")


def length_ratio(clouds: Iterable[dict[str, np.ndarray]]) -> float:
    """Height over width of panels that show every cloud, within what a picture can hold."""
    clouds = list(clouds)
    width, height = (
        max(cloud[axis].max() for cloud in clouds) - min(cloud[axis].min() for cloud in clouds)
        for axis in "xy"
    )
    return float(np.clip(height / max(width, 1e-300), 0.2, 1.2))


def draw_cloud(axes: Axes, points: dict[str, np.ndarray], colours: np.ndarray | str) -> int:
    """Draws at most MAX_POINTS of the points, evenly chosen; returns how many.

    The markers are so large that all together cover about the area of the axes.
    """
    chosen = slice(None, None, len(points["x"]) // MAX_POINTS + 1)
    x, y = points["x"][chosen], points["y"][chosen]
    size = axes.get_position(original=True).size * axes.figure.get_size_inches() * 72
    if not isinstance(colours, str):
        colours = colours[chosen]
    axes.scatter(x, y, c=colours, s=np.clip(size.prod() / len(x), 0.5, 20), linewidths=0)
    return len(x)


def place_labels(
    axes: Axes, marks: list[tuple[float, float, float, float]], texts: list[str]
) -> None:
    """Writes each text beside its mark (x from, x, x to, y) where it covers nothing else.

    The view limits must be final; the first of the places that covers least is taken.
    """
    axes.figure.canvas.draw()
    renderer = axes.figure.canvas.get_renderer()
    frame = axes.get_window_extent(renderer)
    taken = [box for mark in marks for box in _mark_boxes(axes, mark)]
    for (_, x, _, y), text in zip(marks, texts):
        notes = [_annotate(axes, x, y, text, place) for place in _PLACES]
        boxes = [note.get_window_extent(renderer).expanded(1.02, 1.05) for note in notes]
        costs = [
            sum(box.overlaps(other) for other in taken) + 2 * (not _inside(box, frame))
            for box in boxes
        ]
        best = costs.index(min(costs))
        taken.append(boxes[best])
        for note in notes[:best] + notes[best + 1 :]:
            note.remove()


# Offset in points, horizontal and vertical alignment; above and below first, since bars run across.
_PLACES = [
    ((0, 6), "center", "bottom"),
    ((0, -6), "center", "top"),
    ((6, 5), "left", "bottom"),
    ((-6, 5), "right", "bottom"),
    ((6, -5), "left", "top"),
    ((-6, -5), "right", "top"),
    ((0, 18), "center", "bottom"),
    ((0, -18), "center", "top"),
    ((0, 30), "center", "bottom"),
    ((0, -30), "center", "top"),
]

_Place = tuple[tuple[float, float], str, str]


def _annotate(axes: Axes, x: float, y: float, text: str, place: _Place) -> Annotation:
    offset, horizontal, vertical = place
    return axes.annotate(
        text,
        (x, y),
        xytext=offset,
        textcoords="offset points",
        ha=horizontal,
        va=vertical,
        fontsize=8,
        color="#222222",
    )


def _mark_boxes(axes: Axes, mark: tuple[float, float, float, float]) -> list[Bbox]:
    """On the screen: the marker, and the bar through it."""
    left, x, right, y = mark
    ends = axes.transData.transform([(left, y), (x, y), (right, y)])
    (x0, _), (x1, middle), (x2, _) = ends
    return [
        Bbox.from_extents(x1 - 6, middle - 6, x1 + 6, middle + 6),
        Bbox.from_extents(x0, middle - 2, x2, middle + 2),
    ]


def _inside(box: Bbox, frame: Bbox) -> bool:
    return frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1
