"""The tree of cuts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator
from ._arrays import Array, Points, copied, numbers_in

CUT = np.dtype([("axis", np.int32), ("divides", np.int32), ("at", np.float64, 3)])


class Cuts:
    """The cuts of a balance. They are the same on every rank, and can be pickled.

    `tree` contains num_parts - 1 cuts in preorder, each with axis, divides and at. No method is
    collective.
    """

    def __init__(
        self,
        dimension: int,
        num_parts: int,
        tree: Array,
        shape: tuple[int, int, int] = (1, 0, 0),
        numbers: Array | None = None,
        debt: float = 0,
    ) -> None:
        self.dimension = dimension
        self.num_parts = num_parts
        self.tree = np.ascontiguousarray(tree, dtype=CUT)
        if self.tree.shape != (num_parts - 1,):
            raise c.Error(f"tree must have the shape ({num_parts - 1},), not {self.tree.shape}")
        self._shape = shape
        self._numbers = None if numbers is None else np.ascontiguousarray(numbers, dtype=np.int32)
        self._debt = debt
        self._own: c.OwnedHandle | None = None

    def __getstate__(self) -> tuple[Any, ...]:
        return (self.dimension, self.num_parts, self.tree, self._shape, self._numbers, self._debt)

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self.__init__(*state)  # type: ignore[misc]

    def __repr__(self) -> str:
        return f"<rrcb.Cuts of {self.num_parts} parts in {self.dimension} dimensions>"

    def save(self) -> bytes:
        """Returns the cuts as bytes, which programs in all languages can load."""
        return c.saved("save_cuts", self._handle())

    @staticmethod
    def load(saved: bytes) -> Cuts:
        """Returns cuts from the bytes of save()."""
        own = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", communicator(MPI.COMM_SELF).py2f())
        c.call("load_cuts", own, bytes(saved), len(saved))
        return cuts_of(own)

    def part_of(self, points: Any) -> Any:
        """Returns the part of each of (n, d) positions, or of one position."""
        position = np.ndim(points) == (0 if self.dimension == 1 else 1)
        if position and not isinstance(points, tuple):
            points = numbers_in(points, "a position").reshape(1, -1)
        elif isinstance(points, tuple) and position:
            points = numbers_in([points], "a position")
        view = Points(points)
        parts = np.empty(view.count, dtype=np.int32)
        c.call("assign", self._handle(), view, parts)
        return int(parts[0]) if position else parts

    def boxes(self) -> Array:
        """Returns the regions of the parts, (num_parts, 2, d): lower and upper corners.

        Sides without a cut are +-infinity. In an empty region the upper corner is below the lower one.
        """
        corners = np.empty((self.num_parts, 2, 3))
        for part, (lower, upper) in enumerate(corners):
            c.call("box_of", self._handle(), part, lower, upper)
        return corners[:, :, : self.dimension].copy()

    def finite_boxes(self, within: Any = None) -> Array:
        """Returns boxes() clipped to a box (lower, upper); by default one slightly larger than all cuts."""
        boxes = self.boxes()
        ends = np.asarray(self._around(boxes) if within is None else within, dtype=float)
        return np.clip(boxes, ends[0], ends[1])

    def plot(self, ax: Any = None, within: Any = None, **style: Any) -> Any:
        """Draws the parts with matplotlib into `ax`, or into new axes. Returns the axes."""
        from . import _plot

        return _plot.plot(self, ax, within, style)

    def to_vtk(self, path: str | Path, within: Any = None) -> None:
        """Writes the parts as a legacy VTK file, which ParaView reads. Call it on one rank."""
        from . import _plot

        _plot.to_vtk(self, path, within)

    def _around(self, boxes: Array) -> tuple[Array, Array]:
        faces = np.where(np.isfinite(boxes), boxes, np.nan).reshape(-1, self.dimension)
        lower = np.zeros(self.dimension)
        upper = np.ones(self.dimension)
        for axis in range(self.dimension):
            known = faces[~np.isnan(faces[:, axis]), axis]
            if known.size:
                lower[axis], upper[axis] = known.min(), known.max()
        width = (upper - lower).max()
        margin = 0.25 * (width if width > 0 else 1.0)
        return lower - margin, upper + margin

    def _handle(self) -> c.OwnedHandle:
        if self._own is None:
            own = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", communicator(MPI.COMM_SELF).py2f())
            self._give(own)
            self._own = own
        return self._own

    def _give(self, balancer: c.Handle) -> None:
        """Copies the cuts to a balancer."""
        tree = self.tree.ctypes.data if len(self.tree) else None
        numbers = None if self._numbers is None else self._numbers.ctypes.data
        given = c.Cuts(self.dimension, self.num_parts, tree, *self._shape, numbers, self._debt)
        c.call("set_cuts", balancer, given)


def cuts_of(balancer: c.Handle) -> Cuts:
    """Returns a copy of the cuts of a balancer."""
    shown = c.Cuts()
    c.call("get_cuts", balancer, shown)
    tree = copied(shown.tree, (shown.num_parts - 1,), CUT)
    shape = (shown.group_size, shown.larger_below, shown.round_robin_block)
    numbers = copied(shown.numbers, (shown.num_parts,), np.int32) if shown.numbers else None
    return Cuts(shown.dimension, shown.num_parts, tree, shape, numbers, shown.debt)
