"""Measures the paper's claims again and draws its figures. Each part runs the driver, whose CSV files contain
everything that the figures and the table need."""

from __future__ import annotations

import argparse
import re
import shutil
from pathlib import Path

import pandas as pd
import plot
from claims import claim_table
from document import Report, shared_cores, write_between
from driver import ROOT, Driver, driver_of, options
from methods import RCB, STANDARD, WINNERS, setting_of
from paper_figures import CAPTIONS, CHART_K, FINEST, draw_all, grid_table, speed_ups
from results import Results, measurements, read, sound
from simulation import of_method

GRID = [
    f"rrcb-sampled[mesh={mesh},k={k},fraction={fraction}]"
    for mesh in (2, 4, 6, 8, 10)
    for k in (1, 1.5, 2, 2.5)
    for fraction in (1, 0.5, 0.25, 0.125)
]
RANKS = (2, 4, 6, 8)
# The slope is at rest for 1,000 steps, and some settings move many points while they lie on a lattice.
FIRST_STEP, STEPS, STEPS_BY_RANKS, STEPS_OF_GRID, SELDOM = 1500, 1000, 200, 200, 300
PAGE = ROOT / "docs/design/paper.md"
COUNTS = ROOT / "comparisons/paper.csv"
COUNTED = ["workload", "points", "method", "bytes", "root_bytes_in", "ghosts", "imbalance"]


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


def _simulate(driver: Driver, name: str, ranks: int, methods: list[str], steps: int, rounds: int, every: int = 1) -> None:
    """Runs simulations that rebalance in each step, as in the paper, in turns with a serial run on rank 0."""
    words = ["--only=simulations", f"--every={every}", "--serial", f"--repeats={2 if driver.quick else rounds}"]
    words += [] if driver.quick else [f"--from={FIRST_STEP}", f"--steps={steps}"]
    driver.run(name, ranks, methods, *words)


def measure_simulations(driver: Driver) -> None:
    """Runs six rounds with a seed each. Also runs simulations that rebalance rarely."""
    _simulate(driver, "simulations", 4, [RCB, "rrcb", *WINNERS], STEPS, 6)
    _simulate(driver, "seldom", 4, [RCB], STEPS, 1, SELDOM)


def measure_grid(driver: Driver) -> None:
    """Measures figure 5: every mesh, k and fraction of the paper's charts, in the same rounds."""
    settings = [setting for setting in GRID if setting_of(setting)[1] in CHART_K]
    _simulate(driver, "grid", 4, [RCB, "rrcb", *settings][:: 9 if driver.quick else 1], STEPS_OF_GRID, 6)


def measure_ranks(driver: Driver) -> None:
    """Measures the paper's table 1 for other numbers of processes."""
    for ranks in RANKS[:1] if driver.quick else RANKS:
        _simulate(driver, f"ranks-{ranks}", ranks, [RCB, STANDARD], STEPS_BY_RANKS, 6)


PARTS = {
    "boxes": measure_boxes,
    "snapshots": measure_snapshots,
    "simulations": measure_simulations,
    "grid": measure_grid,
    "ranks": measure_ranks,
}


def rank_table(out: Path) -> pd.DataFrame:
    """Returns the paper's table 1: the speed-up over one process and the imbalance, by number of processes."""
    lines = []
    for ranks in RANKS:
        folder = out / f"ranks-{ranks}"
        runs = sound(Results(folder).all_runs)
        for method, speed in speed_ups(folder).items():
            imbalance = of_method(runs, runs["mean_imbalance"], method).text(4)
            lines.append({"processes": f"{ranks}", "method": method, "speed-up": speed.text(2),
                          "mean imbalance": imbalance})  # fmt: skip
    return pd.DataFrame(lines)


def counts(out: Path) -> pd.DataFrame:
    """Returns the exact counts of calls with which claims are judged."""
    files = [out / "snapshots/table.csv", *sorted(out.glob("points-*/table.csv"))]
    rows = pd.concat([measurements(read(path)) for path in files if path.exists()] or [pd.DataFrame(columns=COUNTED)])
    return rows[rows["method"].isin([RCB, RCB + "[cut=midpoint]", *WINNERS])].reindex(columns=COUNTED)


def write_page(out: Path, claims: pd.DataFrame) -> None:
    """Writes the tables of the page, the counts that a test compares with it, and its figures. Claims that were not
    measured keep their rows."""
    old, ranks = re.search(r"<!-- claims -->\n.*?\n<!-- end -->", PAGE.read_text(), re.S)[0], rank_table(out)
    rows = {row[0]: row for line in old.splitlines()[3:-1] for row in [line.strip("| ").split(" | ")]}
    rows |= {row[0]: row for row in claims.values.tolist()}
    write_between(PAGE, "claims", [list(claims), *(rows[number] for number in sorted(rows, key=int))])
    if len(ranks):
        write_between(PAGE, "ranks", [list(ranks), *ranks.values.tolist()])
    if len(counted := counts(out)):
        counted.to_csv(COUNTS, index=False, float_format="%.9g")
    for figure in (out / f"paper_figure_{name}.png" for name in ("all", "5", "6")):
        if figure.exists():
            shutil.copy(figure, ROOT / "docs/figures")


def main() -> None:
    arguments = _read_arguments()
    driver, out = driver_of(arguments), arguments.out
    for part in arguments.only:
        PARTS[part](driver)
    plot.use_style()
    report = Report("The paper, measured again", out)
    report.text(shared_cores(max(RANKS)))
    claims = claim_table(out)
    for caption, rows in (("What the paper says", claims), ("Table 1: by processes", rank_table(out)),
                          ("Figure 5: its settings", grid_table(out))):  # fmt: skip
        report.table(caption, rows, is_shown=True)
    for name in draw_all(out):
        report.picture(name, CAPTIONS[name])
    report.write(out / "snapshots/run.txt")
    if arguments.page:
        write_page(out, claims)


def _read_arguments() -> argparse.Namespace:
    parser = options("paper", __doc__, "a small run of everything", "comparisons/paper")
    usual = [part for part in PARTS if part != "grid"]
    parser.add_argument("--only", type=_parts, default=usual, metavar="LIST",
                        help=f"what to measure, by commas: {', '.join(PARTS)}; all but grid. The rest is read from"
                        " the folder.")  # fmt: skip
    parser.add_argument("--page", action="store_true", help="write docs/design/paper.md, its counts and figures")
    return parser.parse_args()


def _parts(text: str) -> list[str]:
    parts = [part.strip() for part in text.split(",") if part.strip()]
    if unknown := [part for part in parts if part not in PARTS]:
        raise argparse.ArgumentTypeError(f"unknown {unknown[0]!r}; choose from {', '.join(PARTS)}")
    return parts


if __name__ == "__main__":
    main()
