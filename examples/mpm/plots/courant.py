"""Largest stable Courant numbers of the methods: courant.py PROGRAM SCENE

Runs a vibrating elastic body with each shape function and transfer, and 2 or 3 points along a side of
a cell, in two sizes of cells, at ever larger Courant numbers. A run is stable if it ends and its
kinetic and strain energy never exceed those of the start by 5 %. Prints a table of the last number
before the first unstable one."""

from __future__ import annotations

import csv
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from ladder import ALONE, METHODS, POINTS_PER_CELL, with_method

NUMBERS = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
MOST_GAIN = 1.05
CELL_SIZES = [0.25, 0.5]
END_TIME = 1.0


def with_courant_number(text: str, number: float) -> str:
    text = re.sub(r"^ *courant_number: .*\n", "", text, flags=re.MULTILINE)
    return text.replace("  method:\n", f"  method:\n    courant_number: {number}\n")


def is_stable(program: str, text: str, cell_size: float) -> bool:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = folder / "scene.yaml"
        scene.write_text(text)
        command = [program, f"--scene={scene}", "--balancer=none", f"--out={folder}"]
        command += [f"--cell-size={cell_size}", f"--end-time={END_TIME}"]
        done = subprocess.run(command, capture_output=True, env={**os.environ, **ALONE})
        if done.returncode != 0:
            return False
        with open(folder / "history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
    energies = [float(row["kinetic_energy"]) + float(row["strain_energy"]) for row in rows]
    return all(energy <= MOST_GAIN * energies[0] for energy in energies)


def largest_stable(program: str, text: str) -> float:
    """The last number before the first unstable one; 0 where none is stable."""
    largest = 0.0
    for number in NUMBERS:
        changed = with_courant_number(text, number)
        if not all(is_stable(program, changed, cell_size) for cell_size in CELL_SIZES):
            break
        largest = number
    return largest


def main(program: str, path: Path) -> None:
    text = path.read_text()
    heads = [f"{count} points along a side" for count in POINTS_PER_CELL]
    print("| shape function | transfer |", " | ".join(heads), "|")
    print("|---|---|" + "---|" * len(heads))
    for shape_function, transfer in METHODS:
        found = [
            largest_stable(program, with_method(text, shape_function, transfer, count))
            for count in POINTS_PER_CELL
        ]
        row = " | ".join(f"{number:g}" for number in found)
        print(f"| {shape_function} | {transfer} | {row} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("courant.py PROGRAM SCENE")
    main(sys.argv[1], Path(sys.argv[2]))
