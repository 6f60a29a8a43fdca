"""The common style of all pictures: colours, lines with intervals, panels, axes and labels."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.axis import Axis  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib import ticker  # noqa: E402
from matplotlib.patches import Rectangle  # noqa: E402

# Colours of parts. Any two of them, and any of them and a method's colour, differ by at least 14 units of CIELAB.
PART_COLOURS = (
    "#B197FF #E5D870 #FF7D70 #7DA43C #3CE5FF #FF7DBE #E5A449 #8A97BE #63F2B1 #CB8A97 "
    "#F2D8BE #49B163 #FFCBFF #7DA48A #BEE5A4 #B1A463 #3CA4FF #FFA4FF #70D8BE #3CA4BE"
).split()
POINT_COLOUR = "#666666"
CALL_COLOUR = "#444444"

MAX_POINTS = 20_000


class MethodStyle(NamedTuple):
    colour: str
    line: str | tuple


# Colours after M. Okabe and K. Ito: Color universal design (2008). The line style distinguishes the methods
# without colour. Settings of one method are shades of its colour.
_METHODS = {
    "none": MethodStyle("#888888", (0, (1, 1))),
    "zoltan-rcb": MethodStyle("#000000", "--"),
    "zoltan-rib": MethodStyle("#CC79A7", (0, (5, 1, 1, 1))),
    "zoltan-hsfc": MethodStyle("#E69F00", (0, (3, 1, 1, 1, 1, 1))),
    "zoltan2-mj": MethodStyle("#A89800", (0, (6, 2))),
    "root-rcb": MethodStyle("#009E73", "-."),
    "rrcb-sampled": MethodStyle("#D55E00", ":"),
    "rrcb-sampled[mesh=2,k=1.5,fraction=0.25]": MethodStyle("#F2A57C", ":"),
    "rrcb-sampled[mesh=4,k=2,fraction=0.125]": MethodStyle("#E58243", ":"),
    "rrcb-sampled[mesh=6,k=2,fraction=0.125]": MethodStyle("#A84600", ":"),
    "rrcb-sampled[mesh=8,k=2,fraction=0.125]": MethodStyle("#6E2C00", ":"),
    "rrcb[tol=1.1]": MethodStyle("#86C1E8", (0, (1, 2))),
    "rrcb[tol=1.05]": MethodStyle("#409CD8", (0, (2, 1))),
    "rrcb": MethodStyle("#0072B2", "-"),
    "rrcb[tol=1.001]": MethodStyle("#00508A", (0, (6, 1))),
    "rrcb-exact": MethodStyle("#0A2A66", (0, (4, 1))),
    "rrcb-arrays": MethodStyle("#7B2D8E", "-"),
    "count": MethodStyle("#A37ACC", (0, (2, 2))),
    "learned": MethodStyle("#C2185B", "-"),
}
_OTHER = MethodStyle("#7A5C4A", "-")
_LINES = ("--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 3)))


def method_style(method: str) -> MethodStyle:
    """Returns the style of the setting, or that of its method if the setting has none."""
    return _METHODS.get(method) or _METHODS.get(method.split("[")[0]) or _OTHER


def distinct_styles(methods: Iterable[str]) -> dict[str, MethodStyle]:
    """Returns the style of each method. Settings with the same style get different lines."""
    styles: dict[str, MethodStyle] = {}
    for method in dict.fromkeys(methods):
        style = method_style(method)
        others = (style._replace(line=line) for line in _LINES)
        is_taken = style in styles.values()
        styles[method] = next((o for o in others if o not in styles.values()), style) if is_taken else style
    return styles


def part_colours(parts: Sequence[float]) -> np.ndarray:
    return np.array(PART_COLOURS)[np.asarray(parts, dtype=int) % len(PART_COLOURS)]


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


# --- panels ---


def panels(lines: int, columns: int, width: float, height: float, **share) -> tuple:
    """Returns a figure and its panels as an array of lines and columns."""
    return plt.subplots(lines, columns, figsize=(width, height), squeeze=False, **share)


def label_edges(grid: np.ndarray, x: str, y: str) -> None:
    for axes in grid[-1]:
        axes.set_xlabel(x)
    for axes in grid[:, 0]:
        axes.set_ylabel(y)


def legend_above(figure: Figure, axes: Axes, inches: float = 1.45) -> Figure:
    """Draws the legend of the axes above the panels. An entry is `inches` wide, which determines the number of lines.
    """
    handles = axes.get_legend_handles_labels()[0]
    most = max(1, int(figure.get_figwidth() / inches))
    lines = -(-len(handles) // most)
    figure.suptitle("\n" * (lines - 1) + " ", fontsize=13)  # reserves space for the legend
    figure.legend(handles=handles, loc="upper center", ncol=-(-len(handles) // lines))
    return figure


def save(figure: Figure, path: Path) -> None:
    """Writes the picture. Its logarithmic axes get plain numbers, at least two."""
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        is_fixed = isinstance(axis.get_major_locator(), ticker.FixedLocator)
        if axis.get_scale() == "log" and not is_fixed:
            _label_plainly(axis)
    figure.savefig(path)
    plt.close(figure)


def _label_plainly(axis: Axis) -> None:
    low, high = sorted(axis.get_view_interval())
    several = [ticker.LogLocator(subs=subs, numticks=12) for subs in ((1,), (1, 2, 5), (1, 1.5, 2, 3, 4, 6))]
    for locator in (*several, ticker.MaxNLocator(4)):
        if sum(low <= tick <= high for tick in locator.tick_values(low, high)) >= 2:
            axis.set_major_locator(locator)
            break
    axis.set_major_formatter(ticker.FuncFormatter(_plain_number))
    axis.set_minor_formatter(ticker.NullFormatter())


def _plain_number(value: float, _: int) -> str:
    """Formats a number without powers of ten: 0.001, 100,000, 1 M."""
    if value >= 1e6:
        return f"{value / 1e9:g} G" if value >= 1e9 else f"{value / 1e6:g} M"
    return f"{value:,.0f}" if value >= 1 and value == round(value) else f"{value:.12f}".rstrip("0")


# --- contents of panels ---


def draw_line(
    axes: Axes, x: Sequence[float], y: Sequence[float], low: Sequence[float], high: Sequence[float],
    band: float = 0.15, **look
) -> None:
    """Draws a line through the numbers, in a band from low to high."""
    (line,) = axes.plot(x, y, **look)
    if len(y) > 1:  # a single point has no band
        axes.fill_between(x, low, high, color=line.get_color(), alpha=band, linewidth=0)


def show_lengths(axes: Axes) -> None:
    """Gives both axes equal scales, in metres."""
    axes.set_aspect("equal")
    axes.margins(0.02)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.label_outer()


def length_ratio(clouds: Iterable[pd.DataFrame]) -> float:
    """Returns the height of panels that show every cloud, divided by the width, within limits."""
    all_points = pd.concat([cloud[["x", "y"]] for cloud in clouds])
    width, height = all_points.max() - all_points.min()
    return float(np.clip(height / max(width, 1e-300), 0.2, 1.2))


def draw_cloud(
    axes: Axes, points: pd.DataFrame, colours: Sequence[str] | str, largest: float = 20
) -> None:
    """Draws at most MAX_POINTS of the points, at equal distances in their order. The markers are so large that together
    they cover about the area of the axes, but no larger than `largest`."""
    chosen = slice(None, None, len(points) // MAX_POINTS + 1)
    x, y = points["x"][chosen], points["y"][chosen]
    size = axes.get_position(original=True).size * axes.figure.get_size_inches() * 72
    if not isinstance(colours, str):
        colours = colours[chosen]
    axes.scatter(x, y, c=colours, s=np.clip(size.prod() / len(x), 0.5, largest), linewidths=0)


def rectangles(boxes: pd.DataFrame, **look) -> list[Rectangle]:
    return [
        Rectangle((b.lower_x, b.lower_y), b.upper_x - b.lower_x, b.upper_y - b.lower_y, **look)
        for b in boxes.itertuples()
    ]
