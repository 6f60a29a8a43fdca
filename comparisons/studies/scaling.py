"""Counts what a call moves on 2 to 64 ranks, and models its time on up to a million:
comparisons/scaling [--points-per-rank=50000] [--latency-us=1.5] [--bandwidth-gb=12].

All methods get the same points in the same layout, sorted over the ranks. Counts for each rank are
fitted by a few terms in log2(ranks); of cuts made by many ranks the search is counted on up to a
million virtual ranks. No time here is measured except that on 2 ranks.
"""

from __future__ import annotations

import argparse
import io
import subprocess
import sys
from dataclasses import dataclass, field
from math import log2, sqrt
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import numpy as np
import pandas as pd
import plot
from document import Document
from driver import COMPARE, ROOT, Driver
from machine import add_machine
from results import read, row_of, write_csv

RANKS = (2, 3, 4, 8, 16, 32, 64)
MOST_RANKS = 1 << 20
COUNTED_POINTS = 5000  # a rank, of the counted calls
CENTRAL_PARTS = 4096  # as many as rank 0 makes alone
MIGRATES_FROM = 1_500_000 ** (2 / 3)  # ranks: multijagged's cut-off of ranks^1.5 numbers
FIXED_PER_LEVEL = 14  # collectives of a level of Zoltan's RCB besides the search for its median
TREE_MESSAGES = 7 / 3  # one after the other, for each level of a tree of radix 8, over log2
NS_PER_POINT, NS_PER_LOOK = 20, 2  # moments and assignment; a look at a point
TERMS = {"1": lambda p: 1.0, "log": log2, "root": sqrt, "ranks": float, "ranks^1.5": lambda p: p**1.5}
SEARCHES = {"rrcb by many": 1.01, "rrcb-exact by many": 1}  # and the tolerance of virtual.csv


@dataclass(frozen=True)
class Growth:
    """The driver's name of a method, and the terms by which counts for each rank grow."""

    driver_name: str
    collectives: tuple[str, ...] = ("1",)
    messages: tuple[str, ...] = ("1",)  # to single ranks
    bytes: tuple[str, ...] = ("1", "log", "ranks")


METHODS = {
    "rrcb": Growth("rrcb[mesh=4]"),
    "rrcb-exact": Growth("rrcb-exact[mesh=4]", messages=("1", "log")),
    "rrcb by many": Growth("rrcb-arrays[mesh=4,central=2]"),
    "rrcb-exact by many": Growth("rrcb-arrays[mesh=4,refine=exact,central=2]"),
    "zoltan-rcb": Growth("zoltan-rcb", ("1", "log"), ("1", "log")),
    "zoltan2-mj": Growth("zoltan2-mj", ("1", "root"), bytes=("1", "root", "ranks^1.5")),
}


@dataclass
class Counts:
    """Of one method on each number of ranks: for each rank, and into rank 0."""

    growth: Growth
    ranks: list[int] = field(default_factory=list)
    values: dict[str, list[float]] = field(default_factory=dict)

    def add(self, ranks: int, **values: float) -> None:
        self.ranks.append(ranks)
        for name, value in values.items():
            self.values.setdefault(name, []).append(value)

    def terms(self, name: str, most: int = RANKS[-1]) -> dict[str, float]:
        """Coefficients of the terms; fitted to the relative error, of up to `most` ranks."""
        chosen = self.growth.bytes if "bytes" in name else getattr(self.growth, name)
        rows = [i for i, ranks in enumerate(self.ranks) if ranks <= most]
        counted = np.array([self.values[name][i] for i in rows])
        table = np.array([[TERMS[term](self.ranks[i]) for term in chosen] for i in rows])
        scale = np.maximum(counted, 1)[:, None]
        found = np.linalg.lstsq(table / scale, counted / scale[:, 0], rcond=None)[0]
        return dict(zip(chosen, np.maximum(found, 0)))

    def at(self, name: str, ranks: int, most: int = RANKS[-1]) -> float:
        return sum(c * TERMS[term](ranks) for term, c in self.terms(name, most).items())


@dataclass(frozen=True)
class Machine:
    latency: float  # s, overheads of both ends included
    bandwidth: float  # bytes/s
    points: int  # of a rank


def count(driver: Driver, multijagged: bool, points: int) -> None:
    methods = [g.driver_name for name, g in METHODS.items() if name != "zoltan2-mj" or multijagged]
    layout = ["--cloud=uniform", "--layout=sorted", "--no-data"]
    for ranks in RANKS[:4] if driver.quick else RANKS:
        driver.run(f"ranks-{ranks}", ranks, methods, *layout, "--repeats=1",
                   f"--points={COUNTED_POINTS * ranks}")  # fmt: skip
    driver.run("clock-2", 2, methods, *layout, "--repeats=7", f"--points={2 * points}")


