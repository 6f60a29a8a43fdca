"""Balances points, and moves data to the ranks of their parts."""

from __future__ import annotations

import ctypes
import dataclasses
import re
from functools import cached_property
from typing import Any, Sequence

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare, together
from ._arrays import Array, Columns, Points, as_array, move, numbers_in
from ._cuts import CUT, Cuts, cuts_of
from ._ghosts import Ghosts


@dataclasses.dataclass(frozen=True, repr=False)
class Report:
    """Report of a balance. It is the same on every rank, and prints as a table."""

    imbalance: float  #: heaviest part / mean part; nan with refine="NONE", which counts nothing
    within_tolerance: bool
    kept: bool  #: nothing moves: the points of rank r are part r
    num_points: int  #: over all ranks
    total_weight: float
    least_imbalance: float  #: lower bound of the imbalance of any partition
    estimated_imbalance: float  #: before the cuts were corrected; nan from earlier cuts
    num_cells: int  #: cells bisected
    rounds: int  #: of counting, to correct the cuts
    coincident_cuts: int  #: that would divide points which no allowed cut separates
    all_weights_zero: bool  #: balanced by count instead
    num_empty_parts: int  #: parts that stay empty: more than points

    def __repr__(self) -> str:
        values = dataclasses.asdict(self)
        width = max(map(len, values))
        return "\n".join(
            f"{name.replace('_', ' '):<{width}}  {value:.6g}"
            if isinstance(value, float)
            else f"{name.replace('_', ' '):<{width}}  {value}"
            for name, value in values.items()
        )


class Plan:
    """Parts to which the points of this rank are to be moved; made by plan()."""

    def __init__(self, comm: MPI.Intracomm, own: c.OwnedHandle, parts: Array) -> None:
        self.comm = comm
        self._own = own
        self._parts = parts
        self._parts.flags.writeable = False
        self._num_points_after: int | None = None

    def __repr__(self) -> str:
        return f"<rrcb.{type(self).__name__} of {len(self.parts)} points>"

    def __reduce__(self) -> str:
        raise TypeError("a balance belongs to its communicator: pickle or copy its cuts")

    @property
    def parts(self) -> Array:
        """The part of each point of this rank, as read-only int32."""
        return self._parts

    def transfer(self, data: Any) -> Any:
        """Returns data with a row for each point that belongs on this rank. Collective.

        `data` has a row for each assigned point. It is an array, a dict or a tuple of arrays, or a
        pandas DataFrame, with any dtypes of a fixed size. The result is of the same kind: the
        points that stay come first, then those that arrive, in ascending order of ranks.
        """
        rows = self._plan()

        def local() -> Columns:
            return Columns(data, len(self.parts), "points", rows)

        return move(self.comm, "transfer", self._own, local)

    def _plan(self) -> int:
        if self._num_points_after is None:
            communicator(self.comm)
            c.call("plan", self._own, len(self.parts), self.parts)
            shown = c.Plan()
            c.call("get_plan", self._own, shown)
            self._num_points_after = int(shown.num_points_after)
        return self._num_points_after


