"""Defines how the pictures show the scenes: the values that colour the points, and what is drawn
with them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon

from scene_text import list_in, number_in
from vtk_files import history_of

WATER, ROCK, STEEL = "#CFE6F5", "#9A9A9A", "#3B4A5A"


@dataclass(frozen=True)
class Moment:
    """A state of a run that is drawn."""

    scene: str  # text of the scene file; empty if none is given
    folder: Path  # folder of the run
    time: float


Points = dict[str, np.ndarray]  # columns


def moved(points: Points) -> np.ndarray:
    return np.linalg.norm(points["displacement"], axis=1)


def speed(points: Points) -> np.ndarray:
    return np.linalg.norm(points["velocity"], axis=1)


def kilopascals(points: Points) -> np.ndarray:
    """Returns the pressure."""
    return -sum(points[f"stress_{axis}"] for axis in ("xx", "yy", "zz")) / 3e3


def plastic_strain(points: Points) -> np.ndarray:
    return points["plastic_strain"]


@dataclass(frozen=True)
class View:
    label: str = "moved [m]"
    value: Callable[[Points], np.ndarray] = moved  # determines the colours of the points
    most: float | None = None  # upper end of the colour scale; None: the largest value
    colours: str = "viridis"
    is_mirrored: bool = False  # a quarter or half of the domain, shown with its mirror image
    shows_start: bool = False  # draws the initial surface as a line
    space: float = 0  # height of empty space above the points, m
    marker: float = 1.6  # side of a point's square, relative to the initial spacing
    backdrop: Callable[[Axes, Moment], list[Patch | Line2D]] = lambda axes, moment: []


def anchor(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    """Draws the anchor at its position."""
    radius, cone, length = (
        number_in(moment.scene, key) for key in ("radius", "cone_height", "length")
    )
    history = history_of(moment.folder)
    tip = np.interp(moment.time, history["time"], history["penetrator_tip_y"])
    outline = [(0, 0), (radius, cone), (radius, length), (-radius, length), (-radius, cone)]
    axes.add_patch(Polygon([(x, tip + y) for x, y in outline], facecolor=STEEL, zorder=3))
    return [Patch(facecolor=STEEL, label="anchor")]


def anchor_in_water(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    axes.set_facecolor(WATER)
    return [*anchor(axes, moment), Patch(facecolor=WATER, label="water")]


def ground(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    """Draws the ground behind the plane of the scene."""
    (x, y), (across, up) = list_in(moment.scene, "point"), list_in(moment.scene, "normal")
    ends = np.array([-1e4, 1e4])
    axes.fill_between(ends, y - (ends - x) * across / up, -1e4, color=ROCK, lw=0, zorder=0.5)
    friction = number_in(moment.scene, "friction")
    return [Patch(facecolor=ROCK, label=f"ground, friction {friction:.3g}")]


def bank_in_water(axes: Axes, moment: Moment) -> list[Patch | Line2D]:
    """Draws the sea and its surface, and the bed behind the plane of the scene."""
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
    # Shear separates the rows of points. Larger squares fill the gaps in a layer whose density has not changed.
    "dam_break": View(label="pressure [kPa]", value=kilopascals, most=20, marker=6),
    "granular_column": View(**STRAIN, most=3, marker=3.2),
    "vertical_cut": View(**STRAIN, most=1, marker=2),
}