def search_virtually(driver: Driver) -> None:
    """Rows of the search on virtual ranks, whose points lie in the part of the same number."""
    program = driver.program.parent / "rrcb_virtual_ranks"
    free = 12e9 < _memory_available()
    numbers = [256] if driver.quick else [256, 4096, 65536] + [MOST_RANKS] * free
    rows = []
    for number in numbers:
        for tolerance in ("1.01", "1"):
            print(f"Searching cuts of {number} virtual ranks", file=sys.stderr, flush=True)
            command = [str(program), str(number), "by_part", tolerance, "8"]
            found = subprocess.run(command, capture_output=True, text=True, check=True)
            rows.append(pd.read_csv(io.StringIO(found.stdout)))
    pd.concat(rows).to_csv(driver.out / "virtual.csv", index=False)


def _memory_available() -> float:
    lines = Path("/proc/meminfo").read_text().splitlines()
    return next(1024.0 * int(line.split()[1]) for line in lines if line.startswith("MemAvailable"))


def read_counts(out: Path) -> dict[str, Counts]:
    found = {name: Counts(growth) for name, growth in METHODS.items()}
    for ranks in RANKS:
        table, calls = (read(out / f"ranks-{ranks}" / name) for name in ("table.csv", "calls.csv"))
        for counts in found.values() if len(table) else ():
            method = counts.growth.driver_name
            if (row := row_of(table, method)) is None:
                continue
            of = calls[calls["method"] == method].set_index("function")
            single = of.index.isin(["MPI_Send", "MPI_Isend", "MPI_Rsend"])
            counts.add(
                ranks,
                collectives=of.loc[~single, "calls"].sum() / ranks,
                messages=of["calls"].get("MPI_Isend" if "rrcb" in method else "MPI_Rsend", 0)
                / (ranks - 1 if "many" not in method else ranks),
                fixed_bytes=(of["bytes_in"] + of["bytes_out"])[of.index != "MPI_Rsend"].sum() / ranks,
                point_bytes=of["bytes_in"].get("MPI_Rsend", 0) / ranks / COUNTED_POINTS,
                root_bytes=row.root_bytes_in - of["bytes_in"].get("MPI_Rsend", 0) / ranks,
            )
    return {name: counts for name, counts in found.items() if len(counts.ranks) > 2}


def path(name: str, counts: Counts, ranks: int, machine: Machine, virtual: pd.DataFrame) -> dict:
    """What a call on so many ranks does one after the other, and its modelled time."""
    log = log2(ranks)
    collectives = counts.terms("collectives")
    messages = log * collectives["1"] + collectives.get("log", 0) * log * (log + 1) / 2
    root_bytes = max(0.0, counts.at("root_bytes", ranks))
    sizes = counts.at("fixed_bytes", ranks) + root_bytes
    sizes += counts.at("point_bytes", ranks) * machine.points
    work = NS_PER_POINT
    if name in SEARCHES:
        search = _search(virtual, SEARCHES[name], ranks)
        messages += TREE_MESSAGES * 2 * log + search["messages"]
        sizes, root_bytes = search["bytes"], search["into_rank"]
        work += NS_PER_LOOK * log
    elif name.startswith("rrcb"):
        messages += TREE_MESSAGES * 2 * log + log * counts.at("messages", ranks)
        work += NS_PER_LOOK * log * (name == "rrcb-exact")
    elif name == "zoltan-rcb":
        messages += counts.at("messages", ranks)
        work = log * (NS_PER_POINT / 2 + NS_PER_LOOK * max(1, collectives["log"] - FIXED_PER_LEVEL))
    else:
        steps = collectives["root"]
        if ranks <= MIGRATES_FROM:
            messages += log * steps * sqrt(ranks)
        else:  # the second axis in groups of sqrt(ranks), which search at once
            messages += 1.5 * log * steps + 4 * log
            sizes += 16 * machine.points
        work = 2 * (NS_PER_POINT + NS_PER_LOOK * steps)
    seconds = machine.latency * messages + sizes / machine.bandwidth + 1e-9 * work * machine.points
    return {"method": name, "ranks": ranks, "model_s": seconds, "messages": messages,
            "bytes": sizes, "work_s": 1e-9 * work * machine.points, "bytes_into_root": root_bytes}  # fmt: skip


def _search(virtual: pd.DataFrame, tolerance: float, ranks: int) -> dict[str, float]:
    """The most for each level and step of any number of virtual ranks."""
    rows = virtual[virtual["tolerance"] == tolerance]
    below = np.log2(rows["ranks"]) - (6 if tolerance > 1 else 0)  # rank 0 makes 64 regions
    steps, levels = log2(ranks), log2(ranks) - (6 if tolerance > 1 else 0)
    rounds = (rows["rounds"] / below).max() * levels
    size = (rows["bytes_in_a_row"] / rows["rounds"] / 2 / np.log2(rows["ranks"])).max()
    return {"messages": (2 * rounds + 3) * steps, "bytes": 2 * rounds * steps * size,
            "into_rank": rounds * rows["most_into_rank"].max()}  # fmt: skip


