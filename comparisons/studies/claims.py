"""The paper's claims and the numbers measured here with which they are judged. docs/design/paper.md discusses them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from statistics import mean, median

import numpy as np
import pandas as pd
from boxes import drawn_outside, excesses, material_points
from intervals import NOT_TOLD_APART, ONE, Value, median_of
from methods import RCB, STANDARD, WINNERS, setting_of
from paper_figures import speed_ups
from results import Results, measurements, read
from simulation import balancing, of_method, once, paired, uneven_points

CONFIRMED, REFUTED, PARTLY = "confirmed", "refuted", "partly"
SEEDS = 10
SNAPSHOTS = [f"slope-{moment}" for moment in ("start", "middle", "end")]


@dataclass
class Claim:
    """A claim is confirmed if the first value is greater and the 95 % intervals do not overlap. Single measurements are
    inconclusive. The interval of several counts is their range."""

    text: str
    measured: str
    value: Value
    limit: Value
    part: str  # part of the study that measures the numbers
    digits: int = 2
    verdict: str = ""

    @property
    def row(self) -> dict[str, str]:
        limit = self.limit.text(self.digits) if self.limit is not ONE else "1"
        verdict = self.verdict or compare(self.value, self.limit)
        return {
            "the paper says": self.text, "measured here": self.measured,
            "value": self.value.text(self.digits), "against": limit, "verdict": verdict,
            "part": self.part,
        }  # fmt: skip


def compare(first: Value, second: Value) -> str:
    """Returns whether the first value is greater."""
    if first.low > second.high:
        return CONFIRMED
    return REFUTED if first.high < second.low else NOT_TOLD_APART


def counts(values: Iterable[float]) -> Value:
    values = list(values)
    return Value(median(values), min(values), max(values))


def exactly(value: float) -> Value:
    return Value(value, value, value)


class Evidence:
    """The result files of each run of the driver."""

    def __init__(self, out: Path) -> None:
        self.out = out

    def runs(self, name: str, method: str = "") -> pd.DataFrame:
        runs = once(read(self.out / name / "simulation_runs.csv"))
        return runs[runs["method"] == method] if method and len(runs) else runs

    @cached_property
    def snapshots(self) -> list[dict[str, object]]:
        """Returns the rows of each snapshot by method."""
        rows = measurements(read(self.out / "snapshots/table.csv"))
        groups = rows.groupby("workload", sort=False) if len(rows) else ()
        return [{row.method: row for row in of.itertuples()} for _, of in groups]

    @cached_property
    def winners(self) -> list[tuple]:
        """Returns the rows of RCB and of the paper's best settings, from the same snapshot."""
        return [(rows[RCB], rows[of]) for rows in self.snapshots for of in WINNERS if of in rows]

    def speed_ups(self, name: str, serial: str) -> dict[str, Value]:
        return speed_ups(self.out / name, self.out / serial)

    @cached_property
    def speeds(self) -> dict[str, Value]:
        return self.speed_ups("simulations", "serial")


def claim_table(out: Path) -> pd.DataFrame:
    """Returns a row for each claim that has been measured. The paper gives no number for any of them."""
    evidence = Evidence(out)
    return pd.DataFrame([claim.row for find in FINDERS for claim in find(evidence)])


def _name(method: str) -> str:
    mesh, k, fraction = setting_of(method)
    return f"mesh {mesh:g} × {mesh:g}, {k:g} σ, {100 * fraction:g} %"


def _traffic(evidence: Evidence) -> Iterator[Claim]:
    for column, what in (("bytes", "bytes of RCB / of RRCB, the four settings"),
                         ("root_bytes_in", "bytes received by rank 0, RCB / RRCB")):  # fmt: skip
        if found := [getattr(rcb, column) / getattr(ours, column) for rcb, ours in evidence.winners]:
            text = "RRCB exchanges far less than RCB"
            yield Claim(text, what, counts(found), ONE, "snapshots", 1)
    tables = [read(path) for path in evidence.out.glob("points-*/table.csv")]
    if len(tables) > 1:
        tables.sort(key=lambda table: table["points"].iloc[0])
        first, last = (table.set_index("method") for table in (tables[0], tables[-1]))
        grown = (last["bytes"] / first["bytes"]).map(exactly)
        what = f"growth of RCB's bytes, of RRCB's, {last['points'].iloc[0] / first['points'].iloc[0]:.3g}"
        text = "RCB's traffic grows with the points"
        yield Claim(text, what + " times the points", grown[RCB], grown[WINNERS[1]], "snapshots")


