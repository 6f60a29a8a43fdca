"""Draws the parts."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import Array

if TYPE_CHECKING:
    from ._cuts import Cuts

CELLS = {1: 3, 2: 8, 3: 11}  # VTK_LINE, VTK_PIXEL, VTK_VOXEL


def corners_of(boxes: Array) -> Array:
    """Returns the corners of boxes, (n, 2^d, d), with the first axis running fastest."""
    dimension = boxes.shape[2]
    sides = [side[::-1] for side in itertools.product((0, 1), repeat=dimension)]
    axes = np.arange(dimension)
    return np.stack([boxes[:, list(side), axes] for side in sides], axis=1)


def edges_of(boxes: Array) -> Array:
    """Returns the edges of boxes as pairs of corners, (n * edges, 2, d)."""
    corners = corners_of(boxes)
    count = corners.shape[1]
    pairs = [(a, a | bit) for a in range(count) for bit in (1, 2, 4) if a | bit != a and a | bit < count]
    return np.concatenate([corners[:, np.array(pair), :] for pair in pairs])


def plot(cuts: Cuts, ax: Any, within: Any, style: dict[str, Any]) -> Any:
    """Draws the edges of the parts."""
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection

    boxes = cuts.finite_boxes(within)
    edges = edges_of(boxes[(boxes[:, 1] > boxes[:, 0]).all(axis=1)])
    if ax is None:
        projection = "3d" if cuts.dimension == 3 else None
        ax = plt.figure().add_subplot(projection=projection)
    style = {"colors": "black", "linewidths": 0.8, **style}
    if cuts.dimension == 3:
        from mpl_toolkits.mplot3d.art3d import Line3DCollection

        ax.add_collection3d(Line3DCollection(edges, **style))
        lower, upper = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
        ax.set(xlim=(lower[0], upper[0]), ylim=(lower[1], upper[1]), zlim=(lower[2], upper[2]))
        return ax
    if cuts.dimension == 1:
        for x in np.unique(boxes):
            ax.axvline(x, color=style["colors"], linewidth=style["linewidths"])
        return ax
    ax.add_collection(LineCollection(list(edges), **style))
    ax.autoscale_view()
    return ax


def to_vtk(cuts: Cuts, path: str | Path, within: Any) -> None:
    """Writes a VTK file with a cell for each part."""
    corners = corners_of(cuts.finite_boxes(within))
    count, each, dimension = corners.shape
    points = np.zeros((count * each, 3))
    points[:, :dimension] = corners.reshape(-1, dimension)
    cells = np.column_stack([np.full(count, each), np.arange(count * each).reshape(count, each)])
    with open(path, "w", encoding="ascii") as file:
        file.write("# vtk DataFile Version 3.0\nparts\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        file.write(f"POINTS {len(points)} double\n")
        np.savetxt(file, points, fmt="%.17g")
        file.write(f"CELLS {count} {cells.size}\n")
        np.savetxt(file, cells, fmt="%d")
        file.write(f"CELL_TYPES {count}\n")
        np.savetxt(file, np.full(count, CELLS[dimension]), fmt="%d")
        file.write(f"CELL_DATA {count}\nSCALARS part int 1\nLOOKUP_TABLE default\n")
        np.savetxt(file, np.arange(count), fmt="%d")
