"""What a tolerance costs whole runs: the slope and the dam break on 4 ranks, rebalanced at fixed steps.

The work of steps is counted in instructions (comparisons/studies/run work), and messages are modelled from their
counts. Only the work of the calls, with the points that move, is processor time outside MPI. Messages and calls are
divided by the time of a step that is even over the ranks, of which the least of all rounds counts.
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import plot
from document import Report
from driver import ROOT, Driver, driver_of, options
from matplotlib.figure import Figure
from price import EVERY
from results import read
from simulation import once, slope_of_work, uneven_points, uneven_work

ARRAYS = "rrcb-arrays"
TOLERANCES = {"1.1": f"{ARRAYS}[tol=1.1]", "1.01": ARRAYS, "1.001": f"{ARRAYS}[tol=1.001]",
              "exact": f"{ARRAYS}[refine=exact]"}  # fmt: skip
# The slope in cells of twice their size, until its front lies still.
SCENES = {"slope": [f"--scene={ROOT}/examples/mpm/scenes/slope.yaml", "--quick", "--steps=1815"],
          "dam_break": ["--scene=dam_break"]}  # fmt: skip


def measure(driver: Driver, repeats: int) -> None:
    every = ",".join(map(str, EVERY))
    for scene, words in SCENES.items():
        if driver.quick:
            words = [f"--scene={scene}", "--steps=20"]
        driver.run(scene, 4, list(TOLERANCES.values()), *words, "--only=simulations", f"--every={every}",
                   f"--repeats={repeats}")  # fmt: skip


def rows_of(folder: Path) -> pd.DataFrame:
    """Returns a row for each tolerance and interval, in percent of a step that is even over the ranks."""
    runs = once(read(folder / "simulation_runs.csv"))
    runs = runs[runs["round"] == runs["round"].max()]
    even = runs["least_s"] / runs["ranks"]  # of all steps, as are the terms
    terms = {
        "uneven work": uneven_work(runs) - 1,
        "messages of steps": runs["step_network_s"] / even,
        "calls": (runs["balance_path_s"] + runs["balance_network_s"]) / even,
    }
    rows = runs[["method", "every"]].assign(points=100 * (uneven_points(runs) - 1))
    rows = rows.assign(**{name: 100 * term for name, term in terms.items()})
    return rows.assign(cost=rows[list(terms)].sum(axis=1))[rows["method"] != "none"]


def pick(rows: pd.DataFrame, every: int) -> pd.DataFrame:
    """Returns the rows of an interval, in the order of the tolerances."""
    names = [f"{method} every {every}" for method in TOLERANCES.values()]
    return rows.set_index("method").loc[names]


def draw(scenes: dict[str, pd.DataFrame]) -> Figure:
    """Costs of a tolerance in whole runs: time above steps that are even over the ranks and free calls, in % of such a
    step. Steps are counted work and modelled messages. Rings mark the best tolerance."""
    figure, grid = plot.panels(1, len(scenes), 9, 3.8, sharey=True)
    for axes, (scene, rows) in zip(grid[0], scenes.items()):
        for every, colour in EVERY.items():
            cost = pick(rows, every)["cost"].to_numpy()
            axes.plot(list(TOLERANCES), cost, marker=".", color=colour, label=f"a call each {every:,} steps")
            axes.plot(int(cost.argmin()), cost.min(), "o", ms=11, mfc="none", mew=1.6, color=colour)
        axes.set(yscale="log", xlabel="tolerance", title=scene.replace("_", " "))
        axes.grid(True, axis="y")
    grid[0, 0].set_ylabel("time above even steps\nand free calls [% of a step]")
    return plot.legend_above(figure, grid[0, 0], inches=2)


def table_of(rows: pd.DataFrame) -> pd.DataFrame:
    """Returns a line for each interval and tolerance, with the terms of its cost."""
    lines = []
    for every in EVERY:
        for name, row in zip(TOLERANCES, pick(rows, every).to_dict("records")):
            values = {f"{of}, %": row[of] for of in ("points", "uneven work", "messages of steps", "calls", "cost")}
            lines.append({"a call each, steps": f"{every:,}", "tolerance": name}
                         | {of: f"{value:.2f}" for of, value in values.items()})  # fmt: skip
    return pd.DataFrame(lines)


def report(out: Path) -> None:
    scenes = {scene: rows_of(out / scene) for scene in SCENES if (out / scene / "simulation_runs.csv").exists()}
    plot.use_style()
    plot.save(draw(scenes), out / "application.png")
    found = Report("What a tolerance costs whole runs", out)
    found.picture("application.png", " ".join(draw.__doc__.split()))
    for scene, rows in scenes.items():
        found.table(scene, table_of(rows), is_shown=True)
        if slope := slope_of_work(once(read(out / scene / "simulation_runs.csv"))):
            found.say(f"{scene}: 1 % more points on the fullest rank add {slope.text(2)} % of counted work to the steps.")
    found.text(" ".join(__doc__.split("\n\n")[1].split()))
    found.write(next(out.glob("*/run.txt"), out))


def main() -> None:
    parser = options("application", __doc__, "20 steps of coarse scenes")
    parser.add_argument("--repeats", type=int, default=1, help="equal runs, of whose steps the least seconds count")
    parser.add_argument("--keep", action="store_true", help="report what is in the folder")
    given = parser.parse_args()
    if not given.keep:
        measure(driver_of(given), given.repeats)
    report(given.out)


if __name__ == "__main__":
    main()
