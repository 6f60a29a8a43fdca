"""Ghosts, which are copies of points of other ranks."""

from __future__ import annotations

import ctypes
from typing import Any, Callable

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare, together
from ._arrays import NUMBERS, Array, Columns, Points, axes_of, copied, move, numbers_in, pointer

NEEDS = ("scatter", "gather", "symmetric")


class Ghosts:
    """Points of other ranks that this rank needs; made by Balance.ghosts().

    It can be used as long as no point changes its row.
    """

    count: int  #: ghosts of this rank
    num_points: int  #: points of this rank
    ranks: Array  #: rank of each ghost
    shifts: Array  #: periods along each axis that a ghost is moved by, (count, d)
    sent: dict[int, Array]  #: rows of the points that each rank needs

    def __init__(
        self,
        comm: MPI.Intracomm,
        balancer: c.Handle,
        x: Any,
        cutoff: Any,
        period: Any,
        needs: str = "scatter",
        numbers: Array | None = None,
    ) -> None:
        def local() -> tuple[Points, c.GhostOptions, Array, Array | None]:
            points = Points(x)
            cutoffs, box = cutoff_of(cutoff, points.count), box_of(period, points.dimension)
            options = options_of(cutoffs, box, needs)
            if numbers is not None:
                self._ranges = ranges_of(numbers, self.comm.Get_size())
                options.ranks_of_parts = ctypes.addressof(self._ranges)
                options.num_parts = len(numbers)
            return points, options, cutoffs, box

        def collective(
            points: Any = None, options: Any = None, cutoffs: Any = None, box: Any = None
        ) -> None:
            self._own = c.OwnedHandle("ghosts_create", "ghosts_destroy", balancer, points, options)
            self._box, self._cutoffs = box, cutoffs
            self._read(points.dimension)

        self.comm = communicator(comm)
        together(comm, local, collective)

    def __repr__(self) -> str:
        return f"<rrcb.Ghosts: {self.count} of {self.num_points} points>"

    def fetch(self, data: Any) -> Any:
        """Returns a row of data for each ghost, in the form of `data`. Collective.

        `data` has a row for each point of this rank, as for Balance.transfer().
        """
        return self._fetch(data, lambda: None)

    def fetch_positions(self, x: Any) -> Any:
        """Returns positions of the ghosts, moved to those of the periodic images. Collective."""
        fetched = self._fetch(x, lambda: self._require_positions(x))
        if self._box is None or self.count == 0:
            return fetched
        return shifted("ghosts_apply_shifts", self._own, x, fetched)

    def reply(self, data: Any) -> Any:
        """Returns rows that the ranks of the ghosts send back, such as answers. Collective.

        `data` has a row for each ghost of this rank, as for Balance.transfer(). The result has a
        row for each entry of `sent`, in the order of np.concatenate([*ghosts.sent.values()]).
        """
        rows = sum(map(len, self.sent.values()))

        def local() -> Columns:
            return Columns(data, self.count, "ghosts", rows)

        return move(self.comm, "ghosts_reply", self._own, local)

    def accumulate(self, data: Any) -> Any:
        """Returns the sum of the ghosts' values for each point of this rank. Collective.

        `data` has a row for each ghost, of int32, int64, float32 or float64. Add the result to the
        values of the points, for example to their forces.
        """
        columns = prepare(
            self.comm, lambda: numbers_of(data, self.count, self.num_points), Columns.signature
        )
        c.call("ghosts_accumulate", self._own, *columns.as_numbers(), None)
        return columns.result()

    def _fetch(self, data: Any, check: Callable[[], None]) -> Any:
        def local() -> Columns:
            check()
            return Columns(data, self.num_points, "points", self.count)

        return move(self.comm, "ghosts_fetch", self._own, local)

    def _require_positions(self, x: Any) -> None:
        given, needed = Points(x).dimension, self.shifts.shape[1]
        if given != needed:
            raise c.Error(f"positions must have {needed} axes, not {given}")

    def _read(self, dimension: int) -> None:
        shown = c.GhostPlan()
        c.call("ghosts_get_plan", self._own, shown)
        self.num_points, self.count = int(shown.num_points), int(shown.num_ghosts)
        shares = [shown.receive[k] for k in range(shown.num_receive_ranks)]
        counts = [share.count for share in shares]
        self.ranks = np.repeat(np.array([share.rank for share in shares], dtype=np.int32), counts)
        self.sent = sent_of(shown)
        shifts = np.zeros((self.count, 3), dtype=np.int32)
        if shown.shifts and self.count:
            ctypes.memmove(shifts.ctypes.data, shown.shifts, shifts.nbytes)
        self.shifts = shifts[:, :dimension].copy()


