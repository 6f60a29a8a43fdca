"""Errors of problems with exact answers against instructions: accuracy.py PROGRAM PICTURE [--quick]

PROGRAM is rrcb_mpm. --quick takes the coarsest cells and largest Courant number of the last problem."""

from __future__ import annotations

import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter

from exact_problems import PROBLEMS, Problem
from instructions import call, count
from vtk_files import history_of

FUNCTIONS = ("linear", "quadratic")
COURANT_NUMBERS = (0.4, 0.1)
# Instructions are counted in 50 steps, after which points are sorted again, or in fewer steps if there are many points.
STEPS_COUNTED, POINT_STEPS_COUNTED = 50, 300_000
OUTPUT = "  output:\n    history_every: 1\n    vtk_every: 1000000000\n"
BALANCERS = ("none", "rrcb", "rrcb-exact")
RANKS = 4
STEPS_BETWEEN = 50  # steps between rebalances


@dataclass(frozen=True)
class Result:
    function: str
    cell: float
    courant_number: float
    error: float
    instructions: float  # in all steps


@dataclass(frozen=True)
class Balance:
    name: str
    error: float
    difference: float  # of the energy from that with one rank
    imbalance: float
    busiest: float  # instructions in steps, on the busiest rank
    rebalances: float  # instructions in rebalances, on the busiest rank


def steps_in(printed: str) -> tuple[int, int]:
    """Returns the numbers of points and steps of a run."""
    found = re.search(r"(\d+) points, (\d+) steps", printed)
    return int(found[1]), int(found[2])


def solve(program: str, problem: Problem, function: str, cell: float, courant: float) -> Result:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = folder / "scene.yaml"
        scene.write_text(problem.scene(cell, function, courant, OUTPUT))
        command = [program, f"--scene={scene}", "--balancer=none", f"--out={folder / 'out'}"]
        points, steps = steps_in(call(command))
        error = problem.error_of(folder / "out")
        counted = min(STEPS_COUNTED, POINT_STEPS_COUNTED // points)
        end = counted * history_of(folder / "out")["dt"][0]
        command += [f"--end-time={end}", "--vtk-every=0"]
        counts, printed = count(command, "mpm::Simulation::step()", folder)
        each = sum(counts) / np.prod(steps_in(printed))
        return Result(function, cell, courant, error, each * points * steps)


def balance(program: str, problem: Problem, balancer: str, energy: float | None) -> Balance:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = folder / "scene.yaml"
        scene.write_text(
            problem.scene(problem.cells[-1], "linear", COURANT_NUMBERS[0], OUTPUT)
        )
        command = [
            program, f"--scene={scene}", f"--balancer={balancer}", f"--every={STEPS_BETWEEN}",
            f"--out={folder / 'out'}",
        ]  # fmt: skip
        call(command, RANKS)
        history = history_of(folder / "out")
        end = history["kinetic_energy"][-1] + history["strain_energy"][-1]
        error = problem.error_of(folder / "out")
        steps, rebalances = (
            max(count([*command, "--vtk-every=0"], f"mpm::Simulation::{function}*", folder, RANKS)[0])
            for function in ("step", "rebalance")
        )
        difference = abs(end / energy - 1)
        return Balance(
            balancer, error, difference, history["imbalance"][1:].mean(), steps, rebalances
        )


def energy_of_one_rank(program: str, problem: Problem) -> float:
    with tempfile.TemporaryDirectory() as name:
        scene = Path(name) / "scene.yaml"
        scene.write_text(problem.scene(problem.cells[-1], "linear", COURANT_NUMBERS[0], OUTPUT))
        call([program, f"--scene={scene}", "--balancer=none", f"--out={name}"])
        history = history_of(Path(name))
        return history["kinetic_energy"][-1] + history["strain_energy"][-1]


def print_results(problem: Problem, results: list[Result]) -> None:
    for result in results:
        print(
            f"| {problem.name} | {problem.measure} | {result.function} | {result.cell:g} | "
            f"{result.courant_number:g} | {100 * result.error:.2g} % | "
            f"{result.instructions / 1e6:.3g} |",
            flush=True,
        )


def print_balances(balances: list[Balance]) -> None:
    print(
        "\n| balancer | error | energy differs from one rank's by | imbalance | "
        "million instructions of the busiest rank: steps | rebalances |\n|---|---|---|---|---|---|"
    )
    for row in balances:
        print(
            f"| {row.name} | {100 * row.error:.3f} % | {row.difference:.0e} | {row.imbalance:.3f} | "
            f"{row.busiest / 1e6:.1f} | {row.rebalances / 1e6:.3f} |"
        )


def draw_problem(axes: Axes, problem: Problem, results: list[Result]) -> None:
    for function, colour in zip(FUNCTIONS, ("C0", "C1")):
        for courant, marker in zip(COURANT_NUMBERS, "os"):
            row = [r for r in results if r.function == function and r.courant_number == courant]
            axes.loglog(
                [r.instructions for r in row], [100 * r.error for r in row], "-" + marker,
                ms=5, lw=1, color=colour, mfc=colour if marker == "o" else "white",
                label=f"{function}, Courant number {courant:g}",
            )  # fmt: skip
    axes.set_title(f"{problem.name}: {problem.measure}", fontsize=9)
    axes.set_xlabel("instructions [-]", fontsize=8)
    axes.set_ylabel("error [%]", fontsize=8)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())