class Distribution(Plan):
    """Parts of this rank's points, with the cuts; made by assign(), balance() and remap()."""

    numbers: Array | None = None  #: after remap(), the number of each part of the cuts

    @cached_property
    def cuts(self) -> Cuts:
        """The tree of cuts."""
        return cuts_of(self._own)

    def remap(self, previous: Any = None) -> Distribution:
        """Returns the same parts under numbers with which many points stay. Collective.

        `previous` has the part that each point was in. With None, points should stay on their ranks.
        """
        own = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", self.comm.py2f())
        numbers = np.empty(self.cuts.num_parts, dtype=np.int32)

        def local() -> Array | None:
            self.cuts._give(own)
            return None if previous is None else parts_in(previous, len(self.parts))

        before = prepare(self.comm, local)
        count = len(self.parts)
        c.call("remap", own, count, self.parts, before, None, len(numbers), numbers, None)
        made = Distribution(self.comm, own, numbers[self.parts])
        made.numbers = numbers
        return made

    def part_weights(self, weights: Any = None) -> Array:
        """Returns the weight of each part over all ranks. By default each point weighs 1. Collective."""
        found = np.empty(self.cuts.num_parts)
        points = prepare(self.comm, lambda: self._weighed(weights))
        c.call("part_weights", self._own, points, self.parts, len(found), found)
        return found

    def moved_fraction(self, weights: Any = None) -> float:
        """Returns which share of the weight, from 0 to 1, moves to another rank. Collective."""
        fraction = ctypes.c_double()
        points = prepare(self.comm, lambda: self._weighed(weights))
        c.call("moved_fraction", self._own, points, self.parts, fraction)
        return fraction.value

    def _weighed(self, weights: Any) -> Points:
        return Points(np.zeros((len(self.parts), self.cuts.dimension)), weights)

    def ghosts(self, x: Any, cutoff: Any, period: Any = None, needs: str = "scatter") -> Ghosts:
        """Finds the points that other ranks need, within a cutoff distance. Collective.

        `x` are the positions on this rank after transfer(); positions before it are refused.
        `cutoff` is a number, or an array with a cutoff for each point, within which other ranks
        need the point. With `needs` "gather" it is the cutoff within which the point needs
        others, with "symmetric" it is both (docs/loop.md). `period` is the length of a periodic box
        that begins at 0, as one number or one for each axis (infinity: not periodic), or the
        corners (lower, upper) of the box.
        """
        return Ghosts(self.comm, self._own, x, cutoff, period, needs, self.numbers)


class Balance(Distribution):
    """Parts of this rank's points, with the cuts and a report; made by balance()."""

    def __repr__(self) -> str:
        return f"<rrcb.Balance of {self.cuts.num_parts} parts, imbalance {self.report.imbalance:.6g}>"

    @cached_property
    def report(self) -> Report:
        """The measured imbalance, and statistics of the call."""
        shown = c.Report()
        c.call("get_report", self._own, shown)
        values = {
            field.name: bool(value) if str(field.type) == "bool" else value
            for field in dataclasses.fields(Report)
            for value in [getattr(shown, field.name)]
        }
        return Report(**values)


def balance(
    x: Any,
    weights: Any = None,
    comm: MPI.Comm | None = None,
    tolerance: float | None = None,
    previous: Distribution | Cuts | None = None,
    part_sizes: Sequence[float] | Array | None = None,
    **options: Any,
) -> Balance:
    """Divides points so that every part has the same weight. Collective over `comm`.

    `x` are the positions of this rank's points: (n, d) float64 or float32, or a tuple of d
    columns, with d from 1 to 3; n may be 0. `weights` has a number for each point; by default each
    point weighs 1. `tolerance` is the largest accepted value of heaviest part / mean part, 1.01 by
    default. With `previous` the call starts from earlier cuts, which suits points that have moved
    little. `part_sizes` are relative weights of the parts. `options` are those of
    docs/parameters.md, with a double underscore in place of a dot: refine="EXACT", num_parts=8,
    axes__min_width=(0.1, 0.1).

    `comm` is MPI.COMM_WORLD by default; every rank of it must make the call. The library duplicates
    it at the first call. Raises the same Error on every rank.
    """
    chosen = communicator(comm)
    own = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", chosen.py2f())

    def local() -> tuple[Points, Array]:
        points = Points(x, weights)
        if tolerance is not None:
            set_option(own, "imbalance_tolerance", tolerance)
        for name, value in options.items():
            set_option(own, name.replace("__", "."), value)
        if part_sizes is not None:
            sizes = np.ascontiguousarray(numbers_in(part_sizes, "part_sizes").ravel())
            c.call("balancer_set_part_sizes", own, sizes.size, sizes)
        if previous is not None:
            cuts_from(previous)._give(own)
        return points, np.empty(points.count, dtype=np.int32)

    def collective(points: Any = None, parts: Any = None) -> Balance:
        c.call("balance", own, points, parts)
        return Balance(chosen, own, parts)

    return together(chosen, local, collective)


