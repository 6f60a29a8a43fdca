"""What the tests of the studies share: the folder of the studies on the path, and rows of the driver."""

from __future__ import annotations

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "comparisons" / "studies"))

import pandas as pd
from results import measurements


def measured(method: str, time: float, imbalance: float, spread: float | None = None, **more: object) -> dict:
    """A row of table.csv, 1000 points on 4 ranks: exact is an imbalance of 1.004 at most. Intervals of
    the time and its share of Zoltan's 8 ms reach `spread` times it to both sides."""
    row = {
        "method": method, "workload": "fog", "layout": "sorted", "ranks": 4, "points": 1000, "dim": 2,
        "time_ms_median": time, "time_ms_min": time, "imbalance": imbalance,
        "messages": 1, "bytes": 100, "root_bytes_in": 1, "moved_fraction": 0,
        "time_vs_zoltan_rcb": time / 8, "ghosts": 500,
    }  # fmt: skip
    for end, factor in () if spread is None else (("low", 1 - spread), ("high", 1 + spread)):
        row |= {f"time_ms_{end}": time * factor, f"time_vs_zoltan_rcb_{end}": time * factor / 8}
    return row | more


def table(*rows: dict) -> pd.DataFrame:
    return measurements(pd.DataFrame(rows))


def simulated(method: str, number: int, path: float, **more: object) -> dict:
    """A row of simulation_runs.csv: ten steps of 1000 points on 4 ranks, 4 s of work in all."""
    names = (
        "wall_s balance_s step_s mean_imbalance worst_imbalance front_x_m moved_m mass_kg step_network_s"
        " balance_work_s step_root_s balance_root_s"
    )
    decisions = "decide_s decide_work_s decide_path_s decide_root_s decide_network_s"
    return dict.fromkeys(names.split(), 1) | dict.fromkeys(decisions.split(), 0) | {
        "method": method, "round": number, "seed": None, "ranks": 4, "points": 1000, "steps": 10,
        "every": "auto", "critical_path_s": path, "step_work_s": 4, "step_path_s": 1.1,
        "path_points": 2500, "counted": 4, "counted_path": 1.1, "counted_at_rest": 4, "counted_at_rest_path": 1.05,
        "least_s": 4, "least_s_path": 1.2, "least_at_rest_s": 4, "least_at_rest_s_path": 1.15, "balance_path_s": 0.1, "balance_network_s": 0.1, "rebalances": 2,
        "moved_fraction": 0.125, "error": None, "scene": "slope", "step_messages": 60,
        "step_bytes": 48_000, "balance_messages": 20, "balance_bytes": 3_000,
    } | more  # fmt: skip
