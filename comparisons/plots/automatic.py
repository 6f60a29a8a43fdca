"""Whether RRCB's own choice of mesh and refinement is near the best setting tried."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

from choice import cases, fastest, find_method, is_within
from intervals import NOT_TOLD_APART, are_apart, with_interval
from results import Measurement

LIMIT = 1.2  # times the best setting's time
AUTOMATIC = {
    "1.10": "rrcb[tol=1.1]",
    "1.05": "rrcb[tol=1.05]",
    "1.01": "rrcb",
    "1.001": "rrcb[tol=1.001]",
    "exact": "rrcb-exact",
}


@dataclass(frozen=True)
class Judgement:
    """The automatic mesh beside the fastest setting of RRCB that reaches the same tolerance."""

    case: str
    tolerance: str
    automatic: Measurement
    best: Measurement

    @property
    def ratio(self) -> float:
        return self.automatic.time_ms / self.best.time_ms

    @property
    def ratio_of_least(self) -> float:
        """Of the least times, which a busy machine disturbs less."""
        return self.automatic.time_ms_min / self.best.time_ms_min

    @property
    def reached(self) -> bool:
        return is_within(self.automatic, self.tolerance)

    @property
    def told_apart(self) -> bool:
        """Of two settings; a setting is always as fast as itself."""
        return self.automatic is self.best or are_apart(
            self.automatic.time_interval, self.best.time_interval
        )

    @property
    def passed(self) -> bool:
        return self.reached and self.ratio <= LIMIT


def judgements(rows: list[Measurement]) -> list[Judgement]:
    """Of the cases and tolerances where both were measured."""
    found = []
    for case, measured in cases(rows).items():
        ours = [row for row in measured if row.method.split("[")[0] in ("rrcb", "rrcb-exact")]
        for tolerance, method in AUTOMATIC.items():
            automatic = find_method(ours, method)
            best = fastest(ours, tolerance)
            if automatic and best and len(ours) > 1 and best.time_ms_min > 0:
                found.append(Judgement(case, tolerance, automatic, best))
    return found


def write_automatic(directory: Path, rows: list[Measurement]) -> None:
    """automatic.csv: a row per case and tolerance."""
    found = judgements(rows)
    if not found:
        return
    with (directory / "automatic.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(
            "case,tolerance,automatic,time_ms,imbalance,reached,best,best_time_ms,best_imbalance,"
            "time_ratio,least_time_ratio,within_20_percent".split(",")
        )
        for j in found:
            writer.writerow(
                [j.case, j.tolerance, j.automatic.method, j.automatic.time_ms]
                + [j.automatic.imbalance, _yes(j.reached), j.best.method, j.best.time_ms]
                + [j.best.imbalance, f"{j.ratio:.3f}", f"{j.ratio_of_least:.3f}", _yes(j.passed)]
            )


def automatic_table(found: list[Judgement]) -> tuple[list[str], list[list[str]]]:
    header = ["cloud", "imbalance ≤", "automatic: ms", "imbalance", "best setting", "ms"]
    header += ["time ratio", "of least times", "within 20 %"]
    table = [
        [
            j.case,
            j.tolerance,
            with_interval(j.automatic.time_ms, j.automatic.time_interval, 2),
            f"{j.automatic.imbalance:.5f}" + ("" if j.reached else " (not reached)"),
            j.best.method,
            with_interval(j.best.time_ms, j.best.time_interval, 2),
            f"{j.ratio:.2f}" + f", {NOT_TOLD_APART}" * (not j.told_apart),
            f"{j.ratio_of_least:.2f}",
            _yes(j.passed),
        ]
        for j in found
    ]
    return header, table


def automatic_sentence(found: list[Judgement]) -> str:
    passed = sum(j.passed for j in found)
    missed = sum(not j.reached for j in found)
    worst = max(found, key=lambda j: j.ratio)
    text = (
        f"RRCB's automatic mesh was within 20 % of the fastest setting that reaches the same"
        f" tolerance in {passed} of {len(found)} cases"
    )
    if missed:
        text += f" and missed the tolerance in {missed}"
    return text + f"; the worst ratio was {worst.ratio:.2f} ({worst.case}, {worst.tolerance})."


def _yes(value: bool) -> str:
    return "yes" if value else "no"
