"""One look for all pictures: colours, line styles, axes, and labels that keep clear of each other."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.transforms import Bbox  # noqa: E402

# K. L. Kelly: Twenty-two colors of maximum contrast (1965), without white and black.
PART_COLOURS = (
    "#0067A5 #F3C300 #BE0032 #8DB600 #875692 #F38400 #A1CAF1 #882D17 #008856 #E68FAC "
    "#604E97 #DCD300 #654522 #F99379 #2B3D26 #C2B280 #B3446C #F6A600 #848482 #E25822"
).split()


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


def place_labels(axes: Axes, labels: list[tuple[float, float, str, str]]) -> None:
    """Writes (x, y, text, colour) beside each point where it covers no label and no other point.

    The view limits must be final; of the places that are free the first one is taken.
    """
    figure = axes.figure
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    frame = axes.get_window_extent(renderer)
    anchors = axes.transData.transform([(x, y) for x, y, _, _ in labels])
    taken = [Bbox.from_bounds(x - 5, y - 5, 10, 10) for x, y in anchors]
    for x, y, text, colour in sorted(labels, key=lambda label: label[:2]):
        best = None
        for offset, horizontal, vertical in _PLACES:
            note = axes.annotate(
                text,
                (x, y),
                xytext=offset,
                textcoords="offset points",
                ha=horizontal,
                va=vertical,
                color=colour,
                fontsize=8,
            )
            box = note.get_window_extent(renderer).expanded(1.02, 1.05)
            cost = sum(box.overlaps(other) for other in taken) + 2 * (not _inside(box, frame))
            if best is None or cost < best[0]:
                if best is not None:
                    best[1].remove()
                best = (cost, note, box)
            else:
                note.remove()
            if cost == 0:
                break
        taken.append(best[2])


_PLACES = [
    ((7, 0), "left", "center"),
    ((-7, 0), "right", "center"),
    ((0, 7), "center", "bottom"),
    ((0, -7), "center", "top"),
    ((6, 6), "left", "bottom"),
    ((6, -6), "left", "top"),
    ((-6, 6), "right", "bottom"),
    ((-6, -6), "right", "top"),
    ((0, 18), "center", "bottom"),
    ((0, -18), "center", "top"),
]


def _inside(box: Bbox, frame: Bbox) -> bool:
    return frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1
