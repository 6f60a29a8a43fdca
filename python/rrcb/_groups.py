"""Groups of points that go to one part together."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare, together
from ._arrays import Array, Columns, Points, as_array, copied, move, numbers_in
from ._balance import Balance, Distribution

PLACES = ("centre", "first_point")


class Groups:
    """Groups of points with equal keys, each represented by one point; made by groups().

        molecules = rrcb.groups(x, keys, comm=comm)
        balance = rrcb.balance(molecules.x, molecules.weights, comm)
        here = molecules.distribution(balance).transfer({"x": x, "key": keys})
    """

    x: Array  #: positions of the groups of this rank, (m, d)
    weights: Array  #: of these groups: sums over their points

    def __init__(self, comm: MPI.Intracomm, own: c.OwnedHandle, num_points: int) -> None:
        self.comm = comm
        self._own = own
        self._num_points = num_points
        shown = c.Points()
        c.call("groups_points", own, shown)
        self.x = copied(shown.axes[0], (shown.count, shown.dimension))
        self.weights = copied(shown.weights, (shown.count,))

    def __repr__(self) -> str:
        return f"<rrcb.Groups: {len(self.x)} of {self._num_points} points>"

    def to_points(self, data: Any) -> Any:
        """Returns for each point the data of its group, in the form of `data`. Collective.

        `data` has a row for each group of this rank, as for Balance.transfer().
        """

        def local() -> Columns:
            return Columns(data, len(self.x), "groups", self._num_points)

        return move(self.comm, "groups_to_points", self._own, local)

    def sums(self, values: Any) -> Array:
        """Returns the sum over the points of each group of this rank. Collective.

        `values` has a row of numbers for each point, with the same shape on every rank.
        """

        def local() -> Array:
            rows = np.ascontiguousarray(numbers_in(values, "values"))
            if rows.ndim == 0 or len(rows) != self._num_points:
                raise c.Error(
                    f"values must have a row for each of {self._num_points} points, not {rows.shape}"
                )
            return rows

        def signature(given: Array) -> str:
            return f"rows of the shape {given.shape[1:]}"

        rows = prepare(self.comm, local, signature)
        result = np.zeros((len(self.x), *rows.shape[1:]))
        c.call("groups_sums", self._own, int(np.prod(rows.shape[1:])), rows, result)
        return result

    def distribution(self, balance: Balance) -> Distribution:
        """Returns the parts of the points, from a balance of the groups. Collective."""
        return Distribution(self.comm, balance._own, self.to_points(balance.parts))


def groups(
    x: Any,
    keys: Any,
    weights: Any = None,
    comm: MPI.Comm | None = None,
    place: str = "centre",
) -> Groups:
    """Finds the groups of all points with equal keys. Collective over `comm`.

    `x` and `weights` are as for balance(). `keys` has an integer for each point, -1 for one that
    is a group of its own. `place` of a group is its "centre" of
    weight or its "first_point". Raises Error on every rank alike.
    """
    chosen = communicator(comm)
    balancer = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", chosen.py2f())

    def local() -> tuple[Points, Array, int]:
        points = Points(x, weights)
        if place not in PLACES:
            raise c.Error(f"place must be one of {', '.join(PLACES)}, not {place!r}")
        return points, keys_of(keys, (points.count,)), PLACES.index(place)

    def collective(points: Any = None, numbers: Any = None, number: int = 0) -> Groups:
        own = c.OwnedHandle("groups_create", "groups_destroy", balancer, points, numbers, number)
        return Groups(chosen, own, points.count)

    return together(chosen, local, collective)


def keys_of(keys: Any, shape: tuple[int, ...]) -> Array:
    """Returns keys in the form that the library takes."""
    values = as_array(keys)
    if values.size and values.dtype.kind not in "iu":
        raise c.Error(f"keys must be integers, not {values.dtype}")
    if values.shape != shape:
        raise c.Error(f"keys must have the shape {shape}, not {values.shape}")
    return np.ascontiguousarray(values, dtype=np.uint64)
