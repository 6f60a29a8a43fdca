"""Compares the ghosts of methods on 16 clouds.

With --loads it instead counts the loads of parts whose sizes are corrected for their ghosts.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import pandas as pd
from document import markdown_table
from driver import OUT, PROGRAMS, build, on_ranks
from results import read_all

CASE = ["cloud", "dim", "parts"]
BASE = "zoltan-rcb"
COUNTS = ["ghosts", "ghosts_max", "neighbours_max"]
LOAD_RANKS = (8, 16, 32)


def ratios(rows: pd.DataFrame) -> pd.DataFrame:
    """Returns the counts of each cloud, dimension, number of parts, seed and method divided by those of Zoltan's RCB.
    """
    counts = rows.set_index([*CASE, "seed", "method"])[COUNTS]
    return counts / counts.xs(BASE, level="method").reindex(counts.droplevel("method").index).to_numpy()


def mean(numbers: pd.Series) -> float:
    return float(np.exp(np.log(numbers).mean()))


def table(found: pd.DataFrame) -> list[list[str]]:
    """Returns the geometric means over parts and seeds for each cloud and dimension, then those of all clouds."""
    methods = [m for m in found.index.unique("method") if m != BASE]
    ghosts = found["ghosts"].groupby(["cloud", "dim", "method"], sort=False).agg(mean).unstack("method")
    lines = [["cloud", *methods]]
    for (cloud, dim), row in ghosts.iterrows():
        lines.append([f"{cloud} {dim}-D", *(f"{row[m]:.2f}" for m in methods)])
    for count in COUNTS:
        of_all = found[count].groupby("method").agg(mean)
        lines.append([f"all, {count}", *(f"{of_all[m]:.2f}" for m in methods)])
    worst = found["ghosts"].groupby([*CASE, "method"]).agg(mean).groupby("method").max()
    lines.append(["worst cloud and number of parts", *(f"{worst[m]:.2f}" for m in methods)])
    return lines


def load_table(rows: pd.DataFrame) -> list[list[str]]:
    """Returns a line for each number of parts and cost of a ghost. It has the largest load divided by the mean load
    after each correction, as mean over the clouds and worst value."""
    numbers = sorted(rows["corrections"].unique())
    lines = [["parts", "cost of a ghost", *(f"{n} corrections: mean (worst)" for n in numbers),
              *(f"{n} / 0" for n in numbers[1:]), "ghosts after 2 / 0", "at most 1.03: 0; 2"]]  # fmt: skip
    for (parts, cost), of in rows.groupby(["parts", "cost"]):
        largest, ghosts = (of.pivot_table(index=["cloud", "dim"], columns="corrections", values=name)
                           for name in ("largest", "ghosts"))  # fmt: skip
        line = [str(parts), f"{cost:g}", *(f"{largest[n].mean():.3f} ({largest[n].max():.3f})" for n in numbers)]
        good = [str((largest[n] <= 1.03).sum()) for n in (0, 2)]
        line += [f"{mean(largest[n] / largest[0]):.3f}" for n in numbers[1:]]
        lines.append([*line, f"{mean(ghosts[2] / ghosts[0]):.3f}", f"{'; '.join(good)} of {len(largest)}"])
    return lines


def count(program: Path, file: Path, *words: str, ranks: int = 1) -> pd.DataFrame:
    print("rrcb_ghosts", *words, file=sys.stderr, flush=True)
    with file.open("w") as rows:
        on_ranks(ranks, program, *words, stdout=rows, check=True)
    return read_all(file)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT / "ghosts", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="few points, one seed")
    parser.add_argument("--loads", action="store_true", help="correct part sizes by ghosts, on 8, 16 and 32 ranks")
    parser.add_argument("--driver", type=Path, help="a program beside rrcb_ghosts, which is not built then")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    if not given.driver:
        build("rrcb_ghosts")
    program = (given.driver.parent if given.driver else PROGRAMS) / "rrcb_ghosts"
    quick = ["--quick"] * given.quick
    if given.loads:
        found = [count(program, given.out / f"loads_{ranks}.csv", "loads", *quick, ranks=ranks)
                 for ranks in ((8,) if given.quick else LOAD_RANKS)]  # fmt: skip
        print(markdown_table(load_table(pd.concat(found))))
        return
    print("Ghosts over those of zoltan-rcb\n")
    print(markdown_table(table(ratios(count(program, given.out / "clouds.csv", "clouds", *quick)))))


if __name__ == "__main__":
    main()
