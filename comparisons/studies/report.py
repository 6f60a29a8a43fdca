"""Draws and reports a run: report.py DIRECTORY, where the driver wrote its files, makes the
pictures, report.html and report.md.

report.html holds its pictures; report.md names them. A picture whose data is not there is left out,
and removed if an earlier run drew it.
"""

from __future__ import annotations

import sys
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import pandas as pd
import plot
from document import Document
from headline import headline, work_paragraph
from history import draw_history
from machine import CORES, add_machine, busy_warning, shared_cores
from moving_boxes import draw_moving_boxes
from parts import draw_parts
from price import draw_price
from results import Results, cases
from tables import ghost_table, method_table, noise_table, simulation_table

CSV = {"summary": "simulation.csv", "noise": "noise.csv"}  # of each what it is called here

# Their captions are the docstrings of what draws them.
PICTURES = {
    "price.png": draw_price,
    "parts.png": draw_parts,
    "moving_boxes.png": draw_moving_boxes,
    "unbalance_history.png": draw_history,
}


def main() -> int:
    if len(sys.argv) != 2 or not (directory := Path(sys.argv[1])).is_dir():
        print("usage: report.py DIRECTORY (with the files of a comparison)", file=sys.stderr)
        return 2
    results = Results(directory)
    for name in ("summary", "noise"):
        if len(rows := getattr(results, name)):
            rows.to_csv(directory / CSV[name], index=False)
    draw(results)
    arguments = results.record.get("arguments", "")
    document = comparison_report(results)
    add_machine(document, directory, arguments)
    document.paragraph(
        "imbalance: heaviest part / mean part. Lu: (ideal − actual) / ideal of a part, below 0 where"
        " it is too heavy. time: slowest rank, median of the repeats. times as fast: Zoltan RCB's"
        " time / this method's. bytes and"
        " messages: of one call over all ranks. into root: bytes that rank 0 receives."
        " moved: weight that changes rank. ghosts: copies of points that parts need from others; a"
        " point counts once for each other part that has a point within the radius of it."
        " In brackets: intervals of 95 %; where they overlap, or that of a ratio holds 1, two"
        " methods are not told apart."
    )
    document.write()
    print(document.summary)
    print(f"Report: {directory / 'report.html'}")
    return 0


def draw(results: Results) -> None:
    plot.use_style()
    for name, draw_picture in PICTURES.items():
        picture = results.folder / name
        if figure := draw_picture(results):
            plot.save(figure, picture)
            print(f"Picture: {picture}")
        else:
            picture.unlink(missing_ok=True)


def comparison_report(results: Results) -> Document:
    document = Document("RRCB beside Zoltan's balancers", results.folder)
    _begin(document, results, headline(results.table, results.turns, results.rounds))
    document.heading("Every method on the same points")
    _add_methods(document, results, results.table)
    _add_simulations(document, results.runs, results.rounds)
    _add_pictures(document, "moving_boxes.png", "parts.png",
                  "unbalance_history.png")  # fmt: skip
    return document


def _add_pictures(document: Document, *names: str) -> None:
    for name in names:
        document.picture(name, " ".join(PICTURES[name].__doc__.split()))


def _begin(document: Document, results: Results, texts: list[str]) -> None:
    """The price at a glance, and what must be known of the machine."""
    if busy := busy_warning(results.record):
        document.conclude(busy)
    _add_pictures(document, "price.png")
    tables = (results.table, results.runs)
    ranks = [rank for rows in tables if len(rows) for rank in rows["ranks"]]
    document.conclude(texts if ranks else ["Nothing was measured."])
    for text in shared_cores(max(ranks, default=1)):
        document.paragraph(text)


def _add_methods(document: Document, results: Results, rows: pd.DataFrame) -> None:
    for case, measured in cases(rows).items():
        document.table(f"{case}: {_size(measured)}", method_table(measured))
        document.table(f"{case}: ghosts, the price of the parts' shape", ghost_table(measured))
    caption = "Noise: a baseline measured twice; less than this is not told apart"
    document.table(caption, noise_table(results.noise))


def _size(rows: pd.DataFrame) -> str:
    return f"{rows['points'].iloc[0]:,} points, {rows['ranks'].iloc[0]} ranks"


def _add_simulations(document: Document, runs: pd.DataFrame, rounds: pd.DataFrame) -> None:
    if runs.empty:
        return
    first = runs.iloc[-1]
    caption = f"Simulations: {first['points']:,} points, {first['steps']:,} steps"
    document.summarise(caption, simulation_table(runs, "none", rounds))
    shared = f" {first['ranks']} ranks share {CORES} cores here, so it hides unbalance."
    document.paragraph(
        "critical path: what the run would take with a core for every rank, the processor time of"
        " the slowest rank of each step and rebalance outside MPI and its messages on a network of"
        " 1.5 µs and 12 GB/s. Ratios are medians of pairs of one round, which take turns. gain kept: of"
        " what ideal balance without cost would gain. moved: weight"
        " that changed rank, of all weight, in a rebalance. wall: by the clock."
        + shared * bool(first["ranks"] > CORES)
    )
    if text := work_paragraph(rounds):
        document.paragraph(text)


if __name__ == "__main__":
    sys.exit(main())