def plan(parts: Any, num_parts: int | None = None, comm: MPI.Comm | None = None) -> Plan:
    """Plans a move of points to the ranks of any parts. Collective over `comm`.

    `parts` has the part of each point of this rank, from 0 to num_parts - 1. By default `num_parts`
    is the number of ranks, so that part p is on rank p. The result's transfer() moves columns.
    """
    chosen = communicator(comm)
    own = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", chosen.py2f())

    def local() -> Array:
        number = chosen.size if num_parts is None else num_parts
        Cuts(1, number, np.zeros(max(number, 1) - 1, dtype=CUT))._give(own)
        return parts_in(parts).copy()

    made = Plan(chosen, own, prepare(chosen, local, lambda _: f"num_parts = {num_parts}"))
    made._plan()
    return made


def parts_in(given: Any, count: int | None = None) -> Array:
    """Returns parts in the form that the library takes."""
    numbers = as_array(given)
    if numbers.dtype.kind not in "iu" and numbers.size:
        raise c.Error(f"parts must be integers, not {numbers.dtype}")
    if numbers.ndim != 1 or (count is not None and len(numbers) != count):
        shape = "n" if count is None else count
        raise c.Error(f"parts must have the shape ({shape},), not {numbers.shape}")
    if numbers.size and not (0 <= numbers.min() and numbers.max() < 2**31):
        raise c.Error("parts must be 0 or more, and below the number of parts")
    return np.ascontiguousarray(numbers, dtype=np.int32)


def assign(x: Any, cuts: Distribution | Cuts, comm: MPI.Comm | None = None) -> Distribution:
    """Assigns points to parts by earlier cuts, without balancing. Collective over `comm`."""
    chosen = communicator(comm)
    own = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", chosen.py2f())

    def local() -> tuple[Points, Array]:
        points = Points(x)
        cuts_from(cuts)._give(own)
        return points, np.empty(points.count, dtype=np.int32)

    def collective(points: Any = None, parts: Any = None) -> Distribution:
        c.call("assign_all", own, points, parts)
        return Distribution(chosen, own, parts)

    return together(chosen, local, collective)


def balanced_sizes(loads: Any, part_sizes: Any = None) -> Array:
    """Returns `part_sizes` for the next balance that make the loads of the parts more even.

    `loads` has the load of each part in the last step, in any unit, such as points + 0.25 * ghosts.
    `part_sizes` are those of the last balance; None stands for equal parts. Pass the cuts of the
    last balance to the next one. Not collective.
    """
    of_parts = np.ascontiguousarray(numbers_in(loads, "loads").ravel())
    before = None
    if part_sizes is not None:
        before = np.ascontiguousarray(numbers_in(part_sizes, "part_sizes").ravel())
        if before.size != of_parts.size:
            raise c.Error(f"part_sizes must hold one entry per part: {of_parts.size}, not {before.size}")
    sizes = np.empty(of_parts.size)
    if sizes.size:
        c.call("balanced_sizes", sizes.size, of_parts, before, sizes)
    return sizes


def cuts_from(given: Any) -> Cuts:
    """Returns the given cuts, or the cuts of a given balance."""
    cuts = given.cuts if isinstance(given, Distribution) else given
    if not isinstance(cuts, Cuts):
        raise c.Error(f"give a balance or its cuts, not {type(given).__name__}")
    return cuts


def set_option(own: c.Handle, name: str, value: Any) -> None:
    """Sets an option to a value, passed as text."""
    if value is None:
        raise c.Error(f"the option {name} is None: leave it out for its default")
    try:
        c.call("balancer_set", own, name.encode(), text_of(value).encode())
    except c.Error as error:  # The text must name the keyword, which has no dot.
        raise c.Error(re.sub(r"\b(axes|tree)\.", r"\1__", str(error)), error.kind) from None


def text_of(value: Any) -> str:
    """Returns a value as the text of an option: spaces separate numbers, commas separate rows."""
    if isinstance(value, (bool, np.bool_)):
        return "ON" if value else "OFF"
    if isinstance(value, (tuple, list, np.ndarray)):
        return (", " if np.ndim(value) > 1 else " ").join(map(text_of, value))
    return f"{value:.17g}" if isinstance(value, float) else str(value)
