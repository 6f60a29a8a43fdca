"""From 2 to 1,048,576 ranks: scaling.py DIRECTORY [--latency-us=1.5] [--bandwidth-gb=12] ...

DIRECTORY holds a folder ranks-<number> with the table.csv and calls.csv of each run. Writes
scaling_check.csv, scaling.csv, scaling.png, report.html and report.md; fails where a formula differs
from what was counted.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import plot
from document import Document, Rows
from machine import add_machine
from matplotlib.figure import Figure
from results import read, write_csv
from scaling_check import Comparison, compare_all, read_counted, read_sizes
from scaling_wide import REGIONS
from scaling_time import CallPath, Machine, Observed, all_paths, observe

Paths = dict[int, dict[str, CallPath]]  # by ranks and method
MOST_RANKS = 1 << 20
LINES = {
    "rrcb, estimate alone": ":", "rrcb, estimate accepted": "-", "rrcb, refined": "-.",
    "rrcb by many, accepted": "-", "rrcb by many, exact": "--",
}  # fmt: skip
PANELS = {
    "time of a call [s]": lambda path: path.seconds,
    "messages one after the other": lambda path: path.messages,
    "bytes into rank 0": lambda path: path.root_bytes,
}


def main() -> int:
    arguments = _read_arguments()
    directory = arguments.directory
    counted = read_counted(directory)
    sizes = read_sizes(directory, counted)
    comparisons = compare_all(counted, sizes)
    if sizes is None or not comparisons:
        print(f"{directory}: no runs of rrcb on two ranks; run comparisons/run --scaling")
        return 2
    machine = Machine(
        arguments.latency_us * 1e-6, arguments.bandwidth_gb * 1e9, arguments.points_per_rank
    )
    observed = observe(counted, sizes, read(directory / "virtual.csv"))
    paths = {
        1 << power: all_paths(1 << power, observed, machine)
        for power in range(1, MOST_RANKS.bit_length())
    }
    write_csv(directory / "scaling_check.csv", (c.numbers for c in comparisons))
    write_csv(directory / "scaling.csv", _path_rows(paths))
    plot.use_style()
    plot.save(_draw(paths), directory / "scaling.png")
    _report(directory, comparisons, paths, _assumptions(machine, observed))
    wrong = [c for c in comparisons if not c.agrees]
    for comparison in wrong:
        print(f"{comparison.counted.method}, {comparison.counted.ranks} ranks: formula differs")
    print(f"Counts of {len(comparisons)} calls checked, {len(wrong)} differ.")
    print(f"Report: {directory / 'report.html'}")
    return 1 if wrong else 0


def _read_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Costs of a call on up to 1,048,576 ranks")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--latency-us", type=number_above_0, default=1.5)
    parser.add_argument("--bandwidth-gb", type=number_above_0, default=12.0)
    parser.add_argument("--points-per-rank", type=whole_number, default=50_000)
    return parser.parse_args()


def number_above_0(text: str) -> float:
    if not 0 < (value := float(text)) < float("inf"):
        raise argparse.ArgumentTypeError("must be a number above 0")
    return value


def whole_number(text: str) -> int:
    if (value := int(text)) < 1:
        raise argparse.ArgumentTypeError("must be a whole number, 1 or more")
    return value


def _path_rows(paths: Paths) -> Iterator[dict]:
    """The rows of scaling.csv."""
    for ranks, by_method in paths.items():
        for method, p in by_method.items():
            numbers = {"model_s": p.seconds, "messages": p.messages, "bytes": p.bytes,
                       "work_s": p.work, "bytes_into_root": p.root_bytes}  # fmt: skip
            texts = {name: f"{number:.6g}" for name, number in numbers.items()}
            yield {"method": method, "ranks": ranks, **texts}


def _draw(paths: Paths) -> Figure:
    figure, grid = plot.panels(1, len(PANELS), 4.1 * len(PANELS), 4)
    for axes, (label, value) in zip(grid[0], PANELS.items()):
        for method in paths[MOST_RANKS]:
            style = plot.method_style(method.split(",")[0])
            line = LINES.get(method, style.line)
            found = {n: value(of[method]) for n, of in paths.items() if method in of}
            axes.plot(list(found), found.values(), color=style.colour, linestyle=line, label=method)
        axes.axvspan(2, 64, color="#EEEEEE", zorder=0, label="counts checked here")
        axes.set_xscale("log", base=16)
        axes.set_yscale("log")
        axes.set_title(label)
        axes.grid(True)
    plot.label_edges(grid, ["ranks"] * len(PANELS), ())
    return plot.legend_above(figure, grid[0, 0], inches=2.1)


def _report(
    directory: Path, comparisons: list[Comparison], paths: Paths, assumptions: list[str]
) -> None:
    document = Document("To a million ranks: a model, checked by counting", directory)
    document.conclude([_sentence(ranks, paths[ranks]) for ranks in (64, 4096, MOST_RANKS)])
    document.picture("scaling.png", "What a call costs by the model; grey: counts checked here.")
    document.summarise("Time of a call by the model", _time_table(paths))
    caption = f"What of it goes where on {MOST_RANKS:,} ranks"
    document.table(caption, _share_table(paths[MOST_RANKS]))
    document.heading("What the model assumes")
    for text in assumptions:
        document.paragraph(text)
    if (directory / "virtual.csv").exists():
        virtual = read(directory / "virtual.csv").astype(str)
        document.table("The search below regions on virtual ranks", virtual.to_dict("records"))
    document.heading("Formula beside count")
    caption = "One call, function by function, summed over the ranks"
    document.table(caption, [comparison.texts for comparison in comparisons])
    add_machine(document, directory / "ranks-2", " ".join(sys.argv[2:]))
    document.write()
    print(document.summary)


def _sentence(ranks: int, by_method: dict[str, CallPath]) -> str:
    text = f"On {ranks:,} ranks the model gives RRCB"
    text += f" {_time(by_method['rrcb, estimate accepted'].seconds)} where its estimate will do"
    for method, name in (
        ("rrcb, refined", "refined to the tolerance"),
        ("rrcb-exact", "exactly balanced"),
        ("rrcb by many, accepted", "made by many ranks to the tolerance"),
        ("rrcb by many, exact", "made by many ranks exactly"),
        ("zoltan-rcb", "Zoltan's RCB"),
        ("zoltan2-mj", "multijagged"),
    ):
        if method in by_method:
            text += f", {name} {_time(by_method[method].seconds)}"
    return text + "."


def _time(seconds: float) -> str:
    return f"{seconds:.3g} s" if seconds >= 0.1 else f"{1e3 * seconds:.3g} ms"


def _time_table(paths: Paths) -> Rows:
    shown = (2, 8, 64, 512, 4096, 32768, 262144, MOST_RANKS)
    def time_of(ranks: int, method: str) -> str:
        return _time(paths[ranks][method].seconds) if method in paths[ranks] else "–"

    return [
        {"ranks": f"{ranks:,}"} | {method: time_of(ranks, method) for method in paths[MOST_RANKS]}
        for ranks in shown
    ]


def _share_table(by_method: dict[str, CallPath]) -> Rows:
    return [
        {
            "method": method,
            "messages": _time(path.messages * path.machine.latency),
            "bytes": _time(path.bytes / path.machine.bandwidth),
            "work": _time(path.work),
            "bytes into rank 0": f"{path.root_bytes / 2**20:,.0f} MiB",
        }
        for method, path in by_method.items()
    ]


def _assumptions(machine: Machine, observed: Observed) -> list[str]:
    return [
        f"Network: {1e6 * machine.latency:g} µs a message, {machine.bandwidth / 1e9:g} GB/s. A"
        " collective takes log2(ranks) messages one after the other and its bytes once (a reduction"
        " to everybody twice); a gather takes all bytes into rank 0.",
        f"{machine.points:,} points a rank in 2-D, a core for every rank;"
        f" {1e9 * machine.per_point:g} ns a point for moments and assignment,"
        f" {1e9 * machine.per_look:g} ns a point and look, {1e9 * machine.per_cell:g} ns a cell.",
        "RRCB: a support mesh of 4 x 4, at most 8,192 cells in a message of the tree, as the automatic mesh keeps to;"
        " with more parts than these no estimate is within a tolerance. Refined: one round a level and"
        " a histogram a cut, as with 20,000 uniform points a rank here; in clusters it was up to 2.5"
        f" and 1.7. Exact: {observed.rounds_per_level} rounds a level,"
        f" {observed.bytes_per_cut:.0f} bytes of records a rank and cut, the most seen here.",
        f"Zoltan's RCB: {observed.iterations:.2f} iterations a median, the mean seen here; half of"
        f" the points move at every level, to one partner; {machine.partners} partners and parts a"
        " rank at the end, as where points hardly move. Points that lie scattered cost far more:"
        " every rank then tells every other of each of its parts.",
        f"Multijagged: {observed.steps:.2f} steps a section, the mean seen here; its sections are"
        " searched one after the other, as they are by default.",
        *_searches_assumed(observed),
        "Contention, memory and the time inside MPI are left out: beyond the ranks of the check"
        " these are no measurements.",
    ]


def _searches_assumed(observed: Observed) -> list[str]:
    if not (observed.to_tolerance and observed.exact):
        return []
    told = [
        f"{name} {of.rounds_per_level:.2f} rounds a level, {of.bytes_per_step:,.0f} bytes in the"
        f" longest message of a step on the average, {of.most_into_rank:,} bytes into a rank in a"
        " round at most"
        for name, of in (("to the tolerance", observed.to_tolerance), ("exact", observed.exact))
    ]
    return [
        f"By many: rank 0 makes {REGIONS} regions, of exact cuts one; below them "
        + "; ".join(told)
        + ", the most of any number of virtual ranks in virtual.csv. A round is 2 log2(ranks)"
        " messages one after the other. Points lie where their parts do. A look at every point a"
        " level, as in the other curves; further rounds count candidates only. rrcb::balance alone:"
        " the plug-in adds five times log2(ranks) messages one after the other where no part gains"
        " by another number, and 41 times log2(ranks) at most."
    ]


if __name__ == "__main__":
    sys.exit(main())
