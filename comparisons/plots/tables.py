"""The tables of a report: a header, and rows of text."""

from __future__ import annotations

from choice import TOLERANCES, Choice, find_method
from intervals import NOT_TOLD_APART, decimals, differs_from_one, inverse, with_interval
from results import Interval, Measurement, Repeat, Simulation

Table = tuple[list[str], list[list[str]]]


def method_table(rows: list[Measurement]) -> Table:
    header = ["method", "imbalance", "largest |Lu|, signed %", "time ms", "times as fast", "bytes"]
    header += ["messages", "into root", "moved %"]
    reference = find_method(rows, "zoltan-rcb")
    table = [
        [
            row.method,
            with_interval(row.imbalance, row.imbalance_interval, 5),
            _signed(row),
            with_interval(row.time_ms, row.time_interval, 2),
            _times_as_fast(row, reference),
            f"{row.bytes:,}",
            f"{row.messages:,}",
            f"{row.root_bytes_in:,}",
            f"{100 * row.moved_fraction:.1f}",
        ]
        for row in rows
    ]
    return header, table


def _signed(row: Measurement) -> str:
    """Largest |Lu| with its sign, where that was measured."""
    if row.worst_lu is None:
        return f"±{row.lu_percent:.3f}"
    text = f"{row.worst_lu:+.3f}"
    return "0.000" if float(text) == 0 else text


def _times_as_fast(row: Measurement, reference: Measurement | None) -> str:
    if reference is None or row.time_ms <= 0:
        return "–"
    speed = 1 / row.share if row.share else reference.time_ms / row.time_ms
    text = with_interval(speed, inverse(row.share_interval), 2)
    same = row is not reference and not differs_from_one(row.share_interval)
    return text + f", {NOT_TOLD_APART}" * same


def choice_table(chosen: list[Choice]) -> Table:
    header = ["cloud", "imbalance ≤", "fastest setting", "time ms", "times as fast", "imbalance"]
    table = [
        [
            choice.case,
            choice.tolerance,
            choice.setting + choice.remark or "none",
            _number(choice.time_ms, 2, choice.time_interval),
            _number(choice.times_as_fast, 2, choice.speed_interval),
            _number(choice.imbalance, 5),
        ]
        for choice in chosen
    ]
    return header, table


def choice_matrix(chosen: list[Choice]) -> Table:
    """A row per cloud, a column per tolerance."""
    table: dict[str, list[str]] = {}
    for choice in chosen:
        text = "none"
        if choice.setting:
            text = f"{choice.setting} {_number(choice.time_ms, 2)}"
            text += f"\N{NO-BREAK SPACE}{_number(choice.times_as_fast, 1)}×{choice.remark}"
        table.setdefault(choice.case, [choice.case]).append(text)
    return ["cloud", *(f"≤ {t}" for t in TOLERANCES[:-1]), TOLERANCES[-1]], list(table.values())


def _number(value: float | None, digits: int, interval: Interval | None = None) -> str:
    return "–" if value is None else with_interval(value, interval, digits)


def simulation_table(runs: list[Simulation], reference: str) -> Table:
    base = next((run for run in runs if run.method == reference), None)
    digits = decimals([run.critical_path for run in runs], 4)
    header = ["method", "ranks", "critical path s", f"times as fast as {reference}", "gain kept %"]
    header += ["rebalances", "moved %", "mean imbalance", "wall s"]
    table = [
        [
            run.method,
            str(run.ranks),
            with_interval(run.critical_path, run.critical_path_interval, digits),
            _speed_up(run, base),
            _percent(run.gain_kept),
            "–" if run.rebalances is None else str(run.rebalances),
            _percent(run.moved_fraction),
            with_interval(run.mean_imbalance, run.imbalance_interval, 4),
            with_interval(run.wall, run.wall_interval, digits),
        ]
        for run in runs
    ]
    return header, table


def _speed_up(run: Simulation, base: Simulation | None) -> str:
    value = run.speed_up
    if value is None and base and run.critical_path > 0:
        value = base.critical_path / run.critical_path
    if value is None:
        return "–"
    same = run is not base and not differs_from_one(run.speed_up_interval)
    return with_interval(value, run.speed_up_interval, 2) + f", {NOT_TOLD_APART}" * same


def _percent(fraction: float | None) -> str:
    return "–" if fraction is None else f"{100 * fraction:.1f}"


def noise_table(repeats: list[Repeat]) -> Table:
    header = ["workload", "what was measured twice", "second / first", "differs"]
    table = [
        [r.workload, r.what, with_interval(r.ratio, r.interval, 3)]
        + ["–" if r.interval is None else "yes" if differs_from_one(r.interval) else "no"]
        for r in repeats
    ]
    return header, table