def draw_balances(axes: Axes, balances: list[Balance]) -> None:
    names = [row.name for row in balances]
    steps = np.array([row.busiest for row in balances]) / 1e6
    axes.barh(names, steps, color="C7", label="steps")
    rebalances = [row.rebalances / 1e6 for row in balances]
    axes.barh(names, rebalances, left=steps, color="C3", label="rebalances")
    axes.set_xlim(right=1.45 * steps.max())
    for at, row in enumerate(balances):
        text = f" error {100 * row.error:.3f} %"
        axes.text(steps[at] + rebalances[at], at, text, va="center", fontsize=7)
    axes.set_ylim(len(names), -0.6)
    axes.set_title(f"disks on {RANKS} ranks, by balancer", fontsize=9)
    axes.set_xlabel("instructions of the busiest rank [million]", fontsize=8)
    axes.legend(fontsize=7, loc="lower right", ncols=2, frameon=False)


def draw(
    results: dict[Problem, list[Result]], balances: list[Balance], picture: Path
) -> None:
    figure, panels = plt.subplots(2, 3, figsize=(10, 6), layout="constrained")
    for axes, (problem, rows) in zip(panels.flat, results.items()):
        draw_problem(axes, problem, rows)
        axes.grid(lw=0.3)
    panels.flat[-1].set_visible(bool(balances))
    if balances:
        draw_balances(panels.flat[-1], balances)
    for axes in panels.flat:
        axes.tick_params(labelsize=7)
    lines = panels.flat[0].get_legend_handles_labels()
    figure.legend(
        *lines, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=4, fontsize=8, frameon=False
    )
    figure.savefig(
        picture, dpi=130, bbox_inches="tight", pad_inches=0.05, metadata={"Software": None}
    )
    plt.close(figure)


def main(program: str, picture: Path, is_quick: bool) -> None:
    print("| problem | error of | functions | cell [m] | Courant number | error | "
          "million instructions |\n|---|---|---|---|---|---|---|")  # fmt: skip
    results = {}
    for problem in PROBLEMS[-1:] if is_quick else PROBLEMS:
        results[problem] = [
            solve(program, problem, function, cell, courant)
            for function in FUNCTIONS
            for courant in (COURANT_NUMBERS[:1] if is_quick else COURANT_NUMBERS)
            for cell in (problem.cells[:1] if is_quick else problem.cells)
        ]
        print_results(problem, results[problem])
    balances = []
    if not is_quick:
        energy = energy_of_one_rank(program, PROBLEMS[-1])
        balances = [balance(program, PROBLEMS[-1], name, energy) for name in BALANCERS]
        print_balances(balances)
    draw(results, balances, picture)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("accuracy.py PROGRAM PICTURE [--quick]")
    main(sys.argv[1], Path(sys.argv[2]), "--quick" in sys.argv)
