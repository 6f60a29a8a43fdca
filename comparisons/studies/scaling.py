"""Counts the traffic of a call on 2 to 64 ranks, and models its time on up to a million ranks.

All methods get the same points in the same layout, sorted over the ranks. A few terms are fitted to the counts of each
rank. The search of many ranks is counted on up to a million virtual ranks. Only the times on 2 ranks are measured.
"""

from __future__ import annotations

import shutil
from itertools import combinations, product
from math import ceil, log2, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import plot
from document import Report, write_between
from driver import ROOT, Driver, driver_of, has_multijagged, options
from results import printed, read, row_of

RANKS = (2, 3, 4, 8, 16, 32, 64)
MOST_RANKS = 1 << 20
RANK_TICKS = [1 << power for power in (4, 8, 12, 16, 20)]
COUNTED_POINTS = 5000  # per rank, in the counted calls
CENTRAL_PARTS = 4096  # up to this number rank 0 alone finds the cuts
FIXED_PER_LEVEL = 14  # collectives per level of Zoltan's RCB, without the search for the median
CHILDREN = 7  # per rank in a tree of radix 8
RANK_CELLS, CENTRAL_CELLS = 16, 8192  # cells of a rank, and the largest number passed on
NS_PER_POINT, NS_PER_LOOK, NS_PER_CELL = 20, 2, 50  # moments and assignment; a count; a merge
POINT_BYTES = 16  # in 2-D
TERMS = {"1": lambda p: 1.0, "log": log2, "root": sqrt, "ranks": float, "ranks log": lambda p: p * log2(p)}
ZOLTAN, JAGGED = "zoltan-rcb", "zoltan2-mj"
NAMES = {name: name for name in (ZOLTAN, JAGGED)}  # names of the driver
NAMES |= {name: f"{name}[mesh=4]" for name in ("rrcb", "rrcb-exact")}
LEVELS = ("1", "log")
# The terms that follow from the method; at each level a point moves at most once. All others are chosen by the error.
GROWTHS = {
    ZOLTAN: {"collectives": LEVELS, "messages": LEVELS, "point bytes": LEVELS},
    JAGGED: {"collectives": LEVELS, "messages": ("1",), "point bytes": LEVELS},
    "rrcb": {"collectives": ("1",), "messages": ("1",)},
    "rrcb-exact": {"collectives": ("1",), "messages": LEVELS},
}
AS_GOOD = 2  # times the least error of a fit, which the counts do not tell apart from it
POINTS_BY = {ZOLTAN: "MPI_Rsend", JAGGED: "MPI_Send"}  # the function that moves points
TOLERANCES = {"rrcb": 1.01, "rrcb-exact": 1}  # of the search on virtual ranks


class Machine(NamedTuple):
    latency: float = 1.5e-6  # s, including the overheads at both ends
    bandwidth: float = 12e9  # bytes/s
    points: int = 50_000  # per rank


def count(driver: Driver, points: int) -> None:
    methods = [NAMES[name] for name in NAMES if name != JAGGED or has_multijagged(driver.program)]
    layout = ["--cloud=uniform", "--layout=sorted", "--no-data"]
    for ranks in RANKS[:4] if driver.quick else RANKS:
        driver.run(f"ranks-{ranks}", ranks, methods, *layout, "--repeats=1",
                   f"--points={COUNTED_POINTS * ranks}")  # fmt: skip
    driver.run("clock-2", 2, methods, *layout, "--repeats=6", f"--points={2 * points}")


def search_virtually(driver: Driver) -> None:
    """Writes a row for each search on virtual ranks."""
    free = next(line for line in Path("/proc/meminfo").open() if line.startswith("MemAvailable"))
    numbers = [256, 4096, 65536] + [MOST_RANKS] * (int(free.split()[1]) > 12e6)
    program = driver.program.with_name("rrcb_virtual_ranks")
    rows = [printed(1, program, str(number), str(tolerance))
            for number in (numbers[:1] if driver.quick else numbers) for tolerance in TOLERANCES.values()]  # fmt: skip
    pd.concat(rows).to_csv(driver.out / "virtual.csv", index=False)


