"""Converts points and columns of numpy to the form that the library takes."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from typing import Any, Callable

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import prepare

Array = np.ndarray[Any, np.dtype[Any]]
FLOATS = {np.dtype(np.float64): 4, np.dtype(np.float32): 3}
BYTES = 5
NUMBERS = {np.dtype(np.int32): 1, np.dtype(np.int64): 2, **FLOATS}


def pointer(values: Array) -> int | None:
    """Returns the address of an array, or None if it is empty."""
    return values.ctypes.data if values.size else None


def copied(address: Any, shape: tuple[int, ...], dtype: Any = np.float64) -> Array:
    """Returns a copy of an array of the library."""
    values = np.empty(shape, dtype=dtype)
    if values.size:
        ctypes.memmove(values.ctypes.data, address, values.nbytes)
    return values


def float_type(values: Array, name: str) -> int:
    """Returns the rrcb_type of coordinates."""
    if values.dtype not in FLOATS:
        fix = "give a tuple of its fields" if values.dtype.names else "call .astype(float)"
        raise c.Error(f"{name} must be float64 or float32, not {values.dtype}: {fix}")
    return FLOATS[values.dtype]


# Device types of DLPack whose memory the host can read: CPU, pinned by CUDA or ROCm, managed.
HOSTS = (1, 3, 11, 13)


def refuse_device(values: Any) -> None:
    """Raises Error for an array in the memory of a device."""
    if isinstance(values, np.ndarray):
        return
    device = getattr(values, "__dlpack_device__", None)
    if hasattr(values, "__cuda_array_interface__") or (device and device()[0] not in HOSTS):
        raise c.Error(
            f"an array of type {type(values).__name__} is on a device, which Python calls cannot "
            "read: copy it to numpy (cupy.asnumpy(x), x.cpu().numpy()), or use rrcb/experimental/kokkos.hpp"
        )


def as_array(values: Any) -> Array:
    """Returns values as an array. Raises Error if they are on a device, or some are masked."""
    refuse_device(values)
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise c.Error("some values are masked: drop them, or call .filled()")
    return np.asarray(values)


def numbers_in(values: Any, name: str) -> Array:
    """Returns values as float64. Raises Error if some are not numbers, or are on a device."""
    refuse_device(values)
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        text = repr(values)
        given = text if len(text) <= 40 else text[:37] + "..."
        raise c.Error(f"{name} must be numbers, not {given}") from None


def axes_of(x: Any) -> list[Array]:
    """Returns an array for each axis of points, given as (n, d), (n,) or a tuple of columns."""
    if isinstance(x, tuple):
        axes = [as_array(axis) for axis in x]
        if not axes or any(axis.ndim != 1 or len(axis) != len(axes[0]) for axis in axes):
            raise c.Error("a tuple of positions must contain 1-D arrays of one length")
    else:
        whole = as_array(x)
        if whole.ndim == 1:
            whole = whole[:, np.newaxis]
        if whole.ndim != 2:
            raise c.Error(f"positions must have the shape (n, d), not {whole.shape}")
        axes = [whole[:, axis] for axis in range(whole.shape[1])]
    if not 1 <= len(axes) <= 3:
        raise c.Error(
            f"positions must have 1 to 3 axes, not {len(axes)}: give (n, d), or a tuple of d columns"
        )
    return axes


def can_borrow(axes: list[Array], item: int) -> bool:
    """Returns whether the library can read the axes in place."""
    stride = axes[0].strides[0]
    return stride >= item and all(
        axis.strides[0] == stride and stride % item == 0 and axis.flags.aligned for axis in axes
    )


class Points:
    """A view of positions and weights, which it keeps alive."""

    def __init__(self, x: Any, weights: Any = None) -> None:
        axes = axes_of(x)
        kind = float_type(axes[0], "positions")
        if any(axis.dtype != axes[0].dtype for axis in axes):
            raise c.Error("a tuple of positions must have one dtype")
        item = axes[0].itemsize
        self.count = len(axes[0])
        if self.count and not can_borrow(axes, item):
            axes = list(np.ascontiguousarray(np.stack(axes)))
        weighed = None if weights is None else weights_of(weights, self.count)
        self._kept = (axes, weighed)
        addresses = [pointer(axis) for axis in axes]
        self._as_parameter_ = ctypes.byref(
            c.Points(
                len(axes),
                kind,
                self.count,
                axes[0].strides[0] if self.count else item,
                tuple(addresses),
                None if weighed is None else pointer(weighed),
            )
        )
        self.dimension = len(axes)


def weights_of(weights: Any, count: int) -> Array:
    """Returns weights in the form that the library takes."""
    values = as_array(weights)
    if values.dtype.kind not in "fiub":
        given = type(weights).__name__ if values.dtype.hasobject else values.dtype
        raise c.Error(f"weights must be numbers, not {given}")
    if values.shape != (count,):
        raise c.Error(f"weights must have the shape ({count},), not {values.shape}")
    return np.ascontiguousarray(values, dtype=np.float64)


Build = Callable[[list[Array]], Any]


def split(data: Any) -> tuple[list[tuple[str, Array]], Build]:
    """Returns the arrays of data with their names, and a function that builds such data from arrays."""
    if isinstance(data, Mapping):
        names = sorted(data, key=str)
        order = list(data)

        def to_dict(arrays: list[Array]) -> Any:
            found = dict(zip(names, arrays))
            return {name: found[name] for name in order}

        return [(str(name), as_array(data[name])) for name in names], to_dict
    if isinstance(data, tuple):
        return [(str(k), as_array(values)) for k, values in enumerate(data)], tuple
    if hasattr(data, "iloc") and hasattr(data, "columns"):
        return split_frame(data)
    if hasattr(data, "to_frame"):  # A Series of pandas.
        columns, to_frame = split_frame(data.to_frame())
        return columns, lambda arrays: to_frame(arrays).iloc[:, 0].rename(data.name)
    return [("data", as_array(data))], lambda arrays: arrays[0]


def numpy_of(name: str, column: Any) -> Array:
    """Returns a column of a DataFrame as an array."""
    if column.dtype.name == "category":
        raise c.Error(f"column {name} is categorical: give its .cat.codes")
    return as_array(column.to_numpy())


def split_frame(frame: Any) -> tuple[list[tuple[str, Array]], Build]:
    """Does as split() for a DataFrame. The index moves with the rows."""
    columns = [(str(name), numpy_of(str(name), frame.iloc[:, k])) for k, name in enumerate(frame)]
    index = frame.index
    values = index.to_numpy()
    # In pandas 1 the index of an empty frame has the dtype object.
    no_type = len(index) == 0 and values.dtype.hasobject
    columns.append(("index", values.astype(np.int64) if no_type else values))

    def to_frame(arrays: list[Array]) -> Any:
        from pandas import Index

        rows = Index(arrays[-1], name=index.name)
        made = type(frame)(dict(enumerate(arrays[:-1])), index=rows)
        made.columns = frame.columns
        return made

    return columns, to_frame


class Columns:
    """Columns to send, with arrays for the rows that arrive."""

    def __init__(self, data: Any, rows: int, of: str, rows_after: int, fill: Any = np.empty) -> None:
        named, self._build = split(data)
        for name, values in named:
            check_column(name, values, rows, of)
        self.names = [name for name, _ in named]
        self.arrays = [np.ascontiguousarray(values) for _, values in named]
        self.results: list[Array] = [
            fill((rows_after, *a.shape[1:]), a.dtype) for a in self.arrays
        ]

    def signature(self) -> str:
        """Returns the names, dtypes and shapes of rows, which must be the same on every rank."""
        texts = [
            f"{name}: {values.dtype}" + (f" {values.shape[1:]}" if values.ndim > 1 else "")
            for name, values in zip(self.names, self.arrays)
        ]
        return ", ".join(texts).removeprefix("data: ") or "no column"

    def result(self) -> Any:
        """Returns the rows that have arrived, in the form of the data."""
        return self._build(self.results)

    def as_bytes(self) -> tuple[int, Any]:
        """Returns the columns in the form that the library moves, with any dtypes."""
        return self._columns([(BYTES, a.itemsize * row_length(a)) for a in self.arrays])

    def as_numbers(self) -> tuple[int, Any]:
        """Returns the columns in the form that the library adds up."""
        return self._columns([(NUMBERS[a.dtype], row_length(a)) for a in self.arrays])

    def as_arrays(self) -> tuple[int, Any]:
        """Returns the results as arrays that the library lengthens or shortens."""
        made = []
        for k, a in enumerate(self.results):
            kind = NUMBERS.get(a.dtype, BYTES)
            size = row_length(a) * (a.itemsize if kind == BYTES else 1)
            if size == 0:
                raise c.Error(f"column {self.names[k]} has rows without values: leave it out")
            made.append(c.Array(kind, size, pointer(a), len(a), 0, self._resize_of(k), None))
        return len(made), (c.Array * len(made))(*made)

    def addresses(self) -> Any:
        """Returns the addresses of the columns."""
        return (ctypes.c_void_p * len(self.arrays))(*map(pointer, self.arrays))

    def _resize_of(self, k: int) -> Any:
        def resize(_: Any, count: int) -> int | None:
            values = self.results[k]
            try:
                values.resize((count, *values.shape[1:]), refcheck=False)
            except MemoryError:
                return None
            return values.ctypes.data

        return c.Resize(resize)

    def _columns(self, types: list[tuple[int, int]]) -> tuple[int, Any]:
        made = [
            c.Column(kind, size, pointer(a), pointer(result))
            for (kind, size), a, result in zip(types, self.arrays, self.results)
            if size > 0
        ]
        return len(made), (c.Column * len(made))(*made)


def move(
    comm: MPI.Intracomm, function: str, own: c.Handle, local: Callable[[], Columns]
) -> Any:
    """Moves the columns of local() by a function of the library. Returns what arrives. Collective."""
    columns = prepare(comm, local, Columns.signature)
    c.call(function, own, *columns.as_bytes(), None)
    return columns.result()


def row_length(values: Array) -> int:
    """Returns the number of values in a row."""
    return int(np.prod(values.shape[1:]))


def check_column(name: str, values: Array, rows: int, of: str) -> None:
    """Raises Error if a column cannot be sent."""
    if values.dtype.hasobject or values.dtype.itemsize == 0:
        raise c.Error(
            f"column {name} has the dtype {values.dtype}; convert it to one of a fixed size"
        )
    if values.ndim == 0 or len(values) != rows:
        raise c.Error(
            f"column {name} has the shape {values.shape}, but there are {rows} {of}: "
            "give a row for each, and several columns as a tuple or dict"
        )