def all_paths(counts: dict[str, Counts], machine: Machine, virtual: pd.DataFrame) -> pd.DataFrame:
    rows = []
    for name, of in counts.items():
        for power in range(1, MOST_RANKS.bit_length()):
            ranks = 1 << power
            if (name in SEARCHES) == (ranks > CENTRAL_PARTS) or "rrcb" not in name:
                if name not in SEARCHES or len(virtual):
                    rows.append(path(name, of, ranks, machine, virtual))
    return pd.DataFrame(rows)


def draw(paths: pd.DataFrame) -> plot.Figure:
    panels = {"model_s": "modelled time of a call [s]", "messages": "messages one after the other",
              "bytes_into_root": "bytes into rank 0"}  # fmt: skip
    figure, grid = plot.panels(1, len(panels), 12.3, 4)
    for axes, (column, label) in zip(grid[0], panels.items()):
        for name, rows in paths.groupby("method", sort=False):
            style, dashes = plot.method_style(name.split()[0]), "-" if name in SEARCHES else "--"
            axes.plot(rows["ranks"], rows[column], color=style.colour, linestyle=dashes, label=name)
        axes.axvspan(2, RANKS[-1], color="#EEEEEE", zorder=0, label="counted here")
        axes.set_xscale("log", base=16)
        axes.set_yscale("log")
        axes.set_title(label)
        axes.grid(True)
    plot.label_edges(grid, ["ranks"] * len(panels), ())
    return plot.legend_above(figure, grid[0, 0], inches=2.1)


def fit_errors(counts: dict[str, Counts]) -> list[dict[str, str]]:
    """How far a fit without the largest number of ranks misses the counts on it."""
    rows = []
    for name, of in counts.items():
        last, errors = of.ranks[-1], {}
        for what in ("collectives", "messages", "fixed_bytes", "root_bytes"):
            counted = max(of.values[what][-1], 1)
            errors[what.replace("_", " ")] = f"{of.at(what, last, last - 1) / counted - 1:+.0%}"
        rows.append({"method": name, **errors})
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(prog="comparisons/scaling", description=__doc__.split(":")[0])
    parser.add_argument("--out", type=Path, default=ROOT / "comparisons/out/scaling")
    parser.add_argument("--latency-us", type=_above_0, default=1.5)
    parser.add_argument("--bandwidth-gb", type=_above_0, default=12.0)
    parser.add_argument("--points-per-rank", type=lambda t: int(_above_0(t)), default=50_000)
    parser.add_argument("--quick", action="store_true", help="up to 8 ranks")
    parser.add_argument("--driver", type=Path, default=COMPARE, help="the program to run")
    arguments = parser.parse_args()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    driver = Driver(out, arguments.driver, arguments.quick)
    help_text = subprocess.run([str(driver.program), "--help"], capture_output=True, text=True)
    count(driver, "zoltan2-mj" in help_text.stdout, arguments.points_per_rank)
    search_virtually(driver)
    machine = Machine(arguments.latency_us * 1e-6, arguments.bandwidth_gb * 1e9,
                      arguments.points_per_rank)  # fmt: skip
    counts, virtual = read_counts(out), read(out / "virtual.csv")
    paths = all_paths(counts, machine, virtual)
    write_csv(out / "scaling.csv", paths.to_dict("records"))
    plot.use_style()
    plot.save(draw(paths), out / "scaling.png")
    report(out, counts, paths, virtual)
    return 0


def _above_0(text: str) -> float:
    if not 0 < (value := float(text)) < float("inf"):
        raise argparse.ArgumentTypeError("must be a number above 0")
    return value


def report(out: Path, counts: dict[str, Counts], paths: pd.DataFrame, virtual: pd.DataFrame) -> None:
    document = Document("To a million ranks: counts and a model", out)
    document.picture("scaling.png", "A call by the model; grey: counted here.")
    table = (1e3 * paths.set_index("ranks").pivot(columns="method")["model_s"]).loc[::3]
    rows = [
        {"ranks": f"{ranks:,}", **{m: "–" if np.isnan(t) else f"{t:.3g}" for m, t in row.items()}}
        for ranks, row in table.iterrows()
    ]
    document.summarise("Modelled time of a call, ms", rows)
    clock = read(out / "clock-2/table.csv")
    two = paths[paths["ranks"] == 2].set_index("method")["model_s"]
    rows = [
        {"method": name, "model ms": f"{1e3 * two[name]:.2f}",
         "clock ms": f"{row_of(clock, METHODS[name].driver_name).time_ms_median:.2f}"}
        for name in two.index
    ]  # fmt: skip
    document.summarise("The model against a clock: 2 ranks of one machine, lists included", rows)
    caption = "A fit to the counts on fewer ranks against the counts on the most"
    document.summarise(caption, fit_errors(counts))
    document.table("The search on virtual ranks", virtual.astype(str).to_dict("records"))
    add_machine(document, out / "ranks-2", " ".join(sys.argv[1:]))
    document.write()
    print(document.summary)
    print(f"Report: {out / 'report.html'}")


if __name__ == "__main__":
    sys.exit(main())
