"""Does the balancer matter? Whole simulations of a dam break and of a fast granular flow, from 1,000 to 500,000
points a rank, each rebalanced when its own controller finds that it pays.

Simulations of a round take turns of 50 steps in an order drawn anew, so ratios of one round are paired. With a
core for each rank the time is that of the clock, else the critical path. Our balancer runs twice in each round.
A ratio shows a difference only if its 95 % interval is outside 1 +- 1 % and outside the interval of these
identical runs. Rounds that met a busy machine count for nothing.
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

import pandas as pd
from document import CORES, Report, show
from driver import COMPARE, OUT, ROOT, Driver, build
from intervals import NOT_TOLD_APART, Value
from results import read_all
from simulation import AGAIN, MARGIN, limit_of, paired

STUDIES = Path(__file__).parent
# File, and points in it times the area of a cell in m2.
SCENES = {
    "dam_break": (ROOT / "examples/mpm/scenes/dam_break.yaml", 32.0),
    "granular_flow": (STUDIES / "granular_flow.yaml", 4.5),
}
OURS, ZOLTAN = "rrcb-arrays[reuse]", "zoltan-rcb"  # the program's own default in a loop
METHODS = f"{OURS},{ZOLTAN},zoltan-rcb[reuse,lock],rrcb[reuse],rrcb-arrays[refine=exact,reuse]"
SIZES = {  # points a rank: steps, rounds, numbers of ranks
    1000: (2000, 10, (2, 4, 16)), 3000: (2000, 10, (2, 4)), 13_000: (1000, 10, (2,)),
    50_000: (400, 6, (2,)), 500_000: (60, 1, (2,)),
}  # fmt: skip


@dataclass(frozen=True)
class Cell:
    """Simulations that take turns."""

    scene: str
    points: int  # a rank
    ranks: int
    every: str
    steps: int
    rounds: int

    @property
    def name(self) -> str:
        return f"{self.scene}-{self.points}-{self.ranks}" + f"-{self.every}" * (self.every != "auto")

    def run(self, driver: Driver, methods: str, number: int) -> pd.DataFrame:
        """One round, whose turns have an order of their own."""
        folder = driver.out / self.name
        folder.mkdir(parents=True, exist_ok=True)
        scene = folder / f"{self.scene}.yaml"
        scene.write_text(sized(self.scene, self.points * self.ranks))
        words = [f"--scene={scene}", f"--steps={self.steps}", f"--every={self.every}", "--only=simulations",
                 "--repeats=1", f"--seed={number}", "--no-data"]  # fmt: skip
        driver.run(self.name, self.ranks, [methods], *words)
        rows = read_all(folder / "simulation_runs.csv")
        others = re.search(r"used by other processes: (\d+) %", (folder / "run.txt").read_text())
        return rows.assign(cell=self.name, others_percent=float(others[1]) if others else 0.0)


def cells(every: list[str], quick: bool) -> list[Cell]:
    if quick:
        return [Cell(scene, 200, 2, "auto", 40, 2) for scene in SCENES]
    return [Cell(scene, points, number, interval, steps, rounds) for scene in SCENES for interval in every
            for points, (steps, rounds, ranks) in SIZES.items() for number in ranks]  # fmt: skip


def sized(name: str, points: int) -> str:
    """The scene with cells so large that it has about so many points."""
    path, filled = SCENES[name]
    text = path.read_text()
    shipped = float(re.search(r"cell_size: (\S+)", text)[1])
    size = (filled / points) ** 0.5
    text = re.sub(r"cell_size: \S+", f"cell_size: {size!r}", text)
    count = [max(1, round(int(n) * shipped / size)) for n in re.search(r"cells: \[(\d+), (\d+)\]", text).groups()]
    return re.sub(r"cells: \[.*\]", f"cells: {count}", text)


def measure(driver: Driver, chosen: list[Cell], methods: str, minutes: float, others: float) -> None:
    """Round by round through all cells, on top of what is there already; writes after each round."""
    path = driver.out / "matters_runs.csv"
    runs = read_all(path)
    end = time.monotonic() + 60 * minutes
    for number in range(1, max(cell.rounds for cell in chosen) + 1):
        for cell in chosen:
            done = runs.loc[runs["cell"] == cell.name, "round"].max() if len(runs) else 0
            if number > cell.rounds or done >= number:
                continue
            if time.monotonic() > end:
                print("Out of time; go on with --resume", file=sys.stderr)
                return
            found = cell.run(driver, methods, number)
            if found["others_percent"].iloc[0] > others:
                print("A busy machine: the round does not count", file=sys.stderr)
                continue
            runs = pd.concat([runs, found.assign(round=number)])
            runs.to_csv(path, index=False)


def timed(runs: pd.DataFrame) -> pd.DataFrame:
    """Adds seconds of all and of steps, and of a rebalance: by the clock if ranks have a core each."""
    runs = runs[runs["error"].isna()]
    by_clock = runs["ranks"] <= CORES
    steps, balance = (runs[f"{of}_path_s"] + runs[f"{of}_network_s"] for of in ("step", "balance"))
    calls = runs["rebalances"].where(runs["rebalances"] > 0)
    return runs.assign(
        time=runs["wall_s"].where(by_clock, runs["critical_path_s"]),
        step=runs["step_s"].where(by_clock, steps) / runs["steps"],
        call=runs["balance_s"].where(by_clock, balance) / calls,
        interval=runs["steps"] / calls,
    )


def verdict(ratio: Value, noise: Value) -> str:
    """Of a time over ours, beside that of ours over itself."""
    if not (ratio.has_interval and noise.has_interval):
        return "too few rounds"
    low, high = min(noise.low, 1 / (1 + MARGIN)), max(noise.high, 1 + MARGIN)
    if ratio.low > high:
        return "slower"
    return "faster" if ratio.high < low else NOT_TOLD_APART


def finding(runs: pd.DataFrame) -> pd.DataFrame:
    """A line of texts for each cell: ratios to our balancer, and the interval below which Zoltan's costs MARGIN."""
    lines = []
    for name, of in timed(runs).groupby("cell", sort=False):
        ratios = {m: paired(of, of["time"], m, OURS) or Value(float("nan")) for m in of["method"].unique()}
        noise = ratios.pop(OURS + AGAIN)
        medians = of.groupby("method")[["step", "call", "interval"]].median()
        ours, zoltan = medians.loc[OURS], medians.loc[ZOLTAN]
        limit = limit_of(zoltan["call"], ours["call"], zoltan["step"])
        others = {method: ratio.text(3) for method, ratio in ratios.items() if method not in (OURS, ZOLTAN)}
        lines.append({
            "cell": name, "rounds": f"{of['round'].nunique()}", ZOLTAN: ratios[ZOLTAN].text(3),
            "ours again": noise.text(3), "verdict": verdict(ratios[ZOLTAN], noise),
            "step, ms": f"{1e3 * zoltan['step']:.3f}", "call, ms": f"{1e3 * zoltan['call']:.2f}",
            "ours, ms": f"{1e3 * ours['call']:.2f}", "steps between": f"{zoltan['interval']:.0f}",
            "matters below, steps": f"{limit:.0f}", **others,
        })  # fmt: skip
    return pd.DataFrame(lines).fillna("")