def _speed(evidence: Evidence) -> Iterator[Claim]:
    speeds = evidence.speeds
    if RCB not in speeds:
        return
    for method in (setting for setting in WINNERS if setting in speeds):
        text = f"{_name(method)} is faster than RCB"
        yield Claim(text, "speed-up, RCB's", speeds[method], speeds[RCB], "simulations")
    what = f"speed-up; {_break_even(evidence)}"
    yield Claim("RCB on 4 processes is faster than serial", what, speeds[RCB], ONE, "simulations")
    if "rrcb" in speeds:
        yield Claim("RRCB on 4 processes is faster than serial", "speed-up of rrcb, the best here",
                    speeds["rrcb"], ONE, "simulations")  # fmt: skip


def _break_even(evidence: Evidence) -> str:
    """Returns the cost of a point in a step above which RCB is faster although it is called in each step: the
    additional time of its call divided by what the other processes save."""
    rcb, serial = evidence.runs("simulations", RCB), evidence.runs("serial", "none")
    call = (balancing(rcb) / rcb["steps"]).median()
    step = (serial["step_path_s"] / serial["steps"] / serial["points"]).median()
    saved = rcb["points"] * (1 - rcb["mean_imbalance"] / rcb["ranks"])
    return f"it wins from {1e9 * (call / saved).median():.0f} ns a point-step, here {1e9 * step:.0f}"


def _best_settings(evidence: Evidence) -> Iterator[Claim]:
    """Yields the claims of figure 5."""
    speeds = evidence.speed_ups("grid", "grid-serial")
    fastest = sorted((of for of in speeds if setting_of(of)), key=lambda of: -speeds[of].number)[: len(WINNERS)]
    named = [of for of in WINNERS if of in speeds]
    if fastest and named:
        slowest = min(named, key=lambda of: speeds[of].number)
        both = len(set(fastest) & set(WINNERS))
        what = f"speed-up of the slowest of the paper's four, of the best here, {_name(fastest[0])}; {both} in both"
        yield Claim("these four settings are the fastest", what, speeds[slowest], speeds[fastest[0]], "grid")


def _best_number(evidence: Evidence) -> Iterator[Claim]:
    numbers = sorted(int(path.name.removeprefix("ranks-")) for path in evidence.out.glob("ranks-*"))
    by_ranks = {n: evidence.speed_ups(f"ranks-{n}", "ranks-1") for n in numbers if n > 1}
    for method in (RCB, STANDARD):
        found = {n: of[method] for n, of in by_ranks.items() if method in of}
        if 4 in found and len(found) > 1:
            other = max((n for n in found if n != 4), key=lambda n: found[n].number)
            what = f"speed-up of {method} on 4, on {other}"
            yield Claim("4 processes are best", what, found[4], found[other], "ranks")


def _unbalance(evidence: Evidence) -> Iterator[Claim]:
    runs = evidence.runs("simulations")
    if runs.empty or not {RCB, *WINNERS} <= set(runs["method"]):
        return
    found = {m: of_method(runs, runs["mean_imbalance"], m) for m in (RCB, *WINNERS)}
    rcb = exactly(found[RCB].number)
    least, most = (find((found[m] for m in WINNERS), key=lambda v: v.number) for find in (min, max))
    point = max(rcb.number - 1, runs["ranks"].iloc[0] / runs["points"].iloc[0])
    times = Value(*((found_at - 1) / point for found_at in (most.number, least.low, most.high)))
    yield Claim("RRCB's unbalance is “considerably greater” than RCB's", "excess of RRCB / RCB's",
                times, ONE, "simulations", 0)  # fmt: skip
    yield Claim("its unbalance is a “small increase”", "1.05, mean imbalance of the four settings",
                exactly(1.05), Value(most.number, least.low, most.high), "simulations", 4)  # fmt: skip


