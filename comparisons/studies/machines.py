"""Counts ghosts between machines: RRCB with and without machines beside Zoltan's RCB and HIER.

One process makes the parts of clusters of 3 x 4 to 9,408 x 112 ranks. Real ranks on machines that are
made up fetch their ghosts, and the bytes between machines are counted.
"""

from __future__ import annotations

import argparse
import io
import sys
from itertools import product
from pathlib import Path

import pandas as pd
import plot
from document import Report, show
from driver import OUT, PROGRAMS, build, on_ranks

CLOUDS = ("uniform", "corner", "clusters")
VIRTUAL = [(3, 28), (5, 20), (6, 48), (10, 24), (12, 32), (16, 16), (20, 28), (100, 48), (147, 112)]
LARGEST = (9408, 112)  # Frontier's nodes; ranks of 2 x 56 cores
REAL = [(3, 4), (5, 4), (6, 2)]
SEEDS, MANY_PARTS = 10, 2000  # seeds of machines with fewer parts; of more one
POINTS, POINTS_OF_LARGEST = 60, 8  # a part
CASE = ["cloud", "dimension", "machines", "ranks"]
BASE, OURS, RCB, HIER = "halving", "machines", "zoltan-rcb", "zoltan-hier"


def count(program: Path, shape: tuple[int, int], is_real: bool, *words) -> pd.DataFrame:
    machines, ranks = shape
    arguments = [str(word) for word in (machines, ranks, *words)]
    print("rrcb_machines", *arguments, file=sys.stderr, flush=True)
    found = on_ranks(machines * ranks if is_real else 1, program, *arguments, capture_output=True, text=True)
    if found.returncode:
        sys.exit(found.stdout + found.stderr)
    lines = [line for line in found.stdout.splitlines() if line.count(",") == 10]
    return pd.read_csv(io.StringIO("\n".join(lines))).assign(real=is_real)


def cases(quick: bool, largest: bool):
    """Arguments of count()."""
    virtual, real, seeds, clouds = VIRTUAL, REAL, SEEDS, CLOUDS
    if quick:
        virtual, real, seeds, clouds = [(3, 4), (16, 4)], [(3, 2)], 2, ("uniform", "clusters")
    for (shape, is_real), dimension, cloud in product(
        [(s, False) for s in virtual] + [(s, True) for s in real], (2, 3), clouds
    ):
        parts = shape[0] * shape[1]
        points = POINTS if parts > MANY_PARTS else max(POINTS, (4000 if quick else 100_000) // parts)
        for seed in range(seeds if parts <= MANY_PARTS else 1):
            yield shape, is_real, dimension, cloud, seed, points
    for dimension, cloud in product((2, 3), clouds) if largest else ():
        yield LARGEST, False, dimension, cloud, 0, POINTS_OF_LARGEST


def ratios(rows: pd.DataFrame) -> pd.DataFrame:
    """Of each case, seed and way: ghosts over those of halving."""
    key = [*CASE, "real", "seed"]
    base = rows[rows["method"] == BASE].set_index(key)
    found = rows[rows["method"] != BASE].set_index(key)
    for column in ("off_machine", "ghosts", "most", "bytes"):
        found[column] = found[column] / base[column].reindex(found.index)
    return found.reset_index()


def summary(found: pd.DataFrame) -> pd.DataFrame:
    """Means over the seeds, and the worst seed of machines first."""
    rows = []
    for (real, *case), of in found.groupby(["real", *CASE]):
        ways = {way: r for way, r in of.groupby("method")}
        ours = ways[OURS]
        rows.append({
            "cloud": f"{case[0]} {case[1]}-D", "machines x ranks": f"{case[2]:,} x {case[3]}",
            "": "real" if real else "",
            **{f"off-machine, {way}": f"{ways[way]['off_machine'].mean():.2f}" for way in (OURS, RCB, HIER)},
            "worst seed": f"{ours['off_machine'].max():.2f}",
            "all": f"{ours['ghosts'].mean():.2f}", "most into one part": f"{ours['most'].max():.2f}",
            "bytes of fetch": f"{ours['bytes'].mean():.2f}" if real else "",
        })  # fmt: skip
    return pd.DataFrame(rows)


def draw(found: pd.DataFrame):
    """Off-machine ghosts over the number of machines, a panel for each cloud."""
    clouds = list(dict.fromkeys(zip(found["cloud"], found["dimension"])))
    clouds.sort(key=lambda c: (c[1], CLOUDS.index(c[0])))
    lines = sorted({d for _, d in clouds})
    grid_of = {c: (lines.index(c[1]), [x for x in clouds if x[1] == c[1]].index(c)) for c in clouds}
    figure, grid = plot.panels(len(lines), len(clouds) // len(lines), 9, 5, sharex=True, sharey=True)
    looks = {OURS: plot.method_style("rrcb"), RCB: plot.method_style(RCB), HIER: plot.method_style("zoltan-hsfc")}
    for cloud, place in grid_of.items():
        axes = grid[place]
        axes.set_title(f"{cloud[0]}, {cloud[1]}-D")
        axes.axhline(1, color="#BBBBBB", linewidth=0.8)
        of = found[(found["cloud"] == cloud[0]) & (found["dimension"] == cloud[1]) & ~found["real"]]
        for method, look in looks.items():
            numbers = of[of["method"] == method].groupby("machines")["off_machine"]
            middle = numbers.mean()
            axes.errorbar(middle.index, middle, [middle - numbers.min(), numbers.max() - middle],
                          label=method, capsize=2, **look.mark)  # fmt: skip
        axes.set_xscale("log")
    plot.label_edges(grid, "machines", "off-machine ghosts / halving")
    return plot.legend_above(figure, grid[0, 0])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--out", type=Path, default=OUT / "machines", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="few small cases")
    parser.add_argument("--largest", action="store_true", help="9,408 x 112 as well: 3 GB, minutes")
    parser.add_argument("--driver", type=Path, help="a program beside rrcb_machines, which is not built then")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    if not given.driver:
        build("rrcb_machines")
    program = (given.driver.parent if given.driver else PROGRAMS) / "rrcb_machines"
    rows = pd.concat([count(program, *case) for case in cases(given.quick, given.largest)])
    rows.to_csv(given.out / "machines.csv", index=False)
    found = ratios(rows)
    table = summary(found)
    show("Ghosts over those of halving, means of the seeds", table)
    plot.use_style()
    plot.save(draw(found), given.out / "machines.png")
    report = Report("Ghosts between machines", given.out)
    report.picture("machines.png", "Off-machine ghosts over those of halving. Mean and range of the seeds.")
    report.table("Means of the seeds", table)
    report.write(given.out / "run.txt")
    return 0


if __name__ == "__main__":
    sys.exit(main())
