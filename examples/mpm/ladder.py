"""Accuracy against cost of the methods on the axial bar: ladder.py PROGRAM SCENE [CELL_SIZE ...]

Runs the bar with each shape function and transfer in ever smaller cells, and prints the error of
its mean velocity (root of the mean square over a period, by the amplitude) beside the number of
point-steps and the seconds, as a Markdown table."""

from __future__ import annotations

import csv
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

METHODS = [
    ("linear", "flip"),
    ("linear", "apic"),
    ("quadratic", "flip"),
    ("quadratic", "apic"),
    ("gimp", "flip"),
]
CELL_SIZES = [2, 1, 0.5, 0.25]
AMPLITUDE, OMEGA = 0.2 / math.pi, 0.2 * math.pi


def error_of(history: Path) -> float:
    with open(history, newline="") as file:
        rows = list(csv.DictReader(file))
    squares = []
    for row in rows:
        velocity = float(row["momentum_x"]) / float(row["mass"])
        squares.append((velocity - AMPLITUDE * math.cos(OMEGA * float(row["time"]))) ** 2)
    return math.sqrt(sum(squares) / len(squares)) / AMPLITUDE


def run(program: str, scene: str, method: tuple[str, str], cell_size: float) -> str:
    shape, transfer = method
    text = Path(scene).read_text().replace("shape_function: linear", f"shape_function: {shape}")
    text = text.replace("transfer: flip", f"transfer: {transfer}")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bar.yaml"
        file.write_text(text)
        options = [f"--scene={file}", f"--out={folder}", f"--cell-size={cell_size}"]
        done = subprocess.run(
            [program, "--balancer=none", *options], check=True, capture_output=True, text=True
        )
        found = re.search(r"(\d+) points, (\d+) steps to .* s in ([\d.]+) s", done.stdout)
        points, steps, seconds = int(found[1]), int(found[2]), float(found[3])
        error = error_of(Path(folder) / "history.csv")
    return f"| {shape} | {transfer} | {cell_size} | {error:.2e} | {points * steps} | {seconds:.2f} |"


def main(program: str, scene: str, cell_sizes: list[float]) -> None:
    print("| shape function | transfer | cell, m | error | point-steps | seconds |")
    print("|---|---|---|---|---|---|")
    for method in METHODS:
        for cell_size in cell_sizes:
            print(run(program, scene, method, cell_size), flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("ladder.py PROGRAM SCENE [CELL_SIZE ...]")
    main(*sys.argv[1:3], [float(size) for size in sys.argv[3:]] or CELL_SIZES)
