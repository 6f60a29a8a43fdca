"""Accuracy against cost of the methods on problems with an analytic answer.

ladder.py PROGRAM SCENES OUT [--small] [--busy] [PROBLEM ...]

Runs each problem with each shape function and transfer, in ever smaller cells with few or more points,
and writes OUT/ladder.csv, OUT/ladder.md and a picture per problem: the error beside the point-steps
and the seconds it took. --small takes the largest cells only, --busy draws no seconds, which a busy
machine cannot tell."""

from __future__ import annotations

import csv
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from ladder_picture import COSTS, draw_all
from ladder_problems import PROBLEMS, Problem

# Shape function and transfer, and whether velocities are mapped back to the nodes (modified).
METHODS = [
    ("linear", "flip"),
    ("linear", "apic"),
    ("quadratic", "flip"),
    ("quadratic", "apic"),
    ("gimp", "flip"),
    ("linear", "flip modified"),
    ("quadratic", "flip modified"),
    ("gimp", "flip modified"),
]
POINTS_PER_CELL = [2, 3]  # along each axis
# A process alone starts ten times as fast if Open MPI looks for no other.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OMPI_MCA_pml": "ob1"}


@dataclass(frozen=True)
class Rung:
    problem: str
    shape_function: str
    transfer: str
    points_per_cell: int
    cell_size: float  # m
    error: float
    points: int
    steps: int
    seconds: float

    @property
    def point_steps(self) -> int:
        return self.points * self.steps


def with_method(text: str, shape_function: str, transfer: str, points_per_cell: int) -> str:
    """The scene with another method and number of points."""
    text = re.sub(r"^ *(shape_function|transfer|time_integration): .*\n", "", text, flags=re.MULTILINE)
    transfer, *is_modified = transfer.split()
    lines = ["  method:", f"    shape_function: {shape_function}", f"    transfer: {transfer}"]
    lines += ["    time_integration: modified"] if is_modified else []
    text = text.replace("  method:\n", "\n".join(lines) + "\n")
    count = f"points_per_cell: [{points_per_cell}, {points_per_cell}]"
    return re.sub(r"points_per_cell: \[.*\]", count, text)


def climb(program: str, text: str, problem: Problem, rung: tuple[str, str, int, float]) -> Rung:
    shape_function, transfer, points_per_cell, cell_size = rung
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = folder / "scene.yaml"
        scene.write_text(with_method(text, shape_function, transfer, points_per_cell))
        options = [f"--scene={scene}", f"--out={folder}", f"--cell-size={cell_size}"]
        # Of the points, the first and the last state.
        options += ["--balancer=none", "--vtk-every=1000000000"]
        environment = {**os.environ, **ALONE}
        done = subprocess.run(
            [program, *options], capture_output=True, text=True, env=environment
        )
        found = re.search(r"(\d+) points, (\d+) steps to .* s in ([\d.e-]+) s", done.stdout)
        if done.returncode != 0 or not found:
            sys.exit(f"{problem.name}, {rung}: {done.stderr}")
        error = problem.error(folder)
        return Rung(problem.name, *rung, error, int(found[1]), int(found[2]), float(found[3]))


def markdown(rungs: list[Rung]) -> str:
    lines = [
        "| problem | shape function | transfer | points per axis | cell, m | error | point-steps | s |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for r in rungs:
        lines.append(
            f"| {r.problem} | {r.shape_function} | {r.transfer} | {r.points_per_cell} | {r.cell_size:g}"
            f" | {r.error:.2e} | {r.point_steps} | {r.seconds:.3g} |"
        )
    return "\n".join(lines) + "\n"


def write_table(rungs: list[Rung], path: Path) -> None:
    with path.open("w", newline="") as file:
        names = [field.name for field in fields(Rung)]
        writer = csv.DictWriter(file, [*names, "point_steps"], lineterminator="\n")
        writer.writeheader()
        writer.writerows({**asdict(rung), "point_steps": rung.point_steps} for rung in rungs)


def main(program: str, scenes: Path, out: Path, names: list[str], options: list[str]) -> None:
    small, busy = "--small" in options, "--busy" in options
    out.mkdir(parents=True, exist_ok=True)
    rungs = []
    for problem in (PROBLEMS[name] for name in names):
        text = (scenes / f"{problem.name}.yaml").read_text()
        for method in METHODS:
            for count in POINTS_PER_CELL[: 1 if small else None]:
                for cell_size in problem.cell_sizes[: 1 if small else None]:
                    rungs.append(climb(program, text, problem, (*method, count, cell_size)))
                    print(markdown(rungs[-1:]).splitlines()[-1], flush=True)
    write_table(rungs, out / "ladder.csv")
    (out / "ladder.md").write_text(markdown(rungs))
    draw_all(rungs, out, [cost for cost in COSTS if cost != "seconds" or not busy])
    print(f"Tables: {out / 'ladder.csv'} {out / 'ladder.md'}")


if __name__ == "__main__":
    options = [word for word in sys.argv[1:] if word in ("--small", "--busy")]
    words = [word for word in sys.argv[1:] if word not in options]
    unknown = [name for name in words[3:] if name not in PROBLEMS]
    if len(words) < 3 or unknown:
        sys.exit(f"ladder.py PROGRAM SCENES OUT [--small] [--busy] [{'|'.join(PROBLEMS)} ...]")
    program, scenes, out = words[:3]
    main(program, Path(scenes), Path(out), words[3:] or list(PROBLEMS), options)
