"""Writes the report of a run: report.py DIRECTORY makes report.html and report.md.

report.html holds its pictures; report.md names them.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from automatic import automatic_sentence, automatic_table, judgements, write_automatic
from choice import EVERYWHERE, cases, choices, write_choices, write_fronts
from claims import HEADER, claim_table, set_up_table
from cycle import cycle_table, read_cycle
from document import Document, write_html, write_markdown
from machine import add_machine, busy_warning, read_record, shared_cores
from prices import exchange_rate
from results import Measurement, Simulation, read_noise, read_simulations, read_table
from sentences import sentences, simulation_sentence
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
from tables import choice_matrix, choice_table, method_table, noise_table, simulation_table

PRICE = {
    "price.png": "The price of accuracy. Left, the time of a call as a share of Zoltan's RCB over"
    " the imbalance asked for; the paper's methods, which take no tolerance, stand at what they left."
    " Over several workloads: geometric means, and bands from the least to the most end of the 95 %"
    " intervals. Right, the simulation on the critical path: seconds that its calls and the"
    " unbalance of its steps cost, over those of ideally balanced steps. What noise of the"
    " processors and messages of the steps add is the same under all and left out. price.csv has"
    " the numbers.",
}
COST = {
    "time_against_imbalance.png": "What accuracy costs: the time of a call against the imbalance "
    "it leaves; lower is better balanced, further left is faster. One point more in a part than in "
    "the mean is the least that can be told."
}
PICTURES = {
    "parts.png": "The points, coloured by part, with the boxes of the parts; in each part its"
    " number and, where every point is drawn, its points and their Lu. All scales are equal.",
    "support_mesh.png": "A support mesh with the centroids and standard deviations of its cells.",
    "statistical_domain.png": "The real points and the statistical domain that stands for them,"
    " on equal scales.",
    "unbalance_history.png": "Load unbalance over the steps of the simulation: the largest of each"
    " method, then Lu of every part, bands from least to most of a window of steps; scales differ.",
    "simulation_time.png": "Where the time of the whole simulation goes, on the critical path.",
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
    "study_history.png": "Load unbalance over the simulation under all settings, largest |Lu| of the"
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
    runs = read_simulations(directory)
    document = Document("RRCB beside Zoltan's balancers")
    _begin(document, directory, rows, runs)
    _add_pictures(document, directory, COST)
    document.heading("Every method on the same points")
    for case, measured in cases(rows).items():
        document.table(_title(case, measured), *method_table(measured))
    _add_noise(document, directory)
    _add_simulations(document, runs, "none")
    _add_pictures(document, directory, PICTURES)
    return document


def sweep_report(directory: Path) -> Document:
    clouds = read_clouds(directory)
    snapshots = read_snapshots(directory)
    runs = middle_runs(read_simulations(directory, SIMULATIONS))
    write_automatic(directory, clouds)
    write_choices(directory, clouds)
    write_fronts(directory, clouds)
    document = Document("What accuracy costs")
    _begin(document, directory, clouds or snapshots, runs)
    _add_claims(document, directory)
    _add_choices(document, directory, clouds)
    _add_automatic(document, clouds)
    _add_sources(document, directory)
    _add_cycle(document, directory)
    document.heading("The failing slope")
    _add_pictures(document, directory, STUDY_PICTURES)
    _add_speed_ups(document, directory)
    _add_every_step(document, directory)
    for case, measured in cases(snapshots).items():
        document.table(_title(case, measured), *method_table(measured))
    _add_noise(document, directory)
    _add_simulations(document, runs, "serial")
    return document


def _begin(
    document: Document, directory: Path, rows: list[Measurement], runs: list[Simulation]
) -> None:
    """The price at a glance, and what must be known of the machine."""
    if busy := busy_warning(read_record(directory)):
        document.conclude(busy)
    _add_pictures(document, directory, PRICE)
    ranks = max([row.ranks for row in rows] + [run.ranks for run in runs], default=1)
    texts = shared_cores(ranks) + sentences(rows)
    texts += [text for text in (simulation_sentence(runs), exchange_rate(runs)) if text]
    document.conclude(texts or ["Nothing was measured."])


def _add_choices(document: Document, directory: Path, clouds: list[Measurement]) -> None:
    chosen = choices(clouds)
    if not chosen:
        return
    document.heading("Which setting for which tolerance")
    everywhere = [choice for choice in chosen if choice.case == EVERYWHERE]
    if everywhere:
        caption = "Within the tolerance on every cloud, fastest in the mean"
        document.summarise(caption, *choice_table(everywhere))
    _add_pictures(document, directory, SWEEP_PICTURES)
    on_each = [choice for choice in chosen if choice.case != EVERYWHERE]
    table = choice_matrix(on_each) if everywhere else choice_table(on_each)
    caption = "Fastest within the tolerance, cloud by cloud"
    document.summarise(caption + ": ms, times as fast as Zoltan's RCB" * bool(everywhere), *table)


def _add_noise(document: Document, directory: Path) -> None:
    repeats = read_noise(directory)
    if not repeats:
        return
    caption = "Noise: a baseline measured twice; less than this is not told apart"
    document.table(caption, *noise_table(repeats))


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


def _add_simulations(document: Document, runs: list[Simulation], reference: str) -> None:
    if not runs:
        return
    first = runs[-1]
    caption = f"Simulations: {first.points:,} points, {first.steps:,} steps"
    document.table(caption, *simulation_table(runs, reference))
    shared = f" {first.ranks} ranks share {os.cpu_count()} cores here, so it hides unbalance."
    document.paragraph(
        "critical path: what the run would take with a core for every rank, the processor time of"
        " the slowest rank of each step and rebalance outside MPI and its messages on a network of"
        " 1.5 µs and 12 GB/s. gain kept: of what ideal balance without cost would gain. moved: weight that"
        " changed rank, of all weight, in a rebalance. wall: by the clock."
        + shared * (first.ranks > (os.cpu_count() or 1))
    )


def _define(document: Document) -> None:
    document.paragraph(
        "imbalance: heaviest part / mean part. Lu: (ideal − actual) / ideal of a part, below 0 where"
        " it is too heavy. time: slowest rank, median of the repeats. times as fast: Zoltan RCB's"
        " time / this method's. bytes and"
        " messages: of one call over all ranks. into root: bytes that rank 0 receives."
        " moved: weight that changes rank. exact: no part holds more than one point above the mean."
        " In brackets: intervals of 95 %; where they overlap, or that of a ratio holds 1, two"
        " methods are not told apart."
    )


if __name__ == "__main__":
    sys.exit(main())