def sentence(found: pd.DataFrame) -> str:
    judged = found[~found["verdict"].isin([NOT_TOLD_APART, "too few rounds"])]
    expected = judged["steps between"].astype(float) < judged["matters below, steps"].astype(float)
    right = (expected == (judged["verdict"] == "slower")).sum()
    return (
        f"Zoltan's RCB is told apart from rrcb in {len(judged)} of {len(found)} cells. Rule: it costs more than 1 % if"
        f" rebalances pay more often than every 200 (1 - 1 / sqrt r) call / step steps, r the quotient of both"
        f" calls; right in {right} of these."
    )


def main() -> int:
    parser = argparse.ArgumentParser(prog="comparisons/studies/run matters", description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)  # fmt: skip
    parser.add_argument("--out", type=Path, default=OUT / "matters", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="tiny simulations of two cells")
    parser.add_argument("--resume", action="store_true", help="keep the rounds that are in the folder")
    parser.add_argument("--only", default="*", help="names of cells, with * and ?, by commas:"
                        " dam_break-1000-2 has 1,000 points on each of 2 ranks")  # fmt: skip
    parser.add_argument("--every", default="auto", help="auto, or steps between rebalances; several by commas")
    parser.add_argument("--methods", default=METHODS, help=f"with {OURS} first")
    parser.add_argument("--minutes", type=float, default=1e9, help="begin no round later than that")
    parser.add_argument("--others", type=float, default=10,
                        help="processor time of other processes in %% above which a round does not count; 10")  # fmt: skip
    parser.add_argument("--driver", type=Path, help="the program to run, which is not built then")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    if not given.driver:
        build("rrcb_compare", multijagged=False)
    if not given.resume:
        (given.out / "matters_runs.csv").unlink(missing_ok=True)
    chosen = [cell for cell in cells(given.every.split(","), given.quick)
              if any(fnmatch(cell.name, part) for part in given.only.split(","))]  # fmt: skip
    driver = Driver(given.out, given.driver or COMPARE)
    measure(driver, chosen, given.methods, given.minutes, 100 if given.quick else given.others)
    runs = read_all(given.out / "matters_runs.csv")
    if runs.empty:
        sys.exit("No round was measured.")
    found = finding(runs)
    show("Time over that of " + OURS, found)
    print(f"\n{sentence(found)}")
    document = Report("When the balancer matters", given.out)
    document.text(__doc__.split("\n\n", 1)[1])
    document.table(f"Time over that of {OURS}", found)
    document.text(sentence(found))
    document.write(given.out / runs["cell"].iloc[0] / "run.txt")
    return 0


if __name__ == "__main__":
    sys.exit(main())
