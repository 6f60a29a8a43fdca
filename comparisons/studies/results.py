"""Reads the files that the comparison driver writes; columns.md describes their columns."""

from __future__ import annotations

import re
from functools import cached_property
from pathlib import Path

import pandas as pd
from simulation import noise, once, summarise

WHOLE = "ranks points dim steps every messages bytes root_bytes_in rebalances".split()


def read_all(path: Path) -> pd.DataFrame:
    """With the rows of failures; no rows where there is no such file."""
    if not path.exists():
        return pd.DataFrame()
    return pd.read_csv(
        path, float_precision="round_trip", keep_default_na=False, na_values=["", "nan", "-nan"]
    )


def read(path: Path) -> pd.DataFrame:
    return sound(read_all(path))


def sound(rows: pd.DataFrame) -> pd.DataFrame:
    """The rows without an error; whole numbers as such, 0 steps between rebalances for auto."""
    if "error" in rows:
        rows = rows[rows["error"].isna()].reset_index(drop=True)
    if "every" in rows:
        rows = rows.assign(every=rows["every"].replace("auto", 0))
    whole = [name for name in WHOLE if name in rows and rows[name].notna().all()]
    return rows.astype(dict.fromkeys(whole, int))


def measurements(rows: pd.DataFrame) -> pd.DataFrame:
    """Adds to rows of the table: time_ms, the median; point, what one point more in a part adds to
    the imbalance; excess, what is above the mean, no less than a point; case, a name for the same
    points on the same ranks."""
    if rows.empty:
        return pd.DataFrame(columns=["method", "layout", "case"])
    rows = rows.rename(columns={"time_ms_median": "time_ms"})
    rows["point"] = rows["ranks"] / rows["points"]
    rows["excess"] = (rows["imbalance"] - 1).clip(lower=rows["point"])
    dimension = rows["dim"].astype(str)
    rows["case"] = rows["workload"] + " " + dimension + "-D " + rows["layout"]
    return rows


class Results:
    """The files of a folder, each read once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @cached_property
    def all_rows(self) -> pd.DataFrame:
        """Every method and workload, with failures."""
        return read_all(self.folder / "table.csv")

    @cached_property
    def table(self) -> pd.DataFrame:
        return measurements(sound(self.all_rows))

    @cached_property
    def turns(self) -> pd.DataFrame:
        """Every timed call."""
        return read(self.folder / "call_times.csv")

    @cached_property
    def all_runs(self) -> pd.DataFrame:
        """Every simulation, with failures and the second ones of none."""
        return read_all(self.folder / "simulation_runs.csv")

    @cached_property
    def rounds(self) -> pd.DataFrame:
        return once(sound(self.all_runs))

    @cached_property
    def summary(self) -> pd.DataFrame:
        """The rows of simulation.csv."""
        return summarise(self.all_runs) if len(self.all_runs) else pd.DataFrame()

    @cached_property
    def runs(self) -> pd.DataFrame:
        """The same without failures."""
        return sound(self.summary)

    @cached_property
    def noise(self) -> pd.DataFrame:
        """The rows of noise.csv."""
        return noise(self.all_runs, self.turns)

    def histories(self) -> dict[str, pd.DataFrame]:
        """The rows of each method in history.csv."""
        rows = read(self.folder / "history.csv")
        return {} if rows.empty else dict(iter(rows.groupby("method", sort=False)))

    def data(self, kind: str, *names: str) -> pd.DataFrame:
        """data/<kind>_<name>_<name>.csv, names as the driver spells them in file names."""
        parts = [re.sub(r"[^A-Za-z0-9._-]", "_", name) for name in names]
        return read(self.folder / "data" / ("_".join([kind, *parts]) + ".csv"))


def cases(rows: pd.DataFrame) -> dict[str, pd.DataFrame]:
    return dict(iter(rows.groupby("case", sort=False)))


def row_of(rows: pd.DataFrame, method: str) -> object | None:
    return next(rows[rows["method"] == method].itertuples(), None)