def sent_of(shown: c.GhostPlan) -> dict[int, Array]:
    """Returns the rows of the points that each rank needs."""
    rows = copied(shown.send_indices, (shown.num_sent,), np.uintp)
    needs = [shown.send[k] for k in range(shown.num_send_ranks)]
    ends = np.cumsum([need.count for need in needs], dtype=int)
    return {n.rank: rows[end - n.count : end] for n, end in zip(needs, ends)}


def shifted(function: str, own: c.Handle, x: Any, fetched: Any) -> Any:
    """Returns fetched positions in the form of `x`, moved to those of the periodic images."""
    images = np.ascontiguousarray(np.stack(axes_of(fetched), axis=1))
    c.call(function, own, Points(images))
    return tuple(images.T) if isinstance(x, tuple) else images.reshape(fetched.shape)


def numbers_of(data: Any, rows: int, rows_after: int) -> Columns:
    """Returns columns of numbers that can be added."""
    columns = Columns(data, rows, "ghosts", rows_after, np.zeros)
    for name, values in zip(columns.names, columns.arrays):
        if values.dtype not in NUMBERS:
            raise c.Error(
                f"column {name} has the dtype {values.dtype}, "
                "but only int32, int64, float32 and float64 are added"
            )
    return columns


def cutoff_of(cutoff: Any, count: int) -> Array:
    """Returns one cutoff, or one for each point."""
    cutoffs = numbers_in(cutoff, "cutoff")
    if cutoffs.ndim > 1 or (cutoffs.ndim == 1 and len(cutoffs) != count):
        raise c.Error(f"cutoff must be a number or have the shape ({count},), not {cutoffs.shape}")
    # For the library a single cutoff of 0 means that none is given.
    return np.zeros(count) if cutoffs.ndim == 0 and cutoffs == 0 else cutoffs.copy()


def ranges_of(numbers: Array, num_ranks: int) -> ctypes.Array[c.RankRange]:
    """Returns the ranks of each part of the cuts, from the numbers of the parts."""
    ranges = (c.RankRange * len(numbers))()
    for number, ranks in zip(numbers, ranges):
        c.call("ranks_of_part", int(number), len(numbers), num_ranks, ranks)
    return ranges


def options_of(cutoffs: Array, box: Array | None, needs: str) -> c.GhostOptions:
    """Returns the library's options, which borrow the arrays."""
    if needs not in NEEDS:
        raise c.Error(f"needs must be one of {', '.join(NEEDS)}, not {needs!r}")
    options = c.GhostOptions()
    options.needs = NEEDS.index(needs)
    if cutoffs.ndim == 0:
        options.cutoff = float(cutoffs)
    else:
        options.cutoffs = pointer(cutoffs)
    if box is not None:
        options.lower, options.upper = box[0].ctypes.data, box[1].ctypes.data
    return options


def box_of(period: Any, dimension: int) -> Array | None:
    """Returns the corners (2, 3) of a periodic box, infinite along axes that are not periodic."""
    if period is None:
        return None
    given = numbers_in(period, "period")
    if given.ndim == 0:
        given = np.full(dimension, given)
    if given.ndim == 1:
        given = np.stack([np.where(np.isinf(given), -np.inf, 0.0), given])
    if given.shape != (2, dimension):
        raise c.Error(
            f"period must be a number, {dimension} lengths or the corners (lower, upper) "
            f"of {dimension} axes, not of the shape {np.shape(period)}"
        )
    box = np.empty((2, 3))
    box[0], box[1] = -np.inf, np.inf
    box[:, :dimension] = given
    return box
