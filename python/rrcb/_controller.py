"""When to rebalance, and what points cost."""

from __future__ import annotations

import ctypes
import dataclasses
import operator
import weakref
from typing import Any, TypeVar

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare
from ._arrays import Array, numbers_in
from ._balance import Report


Self = TypeVar("Self", bound="Owner")


class Owner:
    """Object with a collective free(), which `with` calls; never freed, it lasts until MPI ends."""

    _comm: MPI.Intracomm
    _own: c.Handle

    def free(self) -> None:
        """Frees the object. Collective."""
        self._own.destroy()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        # An error on one rank would wait here for the others.
        if kind is None:
            self.free()


def number(value: Any) -> float:
    """Returns a float; NaN, which the library reports on every rank, for what is none."""
    try:
        return float(value)
    except (TypeError, ValueError):
        return float("nan")


def values_of(columns: Any) -> Any:
    """Returns numbers as one row; NaN for what has no shape."""
    try:
        return np.ravel(columns)
    except ValueError:
        return [float("nan")]


def index_of(num_columns: Any) -> int:
    """Returns a number of columns. Raises Error for what is none."""
    try:
        columns = operator.index(num_columns)
    except TypeError:
        raise c.Error(f"num_columns must be a whole number, not {num_columns!r}") from None
    if ctypes.c_int(columns).value != columns:
        raise c.Error(f"num_columns must be an int32, not {columns}")
    return columns


class Controller(Owner):
    """Decides when a rebalance pays. Making and freeing one are collective over `comm`."""

    def __init__(self, comm: MPI.Comm | None = None) -> None:
        self._comm = communicator(comm)
        self._own = c.Handle("controller_create_fortran", "controller_destroy", self._comm.py2f())
        self._models: weakref.WeakSet[CostModel] = weakref.WeakSet()

    def save(self) -> bytes:
        """Returns the state as bytes, the same on every rank. Collective."""
        communicator(self._comm)
        return c.saved("controller_save", self._own)

    @classmethod
    def load(cls, saved: bytes, comm: MPI.Comm | None = None) -> Controller:
        """Returns a controller that continues from the bytes of save(). Collective over `comm`."""
        made = cls.__new__(cls)
        made._comm = communicator(comm)
        data = prepare(made._comm, lambda: bytes(saved))
        made._own = c.Handle(
            "controller_load_fortran", "controller_destroy", made._comm.py2f(), data, len(data)
        )
        made._models = weakref.WeakSet()
        return made

    def free(self) -> None:
        """Frees the object and its cost models. Collective."""
        for model in self._models:
            model._own.destroy()
        super().free()

    @property
    def due(self) -> bool:
        """Whether to rebalance before the next step; the same on every rank."""
        due = ctypes.c_int()
        c.call("controller_due", self._own, due)
        return bool(due.value)

    def step(self, load: float, weight: float | None = None) -> bool:
        """Records a step that took this rank `load` of its own work; returns `due`. Collective.

        `weight` is the sum of the weights balanced by of this rank's points, without weights
        their number; give it with measured loads. An illegal number raises Error on every rank, one call later.
        """
        communicator(self._comm)
        due = ctypes.c_int()
        if weight is None:
            c.call("controller_step", self._own, number(load), due)
        else:
            c.call("controller_step_weight", self._own, number(load), number(weight), due)
        return bool(due.value)

    def rebalanced(self, report: Report | None, cost: float) -> None:
        """Records a rebalance and its cost on this rank, in the unit of the loads. On all ranks.

        `report` is that of the balance, None after another balancer.
        """
        is_report = isinstance(report, Report)
        if report is not None and not is_report:
            cost = float("nan")
        given = c.Report(**dataclasses.asdict(report)) if is_report else None
        c.call("controller_rebalanced", self._own, given, number(cost))


def address_of(controller: Controller | None) -> Any:
    """Returns the address of a controller, or None. Raises Error for what is none."""
    if controller is None:
        return None
    if not isinstance(controller, Controller):
        raise c.Error(f"controller must be a Controller, not {type(controller).__name__}")
    controller._own.require_alive()
    return controller._own._as_parameter_


class CostModel(Owner):
    """Learns the seconds that points cost. Making one is collective.

    Its sums travel with the steps of `controller`, or on a communicator of their own. The first
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
        """Returns the state as bytes, the same on every rank; save its controller, too. Collective."""
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
        """Records a step: seconds of this rank's own work, its number of each column. Collective."""
        communicator(self._comm)
        counts = np.array([number(value) for value in values_of(columns)])
        c.call("cost_model_step", self._own, number(seconds), counts.size, counts)

    def weights(self, columns: Any) -> Array:
        """Returns the weight of each point by its share of the columns, (n, num_columns)."""
        rows = np.ascontiguousarray(numbers_in(columns, "columns"))
        if rows.size and rows.shape[1:] != (self.num_columns,):
            raise c.Error(f"columns must have the shape (n, {self.num_columns}), not {rows.shape}")
        weights = np.empty(len(rows))
        c.call("cost_model_weights", self._own, len(rows), self.num_columns, rows, weights)
        return weights

    @property
    def costs(self) -> Array:
        """Seconds of a unit of each column."""
        costs = np.empty(self.num_columns)
        c.call("cost_model_costs", self._own, costs.size, costs)
        return costs

    @property
    def uses_costs(self) -> bool:
        """Whether weights() uses the costs; otherwise each point weighs 1."""
        uses = ctypes.c_int()
        c.call("cost_model_uses_costs", self._own, uses)
        return bool(uses.value)

    def report(self) -> str:
        """Returns a sentence: whether costs are used, and why."""
        self._own.require_alive()
        return c.text(c.library.rrcb_cost_model_report(self._own))
