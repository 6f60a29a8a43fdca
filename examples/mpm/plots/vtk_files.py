"""Reads the VTK files that rrcb_mpm writes."""

from __future__ import annotations

import base64
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np

TYPES = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}


def arrays_in(path: Path) -> dict[str, np.ndarray]:
    arrays = {}
    for array in xml.parse(path).getroot().iter("DataArray"):
        # The first 8 bytes are the length.
        data = base64.b64decode(array.text.strip())[8:]
        values = np.frombuffer(data, TYPES[array.get("type")])
        width = int(array.get("NumberOfComponents"))
        arrays[array.get("Name")] = values.reshape(-1, width) if width > 1 else values
    return arrays


def points_of(path: Path) -> dict[str, np.ndarray]:
    """Columns of the points of all ranks."""
    pieces = [
        arrays_in(path.parent / piece.get("Source"))
        for piece in xml.parse(path).getroot().iter("Piece")
    ]
    pieces = [piece for piece in pieces if piece["part"].size > 0]
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


def frames_of(folder: Path, name: str) -> list[tuple[float, Path]]:
    """Times and files of a series, `points` or `boxes`."""
    entries = xml.parse(folder / f"{name}.pvd").getroot().iter("DataSet")
    return [(float(entry.get("timestep")), folder / entry.get("file")) for entry in entries]
