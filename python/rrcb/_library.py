"""The shared library: where it is, and its functions."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
from ctypes import (
    POINTER,
    Structure,
    c_char_p,
    c_double,
    c_int,
    c_int32,
    c_int64,
    c_size_t,
    c_void_p,
)
from pathlib import Path
from typing import Any

from mpi4py import MPI

__all__: list[str] = []

VERSION = "0.2"  # of the shared library
CODES = ("", "invalid argument", "out of memory", "MPI error", "internal error")


class Error(RuntimeError):
    """Error of the library or of an argument; from a collective call the same on every rank.

    `kind` is "invalid argument", "out of memory", "MPI error" or "internal error".
    """

    def __init__(self, text: str, kind: str = CODES[1]) -> None:
        super().__init__(text)
        self.kind = kind


class Points(Structure):
    """rrcb_points."""

    _fields_ = [
        ("dimension", c_int),
        ("type", c_int),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("axes", c_void_p * 3),
        ("weights", c_void_p),
    ]


class Cuts(Structure):
    """rrcb_cuts."""

    _fields_ = [
        ("dimension", c_int),
        ("num_parts", c_int),
        ("tree", c_void_p),
        ("group_size", c_int),
        ("larger_below", c_int),
        ("dealt", c_int),
    ]


class Report(Structure):
    """rrcb_report."""

    _fields_ = [
        ("imbalance", c_double),
        ("within_tolerance", c_int),
        ("kept", c_int),
        ("num_points", c_int64),
        ("total_weight", c_double),
        ("least_imbalance", c_double),
        ("estimated_imbalance", c_double),
        ("num_records", c_int64),
        ("rounds", c_int),
        ("coincident_cuts", c_int),
        ("all_weights_zero", c_int),
        ("surplus_parts", c_int),
    ]


class Column(Structure):
    """rrcb_column."""

    _fields_ = [
        ("type", c_int),
        ("components", c_size_t),
        ("from_", c_void_p),
        ("to", c_void_p),
    ]


class Plan(Structure):
    """rrcb_plan_lists."""

    _fields_ = [
        ("num_points", c_size_t),
        ("num_points_after", c_size_t),
        ("num_exports", c_size_t),
        ("export_indices", c_void_p),
        ("export_ranks", c_void_p),
        ("export_parts", c_void_p),
        ("num_imports", c_size_t),
        ("import_ranks", c_void_p),
        ("import_indices", c_void_p),
        ("import_parts", c_void_p),
    ]


class GhostOptions(Structure):
    """rrcb_ghost_options."""

    _fields_ = [
        ("radius", c_double),
        ("radii", c_void_p),
        ("lower", c_void_p),
        ("upper", c_void_p),
        ("ranks_of_parts", c_void_p),
        ("num_parts", c_size_t),
        ("needs", c_int),
    ]


class RankCount(Structure):
    """rrcb_rank_count."""

    _fields_ = [("rank", c_int), ("count", c_size_t)]


class RankRange(Structure):
    """rrcb_rank_range."""

    _fields_ = [("first_rank", c_int), ("count", c_int)]


class GhostPlan(Structure):
    """rrcb_ghost_plan."""

    _fields_ = [
        ("num_points", c_size_t),
        ("num_ghosts", c_size_t),
        ("num_send_ranks", c_size_t),
        ("send", POINTER(RankCount)),
        ("num_sent", c_size_t),
        ("send_indices", c_void_p),
        ("num_receive_ranks", c_size_t),
        ("receive", POINTER(RankCount)),
        ("shifts", c_void_p),
    ]


class VerifyOptions(Structure):
    """rrcb_verify_options."""

    _fields_ = [
        ("sample", c_size_t),
        ("radius", c_double),
        ("radii", c_void_p),
        ("num_ids", c_size_t),
        ("ids", c_void_p),
        ("num_ids_before", c_size_t),
        ("ids_before", c_void_p),
    ]


class Verification(Structure):
    """rrcb_verification."""

    _fields_ = [
        ("num_pairs", c_int64),
        ("num_faults", c_int64),
        ("num_missing", c_size_t),
        ("missing", c_void_p),
        ("num_twice", c_size_t),
        ("twice", c_void_p),
        ("num_strangers", c_size_t),
        ("strangers", c_void_p),
    ]


class Address:
    """Argument type of arrays: their address, null if they are empty or None."""

    @staticmethod
    def from_param(values: Any) -> c_void_p | None:
        return c_void_p(values.ctypes.data) if values is not None and values.size else None


HANDLE = POINTER(c_void_p)
FUNCTIONS: dict[str, tuple[Any, ...]] = {
    "create_fortran": (c_int, HANDLE),
    "set": (c_void_p, c_char_p, c_char_p),
    "set_part_sizes": (c_void_p, c_size_t, Address),
    "balance": (c_void_p, POINTER(Points), Address),
    "get_report": (c_void_p, POINTER(Report)),
    "get_cuts": (c_void_p, POINTER(Cuts)),
    "set_cuts": (c_void_p, POINTER(Cuts)),
    "save_cuts": (c_void_p, POINTER(c_void_p), POINTER(c_size_t)),
    "load_cuts": (c_void_p, c_char_p, c_size_t),
    "assign": (c_void_p, POINTER(Points), Address),
    "assign_all": (c_void_p, POINTER(Points), Address),
    "box_of": (c_void_p, c_int32, Address, Address),
    "part_weights": (c_void_p, POINTER(Points), Address, c_size_t, Address),
    "moved_fraction": (c_void_p, POINTER(Points), Address, POINTER(c_double)),
    "remap": (c_void_p, c_size_t, Address, Address, c_void_p, c_size_t, Address, c_void_p),
    "ranks_of_part": (c_int32, c_int, c_int, POINTER(RankRange)),
    "plan": (c_void_p, c_size_t, Address),
    "get_plan": (c_void_p, POINTER(Plan)),
    "transfer": (c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "ghosts_create": (c_void_p, POINTER(Points), POINTER(GhostOptions), HANDLE),
    "ghosts_get_plan": (c_void_p, POINTER(GhostPlan)),
    "ghosts_fetch": (c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "ghosts_reply": (c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "ghosts_accumulate": (c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "ghosts_verify": (c_void_p, POINTER(Points), POINTER(VerifyOptions), POINTER(Verification)),
    "ghosts_apply_shifts": (c_void_p, POINTER(Points)),
    "groups_create": (c_void_p, POINTER(Points), Address, c_int, HANDLE),
    "groups_points": (c_void_p, POINTER(Points)),
    "groups_fetch": (c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "groups_sums": (c_void_p, c_size_t, Address, Address),
    "controller_create_fortran": (c_int, HANDLE),
    "controller_step": (c_void_p, c_double, POINTER(c_int)),
    "controller_step_weight": (c_void_p, c_double, c_double, POINTER(c_int)),
    "controller_due": (c_void_p, POINTER(c_int)),
    "controller_rebalanced": (c_void_p, POINTER(Report), c_double),
    "controller_save": (c_void_p, POINTER(c_void_p), POINTER(c_size_t)),
    "controller_load_fortran": (c_int, c_char_p, c_size_t, HANDLE),
    "cost_model_save": (c_void_p, POINTER(c_void_p), POINTER(c_size_t)),
    "cost_model_load_fortran": (c_int, HANDLE, c_char_p, c_size_t, HANDLE),
    "cost_model_create_fortran": (c_int, HANDLE, c_int, HANDLE),
    "cost_model_step": (c_void_p, c_double, c_size_t, Address),
    "cost_model_weights": (c_void_p, c_size_t, c_size_t, Address, Address),
    "cost_model_costs": (c_void_p, c_size_t, Address),
    "cost_model_uses_costs": (c_void_p, POINTER(c_int)),
}
DESTROYED = tuple(
    handle + "destroy" for handle in ("", "ghosts_", "groups_", "controller_", "cost_model_")
)


class DlInfo(Structure):
    """Dl_info of dladdr()."""

    _fields_ = [
        ("fname", c_char_p),
        ("fbase", c_void_p),
        ("sname", c_char_p),
        ("saddr", c_void_p),
    ]


def file_of(library: ctypes.CDLL, symbol: str) -> str:
    """Returns the file that holds a symbol, as a library or what it links resolves it."""
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
        getattr(library, "rrcb_" + function).argtypes = (c_void_p,)
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
    """Returns the bytes that a function shows."""
    address, size = c_void_p(), c_size_t()
    call(function, handle, ctypes.byref(address), ctypes.byref(size))
    return ctypes.string_at(address, size.value)


class Handle:
    """An object of the library, which is destroyed with this one if that is not collective."""

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
        """Destroys the object; does nothing the second time."""
        if self._as_parameter_ is not None:
            self._destroy(self._as_parameter_)
            self._as_parameter_ = None


class OwnedHandle(Handle):
    """A handle whose destruction is not collective."""

    def __del__(self) -> None:
        self.destroy()
