"""What the paper says, beside what was measured here: computed from the files of a sweep."""

from __future__ import annotations

from collections.abc import Iterator

from cycle import lasting
from intervals import NOT_TOLD_APART, ONE, Value, median_of
from machine import CORES
from methods import STANDARD, WINNERS, setting_of
from results import Results
from speed_up import SpeedUp, read_speed_ups

CONFIRMED, REFUTED = "confirmed", "refuted"
NOT_TESTABLE = "not testable here"
COMMAND = "comparisons/run --sweep --only="
RCB = "root-rcb"  # the paper's
PROCESSES = 4  # of the paper's study
COARSE, FINE = 2, 10  # the ends of the paper's meshes

Claim = tuple[str, str, str, str]  # text, ours, verdict, parts of the sweep that hold the numbers


class Evidence:
    """What the claims are judged by."""

    def __init__(self, results: Results) -> None:
        self.results = results
        self.snapshots = [
            {row.method: row for row in rows.itertuples()}
            for _, rows in results.snapshots.groupby(["workload", "points"], sort=False)
        ] if len(results.snapshots) else []  # fmt: skip
        self.all_speed_ups = read_speed_ups(results.swept_runs)
        self.speed_ups = _on_four(self.all_speed_ups)
        self.at_every_step = _on_four(read_speed_ups(results.paper_runs))


def _on_four(speed_ups: list[SpeedUp]) -> dict[str, SpeedUp]:
    return {s.run.method: s for s in speed_ups if s.run.ranks == PROCESSES}


def claim_table(results: Results) -> list[dict[str, str]]:
    """A row per claim whose numbers are there."""
    evidence = Evidence(results)
    header = ("the paper says", "measured here, with 95 % intervals", "verdict", "command")
    found = [claim for find in FINDERS for claim in find(evidence)]
    return [dict(zip(header, (*claim[:3], COMMAND + claim[3]))) for claim in found]


def compare(first: Value, second: Value) -> str:
    """Whether the first is greater; nothing is told apart by single runs."""
    if first.low > second.high:
        return CONFIRMED
    return REFUTED if first.high < second.low else NOT_TOLD_APART


def set_up_table(results: Results) -> list[dict[str, str]]:
    """In what this study differs from the paper's."""
    once = read_speed_ups(results.paper_runs)
    runs = [s.run for s in read_speed_ups(results.swept_runs) or once]
    rows = [("machine", "not known", f"{CORES} cores, shared by the ranks")]
    if runs:
        run = runs[-1]
        every = "each step" if run.every == 1 else f"each {run.every} steps"
        every += "; each step in one run more" * (bool(once) and run.every > 1)
        rows += [
            ("material points", "54,440", f"{run.points:,}"),
            ("steps of the failure", "not known", f"{run.steps:,}"),
            ("rebalanced", "each step", every),
        ]
    rows += [
        ("language, MPI library", "not known", "C++20; run.txt names the library"),
        ("calls", "not known", "through Zoltan's callbacks and lists"),
        ("speed-up", "serial time / parallel time", "the same by processor time outside MPI and a"
         " network of 1.5 µs and 12 GB/s: as with a core for every rank; and by the clock"),
        ("start", "not known", "slabs of equal width"),
        ("pseudo-random points", "fixed seed", "fixed in a run; other runs take other seeds"),
        ("cut", "“midpoint of that direction”", "where the points on both sides are in the ratio of"
         " the processes; the literal rule is tried too"),
    ]  # fmt: skip
    return [dict(zip(("", "in the paper", "here"), row)) for row in rows]


def _less_traffic(evidence: Evidence) -> Iterator[Claim]:
    pairs = [
        (rows[RCB], rows[setting])
        for rows in evidence.snapshots
        for setting in WINNERS
        if RCB in rows and setting in rows
    ]
    if pairs:
        sent = [rcb.bytes / ours.bytes for rcb, ours in pairs]
        received = [rcb.root_bytes_in / ours.root_bytes_in for rcb, ours in pairs]
        ours = f"RCB sends {min(sent):.3g} to {max(sent):.3g} times the bytes of a call with the"
        ours += f" four settings; into the root {min(received):.3g} to {max(received):.3g} times"
        verdict = CONFIRMED if min(received) > 1 and min(sent) > 1 else REFUTED
        yield "RRCB exchanges far less than RCB", ours, verdict, "snapshots"


