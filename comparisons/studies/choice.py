"""Which setting is the fastest within a tolerance: what accuracy costs, in numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pandas as pd
from intervals import NOT_TOLD_APART, ONE, Value, mean_of, value_of
from methods import is_ours
from results import cases, is_within, row_of

TOLERANCES = {  # and RRCB's own setting for each
    "1.10": "rrcb[tol=1.1]",
    "1.05": "rrcb[tol=1.05]",
    "1.01": "rrcb",
    "1.001": "rrcb[tol=1.001]",
    "exact": "rrcb-exact",
}
EVERYWHERE = "all of these"


@dataclass(frozen=True)
class Choice:
    """The fastest setting on a case; none where no setting is within the tolerance."""

    case: str
    tolerance: str
    setting: str = ""
    time_ms: Value | None = None
    times_as_fast: Value | None = None  # as Zoltan's RCB; over all cases the geometric mean
    imbalance: float | None = None
    rivals: tuple[str, ...] = ()  # settings whose time is not told apart from this one's

    @property
    def remark(self) -> str:
        """Empty where the setting is the fastest beyond the noise."""
        others = self.rivals[0] if len(self.rivals) == 1 else f"{len(self.rivals)} others"
        return f" ({NOT_TOLD_APART} from {others})" if self.rivals else ""

    @property
    def numbers(self) -> dict:
        """A row of choices.csv: empty fields where no setting is within the tolerance."""
        return {
            "case": self.case, "tolerance": self.tolerance, "setting": self.setting,
            "time_ms": self.time_ms and self.time_ms.number,
            "times_as_fast": self.times_as_fast and self.times_as_fast.number,
            "imbalance": self.imbalance, "not_told_apart_from": ";".join(self.rivals),
        }  # fmt: skip


def fastest(rows: pd.DataFrame, tolerance: str) -> object | None:
    within = rows[is_within(rows, tolerance)]
    return next(within.sort_values("time_ms", kind="stable").itertuples(), None)


def choices(rows: pd.DataFrame) -> list[Choice]:
    """For every tolerance: the setting to take everywhere, then the fastest one on each case."""
    by_case = cases(rows)
    everywhere = {EVERYWHERE: rows} if len(by_case) > 1 else {}
    named = everywhere | by_case
    return [_choose(case, of_case, t) for case, of_case in named.items() for t in TOLERANCES]


def _choose(case: str, rows: pd.DataFrame, tolerance: str) -> Choice:
    """Within the tolerance on every case of the rows, and the fastest in the geometric mean."""
    number = rows["case"].nunique()
    reference = rows[rows["method"] == "zoltan-rcb"].set_index("case")["time_ms"]
    candidates = []
    for setting, found in rows.groupby("method", sort=number > 1):
        is_usable = is_within(found, tolerance) & (found["time_ms"] > 0)
        if len(found) == number and is_usable.all():
            speeds = []
            for row in found.itertuples():
                paired = ONE / value_of(row, "time_vs_zoltan_rcb")
                speed = reference.get(row.case, 0) / row.time_ms
                speeds.append(Value(speed, paired.low, paired.high))
            times = mean_of(value_of(row, "time_ms") for row in found.itertuples())
            speed = mean_of(speeds) if all(s.number for s in speeds) else None
            imbalance = found["imbalance"].max()
            candidates.append(Choice(case, tolerance, setting, times, speed, imbalance))
    best = min(candidates, key=lambda c: c.time_ms.number, default=Choice(case, tolerance))
    rivals = [c for c in candidates if c is not best and not c.time_ms.is_apart(best.time_ms)]
    return replace(best, rivals=tuple(c.setting for c in rivals))


def pareto_front(rows: pd.DataFrame) -> pd.DataFrame:
    """The rows that no other beats in both time and imbalance, fastest first."""
    rows = rows.sort_values(["time_ms", "imbalance"], kind="stable")
    return rows[rows["imbalance"] < rows["imbalance"].cummin().shift(fill_value=float("inf"))]


# --- whether RRCB's own choice of mesh and refinement is near the best setting tried ---

LIMIT = 1.2  # times the best setting's time


@dataclass(frozen=True)
class Judgement:
    """The automatic mesh beside the fastest setting of RRCB that reaches the same tolerance."""

    case: str
    tolerance: str
    automatic: object
    best: object

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
    def passed(self) -> str:
        return yes(self.reached and self.ratio <= LIMIT)

    @property
    def numbers(self) -> dict:
        """A row of automatic.csv."""
        own, best = self.automatic, self.best
        return {
            "case": self.case, "tolerance": self.tolerance, "automatic": own.method,
            "time_ms": own.time_ms, "imbalance": own.imbalance, "reached": yes(self.reached),
            "best": best.method, "best_time_ms": best.time_ms, "best_imbalance": best.imbalance,
            "time_ratio": f"{self.ratio:.3f}", "least_time_ratio": f"{self.ratio_of_least:.3f}",
            "within_20_percent": self.passed,
        }  # fmt: skip

    @property
    def texts(self) -> dict[str, str]:
        own, best = (value_of(row, "time_ms") for row in (self.automatic, self.best))
        is_known = self.automatic.method == self.best.method or own.is_apart(best)
        missed = "" if self.reached else " (not reached)"
        return {
            "cloud": self.case, "imbalance ≤": self.tolerance, "automatic: ms": own.text(2),
            "imbalance": f"{self.automatic.imbalance:.5f}{missed}",
            "best setting": self.best.method, "ms": best.text(2),
            "time ratio": f"{self.ratio:.2f}" + f", {NOT_TOLD_APART}" * (not is_known),
            "of least times": f"{self.ratio_of_least:.2f}", "within 20 %": self.passed,
        }  # fmt: skip


def yes(value: bool) -> str:
    return "yes" if value else "no"


def judgements(rows: pd.DataFrame) -> list[Judgement]:
    """Of the cases and tolerances where both were measured."""
    found = []
    for case, measured in cases(rows).items():
        ours = measured[measured["method"].map(is_ours)]
        for tolerance, method in TOLERANCES.items() if len(ours) > 1 else ():
            automatic, best = row_of(ours, method), fastest(ours, tolerance)
            if automatic and best and best.time_ms_min > 0:
                found.append(Judgement(case, tolerance, automatic, best))
    return found


def automatic_sentence(found: list[Judgement]) -> str:
    passed = sum(j.passed == "yes" for j in found)
    missed = sum(not j.reached for j in found)
    worst = max(found, key=lambda j: j.ratio)
    return (
        "RRCB's automatic mesh was within 20 % of the fastest setting that reaches the same"
        f" tolerance in {passed} of {len(found)} cases"
        + f" and missed the tolerance in {missed}" * bool(missed)
        + f"; the worst ratio was {worst.ratio:.2f} ({worst.case}, {worst.tolerance})."
    )
