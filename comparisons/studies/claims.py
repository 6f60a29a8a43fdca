"""What the paper says, compared with what was measured here: computed from the files of a study."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from statistics import mean

import numpy as np
import pandas as pd
from boxes import drawn_outside, excesses, material_points
from intervals import NOT_TOLD_APART, ONE, Value, median_of
from machine import CORES
from methods import RCB, STANDARD, WINNERS, setting_of
from results import Results, measurements, read, row_of
from simulation import once

CONFIRMED, REFUTED, PARTLY = "confirmed", "refuted", "partly"
NOT_TESTABLE = "not testable here"
COARSE, FINE = 2, 10  # the ends of the paper's meshes
MOST, LEAST = 1, 0.125  # and of its fractions
SEEDS = 10
SNAPSHOTS = ("start", "middle", "end")

Claim = tuple[str, str, str, str]  # text, ours, verdict, part of the study that holds the numbers


class Evidence:
    """What the claims are judged by: the files of each run of the driver, read once."""

    def __init__(self, out: Path) -> None:
        self.out = out

    def runs(self, name: str) -> pd.DataFrame:
        return once(read(self.out / name / "simulation_runs.csv"))

    @cached_property
    def snapshots(self) -> list[dict[str, object]]:
        """Rows by method, of each snapshot."""
        rows = measurements(read(self.out / "snapshots/table.csv"))
        groups = rows.groupby("workload", sort=False) if len(rows) else ()
        return [{row.method: row for row in of.itertuples()} for _, of in groups]

    @cached_property
    def skewed(self) -> list[dict[str, object]]:
        """Without the start, where points lie on the faces of cells."""
        return [rows for rows in self.snapshots if not rows[RCB].workload.endswith("-start")]

    @cached_property
    def every_step(self) -> pd.DataFrame:
        return self.runs("simulations")

    def speed_ups(self, name: str, serial: str) -> dict[str, list[float]]:
        """Of each method in each round: median serial critical path / its own."""
        runs, alone = self.runs(name), self.runs(serial)
        if runs.empty or alone.empty:
            return {}
        time = alone.loc[alone["method"] == "none", "critical_path_s"].median()
        return (time / runs["critical_path_s"]).groupby(runs["method"]).agg(list).to_dict()

    @cached_property
    def speeds(self) -> dict[str, list[float]]:
        return self.speed_ups("simulations", "serial")

    @cached_property
    def imbalances(self) -> dict[str, Value]:
        runs = self.every_step
        if runs.empty:
            return {}
        return runs.groupby("method")["mean_imbalance"].agg(list).map(median_of).to_dict()


def claim_table(out: Path) -> list[dict[str, str]]:
    """A row per claim whose numbers are there. The paper's text has no number for any of them."""
    evidence = Evidence(out)
    header = ("the paper says", "measured here, with 95 % intervals", "verdict", "part")
    return [dict(zip(header, claim)) for find in FINDERS for claim in find(evidence)]


def compare(first: Value, second: Value) -> str:
    """Whether the first is greater; nothing is told apart by single runs."""
    if first.low > second.high:
        return CONFIRMED
    return REFUTED if first.high < second.low else NOT_TOLD_APART


def set_up_table(out: Path) -> list[dict[str, str]]:
    """In what this study differs from the paper's."""
    runs = Evidence(out).every_step
    rows = [("machine", "not known", f"{CORES} cores, shared by the ranks")]
    if len(runs):
        run = runs.iloc[-1]
        rows += [
            ("material points", "54,440", f"{run.points:,}"),
            ("steps", "not known", f"{run.steps:,} of the failure"),
            ("rebalanced", "each step", "each step" if run.every == 1 else f"each {run.every}"),
        ]
    rows += [
        ("drawn points", "54,440, 27,226, 13,652 and 6,868", "100, 50, 25 and 12.5 %"),
        ("speed-up", "serial time / parallel time", "the same by processor time outside MPI and a"
         " network of 1.5 µs and 12 GB/s: as with a core for every rank"),
        ("start", "not known", "slabs of equal width"),
        ("pseudo-random points", "fixed seed", "fixed in a run; each run has another"),
    ]  # fmt: skip
    return [dict(zip(("", "in the paper", "here"), row)) for row in rows]


