"""The few functions of rrcb.h that the hosts in Python need, by ctypes; RRCB_LIBRARY is its path."""

from __future__ import annotations

import ctypes
import os

import numpy as np


class Points(ctypes.Structure):
    """rrcb_points."""

    _fields_ = [("dimension", ctypes.c_int), ("type", ctypes.c_int), ("count", ctypes.c_size_t),
                ("stride", ctypes.c_size_t), ("axes", ctypes.c_void_p * 3),
                ("weights", ctypes.c_void_p)]


DOUBLE = 4


class Balancer:
    """Balances points, (n, d) doubles; from the second call on from its cuts."""

    def __init__(self, comm, **options: str) -> None:
        self.library = ctypes.CDLL(os.environ["RRCB_LIBRARY"])
        self.handle = ctypes.c_void_p()
        self.call("rrcb_create_fortran", comm.py2f(), ctypes.byref(self.handle))
        for name, value in options.items():
            self.call("rrcb_set", self.handle, name.encode(), value.encode())
        self.name = "rrcb_balance"

    def call(self, name: str, *arguments) -> None:
        if getattr(self.library, name)(*arguments) != 0:
            raise RuntimeError(f"{name} fails")

    def parts_of(self, x: np.ndarray) -> np.ndarray:
        x = np.ascontiguousarray(x)
        parts = np.empty(len(x), np.int32)
        axes = [x.ctypes.data + 8 * axis for axis in range(x.shape[1])]
        points = Points(x.shape[1], DOUBLE, len(x), 8 * x.shape[1], (ctypes.c_void_p * 3)(*axes))
        self.call(self.name, self.handle, ctypes.byref(points), ctypes.c_void_p(parts.ctypes.data))
        self.name = "rrcb_rebalance"
        return parts

    def boxes(self, num_parts: int, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
        """The regions within a box, (parts, 2, 3)."""
        corners = np.empty((num_parts, 2, 3))
        for part, (low, high) in enumerate(corners):
            self.call("rrcb_box_of", self.handle, part, ctypes.c_void_p(low.ctypes.data),
                      ctypes.c_void_p(high.ctypes.data))
        return np.clip(corners, lower, upper)
