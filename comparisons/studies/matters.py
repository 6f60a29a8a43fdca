"""Does the balancer matter? Whole simulations of a dam break and of a fast granular flow under several
balancers and intervals, from 1,000 to 500,000 points a rank.

Simulations of a round take turns of 50 steps, so ratios of one round are paired. A ratio counts as a
difference only if its 95 % interval lies outside 1 +- 1 %, the margin. With a core for each rank the
time is that of the clock, else the critical path. Rounds that met a busy machine count for nothing.

Expected before it was measured, by docs/design/rebalancing.md: rebalanced at the best interval of k
steps, balancing takes 2 t_c / (k t_s) of the time; t_s is the time of a step, t_c that of a call with
all that it moves. If another call takes 1 / r of t_c, it saves 1 - 1 / sqrt(r) of that. With Zoltan's
RCB and r = 2: at 1,000 points a rank, t_c = 3 t_s and k = 45, overhead 13 % and saved 4 %; at 13,000,
t_c = 2 t_s and k = 75, 5 and 1.5 %; from 50,000 points on less than the margin.
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from dataclasses import dataclass, replace
from fnmatch import fnmatch
from pathlib import Path

import pandas as pd
import plot
from document import CORES, Report, show
from driver import COMPARE, OUT, ROOT, Driver, build, has_multijagged
from matters_finding import comparisons, draw, finding, summary
from results import read_all

STUDIES = Path(__file__).parent
# File, and points in it times the area of a cell in m2.
SCENES = {
    "dam_break": (ROOT / "examples/mpm/scenes/dam_break.yaml", 32.0),
    "granular_flow": (STUDIES / "granular_flow.yaml", 4.5),
}
ZOLTAN, OURS = "zoltan-rcb", "rrcb-arrays[reuse]"  # the program's own default in a loop
REUSED = "zoltan-rcb[reuse,lock]"
ALL = [ZOLTAN, REUSED, "zoltan2-mj", "rrcb[reuse]", OURS, "rrcb-arrays[refine=exact,reuse]"]
STEPS = {200: 40, 1000: 2000, 3000: 2000, 13_000: 1000, 50_000: 400, 500_000: 60}
ROUNDS = {200: 2, 1000: 10, 3000: 10, 13_000: 10, 50_000: 6, 500_000: 1}
PICTURES = {
    "matters.png": ("overhead", "overhead", "Time above the least time of the steps. Line: without rebalancing."),
    "matters_ratio.png": ("time_vs_none", "time / none", "Time over that without rebalancing."),
}


@dataclass(frozen=True)
class Cell:
    """Simulations that take turns."""

    scene: str
    points: int  # a rank
    ranks: int
    methods: list[str]
    every: str
    learned: bool = False

    @property
    def name(self) -> str:
        return f"{self.scene}-{self.points}-{self.ranks}" + "-learned" * self.learned

    def run(self, driver: Driver) -> pd.DataFrame:
        """One round."""
        folder = driver.out / self.name
        folder.mkdir(parents=True, exist_ok=True)
        scene = folder / f"{self.scene}.yaml"
        scene.write_text(sized(self.scene, self.points * self.ranks))
        words = [f"--scene={scene}", f"--steps={STEPS[self.points]}", f"--every={self.every}",
                 "--only=simulations", "--repeats=1", "--no-data", *["--cost=learned"] * self.learned]  # fmt: skip
        driver.run(self.name, self.ranks, self.methods or ["none"], *words)
        rows = read_all(folder / "simulation_runs.csv")
        others = re.search(r"used by other processes: (\d+) %", (folder / "run.txt").read_text())
        key = {"cell": self.name, "scene": self.scene, "points_a_rank": self.points}
        return rows.assign(**key, others_percent=float(others[1]) if others else 0.0)


def cells(quick: bool, multijagged: bool) -> list[Cell]:
    methods = [method for method in ALL if multijagged or method != "zoltan2-mj"]
    if quick:
        return [Cell(scene, 200, 2, [ZOLTAN, OURS], "1,10,auto") for scene in SCENES]
    found = []
    for scene in SCENES:
        for points in (1000, 3000):
            found.append(Cell(scene, points, 2, methods, "1,10,100,1000,auto"))
            found.append(Cell(scene, points, 4, [ZOLTAN, REUSED, OURS], "10,100,auto"))
        found.append(Cell(scene, 13_000, 2, methods, "10,100,1000,auto"))
        found.append(Cell(scene, 50_000, 2, [ZOLTAN, REUSED, OURS], "100,auto"))
        found.append(Cell(scene, 500_000, 2, [ZOLTAN, OURS], "auto"))
        found.append(Cell(scene, 1000, 16, [ZOLTAN, OURS], "10,100,auto"))
        found += [Cell(scene, points, 2, [], "auto", learned=True) for points in (1000, 3000, 13_000)]
    return found


def sized(name: str, points: int) -> str:
    """The scene with cells so large that it has about so many points."""
    path, filled = SCENES[name]
    text = path.read_text()
    shipped = float(re.search(r"cell_size: (\S+)", text)[1])
    size = (filled / points) ** 0.5
    text = re.sub(r"cell_size: \S+", f"cell_size: {size!r}", text)
    count = [max(1, round(int(n) * shipped / size)) for n in re.search(r"cells: \[(\d+), (\d+)\]", text).groups()]
    return re.sub(r"cells: \[.*\]", f"cells: {count}", text)


def measure(driver: Driver, chosen: list[Cell], rounds: int, minutes: float, others: float) -> None:
    """Round by round through all cells, on top of what is there already; writes after each round."""
    path = driver.out / "matters_runs.csv"
    runs = read_all(path)
    end = time.monotonic() + 60 * minutes
    for number in range(1, rounds + 1):
        for cell in chosen:
            done = of_cell(runs, cell)
            if number > ROUNDS[cell.points] or done["chunk"].nunique() >= number:
                continue
            if time.monotonic() > end:
                print("Out of time; go on with --resume", file=sys.stderr)
                return
            found = cell.run(driver)
            if found["others_percent"].iloc[0] > others:
                print("A busy machine: the round does not count", file=sys.stderr)
                continue
            chunk = int(done["chunk"].max()) + 1 if len(done) else 1
            runs = pd.concat([runs, found.assign(chunk=chunk, round=chunk)])
            runs.to_csv(path, index=False)


def of_cell(runs: pd.DataFrame, cell: Cell) -> pd.DataFrame:
    return runs[runs["cell"] == cell.name] if len(runs) else pd.DataFrame(columns=["chunk"])


def report(out: Path, names: list[str]) -> None:
    runs = read_all(out / "matters_runs.csv")
    if runs.empty:
        sys.exit("No round was measured.")
    rows = summary(runs, CORES)
    rows.to_csv(out / "matters.csv", index=False, float_format="%.6g")
    pairs = comparisons(runs, rows, CORES, OURS)
    pairs.to_csv(out / "matters_pairs.csv", index=False, float_format="%.6g")
    plot.use_style()
    for name, (column, label, _) in PICTURES.items():
        plot.save(draw(rows, column, label), out / name)
    text, tables = finding(rows, pairs, ZOLTAN, OURS)
    missing = sorted(set(names) - set(runs["cell"]))
    text += f"\nNot measured: {', '.join(missing)}." * bool(missing)
    captions = (f"Time over that of {OURS}, each at its best interval", "The rule, of Zoltan's RCB")
    for caption, table in zip(captions, tables):
        show(caption, table)
    print(f"\n{text}")
    document = Report("When the balancer matters", out)
    document.text(__doc__.split("\n\n", 1)[1])
    for name, (_, _, caption) in PICTURES.items():
        document.picture(name, caption)
    for caption, table in zip(captions, tables):
        document.table(caption, table)
    document.text(text)
    document.write(out / runs["cell"].iloc[0] / "run.txt")


def main() -> int:
    parser = argparse.ArgumentParser(prog="comparisons/studies/run matters", description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)  # fmt: skip
    parser.add_argument("--out", type=Path, default=OUT / "matters", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="tiny simulations of two cells")
    parser.add_argument("--resume", action="store_true", help="keep the rounds that are in the folder")
    parser.add_argument("--only", default="*", help="names of cells, with * and ?, by commas:"
                        " dam_break-1000-2 has 1,000 points on each of 2 ranks")  # fmt: skip
    parser.add_argument("--every", help="intervals of these rounds, by commas; those of the cell")
    parser.add_argument("--methods", help="methods of these rounds, by commas; those of the cell")
    parser.add_argument("--rounds", type=int, default=10, help="of a cell; 10, of large ones fewer; 0: report only")
    parser.add_argument("--minutes", type=float, default=1e9, help="begin no round later than that")
    parser.add_argument("--others", type=float, default=10,
                        help="processor time of other processes in %% above which a round does not count; 10")  # fmt: skip
    parser.add_argument("--driver", type=Path, help="the program to run, which is not built then")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    if not given.driver:
        build("rrcb_compare", multijagged=not given.quick)
    program = given.driver or COMPARE
    if not given.resume:
        (given.out / "matters_runs.csv").unlink(missing_ok=True)
    every = cells(given.quick, has_multijagged(program))
    chosen = [cell for cell in every if any(fnmatch(cell.name, part) for part in given.only.split(","))]
    if given.every:
        chosen = [replace(cell, every=given.every) for cell in chosen]
    if given.methods:
        methods = re.findall(r"[^,\[]+(?:\[[^\]]*\])?", given.methods)
        chosen = [replace(cell, methods=methods) for cell in chosen if not cell.learned]
    others = 100 if given.quick else given.others
    measure(Driver(given.out, program), chosen, given.rounds, given.minutes, others)
    report(given.out, [cell.name for cell in every])
    return 0


if __name__ == "__main__":
    sys.exit(main())