def _name(method: str) -> str:
    mesh, k, fraction = setting_of(method)
    return f"mesh {mesh:g} × {mesh:g}, {k:g} σ, {100 * fraction:g} %"


def _traffic(evidence: Evidence) -> Iterator[Claim]:
    pairs = [(rows[RCB], rows[of]) for rows in evidence.snapshots for of in WINNERS if of in rows]
    if pairs:
        sent = [rcb.bytes / ours.bytes for rcb, ours in pairs]
        received = [rcb.root_bytes_in / ours.root_bytes_in for rcb, ours in pairs]
        ours = f"RCB sends {min(sent):.3g} to {max(sent):.3g} times the bytes of a call with the"
        ours += f" four settings; into the root {min(received):.3g} to {max(received):.3g} times"
        verdict = CONFIRMED if min(received + sent) > 1 else REFUTED
        yield "RRCB exchanges far less than RCB", ours, verdict, "snapshots"
    tables = [read(path) for path in sorted(evidence.out.glob("points-*/table.csv"))]
    rows = sorted((t for t in tables if len(t)), key=lambda t: t["points"].iloc[0])
    if len(rows) > 1:
        first, last = rows[0], rows[-1]
        grown = last["points"].iloc[0] / first["points"].iloc[0]
        rcb, ours = (
            row_of(last, method).bytes / row_of(first, method).bytes for method in (RCB, WINNERS[1])
        )
        text = f"{grown:.3g} times the points: RCB sends {rcb:.2f} times the bytes, RRCB {ours:.2f}"
        verdict = CONFIRMED if rcb > 1.5 > ours else REFUTED
        yield "RCB's traffic grows with the points", text, verdict, "snapshots"


def _faster(evidence: Evidence) -> Iterator[Claim]:
    speeds = {method: median_of(values) for method, values in evidence.speeds.items()}
    for method in WINNERS if RCB in speeds else ():
        text = f"speed-up {speeds[method].text(2)}, RCB {speeds[RCB].text(2)}"
        verdict = compare(speeds[method], speeds[RCB])
        yield f"{_name(method)} is faster than RCB", text, verdict, "simulations"


def _serial(evidence: Evidence) -> Iterator[Claim]:
    if RCB not in evidence.speeds:
        return
    speed, runs = median_of(evidence.speeds[RCB]), evidence.every_step
    rcb = runs[runs["method"] == RCB]
    call = ((rcb["balance_path_s"] + rcb["balance_network_s"]) / rcb["steps"]).median()
    serial = evidence.runs("serial")
    step = (serial["step_path_s"] / serial["steps"]).median()
    text = f"speed-up {speed.text(2)}: a rebalance takes {1e3 * call:.2g} ms, a whole serial step"
    text += f" {1e3 * step:.2g} ms"
    yield "RCB on 4 processes is faster than serial", text, compare(speed, ONE), "simulations"


def _best_number(evidence: Evidence) -> Iterator[Claim]:
    numbers = sorted(int(path.name.removeprefix("ranks-")) for path in evidence.out.glob("ranks-*"))
    by_ranks = {n: evidence.speed_ups(f"ranks-{n}", "ranks-1") for n in numbers if n > 1}
    for method in (RCB, STANDARD):
        found = {n: median_of(of[method]) for n, of in by_ranks.items() if method in of}
        if 4 not in found or len(found) < 2:
            continue
        verdicts = {compare(found[4], value) for n, value in found.items() if n != 4}
        verdict = CONFIRMED if verdicts == {CONFIRMED} else NOT_TOLD_APART
        texts = [f"{value.text(2)} on {n}" for n, value in found.items()]
        ours = f"speed-up of {method}: " + ", ".join(texts)
        yield "4 processes are best", ours, REFUTED if REFUTED in verdicts else verdict, "ranks"