def read_counts(out: Path) -> dict[str, pd.DataFrame]:
    """Returns for each method a row for each number of ranks: the counts of each rank, and the bytes received by rank
    0."""
    found: dict[str, list[dict]] = {name: [] for name in NAMES}
    for ranks in RANKS:
        table, calls = (read(out / f"ranks-{ranks}" / name) for name in ("table.csv", "calls.csv"))
        for name, method in NAMES.items() if len(table) else ():
            if (row := row_of(table, method)):
                of = calls[calls["method"] == method].set_index("function")
                found[name].append({"ranks": ranks, **_counts(name, row, of)})
    return {name: pd.DataFrame(rows) for name, rows in found.items() if len(rows) > 2}


def _counts(name: str, row: object, calls: pd.DataFrame) -> dict[str, float]:
    ranks, carrier = row.ranks, POINTS_BY.get(name, "")
    single = calls.index.isin(["MPI_Send", "MPI_Isend", "MPI_Rsend"])
    fixed = (calls["bytes_in"] + calls["bytes_out"])[calls.index != carrier].sum() / ranks
    senders = ranks if carrier else ranks - 1
    return {
        "collectives": calls.loc[~single, "calls"].sum() / ranks,
        "messages": calls["calls"].get(carrier or "MPI_Isend", 0) / senders,
        "bytes": fixed,
        "point bytes": calls["bytes_in"].get(carrier, 0) / ranks / COUNTED_POINTS,
        "root bytes": fixed / 2 if carrier else row.root_bytes_in,  # without points
    }


def fit(counts: pd.DataFrame, column: str, terms: tuple[str, ...]) -> dict[str, float]:
    """Returns the coefficients of the terms, fitted to minimize the relative error."""
    counted = counts[column].to_numpy(float)
    table = np.array([[TERMS[term](ranks) for term in terms] for ranks in counts["ranks"]])
    scale = np.maximum(counted, 1)
    found = np.linalg.lstsq(table / scale[:, None], counted / scale, rcond=None)[0]
    return dict(zip(terms, found))


def fits(name: str, counts: pd.DataFrame, column: str) -> list[dict[str, float]]:
    """Returns the fit with the smallest largest error, and then those that are as good. Fits of bytes have any one or two
    terms with positive coefficients, all others the terms of the method."""
    if terms := GROWTHS[name].get(column):
        return [{term: max(factor, 0) for term, factor in fit(counts, column, terms).items()}]
    found = [fit(counts, column, terms) for number in (1, 2) for terms in combinations(TERMS, number)]
    found = [of for of in found if min(of.values()) >= 0]
    errors = [error_of(of, counts, column) for of in found]
    order = sorted(range(len(found)), key=errors.__getitem__)
    return [found[k] for k in order if errors[k] <= AS_GOOD * errors[order[0]] + 1e-9]


def error_of(coefficients: dict[str, float], counts: pd.DataFrame, column: str) -> float:
    """Returns the largest error relative to its count."""
    pairs = zip(counts["ranks"], counts[column])
    return max(abs(at(coefficients, ranks) - counted) / max(counted, 1) for ranks, counted in pairs)


def at(coefficients: dict[str, float], ranks: int) -> float:
    return sum(factor * TERMS[term](ranks) for term, factor in coefficients.items())


