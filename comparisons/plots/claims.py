"""What the paper says, beside what was measured here: computed from the files of a sweep."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from cycle import lasting, read_cycle
from intervals import NOT_TOLD_APART, Spread, spread_of
from results import Measurement
from settings import SETTING, setting_of
from sources import Source, mean_excess, read_sources
from speed_up import EVERY_STEP, SIMULATIONS, STANDARD, WINNERS, SpeedUp, read_speed_ups
from sweep import read_snapshots

T = TypeVar("T")

CONFIRMED, REFUTED = "confirmed", "refuted"
NOT_TESTABLE = "not testable here"
COMMAND = "comparisons/run --sweep --only="
RCB = "root-rcb"  # the paper's
PROCESSES = 4  # of the paper's study


@dataclass(frozen=True)
class Claim:
    text: str
    ours: str
    verdict: str
    parts: str  # of the sweep, whose files hold the numbers


HEADER = ["the paper says", "measured here, with 95 % intervals", "verdict", "command"]


def claim_table(directory: Path) -> list[list[str]]:
    """A row per claim whose numbers are there."""
    found = [claim for find in FINDERS for claim in find(directory)]
    return [[c.text, c.ours, c.verdict, COMMAND + c.parts] for c in found]


def compare(first: Spread, second: Spread) -> str:
    """Whether the first is greater; nothing is told apart by single runs."""
    if first.interval is None or second.interval is None or first.low <= second.high:
        refuted = first.interval and second.interval and first.high < second.low
        return REFUTED if refuted else NOT_TOLD_APART
    return CONFIRMED


def set_up_table(directory: Path) -> tuple[list[str], list[list[str]]]:
    """In what this study differs from the paper's."""
    once = read_speed_ups(directory, EVERY_STEP)
    runs = [s.run for s in read_speed_ups(directory) or once]
    rows = [["machine", "not known", f"{os.cpu_count()} cores, shared by the ranks"]]
    if runs:
        run = runs[-1]
        every = "each step" if run.every == 1 else f"each {run.every} steps"
        every += "; each step in one run more" * (bool(once) and run.every > 1)
        rows += [
            ["material points", "54,440", f"{run.points:,}"],
            ["steps of the failure", "not known", f"{run.steps:,}"],
            ["rebalanced", "each step", every],
        ]
    return ["", "in the paper", "here"], rows + [
        ["language, MPI library", "not known", "C++20; run.txt names the library"],
        ["calls", "not known", "through Zoltan's callbacks and lists"],
        ["speed-up", "serial time / parallel time", "the same by processor time outside MPI and a"
         " network of 1.5 µs and 12 GB/s: as with a core for every rank; and by the clock"],
        ["start", "not known", "slabs of equal width"],
        ["pseudo-random points", "fixed seed", "fixed in a run; other runs take other seeds"],
        ["cut", "“midpoint of that direction”", "where the points on both sides are in the ratio of"
         " the processes; the literal rule is tried too"],
    ]


def _less_traffic(directory: Path) -> list[Claim]:
    pairs = [
        (rows[RCB], rows[setting])
        for rows in _snapshots(directory)
        for setting in WINNERS
        if RCB in rows and setting in rows
    ]
    if not pairs:
        return []
    sent = [rcb.bytes / ours.bytes for rcb, ours in pairs]
    received = [rcb.root_bytes_in / ours.root_bytes_in for rcb, ours in pairs]
    ours = f"RCB sends {min(sent):.3g} to {max(sent):.3g} times the bytes of a call with the four"
    ours += f" settings; into the root {min(received):.3g} to {max(received):.3g} times"
    verdict = CONFIRMED if min(received) > 1 and min(sent) > 1 else REFUTED
    return [Claim("RRCB exchanges far less than RCB", ours, verdict, "snapshots")]


