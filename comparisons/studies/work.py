"""What a step costs: instructions of a point, a run of points, a node and a shared node, by Callgrind.

Coarse scenes on 4 ranks, without rebalancing and with it; every 50th step is counted, without MPI. The unit costs are
the fit by least absolute errors; comparisons/driver/scene_choice_mpi.cpp has them.
"""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import callgrind
import numpy as np
import pandas as pd
from document import markdown_table
from driver import COMPARE, options, prepare
from results import read

RANKS, RECORD = 4, 50  # steps between counted ones: a turn of the driver
SCENES = {"slope": 900, "dam_break": 1200}  # steps
UNITS = ("points", "runs", "nodes", "shared_nodes")


def measure(driver: Path, scene: str, steps: int, out: Path) -> pd.DataFrame:
    """A row for each rank and counted step: its units and its instructions."""
    words = [f"--out={out}", "--quick", f"--scene={scene}", f"--steps={steps}", f"--record={RECORD}", "--every=33",
             "--only=simulations", "--methods=rrcb-arrays", "--repeats=1"]  # fmt: skip
    _, processes = callgrind.run([str(driver), *words], RANKS, "rrcb_recorded_step", out / "callgrind")
    counts = np.array([[sum(callgrind.own_instructions(file).values()) for file in files] for files in processes])
    history = read(out / "history.csv").set_index(["step", "method", "part"])
    rows = []
    for turn, step in enumerate(sorted(set(history.index.get_level_values("step")))):
        found = counts[:, 3 * turn : 3 * turn + 3].T
        # The balanced run is made twice, in a drawn order: the two are nearly equal.
        pair = min(combinations(range(3), 2), key=lambda two: np.abs(found[two[0]] - found[two[1]]).sum())
        (single,) = set(range(3)) - set(pair)
        for method, cost in (("none", found[single]), ("rrcb-arrays", found[pair[0]])):
            rows.append(history.loc[(step, method), list(UNITS)].assign(cost=cost, step=step, method=method))
    return pd.concat(rows)


def fit(rows: pd.DataFrame, units: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Costs of the units, and the relative error of each row; a sort of the points in a step counts little."""
    numbers, cost = rows[list(units)].to_numpy(float), rows["cost"].to_numpy(float)
    errors = np.ones(len(cost))
    for _ in range(60):
        weights = 1 / cost / np.sqrt(np.maximum(np.abs(errors), 1e-3))
        costs = np.linalg.lstsq(numbers * weights[:, None], cost * weights, rcond=None)[0]
        errors = numbers @ costs / cost - 1
    return costs, errors


def table_of(rows: pd.DataFrame) -> list[list[str]]:
    """A line for each choice of units; then how uneven the balanced runs are, by points and by instructions."""
    lines = [["units", "instructions of each", "error, median %", "90 % below"]]
    for count in range(1, len(UNITS) + 1):
        costs, errors = fit(rows, UNITS[:count])
        lines.append([", ".join(UNITS[:count]), ", ".join(f"{cost:.0f}" for cost in costs),
                      *(f"{100 * np.quantile(np.abs(errors), share):.1f}" for share in (0.5, 0.9))])  # fmt: skip
    balanced = rows[rows["method"] != "none"].groupby("step")[["points", "cost"]]
    points, cost = (balanced.max() / balanced.mean()).mean()[["points", "cost"]]
    return [*lines, ["busiest rank / mean", f"points {points:.3f}, instructions {cost:.3f}", "", ""]]


def main() -> None:
    given = options("work", __doc__).parse_args()
    program = prepare(given, COMPARE.name)
    for scene, steps in SCENES.items():
        rows = measure(program, scene, steps, given.out / scene)
        rows.to_csv(given.out / f"{scene}.csv")
        print(f"\n{scene}\n\n{markdown_table(table_of(rows))}")


if __name__ == "__main__":
    main()
