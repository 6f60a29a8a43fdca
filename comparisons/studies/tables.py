"""The tables of a report: rows of texts by the names of their columns."""

from __future__ import annotations

import pandas as pd
from choice import Choice
from document import Rows
from intervals import NOT_TOLD_APART, ONE, Value, decimals, value_of
from results import row_of
from rounds import paired, path


def method_table(rows: pd.DataFrame) -> Rows:
    reference = row_of(rows, "zoltan-rcb")
    return [
        {
            "method": row.method,
            "imbalance": value_of(row, "imbalance").text(5),
            "largest |Lu|, signed %": _signed(row),
            "time ms": value_of(row, "time_ms").text(2),
            "times as fast": _times_as_fast(row, reference),
            "bytes": f"{row.bytes:,}",
            "messages": f"{row.messages:,}",
            "into root": f"{row.root_bytes_in:,}",
            "moved %": f"{100 * row.moved_fraction:.1f}",
        }
        for row in rows.itertuples()
    ]


def ghost_table(rows: pd.DataFrame) -> Rows:
    """What the application pays for the shape of the parts; nothing of files without ghosts."""
    return [_ghosts(row) for row in rows.itertuples()] if "ghosts" in rows else []


def _ghosts(row: object) -> dict[str, str]:
    texts = {
        "method": row.method,
        "ghosts": f"{row.ghosts:,.0f}",
        "% of the points": f"{100 * row.ghosts / row.points:.1f}",
        "most on a part": f"{row.ghosts_max:,.0f}",
        "most neighbours": f"{row.neighbours_max:.0f}",
    }
    if pd.notna(row.off_machine_ghosts):
        texts["off the machine %"] = f"{100 * row.off_machine_ghosts / max(1, row.ghosts):.1f}"
    return texts


def _signed(row: object) -> str:
    """Largest |Lu| with its sign, where that was measured."""
    worst = value_of(row, "lu_worst_percent")
    if pd.isna(worst.number):
        return f"±{row.lu_max_percent:.3f}"
    text = f"{worst.number:+.3f}"
    return "0.000" if float(text) == 0 else text


def _times_as_fast(row: object, reference: object | None) -> str:
    if reference is None or row.time_ms <= 0:
        return "–"
    speed = ONE / value_of(row, "time_vs_zoltan_rcb")
    if pd.isna(speed.number):
        speed = Value(reference.time_ms / row.time_ms, speed.low, speed.high)
    return _or_same(speed, row.method == reference.method)


def _or_same(ratio: Value, is_reference: bool) -> str:
    same = not is_reference and not ratio.is_apart(ONE)
    return ratio.text(2) + f", {NOT_TOLD_APART}" * same


def choice_table(chosen: list[Choice]) -> Rows:
    return [
        {
            "cloud": choice.case,
            "imbalance ≤": choice.tolerance,
            "fastest setting": choice.setting + choice.remark or "none",
            "time ms": choice.time_ms.text(2) if choice.time_ms else "–",
            "times as fast": choice.times_as_fast.text(2) if choice.times_as_fast else "–",
            "imbalance": f"{choice.imbalance:.5f}" if choice.setting else "–",
        }
        for choice in chosen
    ]


def choice_matrix(chosen: list[Choice]) -> Rows:
    """A row per cloud, a column per tolerance."""
    table: dict[str, dict[str, str]] = {}
    for choice in chosen:
        text = "none"
        if choice.setting:
            speed = f"{choice.times_as_fast.number:.1f}" if choice.times_as_fast else "–"
            text = f"{choice.setting} {choice.time_ms.number:.2f}"
            text += f"\N{NO-BREAK SPACE}{speed}×{choice.remark}"
        name = "≤ " * (choice.tolerance != "exact") + choice.tolerance
        table.setdefault(choice.case, {"cloud": choice.case})[name] = text
    return list(table.values())


def simulation_table(
    runs: pd.DataFrame, reference: str, rounds: pd.DataFrame | None = None
) -> Rows:
    base = row_of(runs, reference)
    digits = decimals(runs["critical_path_s"], 4)
    return [
        {
            "method": run.method,
            "ranks": str(run.ranks),
            "critical path s": value_of(run, "critical_path_s").text(digits),
            f"times as fast as {reference}": _speed_up(run, base),
            **_beside_zoltan(run, rounds),
            "gain kept %": _number(run, "gain_kept", 100, 1),
            "rebalances": _number(run, "rebalances", 1, 0),
            "moved %": _number(run, "moved_fraction", 100, 1),
            "mean imbalance": value_of(run, "mean_imbalance").text(4),
            "wall s": value_of(run, "wall_s").text(digits),
        }
        for run in runs.itertuples()
    ]


def _beside_zoltan(run: object, rounds: pd.DataFrame | None) -> dict[str, str]:
    """The same beside Zoltan's RCB; nothing without its rounds."""
    if rounds is None or "zoltan-rcb" not in set(rounds.get("method", ())):
        return {}
    speed = paired(rounds, 1 / path(rounds), run.method, "zoltan-rcb") or Value(float("nan"))
    text = _or_same(speed, run.method == "zoltan-rcb")
    return {"as fast as zoltan-rcb": "–" if pd.isna(speed.number) else text}


def _speed_up(run: object, base: object | None) -> str:
    speed = value_of(run, "speed_up_critical_path")
    if pd.isna(speed.number) and base and run.critical_path_s > 0:
        speed = Value(base.critical_path_s / run.critical_path_s, speed.low, speed.high)
    is_base = run.Index == getattr(base, "Index", None)
    return "–" if pd.isna(speed.number) else _or_same(speed, is_base)


def _number(row: object, name: str, factor: float, digits: int) -> str:
    number = value_of(row, name).number
    return "–" if pd.isna(number) else f"{factor * number:.{digits}f}"


def noise_table(repeats: pd.DataFrame) -> Rows:
    found = [(row, Value(row.ratio, row.low, row.high)) for row in repeats.itertuples()]
    return [
        {
            "workload": row.workload,
            "what was measured twice": row.what,
            "second / first": ratio.text(3),
            "differs": ("yes" if ratio.is_apart(ONE) else "no") if ratio.has_interval else "–",
        }
        for row, ratio in found
    ]
