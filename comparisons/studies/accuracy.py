"""What accuracy costs: every method with a grid of its parameters on each cloud."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
from document import Report, show
from driver import Driver
from intervals import mean_of, value_of
from methods import is_ours
from results import cases, measurements, read

CLOUDS = "clouds"
SHAPES = ("slope", "clusters", "lattice", "uniform")
TOLERANCES = {  # and RRCB's own setting for each
    "1.10": "rrcb[tol=1.1]",
    "1.05": "rrcb[tol=1.05]",
    "1.01": "rrcb",
    "1.001": "rrcb[tol=1.001]",
    "exact": "rrcb-exact",
}
EVERYWHERE = "all of these"
LIMIT = 1.2  # times the best setting's time


def settings() -> list[str]:
    """RRCB with each mesh and tolerance, the paper's method with three meshes, and the others."""
    found = ["zoltan-rcb", "zoltan-rib", "zoltan-hsfc", "root-rcb", "rrcb-arrays"]
    found += [
        f"rrcb-sampled[mesh={mesh},k=1.5,fraction={fraction}]"
        for mesh, fraction in product((4, 10, 32), (1, 0.125))
    ]
    for mesh in ("", "mesh=2", "mesh=4", "mesh=8", "mesh=16", "mesh=32"):
        for refinement in ("refine=none", "tol=1.1", "tol=1.05", "", "tol=1.001"):
            inside = ",".join(filter(None, (mesh, refinement)))
            found.append(f"rrcb[{inside}]" if inside else "rrcb")
        found.append(f"rrcb-exact[{mesh}]" if mesh else "rrcb-exact")
    return found


def measure_clouds(driver: Driver) -> None:
    """In 2-D and 3-D, sorted and scattered over 4 ranks; all rows into sweep.csv."""
    shapes = product(SHAPES, (2, 3), ("sorted", "scattered"))
    methods, size = settings(), ["--points=200000", "--repeats=6"]
    if driver.quick:
        shapes, methods, size = [("slope", 2, "sorted")], ["zoltan-rcb", "rrcb"], []
    rows = [
        read(
            driver.run(f"{shape}-{dimension}-{layout}", 4, methods, f"--cloud={shape}",
                       f"--dim={dimension}", f"--layout={layout}", "--no-data", *size)
            / "table.csv"
        )
        for shape, dimension, layout in shapes
    ]  # fmt: skip
    pd.concat(rows).to_csv(driver.out / "sweep.csv", index=False)


def is_within(rows: pd.DataFrame, tolerance: str) -> pd.Series:
    """Exact: no part has more than one point above the mean."""
    limit = 1 + rows["point"] if tolerance == "exact" else float(tolerance)
    return rows["imbalance"] <= limit * (1 + 1e-9)


def choices(rows: pd.DataFrame) -> pd.DataFrame:
    """A row of choices.csv for each tolerance: the setting to take on all cases, then on each."""
    by_case = cases(rows)
    named = ({EVERYWHERE: rows} if len(by_case) > 1 else {}) | by_case
    return pd.DataFrame([_choose(case, of, t) for case, of in named.items() for t in TOLERANCES])


def _choose(case: str, rows: pd.DataFrame, tolerance: str) -> dict:
    """Within the tolerance on every case of the rows, and the fastest in the geometric mean."""
    usable = rows[is_within(rows, tolerance) & (rows["time_ms"] > 0)].groupby("method", sort=False)
    found = {setting: of for setting, of in usable if len(of) == rows["case"].nunique()}
    choice = {"case": case, "tolerance": tolerance, "setting": ""}
    if not found:
        return choice
    times = {s: mean_of(value_of(r, "time_ms") for r in of.itertuples()) for s, of in found.items()}
    best = min(times, key=lambda setting: times[setting].number)
    rivals = [s for s in times if s != best and not times[s].is_apart(times[best])]
    zoltan = rows[rows["method"] == "zoltan-rcb"].set_index("case")["time_ms"]
    speeds = found[best]["case"].map(zoltan) / found[best]["time_ms"]
    return choice | {
        "setting": best, "time_ms": times[best].number,
        "times_as_fast": np.exp(np.log(speeds).mean(skipna=False)),
        "imbalance": found[best]["imbalance"].max(), "not_told_apart_from": ";".join(rivals),
    }  # fmt: skip


def judgements(rows: pd.DataFrame) -> pd.DataFrame:
    """A row of automatic.csv for each case and tolerance: RRCB's own mesh, and the fastest setting of
    RRCB that reaches the same tolerance."""
    found = []
    for (case, of_case), (tolerance, method) in product(cases(rows).items(), TOLERANCES.items()):
        ours = of_case[of_case["method"].map(is_ours)]
        within = ours[is_within(ours, tolerance)].sort_values("time_ms", kind="stable")
        own = ours[ours["method"] == method]
        if len(ours) < 2 or own.empty or within.empty or within["time_ms_min"].iloc[0] <= 0:
            continue
        own, best = own.iloc[0], within.iloc[0]
        reached, ratio = own["method"] in set(within["method"]), own["time_ms"] / best["time_ms"]
        found.append({
            "case": case, "tolerance": tolerance, "automatic": own["method"],
            "time_ms": own["time_ms"], "imbalance": own["imbalance"], "reached": _yes(reached),
            "best": best["method"], "best_time_ms": best["time_ms"],
            "best_imbalance": best["imbalance"], "time_ratio": f"{ratio:.3f}",
            "least_time_ratio": f"{own['time_ms_min'] / best['time_ms_min']:.3f}",
            "within_20_percent": _yes(reached and ratio <= LIMIT),
        })  # fmt: skip
    return pd.DataFrame(found)


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def add_accuracy(report: Report, out: Path) -> None:
    """Which setting for which tolerance, and whether RRCB's own is as good."""
    clouds = measurements(read(out / "sweep.csv"))
    for name, find in (("choices", choices), ("automatic", judgements)):
        if len(clouds) and len(rows := find(clouds)):
            rows.to_csv(out / f"{name}.csv", index=False)
            digits = dict.fromkeys(("time_ms", "best_time_ms", "times_as_fast"), 2)
            texts = rows.round(digits | {"imbalance": 5, "best_imbalance": 5}).fillna("").astype(str)
            report.table(f"{name}.csv", texts)
            if name == "choices":
                show("The fastest setting within a tolerance", texts[texts["case"] == texts["case"][0]])
