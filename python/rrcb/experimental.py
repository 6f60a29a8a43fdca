"""Experimental functions: costs of points, keys of overlapping groups, a check of ghosts.

Any version may change this module. Its calls are collective, and raise rrcb.Error as rrcb's do.
"""

from __future__ import annotations

import ctypes
import dataclasses
import operator
from typing import Any

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare, together
from ._arrays import Array, Points, as_array, copied, numbers_in, pointer
from ._controller import Controller, Owner, number
from ._ghosts import Ghosts, cutoff_of
from ._groups import keys_of

__all__ = ["CostModel", "Verification", "join_keys", "verify"]

FAULT = np.dtype([("id", "u8"), ("rank", "i4"), ("needed_by", "u8")], align=True)


@dataclasses.dataclass(frozen=True)
class Verification:
    """Result of verify(). Each fault that concerns this rank has the fields id, rank and needed_by."""

    num_pairs: int  #: of the sample, over all ranks
    num_faults: int  #: over all ranks
    missing: Array  #: near points that are no ghosts, ids that are lost
    duplicates: Array  #: ghosts that came twice, ids that another rank has too
    not_mine: Array  #: own points that came as ghosts, new ids


def values_of(columns: Any) -> Any:
    """Returns numbers as one row. Returns NaN for anything that has no shape."""
    try:
        return np.ravel(columns)
    except ValueError:
        return [float("nan")]


def index_of(num_columns: Any) -> int:
    """Returns a number of columns as an int. Raises Error for anything else."""
    try:
        columns = operator.index(num_columns)
    except TypeError:
        raise c.Error(f"num_columns must be a whole number, not {num_columns!r}") from None
    if ctypes.c_int(columns).value != columns:
        raise c.Error(f"num_columns must be an int32, not {columns}")
    return columns


def address_of(controller: Controller | None) -> Any:
    """Returns the address of a controller, or None. Raises Error for any other object."""
    if controller is None:
        return None
    if not isinstance(controller, Controller):
        raise c.Error(f"controller must be a Controller, not {type(controller).__name__}")
    controller._own.require_alive()
    return controller._own._as_parameter_


class CostModel(Owner):
    """Learns the seconds that points cost. Making one is collective.

    Its sums are sent with the steps of `controller`, or on a communicator of their own. The first
    column is the number of points.
    """

    def __init__(
        self, controller: Controller | None, num_columns: int, comm: MPI.Comm | None = None
    ) -> None:
        chosen = communicator(comm)
        self.num_columns, given = prepare(
            chosen, lambda: (index_of(num_columns), address_of(controller))
        )
        self._make("cost_model_create_fortran", chosen, controller, given, self.num_columns)

    def _make(
        self, create: str, comm: MPI.Intracomm, controller: Controller | None, *arguments: Any
    ) -> None:
        self._comm, self._controller = comm, controller
        self._own = c.Handle(create, "cost_model_destroy", comm.py2f(), *arguments)
        if controller is not None:
            controller._models.add(self)

    def save(self) -> bytes:
        """Returns the state as bytes, the same on every rank. Save its controller, too. Collective."""
        communicator(self._comm)
        return c.saved("cost_model_save", self._own)

    @classmethod
    def load(
        cls, saved: bytes, controller: Controller | None = None, comm: MPI.Comm | None = None
    ) -> CostModel:
        """Returns a model that continues from the bytes of save(). Collective.

        `controller` is the loaded controller of the saved model, if it had one.
        """
        made = cls.__new__(cls)
        chosen = communicator(comm)
        given, data = prepare(chosen, lambda: (address_of(controller), bytes(saved)))
        made._make("cost_model_load_fortran", chosen, controller, given, data, len(data))
        columns = ctypes.c_int()
        c.call("cost_model_num_columns", made._own, columns)
        made.num_columns = columns.value
        return made

    def step(self, seconds: float, columns: Any) -> None:
        """Records the seconds of this rank's own work and its number for each column. Collective."""
        communicator(self._comm)
        counts = np.array([number(value) for value in values_of(columns)])
        c.call("cost_model_step", self._own, number(seconds), counts.size, counts)

    def weights(self, columns: Any) -> Array:
        """Returns the weight of each point, from its share of the columns, (n, num_columns)."""
        rows = np.ascontiguousarray(numbers_in(columns, "columns"))
        if rows.size and rows.shape[1:] != (self.num_columns,):
            raise c.Error(f"columns must have the shape (n, {self.num_columns}), not {rows.shape}")
        weights = np.empty(len(rows))
        c.call("cost_model_weights", self._own, len(rows), self.num_columns, rows, weights)
        return weights

    @property
    def costs(self) -> Array:
        """The seconds that one unit of each column costs."""
        costs = np.empty(self.num_columns)
        c.call("cost_model_costs", self._own, costs.size, costs)
        return costs

    @property
    def uses_costs(self) -> bool:
        """Whether weights() uses the costs. If not, each point weighs 1."""
        uses = ctypes.c_int()
        c.call("cost_model_uses_costs", self._own, uses)
        return bool(uses.value)

    def report(self) -> str:
        """Returns a sentence that explains whether costs are used, and why."""
        self._own.require_alive()
        return c.text(c.library.rrcb_cost_model_report(self._own))


