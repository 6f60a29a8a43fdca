"""The price of accuracy at a glance: of a call, and of the whole simulation.

Several snapshots or clouds are combined by the geometric mean; bands reach from the least lower end
of their intervals to the most upper end.
"""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path
from statistics import geometric_mean, median, mode

from choice import cases, find_method, is_within
from intervals import in_digits
from results import Interval, Measurement, Simulation, read_simulations, read_table, unique

EXACT = "exact"
ACROSS = ("none", "zoltan-rcb", "zoltan-hsfc", "zoltan-rib", "zoltan2-mj")  # take no tolerance
CALL, STEPS, CALLS, SIMULATION = "call", "steps", "calls", "simulation"


@dataclass(frozen=True)
class Price:
    """A row of price.csv.

    The value of a call is its share of Zoltan RCB's time; of the simulation it is seconds beyond an
    ideally balanced one without calls, over the seconds of that. The tolerance is the one asked
    for; of the paper's methods, which take none, the imbalance they left; of others there is none.
    """

    panel: str
    method: str
    tolerance: str
    value: float
    low: float
    high: float


def tolerance_asked(method: str) -> str | None:
    """None of a method that takes no tolerance, or is told not to keep it."""
    name, parameters = _parse(method)
    if name == "rrcb-exact" and parameters.keys() <= {"mesh"}:
        return EXACT
    if name in ("rrcb", "rrcb-arrays") and parameters.keys() <= {"mesh", "tol"}:
        return parameters.get("tol", "1.01")
    return None


def family(method: str) -> str:
    """What one line is drawn of: RRCB with one mesh at every tolerance."""
    name, parameters = _parse(method)
    name = name.replace("rrcb-exact", "rrcb")
    return f"{name}[mesh={parameters['mesh']}]" if "mesh" in parameters else name


def is_of_the_paper(method: str) -> bool:
    return method.split("[")[0] in ("rrcb-sampled", "root-rcb")


def _parse(method: str) -> tuple[str, dict[str, str]]:
    name, _, inside = method.partition("[")
    return name, dict(re.findall(r"(\w+)=([^,\]]+)", inside))


def read_calls(directory: Path) -> list[Measurement]:
    """Of the table, or of a sweep: of its clouds, without them of its snapshots."""
    swept = read_table(directory, "sweep.csv")
    clouds = [row for row in swept if row.layout != "simulation"]
    return read_table(directory) or clouds or swept


def read_runs(directory: Path) -> list[Simulation]:
    return read_simulations(directory) or read_simulations(directory, "sweep_simulation.csv")


def read_prices(directory: Path) -> list[Price]:
    return call_prices(read_calls(directory)) + simulation_prices(read_runs(directory))


def call_prices(rows: list[Measurement]) -> list[Price]:
    by_case = list(cases(rows).values())
    prices = []
    for method in unique([row.method for row in rows]):
        found = [
            (share, row)
            for measured in by_case
            if (row := find_method(measured, method)) and (share := _share(row, measured))
        ]
        if not found or not _has_place(method):
            continue
        shares = [share for share, _ in found]
        prices.append(
            Price(
                CALL,
                method,
                _tolerance(method, [row for _, row in found]),
                geometric_mean([value for value, _ in shares]),
                min(interval[0] for _, interval in shares),
                max(interval[1] for _, interval in shares),
            )
        )
    return prices


def _has_place(method: str) -> bool:
    return bool(tolerance_asked(method)) or is_of_the_paper(method) or method in ACROSS


def _share(row: Measurement, measured: list[Measurement]) -> tuple[float, Interval] | None:
    reference = find_method(measured, "zoltan-rcb")
    if reference is None or reference.time_ms <= 0 or row.time_ms <= 0:
        return None
    share = row.share or row.time_ms / reference.time_ms
    return share, row.share_interval or (share, share)


def _tolerance(method: str, rows: list[Measurement]) -> str:
    if not is_of_the_paper(method):
        return tolerance_asked(method) or ""
    if all(is_within(row, EXACT) for row in rows):
        return EXACT
    return f"{geometric_mean([row.imbalance for row in rows]):.6f}"


def _comparable(runs: list[Simulation]) -> tuple[list[Simulation], float]:
    """The runs on as many ranks as most have, and the seconds of their steps if ideal."""
    ranks = mode([run.ranks for run in runs]) if runs else 0
    runs = [run for run in runs if run.ranks == ranks and run.method != "serial"]
    return runs, median([run.step_work for run in runs]) / ranks if runs else 0.0


def simulation_prices(runs: list[Simulation]) -> list[Price]:
    """What unbalance costs is reckoned from the points of the fullest rank in each step, which no
    noise disturbs; what else the critical path holds is the same under every method.
    """
    runs, ideal = _comparable(runs)
    if ideal <= 0:
        return []
    prices = []
    for run in runs:
        steps = max(run.path_points * run.ranks / (run.points * run.steps) - 1, 0.0)
        calls = (run.balance_path + run.balance_network) / ideal
        low, high = run.critical_path_interval or (run.critical_path, run.critical_path)
        beside = [(end - run.critical_path) / ideal for end in (low, high)]
        total = steps + calls
        tolerance = tolerance_asked(run.method) or f"{run.mean_imbalance:.6f}"
        prices += [
            Price(STEPS, run.method, tolerance, steps, steps, steps),
            Price(CALLS, run.method, tolerance, calls, calls, calls),
            Price(SIMULATION, run.method, tolerance, total, total + beside[0], total + beside[1]),
        ]
    return prices


def optimum(prices: list[Price]) -> tuple[Price, list[Price]] | None:
    """RRCB's tolerance of the shortest simulation, and those not told apart from it."""
    totals = [p for p in prices if p.panel == SIMULATION and tolerance_asked(p.method)]
    totals = [p for p in totals if family(p.method) == "rrcb"]
    if len(totals) < 2:
        return None
    best = min(totals, key=lambda p: p.value)
    return best, [p for p in totals if p is not best and p.low <= best.high]


def exchange_rate(runs: list[Simulation]) -> str:
    """What a per cent of unbalance costs beside a more exact call, in words; else empty."""
    runs, ideal = _comparable(runs)
    calls = {
        tolerance: (run.balance_path + run.balance_network)
        / (run.rebalances or -(-run.steps // run.every))
        for run in runs
        if family(run.method) == "rrcb" and (tolerance := tolerance_asked(run.method))
    }
    if EXACT not in calls or len(calls) < 2 or ideal <= 0:
        return ""
    loosest = max((tolerance for tolerance in calls if tolerance != EXACT), key=float)
    a_step = 0.01 * ideal / runs[0].steps
    more = calls[EXACT] - calls[loosest]
    return (
        f"1 % of unbalance costs {_microseconds(a_step)} a step,"
        f" {_microseconds(a_step * runs[0].every)} until the next call ({runs[0].every} steps);"
        f" an exact call costs {_microseconds(abs(more))} {'more' if more >= 0 else 'less'}"
        f" than one to {loosest}."
    )


def _microseconds(seconds: float) -> str:
    return f"{in_digits(1e6 * seconds, 2)} µs"


def write_prices(directory: Path) -> None:
    """price.csv: what price.png is drawn of; nothing without measurements."""
    prices = read_prices(directory)
    if not prices:
        return
    with (directory / "price.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow("panel,method,tolerance,value,low,high".split(","))
        for p in prices:
            numbers = [f"{number:.6g}" for number in (p.value, p.low, p.high)]
            writer.writerow([p.panel, p.method, p.tolerance, *numbers])