def _random_points(evidence: Evidence) -> Iterator[Claim]:
    results = Results(evidence.out / "setting-1")
    pairs = []
    for points in (material_points(results, workload) for workload in SNAPSHOTS):
        for setting in WINNERS if len(points) else ():
            seeds = [np.random.default_rng(seed) for seed in range(SEEDS)]
            drawn = mean(excesses(points, setting, 4, seed) for seed in seeds)
            pairs.append((drawn, excesses(points, setting, 4, None)))
    if pairs:
        drawn, alone = (100 * mean(values) for values in zip(*pairs))
        part = 1 - alone / drawn
        verdict = PARTLY if 0.1 < part < 0.9 else CONFIRMED if part > 0.5 else REFUTED
        what = "% of unbalance with random points, with the boxes they are drawn from"
        yield Claim("... because of the pseudo-random points", what, exactly(drawn), exactly(alone),
                    "boxes", verdict=verdict)  # fmt: skip


def _pairs(rows: dict[str, object], field: int, ends: tuple[float, float]) -> list[tuple]:
    """Returns the rows for both ends of mesh (0) or fraction (2), all other parameters being equal."""
    settings = {setting_of(name): row for name, row in rows.items() if setting_of(name)}
    other = {s: (*s[:field], ends[1], *s[field + 1 :]) for s in settings if s[field] == ends[0]}
    return [(settings[a], settings[b]) for a, b in other.items() if b in settings]


def _finer_mesh(evidence: Evidence) -> Iterator[Claim]:
    # At the start the points are on the faces of cells.
    skewed = [rows for rows in evidence.snapshots if not rows[RCB].workload.endswith("-start")]
    if pairs := [pair for rows in skewed for pair in _pairs(rows, 0, (2, 10))]:
        found = median_of(coarse.excess / fine.excess for coarse, fine in pairs)
        what = f"unbalance of mesh 2 / of mesh 10: {found.count} pairs of k, fraction and snapshot"
        yield Claim("a finer mesh lowers the unbalance", what, found, ONE, "snapshots", 1)
    runs = evidence.runs("simulations")
    if len(runs) and (found := paired(runs, 1 / runs["critical_path_s"], WINNERS[1], WINNERS[3])):
        what = "speed-up with mesh 4 / with mesh 8, 2 σ, 12.5 %"
        yield Claim("... and costs speed", what, found, ONE, "simulations")
    folders = [Results(evidence.out / f"setting-{number}") for number in (2, 4)]
    shares = [[drawn_outside(results, name) for name in SNAPSHOTS] for results in folders]
    if not np.isnan(shares).any():
        coarse, fine = map(exactly, 100 * np.mean(shares, axis=1))
        what = "% of the drawn points in empty squares of 1 m, mesh 4, mesh 8"
        yield Claim("a finer mesh mends the poor incline", what, coarse, fine, "boxes", 1)


def _others(evidence: Evidence) -> Iterator[Claim]:
    if pairs := [pair for rows in evidence.snapshots for pair in _pairs(rows, 2, (1, 0.125))]:
        found = median_of(most.time_ms / least.time_ms for most, least in pairs)
        what = f"time of a call with 100 % / with 12.5 %: {found.count} pairs of mesh, k and snapshot"
        yield Claim("fewer drawn points are faster", what, found, ONE, "snapshots")
    if len(seldom := evidence.runs("seldom", RCB)):
        lost = exactly(100 * (uneven_points(seldom).iloc[0] - 1))
        every, steps = seldom.iloc[0][["every", "steps"]]
        what = f"RCB's excess in %, rebalanced each {every} of {steps:,} steps, 5 %"
        yield Claim("rebalancing is needed at each step", what, lost, exactly(5), "simulations", 1)
    if found := [ours.ghosts / rcb.ghosts for rcb, ours in evidence.winners]:
        verdict = CONFIRMED if max(found) < 1.1 else PARTLY if min(found) < 1.1 else REFUTED
        text = "cuts across the longest extent keep the communication area small"
        yield Claim(text, "ghosts of RRCB's parts / of RCB's", counts(found), exactly(1.1), "snapshots",
                    verdict=verdict)  # fmt: skip
    method = RCB + "[cut=midpoint]"
    if found := [rows[method].imbalance for rows in evidence.snapshots if method in rows]:
        text = "boxes are cut at the “midpoint of that direction”"
        yield Claim(text, "1.1, imbalance of RCB with that rule", exactly(1.1), counts(found), "snapshots", 3)


FINDERS = (_traffic, _speed, _best_settings, _best_number, _unbalance, _random_points, _finer_mesh, _others)
