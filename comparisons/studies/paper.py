"""The paper's figures and claims, measured here: comparisons/paper [--only=LIST] [--out=DIR].

Each part runs the driver, whose CSV files then hold all that the figures and the table are made of.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import plot
from accuracy import CLOUDS, add_accuracy, measure_clouds
from claims import claim_table, set_up_table
from document import Document
from driver import COMPARE, ROOT, Driver
from machine import add_machine, shared_cores
from methods import RCB, STANDARD, WINNERS
from paper_figures import CAPTIONS, draw_all

GRID = [
    f"rrcb-sampled[mesh={mesh},k={k},fraction={fraction}]"
    for mesh in (2, 4, 6, 8, 10)
    for k in (1, 1.5, 2, 2.5)
    for fraction in (1, 0.5, 0.25, 0.125)
]
FINEST = "rrcb-sampled[mesh=10,k=1.5,fraction=1]"  # of figures 3 and 4
RANKS = (2, 4, 6, 8)
STEPS, STEPS_BY_RANKS, SELDOM = 1000, 500, 300


def measure_boxes(driver: Driver) -> None:
    """Figures 2 to 4, and the statistical domains of the four settings."""
    driver.run("six", 6, [RCB], "--only=calls", "--repeats=1")
    driver.run("mesh", 4, [FINEST], "--only=calls", "--repeats=1")
    for number, setting in enumerate(WINNERS, 1):
        driver.run(f"setting-{number}", 4, [setting], "--only=calls", "--repeats=1")


def measure_snapshots(driver: Driver) -> None:
    """The paper's parameters, and how traffic grows with the points."""
    methods = ["zoltan-rcb", RCB, RCB + "[cut=midpoint]", "rrcb", "rrcb-exact"]
    methods += GRID[:: 5 if driver.quick else 1]
    methods += [setting for setting in WINNERS if setting not in methods]
    driver.run("snapshots", 4, methods, "--only=calls", "--no-data", "--repeats=6")
    for points in (27_226, 54_440, 108_880):
        driver.run(f"points-{points}", 4, [RCB, WINNERS[1]], "--cloud=slope",
                   f"--points={points}", "--repeats=1", "--no-data")  # fmt: skip


def measure_simulations(driver: Driver) -> None:
    """Rebalanced at each step as in the paper, ten times with a seed each; and seldom."""
    rounds = 2 if driver.quick else 10
    every_step = ["--only=simulations", "--every=1", f"--repeats={rounds}"]
    steps = [] if driver.quick else [f"--steps={STEPS}"]
    driver.run("simulations", 4, [RCB, "rrcb", *WINNERS], *every_step, *steps)
    driver.run("serial", 1, ["none"], *every_step, *steps)
    seldom = ["--only=simulations", f"--every={SELDOM}", "--repeats=1"]
    driver.run("seldom", 4, [RCB], *seldom)


def measure_ranks(driver: Driver) -> None:
    """The paper's table 1: other numbers of processes."""
    rounds = 2 if driver.quick else 6
    arguments = ["--only=simulations", "--every=1", f"--repeats={rounds}"]
    arguments += [] if driver.quick else [f"--steps={STEPS_BY_RANKS}"]
    for ranks in RANKS:
        driver.run(f"ranks-{ranks}", ranks, [RCB, STANDARD], *arguments)
    driver.run("ranks-1", 1, ["none"], *arguments)


PARTS = {
    "boxes": measure_boxes,
    "snapshots": measure_snapshots,
    "simulations": measure_simulations,
    "ranks": measure_ranks,
    CLOUDS: measure_clouds,
}


def main() -> int:
    arguments = _read_arguments()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    driver = Driver(out, arguments.driver, arguments.quick)
    for part in arguments.only:
        PARTS[part](driver)
    plot.use_style()
    drawn = draw_all(out)
    document = Document("The paper, measured again", out)
    document.conclude(shared_cores(max(RANKS)))
    document.table("What differs from the paper's set-up", set_up_table(out))
    document.summarise("What the paper says", claim_table(out))
    for name in drawn:
        document.picture(name, CAPTIONS[name])
    add_accuracy(document, out)
    add_machine(document, out, " ".join(sys.argv[1:]))
    document.write()
    print(document.summary)
    print(f"Report: {out / 'report.html'}")
    return 0


def _read_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="comparisons/paper", description=__doc__.split(":")[0])
    parser.add_argument("--out", type=Path, default=ROOT / "comparisons/out/paper",
                        help="folder of the results; comparisons/out/paper")  # fmt: skip
    parser.add_argument("--only", type=_parts, default=[p for p in PARTS if p != CLOUDS],
                        help=f"what to measure, by commas: {', '.join(PARTS)};"
                        f" all but {CLOUDS}. The rest is read from the folder.")  # fmt: skip
    parser.add_argument("--quick", action="store_true", help="a small run of everything")
    parser.add_argument("--driver", type=Path, default=COMPARE, help="the program to run")
    return parser.parse_args()


def _parts(text: str) -> list[str]:
    parts = [part.strip() for part in text.split(",") if part.strip()]
    if unknown := [part for part in parts if part not in PARTS]:
        raise argparse.ArgumentTypeError(f"unknown {unknown[0]!r}; choose from {', '.join(PARTS)}")
    return parts


if __name__ == "__main__":
    sys.exit(main())
