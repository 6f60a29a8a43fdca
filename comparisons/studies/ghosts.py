"""Compares the ghosts of methods on 16 clouds.

With --loads it instead counts the loads of parts whose sizes are corrected for their ghosts.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from document import markdown_table
from driver import options, prepare
from results import printed

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


def main() -> None:
    parser = options("ghosts", __doc__, "few points, one seed")
    parser.add_argument("--loads", action="store_true", help="correct part sizes by ghosts, on 8, 16 and 32 ranks")
    given = parser.parse_args()
    program = prepare(given, "rrcb_ghosts")
    quick = ["--quick"] * given.quick
    if given.loads:
        found = [printed(ranks, program, "loads", *quick, file=given.out / f"loads_{ranks}.csv")
                 for ranks in LOAD_RANKS[: 1 if given.quick else None]]  # fmt: skip
        print(markdown_table(load_table(pd.concat(found))))
        return
    print("Ghosts over those of zoltan-rcb\n")
    print(markdown_table(table(ratios(printed(1, program, "clouds", *quick, file=given.out / "clouds.csv")))))


if __name__ == "__main__":
    main()
