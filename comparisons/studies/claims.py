"""The paper's claims and the numbers measured here with which they are judged: the table of docs/design/paper.md."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from statistics import median

import numpy as np
import pandas as pd
from intervals import NOT_TOLD_APART, ONE, Value, median_of
from methods import RCB, WINNERS, setting_of
from paper_figures import moved_shares, speed_ups
from results import Results, measurements, read
from simulation import balancing, of_method, once, uneven_points

CONFIRMED, REFUTED, PARTLY = "confirmed", "refuted", "partly"
BY_COST = "depends on the cost of a point-step"
SNAPSHOTS = [f"slope-{moment}" for moment in ("start", "middle", "end")]
PATH = "critical path"


@dataclass
class Claim:
    """`judge` names the numbers compared: exact counts, or times whose 95 % intervals must not overlap."""

    number: int
    text: str
    measured: str
    verdict: str
    judge: str


def compare(first: Value, second: Value) -> str:
    """Returns whether the first value is greater. Single measurements are inconclusive."""
    if first.low > second.high:
        return CONFIRMED
    return REFUTED if first.high < second.low else NOT_TOLD_APART


def counts(values: Iterable[float]) -> Value:
    """Returns the median of counts, with their range as the interval."""
    values = list(values)
    return Value(median(values), min(values), max(values))


def exactly(value: float) -> Value:
    return Value(value, value, value)


def listed(values: Iterable[str]) -> str:
    *first, last = values
    return f"{', '.join(first)} and {last}" if first else last


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

    @cached_property
    def speeds(self) -> dict[str, Value]:
        return speed_ups(self.out / "simulations")

    @cached_property
    def grid(self) -> dict[str, Value]:
        return speed_ups(self.out / "grid")


def claim_table(out: Path) -> pd.DataFrame:
    """Returns a row for each claim that has been measured. The paper gives no number for any of them."""
    evidence = Evidence(out)
    claims = sorted((claim for find in FINDERS for claim in find(evidence)), key=lambda claim: claim.number)
    return pd.DataFrame(
        [{"": f"{c.number}", "the paper says": c.text, "measured here": c.measured, "verdict": c.verdict,
          "judged by": c.judge} for c in claims]
    )  # fmt: skip


def _name(method: str) -> str:
    mesh, k, fraction = setting_of(method)
    return f"mesh {mesh:g}, k = {k:g} and {100 * fraction:g} %"


def _traffic(evidence: Evidence) -> Iterator[Claim]:
    for number, column, text, what in (
        (1, "bytes", "RRCB exchanges less data than RCB.", "RCB sends {} times as many bytes as the four settings."),
        (2, "root_bytes_in", "The root receives less data.", "Under RCB rank 0 receives {} times as many bytes."),
    ):
        if found := [getattr(rcb, column) / getattr(ours, column) for rcb, ours in evidence.winners]:
            of = counts(found)
            span = f"{of.low:.0f} to {of.high:.0f}"
            yield Claim(number, text, what.format(span), compare(of, ONE), "counts at three moments")
    tables = [read(path) for path in evidence.out.glob("points-*/table.csv")]
    if len(tables) > 1:
        tables.sort(key=lambda table: table["points"].iloc[0])
        first, last = (table.set_index("method") for table in (tables[0], tables[-1]))
        grown, times = last["bytes"] / first["bytes"], last["points"].iloc[0] / first["points"].iloc[0]
        what = f"With {times:.3g} times the points, RCB sends {grown[RCB]:.2f} times as many bytes, RRCB {grown[WINNERS[1]]:.2f} times."
        verdict = compare(*map(exactly, (grown[RCB], grown[WINNERS[1]])))
        yield Claim(3, "RCB's traffic grows with the number of points.", what, verdict, "counts")


def _speed(evidence: Evidence) -> Iterator[Claim]:
    speeds = evidence.speeds
    named = [setting for setting in WINNERS if setting in speeds]
    if RCB not in speeds or not named:
        return
    rcb, moved = speeds[RCB], moved_shares(evidence.out / "simulations")
    verdicts = {compare(speeds[of], rcb) for of in named}
    what = (
        f"Their speed-ups are {listed(speeds[of].text(2) for of in named)}; RCB's is {rcb.text(2)}. A call moves"
        f" {listed(f'{100 * moved[of]:.2g} %' for of in (*named, RCB))} of the points."
    )
    yield Claim(4, "The four settings are faster than RCB.", what, verdicts.pop() if len(verdicts) == 1 else PARTLY, PATH)
    best = max((speeds[of] for of in named), key=lambda v: v.number)
    others = [f"the library's `rrcb` {speeds[of].text(2)}" for of in ("rrcb",) if of in speeds]
    if settings := [v for of, v in evidence.grid.items() if setting_of(of)]:
        others.append(f"the best of {len(settings)} settings {max(settings, key=lambda v: v.number).text(2)}")
    what = f"The best of the four has a speed-up of {best.text(2)}" + "".join(f"; {other}" for other in others) + "."
    yield Claim(5, "RRCB is faster than a serial run.", what, compare(best, ONE), PATH)
    yield Claim(11, "RCB on 4 processes is faster than a serial run.",
                f"Its speed-up is {rcb.text(2)}. {_break_even(evidence)}", BY_COST, PATH)  # fmt: skip


def _break_even(evidence: Evidence) -> str:
    """Returns the cost of a point in a step above which RCB is faster although it is called in each step: the
    additional time of its call divided by what the other processes save."""
    rcb, serial = evidence.runs("simulations", RCB), evidence.runs("simulations", "serial")
    call = (balancing(rcb) / rcb["steps"]).median()
    step = (serial["step_path_s"] / serial["steps"] / serial["points"]).median()
    saved = (rcb["points"] * (1 - rcb["mean_imbalance"] / rcb["ranks"])).median()
    return f"It would be faster if a point cost at least {1e9 * call / saved:.0f} ns a step; here it costs {1e9 * step:.0f} ns."


def _best_settings(evidence: Evidence) -> Iterator[Claim]:
    """Yields the claims of figure 5."""
    speeds, moved = evidence.grid, moved_shares(evidence.out / "grid")
    settings = sorted((of for of in speeds if setting_of(of)), key=lambda of: -speeds[of].number)
    named = [of for of in WINNERS if of in speeds]
    if not settings or not named or RCB not in speeds:
        return
    best, slowest = settings[0], min(named, key=lambda of: speeds[of].number)
    what = (
        f"The slowest of them has a speed-up of {speeds[slowest].text(2)}; {_name(best)} has {speeds[best].text(2)}."
        f" A call moves {100 * moved[slowest]:.2g} and {100 * moved[best]:.2g} % of the points."
    )
    yield Claim(12, "The four settings are the fastest.", what, compare(speeds[slowest], speeds[best]), PATH)
    better = sum(compare(speeds[of], speeds[RCB]) == CONFIRMED for of in settings)
    what = f"{better} of {len(settings)} settings are faster than RCB."
    yield Claim(14, "In certain configurations there was an improvement.", what, CONFIRMED if better else REFUTED, PATH)
    ratios = {}
    for k in sorted({setting_of(of)[1] for of in settings}):
        pairs = _pairs({of: speeds[of] for of in settings if setting_of(of)[1] == k}, 0, (2, 10))
        ratios |= {f"{k:g}": [coarse.number / fine.number for coarse, fine in pairs]} if pairs else {}
    if ratios:
        each = listed(f"{median(of):.2f} with k = {k}" for k, of in ratios.items())
        all_pairs = median_of(ratio for of in ratios.values() for ratio in of)
        what = f"Mesh 2 has {each} of the speed-up of mesh 10; {all_pairs.text(2)} in all {all_pairs.count} pairs."
        yield Claim(18, "A finer mesh costs speed.", what, compare(all_pairs, ONE), PATH)


def _best_number(evidence: Evidence) -> Iterator[Claim]:
    numbers = sorted(int(path.name.removeprefix("ranks-")) for path in evidence.out.glob("ranks-*"))
    found = {n: speeds[RCB] for n in numbers if RCB in (speeds := speed_ups(evidence.out / f"ranks-{n}"))}
    if 4 in found and len(found) > 1:
        what = f"The speed-up on {listed(map(str, found))} processes is {listed(v.text(2) for v in found.values())}."
        yield Claim(13, "4 processes are best for RCB.", what, BY_COST, PATH)


def _unbalance(evidence: Evidence) -> Iterator[Claim]:
    runs = evidence.runs("simulations")
    if runs.empty or not {RCB, *WINNERS} <= set(runs["method"]):
        return
    found = {m: of_method(runs, runs["mean_imbalance"], m) for m in (RCB, *WINNERS)}
    least, most = (find((found[m] for m in WINNERS), key=lambda v: v.number) for find in (min, max))
    ours = Value(most.number, least.low, most.high)
    point = runs["ranks"].iloc[0] / runs["points"].iloc[0]  # one point more in a part
    excess = {m: Value(*(100 * (of - 1) for of in (v.number, v.low, v.high))) for m, v in found.items()}
    what = f"The mean excess is {listed(excess[m].text(2) for m in WINNERS)} % with the four settings, {max(excess[RCB].number, 100 * point):.2f} % with RCB."
    yield Claim(6, "RRCB's imbalance is \u201cconsiderably greater\u201d than RCB's.", what,
                compare(ours, exactly(max(found[RCB].number, 1 + point))), "points of each step")  # fmt: skip
    verdicts = {compare(exactly(1.05), found[m]) for m in WINNERS}
    verdict = verdicts.pop() if len(verdicts) == 1 else NOT_TOLD_APART if NOT_TOLD_APART in verdicts else PARTLY
    what = f"The mean imbalances are {listed(found[m].text(3) for m in WINNERS)}; we call up to 1.05 small."
    yield Claim(17, "RRCB's imbalance is a \u201csmall increase\u201d.", what, verdict, "points of each step")


def _pairs(rows: dict[str, object], field: int, ends: tuple[float, float]) -> list[tuple]:
    """Returns the rows for both ends of mesh (0) or fraction (2), all other parameters being equal."""
    settings = {setting_of(name): row for name, row in rows.items() if setting_of(name)}
    other = {s: (*s[:field], ends[1], *s[field + 1 :]) for s in settings if s[field] == ends[0]}
    return [(settings[a], settings[b]) for a, b in other.items() if b in settings]


def drawn_outside(results: Results, workload: str, side: float = 1.0) -> float:
    """Returns the share of the drawn points in squares without a material point; NaN if there are no files."""
    drawn, real = results.data("statistical", workload), material_points(results, workload)
    if drawn.empty or not len(real):
        return float("nan")
    squares = {tuple(square) for square in np.floor(real / side).astype(int)}
    places = np.floor(drawn[["x", "y"]].to_numpy() / side).astype(int)
    return float(np.mean([tuple(place) not in squares for place in places]))


def material_points(results: Results, workload: str) -> np.ndarray:
    files = sorted((results.folder / "data").glob(f"points_{workload}_*.csv"))
    return np.loadtxt(files[0], delimiter=",", skiprows=1, usecols=(0, 1)) if files else np.empty(0)


def _finer_mesh(evidence: Evidence) -> Iterator[Claim]:
    # At the start the points are on the faces of cells.
    skewed = [rows for rows in evidence.snapshots if not rows[RCB].workload.endswith("-start")]
    if pairs := [pair for rows in skewed for pair in _pairs(rows, 0, (2, 10))]:
        found = median_of(coarse.excess / fine.excess for coarse, fine in pairs)
        what = f"The excess with mesh 2 is {found.text(1)} times that with mesh 10; {found.count} pairs."
        yield Claim(7, "A finer mesh lowers the imbalance.", what, compare(found, ONE), "points at two moments")
    folders = [Results(evidence.out / f"setting-{number}") for number in (2, 4)]
    shares = [[drawn_outside(results, name) for name in SNAPSHOTS] for results in folders]
    if not np.isnan(shares).any():
        coarse, fine = 100 * np.mean(shares, axis=1)
        what = f"With mesh 8, {fine:.1f} % of the drawn points are outside the slope, with mesh 4 {coarse:.1f} %."
        yield Claim(8, "A finer mesh represents the incline better.", what, compare(exactly(coarse), exactly(fine)),
                    "drawn points")  # fmt: skip


def _others(evidence: Evidence) -> Iterator[Claim]:
    if pairs := [pair for rows in evidence.snapshots for pair in _pairs(rows, 2, (1, 0.125))]:
        found = median_of(most.time_ms / least.time_ms for most, least in pairs)
        what = f"A call with 100 % takes {found.text(2)} times as long as with 12.5 %; {found.count} pairs."
        yield Claim(9, "Fewer drawn points are faster.", what, compare(found, ONE), "times of calls")
    if len(seldom := evidence.runs("seldom", RCB)):
        lost = 100 * (uneven_points(seldom).iloc[0] - 1)
        what = f"If RCB is called every {seldom.iloc[0]['every']} steps, its excess is {lost:.1f} %; 5 % would need more calls."
        yield Claim(15, "Each step needs a rebalance.", what, compare(exactly(lost), exactly(5)), "points of each step")
    if found := [ours.ghosts / rcb.ghosts for rcb, ours in evidence.winners]:
        verdict = CONFIRMED if max(found) < 1.1 else PARTLY if min(found) < 1.1 else REFUTED
        what = f"RRCB's parts have {min(found):.2f} to {max(found):.2f} times the ghosts of RCB's; 1.1 would be more."
        yield Claim(10, "Cuts across the longest extent keep communication small.", what, verdict, "counts at three moments")
    method = RCB + "[cut=midpoint]"
    if found := [rows[method].imbalance for rows in evidence.snapshots if method in rows]:
        what = f"This rule leaves an imbalance of {min(found):.2f} to {max(found):.2f}."
        yield Claim(16, "Boxes are cut at the midpoint.", what, compare(exactly(1.1), counts(found)), "points at three moments")


FINDERS = (_traffic, _speed, _best_settings, _best_number, _unbalance, _finer_mesh, _others)
