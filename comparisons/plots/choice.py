"""Which setting is the fastest within a tolerance: what accuracy costs, in numbers."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import geometric_mean

from intervals import NOT_TOLD_APART, are_apart, inverse, mean_interval
from results import Interval, Measurement

TOLERANCES = ("1.10", "1.05", "1.01", "1.001", "exact")
EVERYWHERE = "all of these"


@dataclass(frozen=True)
class Choice:
    """The fastest setting on a case; none where no setting is within the tolerance."""

    case: str
    tolerance: str
    setting: str = ""
    time_ms: float | None = None
    times_as_fast: float | None = None  # as Zoltan's RCB; over all cases the geometric mean
    imbalance: float | None = None
    time_interval: Interval | None = None
    speed_interval: Interval | None = None
    rivals: tuple[str, ...] = ()  # settings whose time is not told apart from this one's

    @property
    def remark(self) -> str:
        """Empty where the setting is the fastest beyond the noise."""
        if not self.rivals:
            return ""
        others = self.rivals[0] if len(self.rivals) == 1 else f"{len(self.rivals)} others"
        return f" ({NOT_TOLD_APART} from {others})"


def cases(rows: list[Measurement]) -> dict[str, list[Measurement]]:
    """Rows that measure the same points on the same ranks, by a name for them."""
    sizes = {(row.points, row.ranks) for row in rows if row.layout != "simulation"}
    result: dict[str, list[Measurement]] = {}
    for row in rows:
        name = f"{row.workload} {row.dimension}-D {row.layout}"
        if len(sizes) > 1:
            name += f", {row.points:,} points, {row.ranks} ranks"
        result.setdefault(name, []).append(row)
    return result


def is_within(row: Measurement, tolerance: str) -> bool:
    """Exact: no part has more than one point above the mean."""
    limit = 1 + row.point if tolerance == "exact" else float(tolerance)
    return row.imbalance <= limit * (1 + 1e-9)


def fastest(rows: list[Measurement], tolerance: str) -> Measurement | None:
    return min(
        (row for row in rows if is_within(row, tolerance)), key=lambda r: r.time_ms, default=None
    )


def find_method(rows: list[Measurement], method: str) -> Measurement | None:
    return next((row for row in rows if row.method == method), None)


def pareto_front(
    rows: list[Measurement], cost: Callable[[Measurement], float]
) -> list[Measurement]:
    """The rows that no other beats in both cost and imbalance, cheapest first."""
    front: list[Measurement] = []
    for row in sorted(rows, key=lambda r: (cost(r), r.imbalance)):
        if not front or row.imbalance < front[-1].imbalance:
            front.append(row)
    return front


COSTS: dict[str, Callable[[Measurement], float]] = {
    "time_ms": lambda row: row.time_ms,
    "bytes": lambda row: row.bytes,
}


def write_fronts(directory: Path, rows: list[Measurement]) -> None:
    """fronts.csv: the settings on the front of each case, by time and by bytes."""
    if not rows:
        return
    with (directory / "fronts.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "cost", "setting", "value", "imbalance"])
        for case, measured in cases(rows).items():
            for name, cost in COSTS.items():
                for row in pareto_front(measured, cost):
                    writer.writerow([case, name, row.method, cost(row), row.imbalance])


def choices(rows: list[Measurement]) -> list[Choice]:
    """For every tolerance: the setting to take everywhere, then the fastest one on each case."""
    by_case = cases(rows)
    everywhere = [_everywhere(by_case, tolerance) for tolerance in TOLERANCES]
    return everywhere * (len(by_case) > 1) + [
        _choose(case, rows, tolerance) for case, rows in by_case.items() for tolerance in TOLERANCES
    ]


def write_choices(directory: Path, rows: list[Measurement]) -> None:
    """choices.csv: a row per case and tolerance, empty fields where no setting is within it."""
    if not rows:
        return
    with (directory / "choices.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(
            "case,tolerance,setting,time_ms,times_as_fast,imbalance,not_told_apart_from".split(",")
        )
        for c in choices(rows):
            numbers = [c.time_ms, c.times_as_fast, c.imbalance]
            writer.writerow([c.case, c.tolerance, c.setting, *numbers, ";".join(c.rivals)])


def _choose(case: str, rows: list[Measurement], tolerance: str) -> Choice:
    within = [row for row in rows if is_within(row, tolerance) and row.time_ms > 0]
    candidates = [_candidate(case, tolerance, [row], [rows]) for row in within]
    return _fastest_of(candidates, Choice(case, tolerance))


def _fastest_of(candidates: list[Choice], none: Choice) -> Choice:
    best = min(candidates, key=lambda c: c.time_ms, default=none)
    rivals = [
        c.setting
        for c in candidates
        if c is not best and not are_apart(c.time_interval, best.time_interval)
    ]
    return replace(best, rivals=tuple(rivals))


def _speed(row: Measurement, rows: list[Measurement]) -> float | None:
    reference = find_method(rows, "zoltan-rcb")
    return reference.time_ms / row.time_ms if reference and row.time_ms > 0 else None


def _everywhere(by_case: dict[str, list[Measurement]], tolerance: str) -> Choice:
    """Within the tolerance on every case, and there the fastest in the geometric mean."""
    settings = {row.method for rows in by_case.values() for row in rows}
    candidates = []
    for setting in sorted(settings):
        found = [find_method(rows, setting) for rows in by_case.values()]
        if all(row and is_within(row, tolerance) and row.time_ms > 0 for row in found):
            candidates.append(_candidate(EVERYWHERE, tolerance, found, list(by_case.values())))
    return _fastest_of(candidates, Choice(EVERYWHERE, tolerance))


def _candidate(
    case: str, tolerance: str, found: list[Measurement], by_case: list[list[Measurement]]
) -> Choice:
    """One setting on one case or more: geometric means, and the worst imbalance."""
    speeds = [_speed(row, rows) for row, rows in zip(found, by_case)]
    return Choice(
        case,
        tolerance,
        found[0].method,
        geometric_mean([row.time_ms for row in found]),
        geometric_mean(speeds) if all(speeds) else None,
        max(row.imbalance for row in found),
        mean_interval(row.time_interval for row in found),
        inverse(mean_interval(row.share_interval for row in found)),
    )
