"""The paper's parameters of rrcb-sampled, and lines over them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from style import multiplier_colour

SETTING = re.compile(r"rrcb-sampled\[mesh=(\d+),k=([\d.]+),fraction=([\d.]+)\]")
MARKERS = "osD^vP"


def setting_of(method: str) -> tuple[float, float, float]:
    """Mesh, multiplier k and fraction."""
    mesh, multiplier, fraction = SETTING.fullmatch(method).groups()
    return float(mesh), float(multiplier), float(fraction)


def values_of(methods: list[str], field: int) -> list[float]:
    """Different values of mesh (1), k (2) or fraction (3), largest first."""
    return sorted({setting_of(method)[field - 1] for method in methods}, reverse=True)


def draw_lines(
    axes: Axes, rows: list, method_of: Callable[[object], str], value: Callable[[object], float]
) -> None:
    """A line per multiplier k over the mesh, with a band where a setting has several rows."""
    methods = [method_of(row) for row in rows]
    for number, multiplier in enumerate(sorted(values_of(methods, 2))):
        by_mesh: dict[float, list[float]] = {}
        for row, method in zip(rows, methods):
            mesh, k, _ = setting_of(method)
            if k == multiplier:
                by_mesh.setdefault(mesh, []).append(value(row))
        meshes = sorted(by_mesh)
        colour = multiplier_colour(multiplier)
        axes.plot(
            meshes,
            [sum(by_mesh[mesh]) / len(by_mesh[mesh]) for mesh in meshes],
            color=colour,
            marker=MARKERS[number % len(MARKERS)],
            markersize=4,
            label=f"k = {multiplier:g}",
        )
        axes.fill_between(
            meshes,
            [min(by_mesh[mesh]) for mesh in meshes],
            [max(by_mesh[mesh]) for mesh in meshes],
            color=colour,
            alpha=0.12,
            linewidth=0,
        )
    axes.set_xticks(sorted(values_of(methods, 1)))
    axes.grid(True)


def handles_of(panels: Iterable[Axes]) -> list:
    """One for each label in any of the panels."""
    found: dict[str, object] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            found.setdefault(label, handle)
    return [found[label] for label in sorted(found)]


def legend_above(figure: Figure, handles: list, inches: float = 1.45) -> None:
    """Outside of the panels, in as many lines as the width needs at `inches` an entry."""
    most = max(1, int(figure.get_figwidth() / inches))
    lines = -(-len(handles) // most)
    columns = -(-len(handles) // lines)
    figure.suptitle("\n" * (lines - 1) + " ", fontsize=13)  # keeps room for the legend
    figure.legend(handles=handles, loc="upper center", ncol=columns)
