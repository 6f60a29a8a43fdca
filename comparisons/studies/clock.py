"""Measures by the clock which part of a balancer matters for a step: the call, the cuts or the weights.

Takes 10 minutes. Complete simulations of particles run on 2 ranks, which need a core each. The scenes are a splash
(SPH) and a pile with loose grains (DEM), in boxes up to 1.5 times as high as wide. There are three factors: Zoltan's
RCB or rrcb, both called through callbacks with reuse; cuts across the longest axis or across the axis with fewest
points nearby; weights of 1 or learned weights. Each round runs all combinations in a random order. Ratios are taken
within a round. The A/A row compares two equal runs: its interval must contain 1.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from io import StringIO
from pathlib import Path

import numpy as np
import pandas as pd
from document import CORES, markdown_table
from driver import OUT, PROGRAMS, build, on_ranks
from intervals import Value, median_of

SCENES = {"splash": 1, "pile": 12}  # number of steps relative to a splash, whose steps take longer
RANKS = 2
FACTORS = {"call": ("zoltan-rcb", "rrcb"), "cuts": ("longest", "fewest"), "weights": ("count", "learned")}


def factors(runs: pd.DataFrame) -> list[list[str]]:
    """Returns a line for each scene: the ratio of the times with the second and the first level of each factor. It is
    taken in each round and for every combination of the other factors, as geometric mean over the combinations."""
    lines = [["factor", *runs["scene"].unique()]]
    once = runs[runs["again"] == 0]
    for factor, (first, second) in FACTORS.items():
        both = {level: once[once[factor] == level] for level in (first, second)}
        lines.append([f"{factor}: {second} / {first}", *(ratios(both[second], both[first], factor, scene).text(3)
                                                         for scene in lines[0][1:])])  # fmt: skip
    ours = once[(once["call"] == "rrcb") & (once["cuts"] == "fewest")]
    with_ghosts = ours[ours["weights"] == "ghosts"].assign(weights="learned")
    again = runs[runs["again"] == 1]
    for what, other in (("column of ghosts: with / without", with_ghosts), ("A/A: rrcb / itself", again)):
        lines.append([what, *(ratios(other, ours, "", scene).text(3) for scene in lines[0][1:])])
    return lines


def ratios(upper: pd.DataFrame, lower: pd.DataFrame, factor: str, scene: str) -> Value:
    """Returns the median over the rounds of the geometric mean over the other factors."""
    key = ["round", *(name for name in FACTORS if name != factor)]
    times = [rows[rows["scene"] == scene].set_index(key)["wall_s"] for rows in (upper, lower)]
    logs = np.log(times[0] / times[1]).dropna().groupby("round").mean()
    return median_of(np.exp(logs))


def counts(runs: pd.DataFrame) -> list[list[str]]:
    """Returns the counts that explain the times, as medians for each combination."""
    lines = [["scene", *FACTORS, "time, s", "calls, % of it", "ghosts", "moved"]]
    runs = runs[runs["again"] == 0].assign(share=100 * runs["calls_s"] / runs["wall_s"])
    columns = {"wall_s": 2, "share": 2, "ghosts": 0, "moved": 0}
    for key, row in runs.groupby(["scene", *FACTORS])[list(columns)].median().iterrows():
        lines.append([*key, *(f"{row[name]:.{digits}f}" for name, digits in columns.items())])
    return lines


def measure(program: Path, out: Path, minutes: float, rounds: int, points: int, steps: int) -> pd.DataFrame:
    """Runs the scenes round by round. Writes the results after each round."""
    runs = pd.DataFrame()
    end = time.monotonic() + 60 * minutes
    for number in range(rounds):
        if number > 0 and time.monotonic() > end:
            break
        for scene, times in SCENES.items():
            print(f"Round {number + 1} of {rounds}: {scene}", file=sys.stderr, flush=True)
            words = [scene, str(number), str(points), str(times * steps)]
            rows = on_ranks(RANKS, program, *words, stdout=subprocess.PIPE, text=True, check=True).stdout
            runs = pd.concat([runs, pd.read_csv(StringIO(rows))], ignore_index=True)
            runs.to_csv(out / "clock.csv", index=False)
    return runs


def main() -> None:
    parser = argparse.ArgumentParser(prog="comparisons/studies/run clock", description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)  # fmt: skip
    parser.add_argument("--out", type=Path, default=OUT / "clock", help="folder of clock.csv and table.md")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--points", type=int, default=20_000, help="of both ranks")
    parser.add_argument("--steps", type=int, default=500, help="of a splash; a pile takes 12 times as many")
    parser.add_argument("--minutes", type=float, default=10.5, help="begin no round later than that")
    parser.add_argument("--quick", action="store_true", help="one round of few points and steps")
    parser.add_argument("--driver", type=Path, help="a program beside rrcb_clock, which is not built then")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    if not given.driver:
        build("rrcb_clock")
    program = (given.driver.parent if given.driver else PROGRAMS) / "rrcb_clock"
    size = (1, 1000, 50) if given.quick else (given.rounds, given.points, given.steps)
    if CORES < RANKS:
        print("The ranks share a core: times mean nothing", file=sys.stderr)
    runs = measure(program, given.out, given.minutes, *size)
    tables = "\n\n".join(markdown_table(lines) for lines in (factors(runs), counts(runs)))
    (given.out / "table.md").write_text(tables + "\n")
    print(tables)


if __name__ == "__main__":
    main()
