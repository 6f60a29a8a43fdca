"""How the pictures show the scenes: what colours the points, and what is drawn beside them."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon

from scene_text import list_in, number_in

WATER, ROCK, STEEL = "#CFE6F5", "#9A9A9A", "#3B4A5A"


@dataclass(frozen=True)
class Moment:
    """A state of a run that is drawn."""

    scene: str  # the text of its file; empty where that is not given
    folder: Path  # of the run
    time: float


Points = dict[str, np.ndarray]  # columns


def moved(points: Points) -> np.ndarray:
    return np.linalg.norm(points["displacement"], axis=1)


def speed(points: Points) -> np.ndarray:
    return np.linalg.norm(points["velocity"], axis=1)


def kilopascals(points: Points) -> np.ndarray:
    """Pressure."""
    return -sum(points[f"stress_{axis}"] for axis in ("xx", "yy", "zz")) / 3e3


def plastic_strain(points: Points) -> np.ndarray:
    return points["plastic_strain"]


@dataclass(frozen=True)
class View:
    label: str = "moved [m]"
    value: Callable[[Points], np.ndarray] = moved  # that colours the points
    most: float | None = None  # end of the colours; none: the largest value
    colours: str = "viridis"
    is_mirrored: bool = False  # a quarter or a half, shown with its image
    shows_start: bool = False  # the surface at the start, as a line
    space: float = 0  # above the points, m
    marker: float = 1.6  # side of a point's square, by the spacing at the start
    backdrop: Callable[[Axes, Moment], list[Patch | Line2D]] = lambda axes, moment: []


def read_fall(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Times, s, and levels of a penetrator's tip, m."""
    with (folder / "history.csv").open(newline="") as file:
        rows = [(float(row["time"]), float(row["penetrator_tip_y"])) for row in csv.DictReader(file)]
    return tuple(np.transpose(rows))


def anchor(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    """The anchor at its place."""
    radius, cone, length = (
        number_in(moment.scene, key) for key in ("radius", "cone_height", "length")
    )
    tip = np.interp(moment.time, *read_fall(moment.folder))
    outline = [(0, 0), (radius, cone), (radius, length), (-radius, length), (-radius, cone)]
    axes.add_patch(Polygon([(x, tip + y) for x, y in outline], facecolor=STEEL, zorder=3))
    return [Patch(facecolor=STEEL, label="anchor")]


def anchor_in_water(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    axes.set_facecolor(WATER)
    return [*anchor(axes, moment), Patch(facecolor=WATER, label="water")]


def ground(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    """The ground behind the plane of the scene."""
    (x, y), (across, up) = list_in(moment.scene, "point"), list_in(moment.scene, "normal")
    ends = np.array([-1e4, 1e4])
    axes.fill_between(ends, y - (ends - x) * across / up, -1e4, color=ROCK, lw=0, zorder=0.5)
    friction = number_in(moment.scene, "friction")
    return [Patch(facecolor=ROCK, label=f"ground, friction {friction:.3g}")]


def bank_in_water(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    """The sea and its surface, and the bed behind the plane of the scene."""
    bed = ground(axes, moment)
    level = axes.get_ylim()[1] - 4
    axes.axhspan(-1e4, level, color=WATER, lw=0, zorder=0)
    axes.axhline(level, color="#2A6F9E", lw=1.2)
    left, right = axes.get_xlim()
    for at in np.linspace(left, right, 12)[1:-1]:
        tail, head = (at, level), (at, level - 6)
        axes.annotate(
            "", xy=head, xytext=tail, arrowprops={"arrowstyle": "->", "color": "#2A6F9E", "lw": 0.8}
        )
    water = number_in(moment.scene, "water_density")
    return [
        Patch(facecolor=WATER, label=f"water, {water:.0f} kg/m³"),
        Line2D([], [], color="#2A6F9E", label="sea level; its load acts as buoyancy"),
        *bed,
    ]


def clamped_feet(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    axes.axhspan(-1e4, 0, color=ROCK, lw=0)
    return [Patch(facecolor=ROCK, label="clamp")]


STRAIN = {"label": "plastic shear strain [-]", "value": plastic_strain, "colours": "YlOrBr"}

VIEWS = {
    "slope": View(**STRAIN, most=2, shows_start=True),
    "submarine_slide": View(
        **STRAIN, most=3, shows_start=True, space=14, backdrop=bank_in_water
    ),
    "torpedo_anchor": View(
        **STRAIN, most=2, is_mirrored=True, space=6.2, backdrop=anchor_in_water
    ),
    "elastic_structure": View(backdrop=clamped_feet),
    "two_disks": View(label="speed [m/s]", value=speed),
    # Shear draws the rows of points apart: larger squares fill a layer as dense as at first.
    "dam_break": View(label="pressure [kPa]", value=kilopascals, most=20, marker=6),
    "granular_column": View(**STRAIN, most=3, marker=3.2),
    "vertical_cut": View(**STRAIN, most=1, marker=2),
}