def _faster(evidence: Evidence) -> Iterator[Claim]:
    runs, once = evidence.speed_ups, evidence.at_every_step
    for method in WINNERS if RCB in runs else ():
        if method not in runs:
            continue
        mesh, k, fraction = setting_of(method)
        name = f"mesh {mesh:g} × {mesh:g}, {k:g} σ, {100 * fraction:g} %"
        ours, theirs = (runs[m].kinds["every_step"] for m in (method, RCB))
        text, parts = f"speed-up {ours.text(2)}, RCB {theirs.text(2)}", "simulations"
        if method in once and RCB in once:
            at_once = (once[m].kinds["critical_path"].number for m in (method, RCB))
            text += "; rebalanced at every step, one run: {:.2f}, RCB {:.2f}".format(*at_once)
            parts += ",paper"
        yield f"{name} is faster than RCB", text, compare(ours, theirs), parts


def _best_number(evidence: Evidence) -> Iterator[Claim]:
    for method in (RCB, STANDARD):
        found = [s for s in evidence.all_speed_ups if s.run.method == method]
        by_ranks = {s.run.ranks: s.kinds["every_step"] for s in found}
        if PROCESSES not in by_ranks or len(by_ranks) < 2:
            continue
        four = by_ranks.pop(PROCESSES)
        verdicts = {compare(four, other) for other in by_ranks.values()}
        verdict = CONFIRMED if verdicts == {CONFIRMED} else NOT_TOLD_APART
        verdict = REFUTED if REFUTED in verdicts else verdict
        ours = f"speed-up of {method} on a core for every rank: 4 ranks {four.text(2)}"
        for ranks, value in sorted(by_ranks.items()):
            ours += f", {ranks} ranks {value.text(2)}"
        yield "4 processes are best", ours, verdict, "ranks"


def _larger_unbalance(evidence: Evidence) -> Iterator[Claim]:
    for runs, part in ((evidence.at_every_step, "paper"), (evidence.speed_ups, "simulations")):
        ours = [runs[setting].run.mean_imbalance for setting in WINNERS if setting in runs]
        if ours and RCB in runs:
            rcb = runs[RCB].run.mean_imbalance
            text = f"mean imbalance of the four settings {min(ours):.4f} to {max(ours):.4f}, of RCB"
            verdict = CONFIRMED if min(ours) > rcb else REFUTED
            yield "RRCB's unbalance is clearly worse than RCB's", f"{text} {rcb:.4f}", verdict, part
            return


def _finer_mesh(evidence: Evidence) -> Iterator[Claim]:
    ratios = [
        coarse.excess / fine.excess
        for rows in evidence.snapshots
        for coarse, fine in _by_mesh(rows)
    ]
    if ratios:
        found = median_of(ratios)
        ours = f"mesh {COARSE} has {found.text(1)} times the unbalance of mesh {FINE}:"
        ours += f" {found.count} pairs of k, fraction and snapshot"
        yield "a finer mesh lowers the unbalance", ours, compare(found, ONE), "snapshots"
    kinds = {method: s.kinds["every_step"].number for method, s in evidence.speed_ups.items()}
    ratios = [coarse / fine for coarse, fine in _by_mesh(kinds)]
    if ratios:
        found = median_of(ratios)
        ours = f"speed-up with mesh {COARSE} / with mesh {FINE}: {found.text(2)};"
        ours += f" {found.count} pairs"
        yield "... and costs speed", ours, compare(found, ONE), "simulations"


def _by_mesh(rows: dict[str, object]) -> list[tuple]:
    """Rows of the coarsest and the finest mesh with the same k and fraction."""
    settings = {setting_of(name): row for name, row in rows.items()}
    return [
        (row, settings[FINE, *rest])
        for (mesh, *rest), row in ((s, row) for s, row in settings.items() if s)
        if mesh == COARSE and (FINE, *rest) in settings
    ]


def _literal_midpoint(evidence: Evidence) -> Iterator[Claim]:
    method = RCB + "[cut=midpoint]"
    found = [rows[method] for rows in evidence.snapshots if method in rows]
    if found:
        texts = [f"{row.imbalance:.3f} ({row.workload})" for row in found]
        ours = "imbalance of RCB with that rule: " + ", ".join(texts)
        verdict = REFUTED if max(row.imbalance for row in found) > 1.1 else CONFIRMED
        claim = "boxes are cut at the “midpoint of that direction”, literally"
        yield claim, ours, verdict, "snapshots"


def _learned(evidence: Evidence) -> Iterator[Claim]:
    found = lasting(evidence.results.cycle)
    text = "comparisons/studies/learned trains one"
    analytic, sampled = found.get("rrcb[refine=none]"), found.get(STANDARD)
    if analytic and sampled:
        text += f"; the analytic one, without random points, leaves {analytic['most'].number:.4f}"
        text += f" on points that stand still, the paper's {sampled['most'].text(4)}"
    claim = "a learned model may generate the statistical domain better (future work)"
    if found:
        yield claim, text, NOT_TESTABLE, "cycle"


FINDERS = (
    _less_traffic,
    _faster,
    _best_number,
    _larger_unbalance,
    _finer_mesh,
    _literal_midpoint,
    _learned,
)
