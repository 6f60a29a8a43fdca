"""Reads the files and rows that the programs write; columns.md describes the columns."""

from __future__ import annotations

import re
import subprocess
import sys
from functools import cached_property
from io import StringIO
from pathlib import Path

import pandas as pd
from driver import on_ranks
from simulation import noise, once, summarise

WHOLE = "ranks points dim steps every messages bytes root_bytes_in rebalances".split()


def read_all(path: Path) -> pd.DataFrame:
    """Returns all rows of a file, including those of failures; no rows if the file does not exist."""
    if not path.exists():
        return pd.DataFrame()
    return parsed(path)


def parsed(source: Path | StringIO) -> pd.DataFrame:
    return pd.read_csv(source, float_precision="round_trip", keep_default_na=False, na_values=["", "nan", "-nan"])


def printed(ranks: int, program: Path, *words: str, file: Path | None = None) -> pd.DataFrame:
    """Returns the rows that a program prints. They are also written to the file."""
    print(f"{program.name} {' '.join(words)} on {ranks} ranks", file=sys.stderr, flush=True)
    text = on_ranks(ranks, program, *words, stdout=subprocess.PIPE, text=True, check=True).stdout
    if file:
        file.write_text(text)
    return parsed(StringIO(text))


def read(path: Path) -> pd.DataFrame:
    return sound(read_all(path))


def sound(rows: pd.DataFrame) -> pd.DataFrame:
    """Returns the rows without an error. Whole numbers become integers; "auto" becomes 0 steps between rebalances."""
    if "error" in rows:
        rows = rows[rows["error"].isna()].reset_index(drop=True)
    if "every" in rows:
        rows = rows.assign(every=rows["every"].replace("auto", 0))
    whole = [name for name in WHOLE if name in rows and rows[name].notna().all()]
    return rows.astype(dict.fromkeys(whole, int))


def measurements(rows: pd.DataFrame) -> pd.DataFrame:
    """Adds columns to rows of the table. `time_ms` is the median. `point` is what one more point in a part adds to the
    imbalance. `excess` is the excess over the mean, at least that of a point. `case` is a name that is the same for
    the same points on the same ranks."""
    if rows.empty:
        return pd.DataFrame(columns=["method", "layout", "case"])
    rows = rows.rename(columns={"time_ms_median": "time_ms"})
    rows["point"] = rows["ranks"] / rows["points"]
    rows["excess"] = (rows["imbalance"] - 1).clip(lower=rows["point"])
    dimension = rows["dim"].astype(str)
    rows["case"] = rows["workload"] + " " + dimension + "-D " + rows["layout"]
    return rows


class Results:
    """The files of a folder. Each is read once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @cached_property
    def all_rows(self) -> pd.DataFrame:
        """Returns the rows of every method and workload, including failures."""
        return read_all(self.folder / "table.csv")

    @cached_property
    def table(self) -> pd.DataFrame:
        return measurements(sound(self.all_rows))

    @cached_property
    def turns(self) -> pd.DataFrame:
        """Returns the rows of every timed call."""
        return read(self.folder / "call_times.csv")

    @cached_property
    def all_runs(self) -> pd.DataFrame:
        """Returns the rows of every simulation, including failures and repeated measurements."""
        return read_all(self.folder / "simulation_runs.csv")

    @cached_property
    def rounds(self) -> pd.DataFrame:
        return once(sound(self.all_runs))

    @cached_property
    def summary(self) -> pd.DataFrame:
        """Returns the rows of simulation.csv."""
        return summarise(self.all_runs) if len(self.all_runs) else pd.DataFrame()

    @cached_property
    def runs(self) -> pd.DataFrame:
        """Returns the rows of the simulations that did not fail."""
        return sound(self.summary)

    @cached_property
    def noise(self) -> pd.DataFrame:
        """Returns the rows of noise.csv."""
        return noise(self.all_runs, self.turns)

    def histories(self) -> dict[str, pd.DataFrame]:
        """Returns the rows of each method in history.csv."""
        rows = read(self.folder / "history.csv")
        return {} if rows.empty else dict(iter(rows.groupby("method", sort=False)))

    def data(self, kind: str, *names: str) -> pd.DataFrame:
        """Returns the rows of data/<kind>_<name>_<name>.csv. Names are spelt as in the driver's file names."""
        parts = [re.sub(r"[^A-Za-z0-9._-]", "_", name) for name in names]
        return read(self.folder / "data" / ("_".join([kind, *parts]) + ".csv"))


def cases(rows: pd.DataFrame) -> dict[str, pd.DataFrame]:
    return dict(iter(rows.groupby("case", sort=False)))


def row_of(rows: pd.DataFrame, method: str) -> object | None:
    return next(rows[rows["method"] == method].itertuples(), None)
