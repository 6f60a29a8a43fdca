"""Finds and loads the shared library, and declares its functions."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import re
from ctypes import Structure, c_char_p, c_int, c_size_t, c_void_p
from pathlib import Path
from typing import Any

from mpi4py import MPI

from ._interface import (
    DESTROYED,
    FUNCTIONS,
    HANDLE,
    Array as Array,
    Column as Column,
    Cuts as Cuts,
    GhostOptions as GhostOptions,
    GhostPlan as GhostPlan,
    NeighbourOptions as NeighbourOptions,
    Plan as Plan,
    Points as Points,
    RankCount as RankCount,
    RankRange as RankRange,
    Report as Report,
    Resize as Resize,
    SharedEntries as SharedEntries,
    Verification as Verification,
    VerifyOptions as VerifyOptions,
    members,
)

__all__: list[str] = []

VERSION = "1"  # of the shared library
CODES = ("", "invalid argument", "out of memory", "MPI error", "internal error")


class Error(RuntimeError):
    """Error of the library or of an argument. A collective call raises the same on every rank.

    `kind` is "invalid argument", "out of memory", "MPI error" or "internal error".
    """

    def __init__(self, text: str, kind: str = CODES[1]) -> None:
        super().__init__(text)
        self.kind = kind


class DlInfo(Structure):
    """Dl_info of dladdr()."""

    _fields_ = members(fname=c_char_p, fbase=c_void_p, sname=c_char_p, saddr=c_void_p)


def file_of(library: ctypes.CDLL, symbol: str) -> str:
    """Returns the file that contains a symbol, as resolved by a library and those that it links."""
    info = DlInfo()
    address = ctypes.cast(getattr(library, symbol), c_void_p)
    ctypes.CDLL(None).dladdr(address, ctypes.byref(info))
    return os.path.realpath((info.fname or b"").decode())


def mpi_abi(mpi: ctypes.CDLL) -> str:
    """Returns the ABI of the MPI that mpi4py has loaded: mpiabi, openmpi or mpich."""
    try:
        major, minor = c_int(-1), c_int(-1)
        mpi.MPI_Abi_get_version(ctypes.byref(major), ctypes.byref(minor))
        if major.value > 0:
            return "mpiabi"
    except AttributeError:
        pass
    return "openmpi" if hasattr(mpi, "ompi_mpi_comm_self") else "mpich"


def candidates(abi: str) -> list[str]:
    """Returns the names to load, in order."""
    chosen = os.environ.get("RRCB_LIBRARY")
    if chosen:
        return [chosen]
    bundled = Path(__file__).parent / f"librrcb.{abi}.so"
    built = Path(__file__).parent / "librrcb.so"
    files = [str(file) for file in (bundled, built) if file.exists()]
    return files + [f"librrcb.so.{VERSION}", ctypes.util.find_library("rrcb") or "librrcb.so"]


def require_same_mpi(library: ctypes.CDLL, name: str, mpi: ctypes.CDLL) -> None:
    """Raises ImportError if the library and mpi4py have loaded different MPIs."""
    theirs, ours = file_of(mpi, "MPI_Comm_rank"), file_of(library, "MPI_Comm_rank")
    if theirs != ours:
        raise ImportError(
            f"mpi4py uses the MPI in {theirs}, but {name} uses the one in {ours}: "
            "set RRCB_LIBRARY to a librrcb that was built with mpi4py's MPI"
        )


def load() -> ctypes.CDLL:
    """Loads the library and declares its functions."""
    mpi = ctypes.CDLL(MPI.__file__)
    abi = mpi_abi(mpi)
    failures = []
    for name in candidates(abi):
        try:
            library = ctypes.CDLL(name)
        except OSError as error:
            failures.append(str(error))
            continue
        require_same_mpi(library, name, mpi)
        declare(library)
        version = text(library.rrcb_version())
        if not version.startswith(VERSION + "."):
            raise ImportError(f"{name} has the version {version}, but this package needs {VERSION}")
        return library
    raise ImportError(
        f"no librrcb for mpi4py's MPI ({abi}); install one or set RRCB_LIBRARY to its path: "
        + "; ".join(failures)
    )


def declare(library: ctypes.CDLL) -> None:
    """Declares arguments and results of the functions."""
    for function, arguments in FUNCTIONS.items():
        getattr(library, "rrcb_" + function).argtypes = arguments
    for function in DESTROYED:
        getattr(library, "rrcb_" + function).argtypes = (HANDLE,)
        getattr(library, "rrcb_" + function).restype = None
    for function in ("last_error", "version", "build_info", "cost_model_report"):
        getattr(library, "rrcb_" + function).restype = c_char_p
    library.rrcb_cost_model_report.argtypes = (c_void_p,)


def text(value: bytes | None) -> str:
    """Returns the text of a C string."""
    return (value or b"").decode(errors="replace")


library = load()


def call(function: str, *arguments: Any) -> None:
    """Calls a function of the library; raises Error unless it returns 0."""
    for argument in arguments:
        if isinstance(argument, Handle):
            argument.require_alive()
    code = getattr(library, "rrcb_" + function)(*arguments)
    if code:
        raise Error(text(library.rrcb_last_error()), CODES[min(code, len(CODES) - 1)])


def saved(function: str, handle: Handle) -> bytes:
    """Returns the bytes to which a function of the library points."""
    address, size = c_void_p(), c_size_t()
    call(function, handle, ctypes.byref(address), ctypes.byref(size))
    return ctypes.string_at(address, size.value)


class Handle:
    """An object of the library. It is destroyed with this one, unless that is collective."""

    def __init__(self, create: str, destroy: str, *arguments: Any) -> None:
        self._as_parameter_: c_void_p | None = None
        self._name = destroy.replace("_destroy", "").replace("_", " ")
        self._destroy = getattr(library, "rrcb_" + destroy)
        made = c_void_p()
        call(create, *arguments, ctypes.byref(made))
        self._as_parameter_ = made

    def require_alive(self) -> None:
        """Raises Error if the object was destroyed."""
        if self._as_parameter_ is None:
            raise Error(f"the {self._name} was freed: make another")

    def destroy(self) -> None:
        """Destroys the object. Does nothing when called again."""
        if self._as_parameter_ is not None:
            self._destroy(ctypes.byref(self._as_parameter_))
            self._as_parameter_ = None


class OwnedHandle(Handle):
    """A handle whose destruction is not collective."""

    def __del__(self) -> None:
        self.destroy()