def path(
    name: str, terms: dict[str, dict[str, float]], ranks: int, machine: Machine, virtual: pd.DataFrame
) -> dict:
    """Returns the sequential messages, bytes and work of a call, and its modelled time, by fits of its columns."""
    log = log2(ranks)
    value = {column: at(of, ranks) for column, of in terms.items()}
    collectives, root_bytes, work = terms["collectives"], value["root bytes"], NS_PER_POINT
    # Terms that grow with the levels: each level has half as many ranks.
    messages = log * collectives["1"] + collectives.get("log", 0) * log * (log + 1) / 2
    sizes = value["bytes"] + root_bytes
    if name == ZOLTAN:
        sizes += value["point bytes"] * machine.points
        messages += value["messages"]
        looks = max(1, collectives["log"] - FIXED_PER_LEVEL)
        work = log * (NS_PER_POINT / 2 + NS_PER_LOOK * looks)
    elif name == JAGGED:  # points migrate once, to their parts; each count takes a collective
        sizes += POINT_BYTES * machine.points
        work = 2 * NS_PER_POINT + NS_PER_LOOK * collectives["1"]
    else:
        is_central = ranks <= CENTRAL_PARTS
        most = min(CENTRAL_CELLS, RANK_CELLS * ranks) if is_central else 0  # with many ranks there is none
        climb = [min(most, RANK_CELLS * 8**level) for level in range(ceil(log / 3))]
        cells = CHILDREN * sum(climb) + most * log
        messages += 2 * CHILDREN * len(climb)
        work += NS_PER_LOOK * log * (name == "rrcb-exact" or not is_central)
        work += NS_PER_CELL * cells / machine.points
        if is_central:
            messages += log * value["messages"]
        else:
            of_search, sizes, root_bytes = _search(virtual, TOLERANCES[name], ranks)
            messages += of_search
    work *= 1e-9 * machine.points
    return {"method": name, "ranks": ranks,
            "model_s": machine.latency * messages + sizes / machine.bandwidth + work,
            "messages": messages, "bytes": sizes, "work_s": work,
            "bytes_into_root": root_bytes}  # fmt: skip


def _search(virtual: pd.DataFrame, tolerance: float, ranks: int) -> tuple[float, float, float]:
    """Returns the sequential messages, the sequential bytes and the bytes into a rank: the largest for any number of
    virtual ranks."""
    rows = virtual[virtual["tolerance"] == tolerance]
    steps = log2(ranks)
    rounds = steps * (rows["rounds"] / np.log2(rows["ranks"])).max()
    size = (rows["bytes_in_a_row"] / rows["rounds"] / 2 / np.log2(rows["ranks"])).max()
    into_rank = rounds * rows["most_into_rank"].max()
    return (2 * rounds + 3) * steps, 2 * rounds * steps * size, into_rank


def all_paths(counts: dict[str, pd.DataFrame], machine: Machine, virtual: pd.DataFrame) -> pd.DataFrame:
    """Returns the calls by the best fits. low_s and high_s are the range of the times by all fits that are as good."""
    rows = []
    for name, of in counts.items():
        choices = {column: fits(name, of, column) for column in of.columns[1:]}
        for ranks in (1 << power for power in range(1, MOST_RANKS.bit_length())):
            found = [path(name, dict(zip(choices, terms)), ranks, machine, virtual)
                     for terms in product(*choices.values())]  # fmt: skip
            times = [row["model_s"] for row in found]
            rows.append(found[0] | {"low_s": min(times), "high_s": max(times)})
    return pd.DataFrame(rows)


def draw(paths: pd.DataFrame) -> plot.Figure:
    panels = {"model_s": "modelled time of a call [ms]", "messages": "sequential messages",
              "bytes_into_root": "bytes received by rank 0"}  # fmt: skip
    figure, grid = plot.panels(2, 2, 7.5, 5.8)
    for axes, (column, label) in zip(grid.flat, panels.items()):
        unit = 1e3 if column == "model_s" else 1
        for name, rows in paths.groupby("method", sort=False):
            style = plot.method_style(name)
            axes.plot(rows["ranks"], unit * rows[column], color=style.colour, linestyle=style.line, label=name)
            if column == "model_s":
                axes.fill_between(rows["ranks"], unit * rows["low_s"], unit * rows["high_s"], color=style.colour,
                                  alpha=0.15, linewidth=0)  # fmt: skip
        axes.axvspan(2, RANKS[-1], color="#EEEEEE", zorder=0, label="counted here")
        axes.axvline(CENTRAL_PARTS, color="#BBBBBB", linewidth=0.8,
                     label="RRCB: rank 0 to the left,\nmany ranks to the right")  # fmt: skip
        axes.set_xscale("log", base=16)
        axes.set_yscale("log")
        axes.set_xticks(RANK_TICKS, [f"{ranks:,}" for ranks in RANK_TICKS])
        axes.minorticks_off()
        axes.set_title(label)
        axes.set_xlabel("ranks")
        axes.grid(True)
    grid[1, 1].axis("off")
    grid[1, 1].legend(*grid[0, 0].get_legend_handles_labels(), loc="center left", fontsize=10)
    return figure


