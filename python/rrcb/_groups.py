"""Points that go to one part together."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare, together
from ._arrays import Array, Columns, Points, numbers_in

PLACES = ("centre", "first point")
NO_GROUP = 2**64 - 1


class Groups:
    """Groups of points with one key, as one point each; made by groups()."""

    x: Array  #: position of each group of this rank, (count, d)
    weights: Array  #: sum of the weights of its points, over all ranks
    count: int  #: groups of this rank
    num_points: int  #: points of this rank

    def __init__(
        self, comm: MPI.Intracomm, balancer: c.Handle, points: Points, keys: Array, place: int
    ) -> None:
        self._own = c.OwnedHandle("groups_create", "groups_destroy", balancer, points, keys, place)
        self.comm, self.num_points = comm, points.count
        shown = c.Points()
        c.call("groups_points", self._own, shown)
        self.count = int(shown.count)
        self.x = np.empty((self.count, points.dimension))
        self.weights = np.empty(self.count)
        if self.count:
            ctypes.memmove(self.x.ctypes.data, shown.axes[0], self.x.nbytes)
            ctypes.memmove(self.weights.ctypes.data, shown.weights, self.weights.nbytes)

    def __repr__(self) -> str:
        return f"<rrcb.Groups: {self.count} of {self.num_points} points>"

    def fetch(self, data: Any) -> Any:
        """Returns for each point of this rank the row of its group, such as its part. Collective.

        `data` has a row for each group of this rank, as for Balance.distribute().
        """
        columns = prepare(
            self.comm,
            lambda: Columns(data, self.count, "groups", self.num_points),
            Columns.signature,
        )
        c.call("groups_fetch", self._own, *columns.as_bytes(), None, None)
        return columns.result()

    def sums(self, values: Any) -> Array:
        """Returns the sum over the points of each group of this rank. Collective.

        `values` has a row of numbers for each point, of one shape on every rank.
        """

        def local() -> Array:
            rows = np.ascontiguousarray(numbers_in(values, "values"))
            if rows.ndim == 0 or len(rows) != self.num_points:
                raise c.Error(
                    f"values must have a row for each of {self.num_points} points, not {rows.shape}"
                )
            return rows

        rows = prepare(self.comm, local, lambda given: f"rows of the shape {given.shape[1:]}")
        result = np.zeros((self.count, *rows.shape[1:]))
        components = int(np.prod(rows.shape[1:]))
        c.call("groups_sums", self._own, components, rows, result)
        return result


def groups(
    x: Any, keys: Any, weights: Any = None, comm: MPI.Comm | None = None, place: str = PLACES[0]
) -> Groups:
    """Finds the groups of all points with equal keys. Collective over `comm`.

    `keys` has a number from 0 for each point; NO_GROUP for a point that needs no group. Balance
    `x` of the result by its `weights`, and fetch the parts of the points. A group is at the
    "centre" of its weight, or at its "first point". Raises Error on every rank alike.
    """
    chosen = communicator(comm)
    own = c.OwnedHandle("create_fortran", "destroy", chosen.py2f())

    def local() -> tuple[Points, Array, int]:
        points = Points(x, weights)
        given = np.ascontiguousarray(keys, dtype=np.uint64)
        if given.shape != (points.count,):
            raise c.Error(f"keys must have the shape ({points.count},), not {given.shape}")
        if place not in PLACES:
            raise c.Error(f"place must be one of {', '.join(PLACES)}, not {place!r}")
        return points, given, PLACES.index(place)

    def collective(points: Any = None, given: Any = None, number: int = 0) -> Groups:
        return Groups(chosen, own, points, given, number)

    return together(chosen, local, collective)
