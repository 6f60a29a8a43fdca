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
from choice import EVERYWHERE, automatic_sentence, choices, fronts, judgements
from claims import claim_table, set_up_table
from cost import draw_study, draw_sweep_bytes, draw_sweep_time
from cycle import cycle_table, draw_cycle
from document import Document
from domains import draw_domains, draw_support_mesh
from headline import headline, work_paragraph
from history import draw_figure_6, draw_history, draw_study_history
from machine import CORES, add_machine, busy_warning, shared_cores
from methods import STANDARD, WINNERS
from parts import draw_figure_2, draw_parts
from price import draw_price
from results import Results, cases, write_csv
from sentences import sentences
from simulation import draw_simulation
from speed_up import (
    KINDS,
    OTHERS,
    draw_ranks,
    draw_speed_up,
    middle_runs,
    rank_table,
    read_speed_ups,
    speed_up_table,
)
from tables import choice_matrix, choice_table, ghost_table, method_table, noise_table, simulation_table

# Their captions are the docstrings of what draws them.
PICTURES = {
    "price.png": draw_price,
    "parts.png": draw_parts,
    "support_mesh.png": draw_support_mesh,
    "statistical_domain.png": draw_domains,
    "unbalance_history.png": draw_history,
    "simulation_time.png": draw_simulation,
    "sweep_time.png": draw_sweep_time,
    "sweep_bytes.png": draw_sweep_bytes,
    "cycle.png": draw_cycle,
    "figure_2.png": draw_figure_2,
    "study.png": draw_study,
    "speed_up.png": draw_speed_up,
    "ranks.png": draw_ranks,
    "figure_6.png": draw_figure_6,
    "study_history.png": draw_study_history,
}


