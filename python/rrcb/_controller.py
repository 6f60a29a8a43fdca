"""When to rebalance."""

from __future__ import annotations

import ctypes
import dataclasses
import weakref
from typing import Any, TypeVar

from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare
from ._balance import Report


Self = TypeVar("Self", bound="Owner")


class Owner:
    """An object with a collective free(), which `with` calls. If never freed, it lasts until MPI ends."""

    _comm: MPI.Intracomm
    _own: c.Handle

    def free(self) -> None:
        """Frees the object. Collective."""
        self._own.destroy()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        # After an error on this rank only, a collective free() would wait for the others.
        if kind is None:
            self.free()


def number(value: Any) -> float:
    """Returns a float. Returns NaN for anything else, which the library reports on every rank."""
    try:
        return float(value)
    except (TypeError, ValueError):
        return float("nan")


class Controller(Owner):
    """Decides when a rebalance pays. Making and freeing a controller are collective over `comm`."""

    def __init__(self, comm: MPI.Comm | None = None) -> None:
        self._comm = communicator(comm)
        self._own = c.Handle("controller_create_fortran", "controller_destroy", self._comm.py2f())
        self._models: weakref.WeakSet[Owner] = weakref.WeakSet()

    def save(self) -> bytes:
        """Returns the state as bytes, which are the same on every rank. Collective."""
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
        """Whether to rebalance before the next step. It is the same on every rank."""
        due = ctypes.c_int()
        c.call("controller_due", self._own, due)
        return bool(due.value)

    def step(self, load: float, weight: float | None = None) -> bool:
        """Records a step in which this rank's own work took `load`. Returns `due`. Collective.

        `weight` is the sum of the weights that balance() got for this rank's points; without weights
        it is their number. Pass it with measured loads. An illegal number raises Error on every
        rank, one call later.
        """
        communicator(self._comm)
        due = ctypes.c_int()
        given = None if weight is None else ctypes.c_double(number(weight))
        c.call("controller_step", self._own, number(load), given, due)
        return bool(due.value)

    def rebalanced(self, report: Report | None, cost: float) -> None:
        """Records a rebalance and its cost on this rank, in the unit of the loads. Call it on all ranks.

        `report` is that of the balance; use None after another balancer.
        """
        is_report = isinstance(report, Report)
        if report is not None and not is_report:
            cost = float("nan")
        given = c.Report(**dataclasses.asdict(report)) if is_report else None
        c.call("controller_rebalanced", self._own, given, number(cost))
