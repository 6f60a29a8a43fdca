"""Compares errors of problems with exact solutions with the work and the time that they cost.

    accuracy.py PROGRAM PICTURE [--quick]

PROGRAM is rrcb_mpm. Each problem is solved at rest and flying, with 2 and 4 points along a cell: the
differences between these four are luck. Work is counted in points times steps, which is exact. Time is
work times the processor time of a point in a step, which the longest run of each shape function gives.
--quick takes the coarsest cells of the last problem, at rest, with 2 points."""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter

from exact_problems import PROBLEMS, Problem

FUNCTIONS = ("linear", "quadratic")
POINTS = (2, 4)  # along a cell
STYLES = {2: "-o", 4: "--s"}
# A process alone starts ten times as fast if Open MPI looks for no other.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OMPI_MCA_pml": "ob1"}


@dataclass(frozen=True)
class Result:
    function: str
    cell: float
    points: int
    errors: tuple[float, ...]  # at rest, and flying
    point_steps: int
    seconds: float  # of processor time, start and output included


Results = dict[Problem, list[Result]]
Rates = dict[tuple[str, int], float]  # seconds of a point-step, of a function and points


def call(command: list[str]) -> str:
    """Runs a command and returns its output."""
    done = subprocess.run(
        command, capture_output=True, text=True, env={**os.environ, **ALONE}, stdin=subprocess.DEVNULL
    )
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def run(program: str, problem: Problem, cell: float, points: int, flies: bool, function: str,
        ) -> tuple[float, int, float]:  # fmt: skip
    """Returns the error of a run, its point-steps and its seconds of processor time."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = folder / "scene.yaml"
        scene.write_text(problem.scene(cell, points, flies, function))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        printed = call([program, f"--scene={scene}", "--balancer=none", f"--out={folder / 'out'}"])
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        found = re.search(r"(\d+) points, (\d+) steps", printed)
        return problem.error_of(folder / "out"), int(found[1]) * int(found[2]), seconds


def solve(program: str, problem: Problem, is_quick: bool) -> list[Result]:
    results = []
    for function in FUNCTIONS:
        for points in POINTS[:1] if is_quick else POINTS:
            for cell in problem.cells[:1] if is_quick else problem.cells:
                flights = (False,) if is_quick else (False, True)
                runs = [run(program, problem, cell, points, flies, function) for flies in flights]
                _, point_steps, seconds = runs[0]
                errors = tuple(error for error, _, _ in runs)
                results.append(Result(function, cell, points, errors, point_steps, seconds))
                print_result(problem, results[-1])
    return results


def print_result(problem: Problem, result: Result) -> None:
    errors = " | ".join(f"{100 * error:.2g} %" for error in result.errors)
    print(
        f"| {problem.name} | {problem.measure} | {result.function} | {result.cell:g} | "
        f"{result.points} | {errors} | {result.point_steps / 1e6:.3g} |",
        flush=True,
    )


def rates_of(results: Results) -> Rates:
    longest: dict[tuple[str, int], Result] = {}
    for rows in results.values():
        for row in rows:
            key = (row.function, row.points)
            if key not in longest or row.point_steps > longest[key].point_steps:
                longest[key] = row
    return {key: row.seconds / row.point_steps for key, row in longest.items()}


def draw_problem(axes: Axes, results: list[Result], rates: Rates | None) -> None:
    """Draws a band for each shape function and number of points, between rest and flight. The
    horizontal axis is time if there are rates."""
    for function, colour in zip(FUNCTIONS, ("C0", "C1")):
        for points in POINTS:
            row = [r for r in results if r.function == function and r.points == points]
            if not row:
                continue
            work = np.array([r.point_steps for r in row]) * (rates[function, points] if rates else 1)
            errors = 100 * np.array([r.errors for r in row]).T
            for values, how, fill in ((errors[0], "at rest", colour), (errors[-1], "flying", "white")):
                axes.loglog(
                    work, values, STYLES[points], ms=4, lw=1, color=colour, mfc=fill,
                    label=f"{function}, {points} x {points} points, {how}",
                )  # fmt: skip
            axes.fill_between(
                work, errors.min(axis=0), errors.max(axis=0), color=colour, alpha=0.15, lw=0
            )
    axes.set_xlabel("time on one core [s]" if rates else "points times steps [-]", fontsize=8)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.tick_params(labelsize=7)
    axes.grid(lw=0.3)


def draw(results: Results, picture: Path) -> None:
    figure, grid = plt.subplots(
        2, len(results), figsize=(2.6 * len(results), 5.2), layout="constrained", squeeze=False
    )
    for (above, below), (problem, rows) in zip(grid.T, results.items()):
        draw_problem(above, rows, None)
        draw_problem(below, rows, rates_of(results))
        above.set_title(f"{problem.name}: {problem.measure}", fontsize=9)
    for axes in grid[:, 0]:
        axes.set_ylabel("error [%]", fontsize=8)
    figure.legend(
        *grid[0, 0].get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0), ncols=4,
        fontsize=8, frameon=False,
    )  # fmt: skip
    figure.savefig(
        picture, dpi=110, bbox_inches="tight", pad_inches=0.05, metadata={"Software": None}
    )
    plt.close(figure)


def main(program: str, picture: Path, is_quick: bool) -> None:
    print("| problem | error of | functions | cell [m] | points along a cell | error at rest | "
          "flying | million point-steps |\n|---|---|---|---|---|---|---|---|")  # fmt: skip
    problems = PROBLEMS[-1:] if is_quick else PROBLEMS
    results = {problem: solve(program, problem, is_quick) for problem in problems}
    for (function, points), seconds in rates_of(results).items():
        print(f"{function}, {points} x {points} points: {1e9 * seconds:.0f} ns of a point in a step")
    draw(results, picture)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("accuracy.py PROGRAM PICTURE [--quick]")
    main(sys.argv[1], Path(sys.argv[2]), "--quick" in sys.argv)