def _snapshots(directory: Path) -> list[dict[str, Measurement]]:
    workloads: dict[tuple[str, int], dict[str, Measurement]] = {}
    for row in read_snapshots(directory):
        workloads.setdefault((row.workload, row.points), {})[row.method] = row
    return list(workloads.values())


def _faster(directory: Path) -> list[Claim]:
    runs = _by_method(read_speed_ups(directory))
    once = _by_method(read_speed_ups(directory, EVERY_STEP))
    if RCB not in runs:
        return []
    return [
        _faster_than_rcb(runs[setting], runs[RCB], once)
        for setting in WINNERS
        if setting in runs
    ]


def _faster_than_rcb(run: SpeedUp, rcb: SpeedUp, once: dict[str, SpeedUp]) -> Claim:
    mesh, k, fraction = setting_of(run.run.method)
    name = f"mesh {mesh:g} × {mesh:g}, {k:g} σ, {100 * fraction:g} %"
    ours, theirs = run.spreads["every_step"], rcb.spreads["every_step"]
    text = f"speed-up {ours.text(2)}, RCB {theirs.text(2)}"
    parts = "simulations"
    if run.run.method in once and RCB in once:
        at_once = (once[method].critical_path for method in (run.run.method, RCB))
        text += "; rebalanced at every step, one run: {:.2f}, RCB {:.2f}".format(*at_once)
        parts += ",paper"
    return Claim(f"{name} is faster than RCB", text, compare(ours, theirs), parts)


def _by_method(speed_ups: list[SpeedUp]) -> dict[str, SpeedUp]:
    return {s.run.method: s for s in speed_ups if s.run.ranks == PROCESSES}


def _best_number(directory: Path) -> list[Claim]:
    found = [s for s in read_speed_ups(directory) if s.run.method in (STANDARD, RCB)]
    return [
        claim
        for method in (RCB, STANDARD)
        if (claim := _best_number_of([s for s in found if s.run.method == method]))
    ]


def _best_number_of(speed_ups: list[SpeedUp]) -> Claim | None:
    by_ranks = {s.run.ranks: s.spreads["every_step"] for s in speed_ups}
    if PROCESSES not in by_ranks or len(by_ranks) < 2:
        return None
    four = by_ranks.pop(PROCESSES)
    verdicts = {compare(four, other) for other in by_ranks.values()}
    verdict = CONFIRMED if verdicts == {CONFIRMED} else NOT_TOLD_APART
    verdict = REFUTED if REFUTED in verdicts else verdict
    ours = f"speed-up of {speed_ups[0].run.method} on a core for every rank: 4 ranks {four.text(2)}"
    for ranks, spread in sorted(by_ranks.items()):
        ours += f", {ranks} ranks {spread.text(2)}"
    return Claim("4 processes are best", ours, verdict, "ranks")


def _larger_unbalance(directory: Path) -> list[Claim]:
    for name, part in ((EVERY_STEP, "paper"), (SIMULATIONS, "simulations")):
        runs = _by_method(read_speed_ups(directory, name))
        ours = [runs[setting].run.mean_imbalance for setting in WINNERS if setting in runs]
        if not ours or RCB not in runs:
            continue
        rcb = runs[RCB].run.mean_imbalance
        text = f"mean imbalance of the four settings {min(ours):.4f} to {max(ours):.4f}, of RCB"
        text += f" {rcb:.4f}"
        verdict = CONFIRMED if min(ours) > rcb else REFUTED
        return [Claim("RRCB's unbalance is clearly worse than RCB's", text, verdict, part)]
    return []


def _because_of_samples(directory: Path) -> list[Claim]:
    rows = [row for row in read_sources(directory) if row.mesh == 4 and row.k == 1.5]
    boxes = [row for row in rows if row.domain == "boxes"]
    if not boxes:
        return []
    return [
        _because_of_share(fraction, boxes, [r for r in rows if r.fraction == fraction])
        for fraction in (1, 0.125)
        if any(row.fraction == fraction for row in rows)
    ]


