"""Reads the files that the comparison driver writes; a file that is not there reads as nothing."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

Columns = dict[str, np.ndarray]
Interval = tuple[float, float]  # of 95 %


@dataclass(frozen=True)
class Measurement:
    """One row of table.csv: a method on a workload."""

    method: str
    workload: str
    layout: str
    ranks: int
    points: int
    dimension: int
    time_ms: float
    time_ms_min: float
    time_ms_max: float
    imbalance: float
    lu_percent: float
    messages: int
    bytes: int
    root_bytes_in: int
    collectives: int
    communicators: int
    moved_fraction: float
    time_interval: Interval | None = None
    share: float | None = None  # of Zoltan RCB's time, measured in turns with it
    share_interval: Interval | None = None
    imbalance_interval: Interval | None = None
    worst_lu: float | None = None  # percent, with its sign

    @property
    def point(self) -> float:
        """What one point more in a part adds to the imbalance."""
        return self.ranks / self.points


@dataclass(frozen=True)
class Simulation:
    """One row of simulation.csv: the whole simulation under a method."""

    method: str
    ranks: int
    points: int
    steps: int
    wall: float
    balance: float
    step: float
    mean_imbalance: float
    worst_imbalance: float
    every: int
    path_points: float
    step_path: float
    step_network: float
    balance_path: float
    balance_network: float
    step_work: float = 0.0
    rebalances: int | None = None
    moved_fraction: float | None = None
    gain_kept: float | None = None
    speed_up: float | None = None  # on the critical path
    speed_up_interval: Interval | None = None
    critical_path_interval: Interval | None = None
    wall_interval: Interval | None = None
    imbalance_interval: Interval | None = None

    path_s: float | None = None

    @property
    def critical_path(self) -> float:
        """Seconds that the run would take with a core for every rank; the median of several."""
        if self.path_s is not None:
            return self.path_s
        return self.step_path + self.step_network + self.balance_path + self.balance_network


@dataclass(frozen=True)
class Repeat:
    """A baseline measured twice: second over first."""

    workload: str
    what: str
    ratio: float
    interval: Interval | None


def read_table(directory: Path, name: str = "table.csv") -> list[Measurement]:
    """The methods that did not fail, in the order of the table."""
    return [
        Measurement(
            method=row["method"],
            workload=row["workload"],
            layout=row["layout"],
            ranks=int(row["ranks"]),
            points=int(row["points"]),
            dimension=int(row["dim"]),
            time_ms=float(row["time_ms_median"]),
            time_ms_min=float(row["time_ms_min"]),
            time_ms_max=float(row["time_ms_max"]),
            imbalance=float(row["imbalance"]),
            lu_percent=float(row["lu_max_percent"]),
            messages=int(row["messages"]),
            bytes=int(row["bytes"]),
            root_bytes_in=int(row["root_bytes_in"]),
            collectives=int(row["collectives"]),
            communicators=int(row["communicators"]),
            moved_fraction=float(row["moved_fraction"]),
            time_interval=_interval(row, "time_ms"),
            share=_number(row, "time_vs_zoltan_rcb"),
            share_interval=_interval(row, "time_vs_zoltan_rcb"),
            imbalance_interval=_interval(row, "imbalance"),
            worst_lu=_number(row, "lu_worst_percent"),
        )
        for row in read_rows(directory / name)
        if not row.get("error")
    ]


def read_simulations(directory: Path, name: str = "simulation.csv") -> list[Simulation]:
    """The runs that did not fail."""
    return [
        Simulation(
            method=row["method"],
            ranks=int(row["ranks"]),
            points=int(row["points"]),
            steps=int(row["steps"]),
            wall=float(row["wall_s"]),
            balance=float(row["balance_s"]),
            step=float(row["step_s"]),
            mean_imbalance=float(row["mean_imbalance"]),
            worst_imbalance=float(row["worst_imbalance"]),
            every=int(row["every"]),
            path_points=float(row["path_points"]),
            step_path=float(row["step_path_s"]),
            step_network=float(row["step_network_s"]),
            balance_path=float(row["balance_path_s"]),
            balance_network=float(row["balance_network_s"]),
            step_work=float(row["step_work_s"]),
            rebalances=_whole(row, "rebalances"),
            moved_fraction=_number(row, "moved_fraction"),
            gain_kept=_number(row, "gain_kept"),
            speed_up=_number(row, "speed_up_critical_path"),
            speed_up_interval=_interval(row, "speed_up_critical_path"),
            critical_path_interval=_interval(row, "critical_path_s"),
            wall_interval=_interval(row, "wall_s"),
            imbalance_interval=_interval(row, "mean_imbalance"),
            path_s=_number(row, "critical_path_s"),
        )
        for row in read_rows(directory / name)
        if not row.get("error")
    ]


def read_noise(directory: Path) -> list[Repeat]:
    return [
        Repeat(row["workload"], row["what"], float(row["ratio"]), _interval(row, ""))
        for row in read_rows(directory / "noise.csv")
    ]


def _number(row: dict[str, str], column: str) -> float | None:
    """None where the column is missing, as in the files of an earlier version, or empty."""
    return float(row[column]) if row.get(column) else None


def _whole(row: dict[str, str], column: str) -> int | None:
    return int(float(row[column])) if row.get(column) else None


def _interval(row: dict[str, str], column: str) -> Interval | None:
    low, high = (_number(row, f"{column}_{end}".lstrip("_")) for end in ("low", "high"))
    return None if low is None or high is None else (low, high)


def read_history(directory: Path) -> dict[str, Columns]:
    """Per method, in the order of the file: the columns step, time, part, points and lu_percent."""
    return _histories(read_rows(directory / "history.csv"))


def read_study_history(directory: Path, ranks: int) -> dict[str, Columns]:
    """The same of the paper's settings on so many ranks, which have a file each."""
    return read_histories(directory, f"history_rrcb-sampled_*_{ranks}.csv")


def read_histories(directory: Path, pattern: str) -> dict[str, Columns]:
    """The same of all files of that pattern in data."""
    files = sorted((directory / "data").glob(pattern))
    return _histories([row for file in files for row in read_rows(file)])


def _histories(rows: list[dict[str, str]]) -> dict[str, Columns]:
    names = ("step", "time", "part", "points", "lu_percent")
    return {
        method: {
            name: np.array([float(row[name]) for row in rows if row["method"] == method])
            for name in names
        }
        for method in dict.fromkeys(row["method"] for row in rows)
    }


def read_data(directory: Path, kind: str, *names: str) -> Columns | None:
    """Columns of data/<kind>_<name>_<name>.csv, names as the driver spells them in file names."""
    parts = [re.sub(r"[^A-Za-z0-9._-]", "_", name) for name in names]
    path = directory / "data" / ("_".join([kind, *parts]) + ".csv")
    if not path.exists():
        return None
    with path.open() as file:
        header = file.readline().strip().split(",")
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    if values.size == 0:
        return None
    return {name: values[:, column] for column, name in enumerate(header)}


def unique(values: list[str]) -> list[str]:
    return list(dict.fromkeys(values))


def read_rows(path: Path) -> list[dict[str, str]]:
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return list(csv.DictReader(file))
