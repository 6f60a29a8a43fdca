"""Exchanges with the ranks near this one, in each step of a simulation."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from typing import Any, Callable

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare
from ._arrays import Array, Columns, Points, as_array, copied, numbers_in, split
from ._balance import Distribution, cuts_from
from ._cuts import Cuts
from ._ghosts import NEEDS, box_of, cutoff_of, numbers_of, ranges_of, sent_of, shifted


class Neighbours:
    """The ranks near this one, found from the cuts of a balance. Make it once for each balance.

        neighbours = rrcb.Neighbours(balance, cutoff=0.1, travel=0.02)
        here = neighbours.migrate(here["x"], here)  # in each step
        neighbours.find_ghosts(here["x"])
        near = neighbours.fetch_positions(here["x"])
        force += neighbours.accumulate(force_of_ghosts)

    `cutoff` is the cutoff of ghosts, the largest one if points have different cutoffs.
    `travel` is the distance that a point may move between two calls of migrate(). `period` and
    `needs` are as for Distribution.ghosts(). The constructor is collective over `comm`, which is
    the communicator of the balance by default. All other calls wait only for neighbours; every rank
    must make them in the same order. If a call raises Error on a rank, it does so on the neighbours
    in the same call, and on their neighbours in the next; then all ranks must make new Neighbours.
    """

    ranks: Array  #: of the neighbours, ascending

    def __init__(
        self,
        cuts: Distribution | Cuts,
        cutoff: float = 0.0,
        travel: float = 0.0,
        period: Any = None,
        needs: str = "scatter",
        comm: MPI.Comm | None = None,
    ) -> None:
        own_comm = cuts.comm if comm is None and isinstance(cuts, Distribution) else comm
        self.comm = communicator(own_comm)
        balancer = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", self.comm.py2f())

        def local() -> c.NeighbourOptions:
            given = cuts_from(cuts)
            given._give(balancer)
            if needs not in NEEDS:
                raise c.Error(f"needs must be one of {', '.join(NEEDS)}, not {needs!r}")
            options = c.NeighbourOptions(
                float(numbers_in(cutoff, "cutoff")), float(numbers_in(travel, "travel"))
            )
            options.needs = NEEDS.index(needs)
            self._box = box_of(period, given.dimension)
            if self._box is not None:
                options.lower, options.upper = (side.ctypes.data for side in self._box)
            numbers = cuts.numbers if isinstance(cuts, Distribution) else None
            if numbers is not None:
                self._ranges = ranges_of(numbers, self.comm.Get_size())
                options.ranks_of_parts = ctypes.addressof(self._ranges)
                options.num_parts = len(numbers)
            return options

        options = prepare(self.comm, local)
        self._own = c.OwnedHandle("neighbours_create", "neighbours_destroy", balancer, options)
        number, ranks = ctypes.c_size_t(), ctypes.c_void_p()
        c.call("neighbours_ranks", self._own, number, ranks)
        self.ranks = copied(ranks, (number.value,), np.int32)

    def __repr__(self) -> str:
        return f"<rrcb.Neighbours: {len(self.ranks)} ranks>"

    @property
    def count(self) -> int:
        """Number of ghosts of the latest fetch; 0 between find_ghosts() and the next fetch."""
        return int(self._lists().num_ghosts)

    @property
    def sent(self) -> dict[int, Array]:
        """Rows of the points that each rank needs, found by find_ghosts()."""
        return sent_of(self._lists())

    def migrate(self, x: Any, data: Any) -> Any:
        """Returns data of the points that are now on this rank, in the form of `data`.

        `x` are the positions on this rank, which `data` must contain too. Points that have left the
        parts of this rank go to their ranks; arriving points take their rows, and then rows at the
        end. Exchanges messages with all neighbours. Raises Error if a point is in a part that no
        neighbour holds; `data` remain unchanged then.
        """

        def local() -> tuple[Columns, tuple[Any, ...]]:
            points = Points(x)
            columns = Columns(data, points.count, "points", 0)
            columns.results = [np.array(a, order="C") for a in columns.arrays]
            number, arrays = columns.as_arrays()
            return columns, (points, number, arrays)

        return self._exchange("migrate", local, (None, 0, None))

    def find_ghosts(self, x: Any, cutoff: Any = None) -> None:
        """Finds the points that other ranks need. Call it on every rank after migrate(), before fetch().

        `cutoff` has a number for each point, at most the cutoff of these neighbours, which is the
        default. Sends no messages, except with `needs` "gather" or "symmetric".
        """

        def local() -> tuple[None, tuple[Any, ...]]:
            points = Points(x)
            if cutoff is None:
                return None, (points, None)
            each = np.broadcast_to(cutoff_of(cutoff, points.count), (points.count,))
            return None, (points, np.ascontiguousarray(each))

        self._exchange("find_ghosts", local, (None, None))

    def fetch(self, data: Any) -> Any:
        """Returns a row of data for each ghost, in the form of `data`.

        `data` has a row for each point of this rank, as for Plan.transfer(). Exchanges messages
        with all neighbours.
        """

        def local() -> tuple[Columns, tuple[Any, ...]]:
            columns = Columns(data, int(self._lists().num_points), "points", 0)
            number, arrays = columns.as_arrays()
            return columns, (number, columns.addresses(), arrays)

        return self._exchange("fetch", local, (1, None, None))

    def fetch_positions(self, x: Any) -> Any:
        """Returns positions of the ghosts, moved to those of the periodic images."""
        fetched = self.fetch(x)
        if self._box is None or self.count == 0:
            return fetched
        return shifted("neighbours_apply_shifts", self._own, x, fetched)

    def accumulate(self, data: Any) -> Any:
        """Returns the sum of the ghosts' values for each point of this rank.

        `data` has a row for each ghost, of int32, int64, float32 or float64. Add the result to the
        values of the points, for example to their forces. Exchanges messages with all neighbours.
        """

        def local() -> tuple[Columns, tuple[Any, ...]]:
            lists = self._lists()
            columns = numbers_of(data, int(lists.num_ghosts), int(lists.num_points))
            return columns, columns.as_numbers()

        return self._exchange("accumulate", local, (1, None))

    def sum(self, shared: Mapping[int, Any], data: Any) -> Any:
        """Returns data in which shared rows are replaced by their sums over the ranks.

        `shared` contains for each neighbour the rows of `data` that the neighbour has too, such as
        nodes at the faces of parts. Both ranks must list the same entries in the same order.
        Exchanges messages with all neighbours.
        """

        def local() -> tuple[Columns, tuple[Any, ...]]:
            rows = len(split(data)[0][0][1])
            columns = numbers_of(data, rows, rows)
            columns.results = [np.array(a, order="C") for a in columns.arrays]
            lists = [as_array(shared[rank]) for rank in sorted(shared)]
            if any(each.dtype.kind not in "iu" or each.size and each.min() < 0 for each in lists):
                raise c.Error("shared rows must be integers, 0 or more")
            indices = np.concatenate([np.empty(0, np.uintp), *lists]).astype(np.uintp)
            counts = (c.RankCount * len(lists))(
                *[c.RankCount(rank, len(shared[rank])) for rank in sorted(shared)]
            )
            self._kept = (counts, indices)
            entries = c.SharedEntries(
                len(lists), ctypes.addressof(counts), len(indices), indices.ctypes.data
            )
            return columns, (entries, rows, *columns.as_numbers())

        return self._exchange("sum", local, (None, 0, 0, None))

    def _exchange(
        self,
        function: str,
        local: Callable[[], tuple[Columns | None, tuple[Any, ...]]],
        nothing: tuple[Any, ...],
    ) -> Any:
        """Returns the result of a call. If local() fails, the call fails on the neighbours too."""
        communicator(self.comm)
        try:
            columns, arguments = local()
        except Exception:
            try:
                c.call("neighbours_" + function, self._own, *nothing)
            except c.Error:
                pass
            raise
        c.call("neighbours_" + function, self._own, *arguments)
        return None if columns is None else columns.result()

    def _lists(self) -> c.GhostPlan:
        shown = c.GhostPlan()
        c.call("neighbours_ghost_plan", self._own, shown)
        return shown