def fit_errors(counts: dict[str, pd.DataFrame]) -> pd.DataFrame:
    """Returns how much fits without the largest number of ranks miss the counts on it, and the terms of bytes."""
    rows = []
    for name, of in counts.items():
        last, row = of.iloc[-1], {"method": name}
        for column in ("collectives", "bytes", "root bytes"):
            errors = [at(each, last["ranks"]) / last[column] - 1 for each in fits(name, of[:-1], column)]
            row[column] = f"{min(errors):+.0%} to {max(errors):+.0%}" if len(errors) > 1 else f"{errors[0]:+.0%}"
        rows.append(row | {"terms of the bytes": "; ".join(" + ".join(of) for of in fits(name, of, "bytes"))})
    return pd.DataFrame(rows)


def time_table(paths: pd.DataFrame) -> list[list[str]]:
    """Returns the table of the page: modelled times in ms, and their ranges."""
    by = paths.set_index(["ranks", "method"])
    names = [name for name in ("rrcb", "rrcb-exact", ZOLTAN, JAGGED) if name in set(paths["method"])]
    lines = [["ranks", "who finds RRCB's cuts", *(f"`{name}`, ms" for name in names)]]
    for ranks in (64, CENTRAL_PARTS, 2 * CENTRAL_PARTS, MOST_RANKS):
        line = [f"{ranks:,}", "rank 0" if ranks <= CENTRAL_PARTS else "many ranks"]
        for name in names:
            model, low, high = (f"{float(f'{1e3 * by.loc[(ranks, name), of]:.2g}'):,g}" for of in ("model_s", "low_s", "high_s"))
            line.append(model if low == high else f"{model} [{low}, {high}]")
        lines.append(line)
    return lines


def report(out: Path, counts: dict[str, pd.DataFrame], paths: pd.DataFrame) -> None:
    times = 1e3 * paths.pivot(index="ranks", columns="method", values="model_s")
    clock = read(out / "clock-2/table.csv").set_index("method")["time_ms_median"]
    pairs = [(m, f"{times.loc[2, m]:.2f}", f"{clock[NAMES[m]]:.2f}") for m in times]
    by_ranks = times[::3].apply(lambda of: of.map("{:.3g}".format)).reset_index().astype(str)
    tables = {
        "Modelled time of a call, ms": by_ranks,
        "The model and a clock: 2 ranks of one machine, lists included":
            pd.DataFrame(pairs, columns=["method", "model ms", "clock ms"]),
        "A fit without the most ranks, compared with the counts on these": fit_errors(counts),
    }  # fmt: skip
    found = Report("To a million ranks: counts and a model", out)
    found.picture("scaling.png", "A call by the model; grey: counted here.")
    for caption, rows in tables.items():
        found.table(caption, rows, is_shown=True)
    found.write(out / "ranks-2/run.txt")


def main() -> None:
    parser = options("scaling", __doc__, "up to 8 ranks", "comparisons/scaling")
    parser.add_argument("--latency-us", type=float, default=1.5)
    parser.add_argument("--bandwidth-gb", type=float, default=12.0)
    parser.add_argument("--points-per-rank", type=int, default=50_000)
    parser.add_argument("--page", action="store_true", help="write the table and the picture of docs/performance.md")
    given = parser.parse_args()
    if not min(given.latency_us, given.bandwidth_gb, given.points_per_rank) > 0:
        parser.error("latency, bandwidth and points must be above 0")
    count(driver := driver_of(given, "rrcb_virtual_ranks", multijagged=True), given.points_per_rank)
    search_virtually(driver)
    machine = Machine(given.latency_us * 1e-6, given.bandwidth_gb * 1e9, given.points_per_rank)
    counts = read_counts(given.out)
    paths = all_paths(counts, machine, read(given.out / "virtual.csv"))
    paths.to_csv(given.out / "scaling.csv", index=False)
    plot.use_style()
    plot.save(draw(paths), given.out / "scaling.png")
    report(given.out, counts, paths)
    if given.page:
        write_between(ROOT / "docs/performance.md", "times", time_table(paths))
        shutil.copy(given.out / "scaling.png", ROOT / "docs/figures")


if __name__ == "__main__":
    main()
