"""PETSc's particles, with and without RRCB, and VTK, which reads the boxes of a balance."""

from __future__ import annotations

import re
from pathlib import Path

from programs import BUILD, ROOT, run
from result import Case, Failed, Result

FOLDER = Path(__file__).parent
PACKAGE = {"RRCB_LIBRARY": BUILD / "src" / "librrcb.so", "PYTHONPATH": ROOT / "python"}


def result_of(ranks: int, command: list, folder: Path) -> tuple[float, str]:
    seconds, output, code = run(ranks, ["/usr/bin/python3", *command], PACKAGE, folder)
    result = re.search(r"^result (.*)$", output, re.MULTILINE)
    if code != 0 or result is None:
        raise Failed(output.strip().split("\n")[-1])
    return seconds, result[1]


def launch_petsc(ranks: int, with_rrcb: bool, folder: Path) -> Result:
    method = "rrcb" if with_rrcb else "cells"
    _, words = result_of(ranks, [FOLDER / "dmswarm.py", method], folder)
    seconds, balancing, moved, ghosts, uneven, *sums = map(float, words.split())
    answer = {f"sum {i}": value for i, value in enumerate(sums)} | {"imbalance": uneven}
    return Result(seconds, balancing, moved, ghosts, answer)


def compare_petsc(plain: Result, rrcb: Result) -> str:
    for name, value in plain.answer.items():
        if name != "imbalance" and not abs(rrcb.answer[name] - value) <= 1e-9 * abs(value):
            raise Failed(f"{name} is {rrcb.answer[name]} instead of {value}")
    imbalances = [run.answer["imbalance"] for run in (plain, rrcb)]
    return "same positions; imbalance {:.2f}, {:.2f}".format(*imbalances)


def launch_vtk(ranks: int, with_rrcb: bool, folder: Path) -> Result:
    """There is no plain run: VTK reads what RRCB made."""
    seconds, text = result_of(1, [FOLDER / "vtk_boxes.py", folder / "boxes.vtk"], folder)
    return Result(seconds, answer={text: 1})


PYTHON_CASES = [
    Case("petsc", "PETSc's DMSwarm, a circling cluster", ["python3-petsc4py-real",
                                                          "python3-mpi4py"],
         ["rrcb_shared"], launch_petsc, compare_petsc),
    Case("vtk", "VTK", ["python3-vtk9", "python3-mpi4py"], ["rrcb_shared"], launch_vtk,
         lambda plain, rrcb: list(rrcb.answer)[0]),
]