def _because_of_share(fraction: float, boxes: list[Source], sampled: list[Source]) -> Claim:
    """Refuted where the boxes alone make more than half of the unbalance with any seed."""
    without, drawn = mean_excess(boxes), mean_excess(sampled)
    ours = f"mesh 4, 1.5 σ, {100 * fraction:g} %: {drawn.text(2)} % of unbalance with the points,"
    ours += f" {without.median:.2f} % with boxes without a random point"
    verdict = REFUTED if without.median > drawn.high / 2 else CONFIRMED
    return Claim("... because of the pseudo-random points", ours, verdict, "sources")


ONE = Spread(1, (1, 1), 1)
COARSE, FINE = 2, 10  # the ends of the paper's meshes


def _finer_mesh(directory: Path) -> list[Claim]:
    ratios = [
        _excess(coarse) / _excess(fine)
        for rows in _snapshots(directory)
        for coarse, fine in _by_mesh(rows)
    ]
    if not ratios:
        return []
    found = spread_of(ratios)
    ours = f"mesh {COARSE} has {found.text(1)} times the unbalance of mesh {FINE}: {found.count}"
    ours += " pairs of k, fraction and snapshot"
    return [Claim("a finer mesh lowers the unbalance", ours, compare(found, ONE), "snapshots")]


def _finer_mesh_costs(directory: Path) -> list[Claim]:
    runs = {s.run.method: s for s in read_speed_ups(directory) if s.run.ranks == PROCESSES}
    ratios = [coarse.every_step / fine.every_step for coarse, fine in _by_mesh(runs)]
    if not ratios:
        return []
    found = spread_of(ratios)
    ours = f"speed-up with mesh {COARSE} / with mesh {FINE}: {found.text(2)}; {found.count} pairs"
    return [Claim("... and costs speed", ours, compare(found, ONE), "simulations")]


def _by_mesh(rows: dict[str, T]) -> list[tuple[T, T]]:
    """Rows of the coarsest and the finest mesh with the same k and fraction."""
    settings = {setting_of(name): row for name, row in rows.items() if SETTING.fullmatch(name)}
    return [
        (row, settings[FINE, k, fraction])
        for (mesh, k, fraction), row in settings.items()
        if mesh == COARSE and (FINE, k, fraction) in settings
    ]


def _excess(row: Measurement) -> float:
    """Not less than what one point makes."""
    return max(row.imbalance - 1, row.ranks / row.points)


def _literal_midpoint(directory: Path) -> list[Claim]:
    method = RCB + "[cut=midpoint]"
    found = [rows[method] for rows in _snapshots(directory) if method in rows]
    if not found:
        return []
    texts = [f"{row.imbalance:.3f} ({row.workload})" for row in found]
    ours = "imbalance of RCB with that rule: " + ", ".join(texts)
    verdict = REFUTED if max(row.imbalance for row in found) > 1.1 else CONFIRMED
    return [
        Claim("boxes are cut at the “midpoint of that direction”, literally", ours, verdict,
              "snapshots")
    ]


def _learned(directory: Path) -> list[Claim]:
    found = {row.method: row for row in lasting(read_cycle(directory))}
    text = "no learned domain here"
    analytic, sampled = found.get("rrcb[refine=none]"), found.get(STANDARD)
    if analytic and sampled:
        text += f"; the analytic one, without random points, leaves {analytic.worse.median:.4f} on"
        text += f" points that stand still, the paper's {sampled.worse.text(4)}"
    claim = "a learned model may generate the statistical domain better (future work)"
    return [Claim(claim, text, NOT_TESTABLE, "cycle")] if found else []


FINDERS: tuple[Callable[[Path], list[Claim]], ...] = (
    _less_traffic,
    _faster,
    _best_number,
    _larger_unbalance,
    _because_of_samples,
    _finer_mesh,
    _finer_mesh_costs,
    _literal_midpoint,
    _learned,
)