def _unbalance(evidence: Evidence) -> Iterator[Claim]:
    found = evidence.imbalances
    ours = [found[method] for method in WINNERS if method in found]
    if not ours or RCB not in found:
        return
    rcb, low, high = found[RCB], min(v.number for v in ours), max(v.number for v in ours)
    run = evidence.every_step.iloc[0]
    text = f"mean imbalance of the four settings {low:.4f} to {high:.4f}, of RCB {rcb.number:.4f}"
    verdicts = {compare(value, Value(rcb.number, rcb.number, rcb.number)) for value in ours}
    verdict = verdicts.pop() if len(verdicts) == 1 else NOT_TOLD_APART
    rounds = f"; {ours[0].count} runs of {run.steps:,} steps"
    yield "RRCB's unbalance is clearly worse than RCB's", text + rounds, verdict, "simulations"
    point = run.ranks / run.points
    excess = max(rcb.number - 1, point)
    text = f"the fullest part has {100 * (low - 1):.1f} to {100 * (high - 1):.1f} % above the mean:"
    text += f" {(low - 1) / excess:.0f} to {(high - 1) / excess:.0f} times RCB's"
    claim = "the unbalance is a “small increase”, and “considerably greater” than RCB's"
    yield claim, text, f"{CONFIRMED}, both: in per cent, and as a multiple", "simulations"


def _random_points(evidence: Evidence) -> Iterator[Claim]:
    results = Results(evidence.out / "setting-1")
    pairs = []
    for workload in (f"slope-{name}" for name in SNAPSHOTS):
        points = material_points(results, workload)
        for setting in WINNERS if len(points) else ():
            seeds = [np.random.default_rng(seed) for seed in range(SEEDS)]
            drawn = mean(excesses(points, setting, 4, seed) for seed in seeds)
            pairs.append((drawn, excesses(points, setting, 4, None)))
    if pairs:
        drawn, alone = map(mean, zip(*pairs))
        part = 1 - alone / drawn
        ours = f"{100 * drawn:.2f} % of unbalance with random points, {100 * alone:.2f} % with the boxes"
        ours += " they are drawn from; four settings, three snapshots that stand still, ten seeds"
        verdict = PARTLY if 0.1 < part < 0.9 else CONFIRMED if part > 0.5 else REFUTED
        yield "... because of the pseudo-random points", ours, verdict, "boxes"


def _pairs(rows: dict[str, object], field: int, ends: tuple[float, float]) -> list[tuple]:
    """Rows at both ends of mesh (0) or fraction (2), all else alike."""
    settings = {setting_of(name): row for name, row in rows.items() if setting_of(name)}
    other = {s: (*s[:field], ends[1], *s[field + 1 :]) for s in settings if s[field] == ends[0]}
    return [(settings[a], settings[b]) for a, b in other.items() if b in settings]


