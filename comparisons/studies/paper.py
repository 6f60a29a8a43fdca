"""Measures the paper's claims again and draws its figures 2 to 6. Each part runs the driver, whose CSV files contain
everything that the figures and the table need."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import pandas as pd
import plot
from claims import claim_table
from document import Report, shared_cores, show
from driver import COMPARE, OUT, Driver, build
from methods import RCB, STANDARD, WINNERS, setting_of
from paper_figures import CAPTIONS, CHART_K, draw_all, speed_ups
from results import measurements, read

GRID = [
    f"rrcb-sampled[mesh={mesh},k={k},fraction={fraction}]"
    for mesh in (2, 4, 6, 8, 10)
    for k in (1, 1.5, 2, 2.5)
    for fraction in (1, 0.5, 0.25, 0.125)
]
FINEST = "rrcb-sampled[mesh=10,k=1.5,fraction=1]"  # of figures 3 and 4
RANKS = (2, 4, 6, 8)
STEPS, STEPS_BY_RANKS, STEPS_OF_GRID, SELDOM = 1000, 500, 200, 300
SEEDS = 200


def measure_boxes(driver: Driver) -> None:
    """Measures figures 2 to 4, and the drawn points of the four settings."""
    runs = {"six": RCB, "mesh": FINEST} | {f"setting-{n}": s for n, s in enumerate(WINNERS, 1)}
    for name, method in runs.items():
        driver.run(name, 6 if name == "six" else 4, [method], "--only=calls", "--repeats=1")


def measure_snapshots(driver: Driver) -> None:
    """Measures the paper's parameters, and how traffic grows with the number of points."""
    methods = ["zoltan-rcb", RCB, RCB + "[cut=midpoint]", "rrcb", "rrcb-exact"]
    methods += GRID[:: 5 if driver.quick else 1]
    methods += [setting for setting in WINNERS if setting not in methods]
    driver.run("snapshots", 4, methods, "--only=calls", "--no-data", "--repeats=6")
    for points in (27_226, 54_440, 108_880):
        driver.run(f"points-{points}", 4, [RCB, WINNERS[1]], "--cloud=slope",
                   f"--points={points}", "--repeats=1", "--no-data")  # fmt: skip


def _simulate(driver: Driver, name: str, ranks: int, methods: list[str], steps: int, rounds: int) -> None:
    """Runs simulations that rebalance in each step, as in the paper."""
    words = ["--only=simulations", "--every=1", f"--repeats={2 if driver.quick else rounds}"]
    driver.run(name, ranks, methods, *words, *([] if driver.quick else [f"--steps={steps}"]))


def measure_simulations(driver: Driver) -> None:
    """Runs ten rounds with a seed each. Also runs simulations that rebalance rarely."""
    _simulate(driver, "simulations", 4, [RCB, "rrcb", *WINNERS], STEPS, 10)
    _simulate(driver, "serial", 1, ["none"], STEPS, 10)
    driver.run("seldom", 4, [RCB], "--only=simulations", f"--every={SELDOM}", "--repeats=1")


def measure_grid(driver: Driver) -> None:
    """Measures figure 5: every mesh, k and fraction of the paper's charts, in the same rounds."""
    methods = [RCB, *(setting for setting in GRID if setting_of(setting)[1] in CHART_K)]
    _simulate(driver, "grid", 4, methods[:: 9 if driver.quick else 1], STEPS_OF_GRID, 6)
    _simulate(driver, "grid-serial", 1, ["none"], STEPS_OF_GRID, 6)


def measure_ranks(driver: Driver) -> None:
    """Measures the paper's table 1 for other numbers of processes."""
    for ranks in RANKS[:1] if driver.quick else RANKS:
        _simulate(driver, f"ranks-{ranks}", ranks, [RCB, STANDARD], STEPS_BY_RANKS, 6)
    _simulate(driver, "ranks-1", 1, ["none"], STEPS_BY_RANKS, 6)


def measure_seeds(driver: Driver) -> None:
    """Runs the settings with 2 σ with many seeds, so that the meshes can be distinguished."""
    seeds = range(1, 3 if driver.quick else SEEDS + 1)
    methods = [f"{setting[:-1]},seed={seed}]" for setting in WINNERS[1:] for seed in seeds]
    driver.run("seeds", 4, methods, "--only=calls", "--no-data", "--repeats=1")


PARTS = {
    "boxes": measure_boxes,
    "snapshots": measure_snapshots,
    "simulations": measure_simulations,
    "grid": measure_grid,
    "ranks": measure_ranks,
    "seeds": measure_seeds,
}


def rank_table(out: Path) -> pd.DataFrame:
    """Returns the paper's table 1: the speed-up over one process by number of processes."""
    lines = []
    for ranks in RANKS:
        speeds = speed_ups(out / f"ranks-{ranks}", out / "ranks-1")
        lines += [{"processes": f"{ranks}"} | {method: of.text(2) for method, of in speeds.items()}] * bool(speeds)
    return pd.DataFrame(lines)


def seed_table(out: Path) -> pd.DataFrame:
    """Returns the median excess over the seeds in percent, by mesh and snapshot."""
    rows = measurements(read(out / "seeds/table.csv"))
    if rows.empty:
        return rows
    rows["mesh"] = rows["method"].str.extract(r"mesh=(\d+)")
    excess = (100 * rows["excess"]).groupby([rows["mesh"], rows["workload"]], sort=False).median()
    return excess.map("{:.2f}".format).unstack().reset_index()


def main() -> int:
    arguments = _read_arguments()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    if not arguments.driver:
        build("rrcb_compare")
    driver = Driver(out, arguments.driver or COMPARE, arguments.quick)
    for part in arguments.only:
        PARTS[part](driver)
    plot.use_style()
    report = Report("The paper, measured again", out)
    report.text(shared_cores(max(RANKS)))
    for caption, rows in (("What the paper says", claim_table(out)),
                          ("Table 1: speed-up by processes", rank_table(out)),
                          ("Excess in %, medians over the seeds", seed_table(out))):  # fmt: skip
        report.table(caption, rows)
        if len(rows):
            show(caption, rows)
    for name in draw_all(out):
        report.picture(name, CAPTIONS[name])
    report.write(out / "snapshots/run.txt")
    return 0


def _read_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="comparisons/paper", description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT / "paper",
                        help="folder of the results; comparisons/out/paper")  # fmt: skip
    usual = [part for part in PARTS if part not in ("seeds", "grid")]
    parser.add_argument("--only", type=_parts, default=usual, metavar="LIST",
                        help=f"what to measure, by commas: {', '.join(PARTS)}; all but seeds and"
                        " grid, of a quarter of an hour. The rest is read from the folder.")  # fmt: skip
    parser.add_argument("--quick", action="store_true", help="a small run of everything")
    parser.add_argument("--driver", type=Path, help="the program to run, which is not built then")
    return parser.parse_args()


def _parts(text: str) -> list[str]:
    parts = [part.strip() for part in text.split(",") if part.strip()]
    if unknown := [part for part in parts if part not in PARTS]:
        raise argparse.ArgumentTypeError(f"unknown {unknown[0]!r}; choose from {', '.join(PARTS)}")
    return parts


if __name__ == "__main__":
    sys.exit(main())