def join_keys(keys: Any, comm: MPI.Comm | None = None) -> Array:
    """Returns one key for each point of overlapping groups. Collective over `comm`.

    `keys` are (n, k) integers, with -1 in place of missing keys; k must be the same on every rank.
    Points that share a key, directly or through other points, all get the least of their keys.
    """
    chosen = communicator(comm)

    def local() -> Array:
        values = as_array(keys)
        if values.ndim != 2:
            raise c.Error(f"keys must have the shape (n, k), not {values.shape}")
        return keys_of(values, values.shape)

    def signature(made: Array) -> str:
        return f"keys of the shape (n, {made.shape[1]})"

    given = prepare(chosen, local, signature)
    balancer = c.OwnedHandle("balancer_create_fortran", "balancer_destroy", chosen.py2f())
    joined = np.empty(len(given), dtype=np.uint64)
    c.call("join_keys", balancer, *given.shape, given, joined)
    return joined


def verify(
    ghosts: Ghosts,
    x: Any,
    sample: int = 1000,
    cutoff: Any = None,
    ids: Any = None,
    ids_before: Any = None,
) -> Verification:
    """Compares ghosts with all pairs of a random sample of the points. Collective.

    `x` are the positions on this rank. `sample` is the maximum number of points, over all ranks,
    whose neighbours are searched. `cutoff` is the true cutoff, if the ghosts have a skin. `ids` are
    numbers of the points, and `ids_before` those of this rank's points before transfer().
    """
    seen, kept = c.Verification(), []

    def numbers(values: Any) -> tuple[int, int | None]:
        if values is None:
            return 0, None
        kept.append(np.ascontiguousarray(values, dtype=np.uint64).ravel())
        return len(kept[-1]), pointer(kept[-1])

    def local() -> tuple[Points, c.VerifyOptions]:
        points = Points(x)
        cutoffs = ghosts._cutoffs if cutoff is None else cutoff_of(cutoff, points.count)
        each = pointer(cutoffs) if cutoffs.ndim else None
        once = 0.0 if cutoffs.ndim or cutoff is None else float(cutoffs)
        return points, c.VerifyOptions(sample, once, each, *numbers(ids), *numbers(ids_before))

    together(
        ghosts.comm, local, lambda p=None, o=None: c.call("ghosts_verify", ghosts._own, p, o, seen)
    )
    lists = [
        copied(address, (count,), FAULT)
        for address, count in (
            (seen.missing, seen.num_missing),
            (seen.duplicates, seen.num_duplicates),
            (seen.not_mine, seen.num_not_mine),
        )
    ]
    return Verification(seen.num_pairs, seen.num_faults, *lists)
