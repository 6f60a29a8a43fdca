"""Reads the files that rrcb_mpm writes."""

from __future__ import annotations

import base64
import csv
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


def history_of(folder: Path) -> dict[str, np.ndarray]:
    """Returns the columns of history.csv."""
    with (folder / "history.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def points_of(files: list[Path]) -> dict[str, np.ndarray]:
    """Returns the columns of the points of all ranks."""
    pieces = [piece for piece in map(arrays_in, files) if piece["part"].size > 0]
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


def frames_of(folder: Path, name: str) -> list[tuple[float, list[Path]]]:
    """Returns the times of a series, `points` or `boxes`, and the files of each time."""
    frames: dict[float, list[Path]] = {}
    for entry in xml.parse(folder / f"{name}.pvd").getroot().iter("DataSet"):
        frames.setdefault(float(entry.get("timestep")), []).append(folder / entry.get("file"))
    return list(frames.items())
