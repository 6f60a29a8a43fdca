"""Writes the report of a run: report.py DIRECTORY makes report.html and report.md.

report.html holds its pictures; report.md names them.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from automatic import automatic_sentence, automatic_table, judgements, write_automatic
from choice import (
    EVERYWHERE,
    TOLERANCES,
    Choice,
    cases,
    choices,
    find_method,
    write_choices,
    write_fronts,
)
from claims import HEADER, claim_table, set_up_table
from cycle import cycle_table, read_cycle
from document import Document, write_html, write_markdown
from machine import add_machine, read_record
from results import Measurement, Simulation, read_simulations, read_table
from sentences import sentences
from sources import read_sources, source_table
from speed_up import (
    EVERY_STEP,
    KINDS,
    OTHERS,
    SIMULATIONS,
    STANDARD,
    WINNERS,
    SpeedUp,
    middle_runs,
    rank_table,
    read_speed_ups,
)
from sweep import read_clouds, read_snapshots

COST = {
    "time_against_imbalance.png": "What accuracy costs: the time of a call against the imbalance "
    "it leaves; lower is better balanced, further left is faster."
}
PICTURES = {
    "parts.png": "The points, coloured by part, with the boxes of the parts.",
    "support_mesh.png": "A support mesh with the centroids and standard deviations of its cells.",
    "statistical_domain.png": "The real points and the statistical domain that stands for them.",
    "unbalance_history.png": "Load unbalance over the steps of the simulation.",
    "simulation_time.png": "Where the time of the whole simulation goes.",
}
SWEEP_PICTURES = {
    "sweep_time.png": "What accuracy costs in time: every setting on every cloud, and the front of "
    "those that no other beats in both.",
    "sweep_bytes.png": "What accuracy costs in traffic.",
}
SOURCE_PICTURES = {
    "error_sources.png": "Imbalance when what is bisected goes from all points to a sample of them:"
    " the support mesh adds what lies between the points and the cells, another half-width than √3 σ,"
    " or a box cut off, what lies between cells and boxes, the sampling what lies above the boxes"
    " (lines: medians over the seeds, bands: their 95 % intervals).",
}
CYCLE_PICTURES = {
    "cycle.png": "Calls on points that stand still, each from the cuts of the one before: medians"
    " and 95 % intervals over the seeds.",
}
STUDY_PICTURES = {
    "figure_2.png": "Figure 2 of the paper: the statistical domain in a box for each of six"
    " processes, and the points in these boxes.",
    "study.png": "The paper's parameters on snapshots of the failing slope: lines are means of the "
    "snapshots, bands reach from least to most.",
    "speed_up.png": "Figure 5 of the paper: speed-up of the simulation over the serial one."
    " Top, with a core for every rank, reckoned from the processor time of each rank outside MPI and"
    " a network of 1.5 µs and 12 GB/s; middle, by the points of the fullest rank alone; bottom, as"
    " the clock on this machine saw it. Bars and bands: 95 % intervals of what was run more than"
    " once.",
    "ranks.png": "Table 1 of the paper: speed-up over the number of ranks.",
    "figure_6.png": "Figure 6 of the paper: Lu of every part under its RCB and the four settings of"
    " its RRCB that were faster.",
    "study_history.png": "Load unbalance over the simulation under all settings, worst |Lu| of the"
    " parts.",
}


def main() -> int:
    if len(sys.argv) != 2 or not (directory := Path(sys.argv[1])).is_dir():
        print("usage: report.py DIRECTORY (with the files of a comparison)", file=sys.stderr)
        return 2
    given = read_record(directory).get("arguments", "")
    is_sweep = "--sweep" in given.split()
    document = sweep_report(directory) if is_sweep else comparison_report(directory)
    add_machine(document, directory, given)
    _define(document)
    write_html(document, directory)
    write_markdown(document, directory)
    print(document.summary)
    print(f"Report: {directory / 'report.html'}")
    return 0


def comparison_report(directory: Path) -> Document:
    rows = read_table(directory)
    document = Document("RRCB beside Zoltan's balancers")
    document.conclude(sentences(rows))
    _add_pictures(document, directory, COST)
    document.heading("Every method on the same points")
    for case, measured in cases(rows).items():
        document.table(_title(case, measured), *_method_table(measured))
    _add_simulations(document, read_simulations(directory), "none")
    _add_pictures(document, directory, PICTURES)
    return document


def sweep_report(directory: Path) -> Document:
    clouds = read_clouds(directory)
    write_automatic(directory, clouds)
    write_choices(directory, clouds)
    write_fronts(directory, clouds)
    document = Document("What accuracy costs")
    document.conclude(sentences(clouds))
    _add_claims(document, directory)
    document.heading("Which setting for which tolerance")
    chosen = choices(clouds)
    everywhere = [choice for choice in chosen if choice.case == EVERYWHERE]
    if everywhere:
        caption = "Within the tolerance on every cloud, fastest in the mean"
        document.summarise(caption, *_choice_table(everywhere))
    _add_pictures(document, directory, SWEEP_PICTURES)
    on_each = [choice for choice in chosen if choice.case != EVERYWHERE]
    if on_each:
        table = _choice_matrix(on_each) if everywhere else _choice_table(on_each)
        caption = "Fastest within the tolerance, cloud by cloud"
        document.summarise(caption + ": ms, times as fast as Zoltan's RCB" * bool(everywhere), *table)
    _add_automatic(document, clouds)
    _add_sources(document, directory)
    _add_cycle(document, directory)
    document.heading("The failing slope")
    _add_pictures(document, directory, STUDY_PICTURES)
    _add_speed_ups(document, directory)
    _add_every_step(document, directory)
    for case, measured in cases(read_snapshots(directory)).items():
        document.table(_title(case, measured), *_method_table(measured))
    _add_simulations(document, middle_runs(read_simulations(directory, SIMULATIONS)), "serial")
    return document


def _add_claims(document: Document, directory: Path) -> None:
    claims = claim_table(directory)
    if not claims:
        return
    document.heading("Against the paper")
    document.table("What differs from the paper's set-up", *set_up_table(directory))
    document.summarise("What the paper says", HEADER, claims)


def _add_cycle(document: Document, directory: Path) -> None:
    calls = read_cycle(directory)
    if not calls:
        return
    document.heading("Calls on points that stand still")
    document.paragraph(
        "Every rank lays its mesh over the points that its last cuts gave it, so every estimate"
        " depends on the one before. docs/paper.md derives what comes of it."
    )
    size = f"{calls[0].points:,} points, {calls[0].ranks} ranks"
    caption = f"After ten calls, medians and 95 % intervals over the seeds: {size}"
    document.summarise(caption, *cycle_table(calls))
    _add_pictures(document, directory, CYCLE_PICTURES)


def _add_every_step(document: Document, directory: Path) -> None:
    speed_ups = read_speed_ups(directory, EVERY_STEP)
    if not speed_ups:
        return
    run = speed_ups[-1].run
    caption = (
        f"Rebalanced at every step as in the paper, one run: speed-up over serial, {run.points:,}"
        f" points, {run.steps:,} steps"
    )
    document.table(caption, *_speed_up_table(speed_ups))


def _add_automatic(document: Document, clouds: list[Measurement]) -> None:
    found = judgements(clouds)
    if not found:
        return
    document.heading("Is the automatic choice a good one?")
    document.paragraph(automatic_sentence(found))
    document.summarise("RRCB's own mesh beside the best one tried", *automatic_table(found))


def _add_sources(document: Document, directory: Path) -> None:
    rows = read_sources(directory)
    if not rows:
        return
    document.heading("Where the error comes from")
    size = f"{rows[0].points:,} points, {rows[0].ranks} ranks"
    caption = f"Imbalance beyond 1 in %, geometric mean of the clouds: {size}"
    document.summarise(caption, *source_table(rows))
    _add_pictures(document, directory, SOURCE_PICTURES)


def _add_speed_ups(document: Document, directory: Path) -> None:
    speed_ups = read_speed_ups(directory)
    if not speed_ups:
        return
    for kind in KINDS:
        table = rank_table(speed_ups, kind)
        if len(table[0]) > 2:
            document.summarise(f"Speed-up over serial by ranks, {KINDS[kind]}", *table)
    run = speed_ups[-1].run
    chosen = (*OTHERS, "serial", STANDARD, *WINNERS)
    table = _speed_up_table([s for s in speed_ups if s.run.method in chosen])
    caption = (
        f"Speed-up over the serial simulation: {run.points:,} points, {run.steps:,} steps,"
        f" rebalanced every {run.every}"
    )
    document.table(caption, *table)
    document.paragraph(
        "critical path: serial work / (work of the slowest rank of each step and rebalance + its"
        " messages on a network of 1.5 µs and 12 GB/s), where work is processor time outside MPI:"
        " what a core for every rank would give; at every step: the same, with the measured cost of"
        " a rebalance after each step. points: all points / points of the fullest rank, which"
        f" leaves all costs out. wall: by the clock, here with {os.cpu_count()} cores: where ranks"
        " share cores it hides unbalance. In brackets: 95 % intervals of the median of what was run"
        " more than once; the rest of the grid was run once, so no setting of it is named the best."
        " speed_up.csv has every setting."
    )


def _speed_up_table(speed_ups: list[SpeedUp]) -> tuple[list[str], list[list[str]]]:
    header = ["method", "ranks", "runs", "critical path", "rebalanced at every step", "points"]
    header += ["wall", "mean imbalance"]
    kinds = {"critical_path": 2, "every_step": 2, "points": 2, "wall": 2, "mean_imbalance": 4}
    return header, [
        [s.run.method, str(s.run.ranks), str(s.spreads["wall"].count)]
        + [s.spreads[kind].text(digits) for kind, digits in kinds.items()]
        for s in sorted(speed_ups, key=lambda s: s.run.ranks)
    ]


def _add_pictures(document: Document, directory: Path, pictures: dict[str, str]) -> None:
    for name, caption in pictures.items():
        if (directory / name).exists():
            document.picture(name, caption)


def _title(case: str, rows: list[Measurement]) -> str:
    return f"{case}: {rows[0].points:,} points, {rows[0].ranks} ranks"


def _method_table(rows: list[Measurement]) -> tuple[list[str], list[list[str]]]:
    header = ["method", "imbalance", "worst Lu %", "time ms", "times as fast", "bytes", "messages"]
    header += ["into root", "moved %"]
    reference = find_method(rows, "zoltan-rcb")
    table = [
        [
            row.method,
            f"{row.imbalance:.5f}",
            f"{row.lu_percent:.3f}",
            f"{row.time_ms:.2f}",
            f"{reference.time_ms / row.time_ms:.2f}" if reference and row.time_ms > 0 else "–",
            f"{row.bytes:,}",
            f"{row.messages:,}",
            f"{row.root_bytes_in:,}",
            f"{100 * row.moved_fraction:.1f}",
        ]
        for row in rows
    ]
    return header, table


def _choice_table(chosen: list[Choice]) -> tuple[list[str], list[list[str]]]:
    header = ["cloud", "imbalance ≤", "fastest setting", "time ms", "times as fast", "imbalance"]
    table = [
        [
            choice.case,
            choice.tolerance,
            choice.setting or "none",
            _number(choice.time_ms, 2),
            _number(choice.times_as_fast, 2),
            _number(choice.imbalance, 5),
        ]
        for choice in chosen
    ]
    return header, table


def _choice_matrix(chosen: list[Choice]) -> tuple[list[str], list[list[str]]]:
    """A row per cloud, a column per tolerance."""
    table: dict[str, list[str]] = {}
    for choice in chosen:
        text = "none"
        if choice.setting:
            text = f"{choice.setting} {_number(choice.time_ms, 2)}"
            text += f"\N{NO-BREAK SPACE}{_number(choice.times_as_fast, 1)}×"
        table.setdefault(choice.case, [choice.case]).append(text)
    return ["cloud", *(f"≤ {t}" for t in TOLERANCES[:-1]), TOLERANCES[-1]], list(table.values())


def _number(value: float | None, digits: int) -> str:
    return "–" if value is None else f"{value:.{digits}f}"


def _add_simulations(document: Document, runs: list[Simulation], reference: str) -> None:
    if not runs:
        return
    base = next((run for run in runs if run.method == reference), None)
    header = ["method", "ranks", f"times as fast as {reference}", "wall s", "balance s", "step s"]
    header.append("mean imbalance")
    table = [
        [
            run.method,
            str(run.ranks),
            f"{base.wall / run.wall:.2f}" if base and run.wall > 0 else "–",
            f"{run.wall:.3f}",
            f"{run.balance:.3f}",
            f"{run.step:.3f}",
            f"{run.mean_imbalance:.4f}",
        ]
        for run in runs
    ]
    caption = f"Simulations: {runs[-1].points:,} points, {runs[-1].steps:,} steps"
    document.table(caption, header, table)


def _define(document: Document) -> None:
    document.paragraph(
        "imbalance: heaviest part / mean part. Lu: (ideal − actual) / ideal of a part. time: slowest"
        " rank, median of the repeats. times as fast: Zoltan RCB's time / this method's. bytes and"
        " messages: of one call over all ranks. into root: bytes that rank 0 receives."
        " moved: weight that changes rank. exact: no part holds more than one point above the mean."
    )


if __name__ == "__main__":
    sys.exit(main())
