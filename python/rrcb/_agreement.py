"""Raises errors of one rank on all ranks."""

from __future__ import annotations

import zlib
from typing import Any, Callable, TypeVar

import numpy as np
from mpi4py import MPI

from ._library import Error

T = TypeVar("T")


def communicator(comm: MPI.Comm | None) -> MPI.Intracomm:
    """Returns the communicator of a call. Raises Error for one that cannot be used."""
    # Otherwise MPI would end the program without naming the call.
    if not MPI.Is_initialized() or MPI.Is_finalized():
        raise Error("MPI is not running: call after MPI.Init() and before MPI.Finalize()")
    chosen = MPI.COMM_WORLD if comm is None else comm
    if not isinstance(chosen, MPI.Comm):
        raise Error(f"comm must be a communicator of mpi4py, not {type(chosen).__name__}")
    if chosen == MPI.COMM_NULL:
        raise Error("comm is MPI.COMM_NULL: it was freed, or this rank is not in it")
    if not isinstance(chosen, MPI.Intracomm) or chosen.Is_inter():
        raise Error("comm is an intercommunicator: call Merge() and pass its result")
    return chosen


def together(
    comm: MPI.Intracomm, local: Callable[[], tuple[Any, ...]], collective: Callable[..., T]
) -> T:
    """Returns collective(*local()), where collective() calls the library. Raises Error on every rank.

    If local() fails on a rank, that rank passes no arguments. The messages of the library itself
    report this on every rank, so that another reduction is needed only after a failure.
    """
    failure: Exception | None = None
    arguments: tuple[Any, ...] = ()
    try:
        arguments = local()
    except Exception as error:  # Whatever fails here must not leave the other ranks alone.
        failure = error
    try:
        return collective(*arguments)
    except Error as error:
        if error.kind != "MPI error":
            dimension = arguments[0].dimension if arguments else 0
            if not agree(comm, failure, dimension):
                raise Error(f"{error}; without points np.empty((0, d))") from error
        raise


def prepare(
    comm: MPI.Intracomm, local: Callable[[], T], signature: Callable[[T], str] | None = None
) -> T:
    """Returns local(). Raises Error on every rank if it fails on one, or if signatures differ.

    Collective: one reduction of three integers.
    """
    communicator(comm)
    failure: Exception | None = None
    number = 0
    try:
        made = local()
        if signature is not None:
            number = zlib.crc32(signature(made).encode())
    except Exception as error:
        failure = error
    if not agree(comm, failure, number) and signature is not None:
        mine = signature(made)
        root = comm.bcast(mine, root=0)
        differs = comm.allgather(mine != root).index(True)
        theirs = comm.bcast(mine, root=differs)
        raise Error(f"{root} on rank 0, but {theirs} on rank {differs}: give the same on every rank")
    return made


def agree(comm: MPI.Intracomm, failure: Exception | None, number: int = 0) -> bool:
    """Returns whether all ranks have the same number. Raises the failure of a rank on every rank.

    Collective: one reduction of three integers.
    """
    size = comm.Get_size()
    failed = 0 if failure is None else size - comm.Get_rank()
    here = np.array([failed, number, -number], dtype=np.int64)
    found = np.empty_like(here)
    comm.Allreduce(here, found, op=MPI.MAX)
    if found[0] > 0:
        raise_together(comm, size - int(found[0]), failure)
    return bool(found[1] == -found[2])


def raise_together(comm: MPI.Intracomm, rank: int, failure: Exception | None) -> None:
    """Raises the Error of a rank on every rank. Collective."""
    text, kind = comm.bcast(describe(failure) if comm.Get_rank() == rank else None, root=rank)
    where = f"rank {rank}: " if comm.Get_size() > 1 else ""
    raise Error(where + text, kind) from failure


def describe(failure: Exception | None) -> tuple[str, str]:
    """Returns the text and the kind of a failure."""
    if isinstance(failure, Error):
        return str(failure), failure.kind
    kind = "out of memory" if isinstance(failure, MemoryError) else "invalid argument"
    return f"{type(failure).__name__}: {failure}", kind