def main() -> int:
    if len(sys.argv) != 2 or not (directory := Path(sys.argv[1])).is_dir():
        print("usage: report.py DIRECTORY (with the files of a comparison)", file=sys.stderr)
        return 2
    results = Results(directory)
    speed_ups = read_speed_ups(results.swept_runs)
    write_csv(directory / "speed_up.csv", (s.numbers for s in speed_ups))
    draw(results)
    arguments = results.record.get("arguments", "")
    report = sweep_report if "--sweep" in arguments.split() else comparison_report
    document = report(results)
    add_machine(document, directory, arguments)
    document.paragraph(
        "imbalance: heaviest part / mean part. Lu: (ideal − actual) / ideal of a part, below 0 where"
        " it is too heavy. time: slowest rank, median of the repeats. times as fast: Zoltan RCB's"
        " time / this method's. bytes and"
        " messages: of one call over all ranks. into root: bytes that rank 0 receives."
        " moved: weight that changes rank. ghosts: copies of points that parts need from others; a"
        " point counts once for each other part that has a point within the radius of it. exact: no part holds more than one point above the mean."
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
    _begin(document, results, headline(results.table, results.rounds))
    document.heading("Every method on the same points")
    _add_methods(document, results, results.table)
    _add_simulations(document, results.runs, "none", results.rounds)
    if text := work_paragraph(results.rounds):
        document.paragraph(text)
    _add_pictures(document, "parts.png", "support_mesh.png", "statistical_domain.png",
                  "unbalance_history.png", "simulation_time.png")  # fmt: skip
    return document


def sweep_report(results: Results) -> Document:
    runs = middle_runs(results.swept_runs)
    document = Document("What accuracy costs", results.folder)
    _begin(document, results, sentences(results.swept if results.clouds.empty else results.clouds))
    if claims := claim_table(results):
        document.heading("Against the paper")
        document.table("What differs from the paper's set-up", set_up_table(results))
        document.summarise("What the paper says", claims)
    _add_choices(document, results)
    _add_cycle(document, results)
    document.heading("The failing slope")
    _add_pictures(document, "figure_2.png", "study.png", "speed_up.png", "ranks.png",
                  "figure_6.png", "study_history.png")  # fmt: skip
    _add_speed_ups(document, results)
    _add_methods(document, results, results.snapshots)
    _add_simulations(document, runs, "serial")
    return document


def _add_pictures(document: Document, *names: str) -> None:
    for name in names:
        document.picture(name, " ".join(PICTURES[name].__doc__.split()))


def _begin(document: Document, results: Results, texts: list[str]) -> None:
    """The price at a glance, and what must be known of the machine."""
    if busy := busy_warning(results.record):
        document.conclude(busy)
    _add_pictures(document, "price.png")
    tables = (results.table, results.runs, results.swept, results.swept_runs)
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


def _add_choices(document: Document, results: Results) -> None:
    """Which setting for which tolerance, and whether RRCB's own is as good."""
    clouds, folder = results.clouds, results.folder
    chosen, judged = choices(clouds), judgements(clouds)
    write_csv(folder / "automatic.csv", (judgement.numbers for judgement in judged))
    write_csv(folder / "choices.csv", (choice.numbers for choice in chosen))
    write_csv(folder / "fronts.csv", fronts(clouds))
    if chosen:
        document.heading("Which setting for which tolerance")
        everywhere = [choice for choice in chosen if choice.case == EVERYWHERE]
        caption = "Within the tolerance on every cloud, fastest in the mean"
        document.summarise(caption, choice_table(everywhere))
        _add_pictures(document, "sweep_time.png", "sweep_bytes.png")
        on_each = [choice for choice in chosen if choice.case != EVERYWHERE]
        caption = "Fastest within the tolerance, cloud by cloud"
        caption += ": ms, times as fast as Zoltan's RCB" * bool(everywhere)
        document.summarise(caption, (choice_matrix if everywhere else choice_table)(on_each))
    if judged:
        document.heading("Is the automatic choice a good one?")
        document.paragraph(automatic_sentence(judged))
        document.summarise("RRCB's own mesh beside the best one tried", [j.texts for j in judged])


def _add_cycle(document: Document, results: Results) -> None:
    calls = results.cycle
    if calls.empty:
        return
    document.heading("Calls on points that stand still")
    document.paragraph(
        "Every rank lays its mesh over the points that its last cuts gave it, so every estimate"
        " depends on the one before. docs/paper.md derives what comes of it."
    )
    caption = f"After ten calls, medians and 95 % intervals over the seeds: {_size(calls)}"
    document.summarise(caption, cycle_table(calls))
    _add_pictures(document, "cycle.png")


def _add_speed_ups(document: Document, results: Results) -> None:
    if speed_ups := read_speed_ups(results.swept_runs):
        for kind, text in KINDS.items():
            caption = f"Speed-up over serial by ranks, {text}"
            document.summarise(caption, rank_table(speed_ups, kind))
        run = speed_ups[-1].run
        chosen = (*OTHERS, "serial", STANDARD, *WINNERS)
        caption = f"Speed-up over the serial simulation: {run.points:,} points, {run.steps:,}"
        caption += f" steps, rebalanced every {run.every}"
        document.table(caption, speed_up_table([s for s in speed_ups if s.run.method in chosen]))
        document.paragraph(
            "critical path: serial work / (work of the slowest rank of each step and rebalance + its"
            " messages on a network of 1.5 µs and 12 GB/s), where work is processor time outside"
            " MPI: what a core for every rank would give; at every step: the same, with the measured"
            " cost of a rebalance after each step. points: all points / points of the fullest rank,"
            f" which leaves all costs out. wall: by the clock, here with {CORES} cores: where ranks"
            " share cores it hides unbalance. In brackets: 95 % intervals of the median of what was"
            " run more than once; the rest of the grid was run once, so no setting of it is named"
            " the best. speed_up.csv has every setting."
        )
    if speed_ups := read_speed_ups(results.paper_runs):
        run = speed_ups[-1].run
        caption = "Rebalanced at every step as in the paper, one run: speed-up over serial,"
        caption += f" {run.points:,} points, {run.steps:,} steps"
        document.table(caption, speed_up_table(speed_ups))


def _add_simulations(
    document: Document, runs: pd.DataFrame, reference: str, rounds: pd.DataFrame | None = None
) -> None:
    if runs.empty:
        return
    first = runs.iloc[-1]
    caption = f"Simulations: {first['points']:,} points, {first['steps']:,} steps"
    document.table(caption, simulation_table(runs, reference, rounds))
    shared = f" {first['ranks']} ranks share {CORES} cores here, so it hides unbalance."
    document.paragraph(
        "critical path: what the run would take with a core for every rank, the processor time of"
        " the slowest rank of each step and rebalance outside MPI and its messages on a network of"
        " 1.5 µs and 12 GB/s. Ratios are medians of pairs of one round, which take turns. gain kept: of what ideal balance without cost would gain. moved: weight"
        " that changed rank, of all weight, in a rebalance. wall: by the clock."
        + shared * bool(first["ranks"] > CORES)
    )


if __name__ == "__main__":
    sys.exit(main())