def _finer_mesh(evidence: Evidence) -> Iterator[Claim]:
    pairs = [pair for rows in evidence.skewed for pair in _pairs(rows, 0, (COARSE, FINE))]
    if pairs:
        found = median_of(coarse.excess / fine.excess for coarse, fine in pairs)
        ours = f"mesh {COARSE} has {found.text(1)} times the unbalance of mesh {FINE}:"
        ours += f" {found.count} pairs of k, fraction and snapshot"
        yield "a finer mesh lowers the unbalance", ours, compare(found, ONE), "snapshots"
    coarse, fine = (evidence.speeds.get(WINNERS[n], []) for n in (1, 3))
    if coarse and fine:
        found = median_of(a / b for a, b in zip(coarse, fine))
        ours = f"speed-up with mesh 4 / with mesh 8, 2 σ, 12.5 %: {found.text(2)}"
        yield "... and costs speed", ours, compare(found, ONE), "simulations"
    shares = [
        drawn_outside(Results(evidence.out / f"setting-{number}"), workload)
        for number in (2, 4)
        for workload in (f"slope-{name}" for name in SNAPSHOTS)
    ]
    if not any(np.isnan(shares)):
        coarse, fine = np.mean(shares[:3]), np.mean(shares[3:])
        ours = f"{100 * coarse:.1f} % of the drawn points lie in empty squares of 1 m with mesh 4,"
        ours += f" {100 * fine:.1f} % with mesh 8"
        verdict = CONFIRMED if fine < coarse else REFUTED
        yield "a finer mesh mends the poor incline", ours, verdict, "boxes"


def _fewer_points(evidence: Evidence) -> Iterator[Claim]:
    pairs = [pair for rows in evidence.snapshots for pair in _pairs(rows, 2, (MOST, LEAST))]
    if pairs:
        found = median_of(most.time_ms / least.time_ms for most, least in pairs)
        ours = f"a call with 100 % takes {found.text(2)} times as long as with 12.5 %:"
        ours += f" {found.count} pairs of mesh, k and snapshot"
        yield "fewer drawn points are faster", ours, compare(found, ONE), "snapshots"


def _each_step(evidence: Evidence) -> Iterator[Claim]:
    seldom = evidence.runs("seldom")
    seldom = seldom[seldom["method"] == RCB] if len(seldom) else seldom
    if len(seldom):
        run = seldom.iloc[0]
        lost = 100 * (run.path_points * run.ranks / (run.points * run.steps) - 1)
        ours = f"rebalanced each {run.every} of {run.steps:,} steps RCB's fullest part has"
        ours += f" {lost:.1f} % more than the mean"
        yield "rebalancing is needed at each step", ours, REFUTED, "simulations"


def _communication_area(evidence: Evidence) -> Iterator[Claim]:
    pairs = [(rows[RCB], rows[of]) for rows in evidence.snapshots for of in WINNERS if of in rows]
    if pairs and hasattr(pairs[0][0], "ghosts"):
        ratios = [ours.ghosts / rcb.ghosts for rcb, ours in pairs]
        ours = f"RRCB's parts have {min(ratios):.2f} to {max(ratios):.2f} times the ghosts of RCB's"
        verdict = CONFIRMED if max(ratios) < 1.1 else PARTLY if min(ratios) < 1.1 else REFUTED
        claim = "cuts across the longest extent keep the communication area small"
        yield claim, ours, verdict, "snapshots"


def _literal_midpoint(evidence: Evidence) -> Iterator[Claim]:
    method = RCB + "[cut=midpoint]"
    found = [rows[method] for rows in evidence.snapshots if method in rows]
    if found:
        texts = [f"{row.imbalance:.3f} ({row.workload})" for row in found]
        ours = "imbalance of RCB with that rule: " + ", ".join(texts)
        verdict = REFUTED if max(row.imbalance for row in found) > 1.1 else CONFIRMED
        yield "boxes are cut at the “midpoint of that direction”", ours, verdict, "snapshots"


def _learned(evidence: Evidence) -> Iterator[Claim]:
    found = evidence.imbalances
    if "rrcb" in found:
        text = "comparisons/studies/learned trains one; RRCB's density, without random points, has"
        text += f" a mean imbalance of {found['rrcb'].number:.4f} in the same simulation"
        claim = "a learned model may generate the statistical domain better (future work)"
        yield claim, text, NOT_TESTABLE, "simulations"


FINDERS = (
    _traffic,
    _faster,
    _serial,
    _best_number,
    _unbalance,
    _random_points,
    _finer_mesh,
    _fewer_points,
    _each_step,
    _communication_area,
    _literal_midpoint,
    _learned,
)
