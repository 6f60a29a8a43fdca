"""What effects and materials that a scene does not name cost it.

compare.py PROGRAMS SCENES [--bits-only] [SCENE ...]

PROGRAMS is the folder of mpm_with_all and mpm_with_<scene>, SCENES that of the scene files. Runs
each scene in the program that has everything and in the one that has what the scene names. All bits
of all columns must be the same, and the instructions of the steps, counted by Valgrind, within 0.1 %;
--bits-only leaves Valgrind out.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

CELL_SIZES = {
    "slope": 5,
    "submarine_slide": 2.5,
    "torpedo_anchor": 0.375,
    "elastic_structure": 0.25,
    "axial_bar": 0.5,
}
STEPS = 40
MOST_DIFFERENCE = 1e-3
# A process alone starts ten times as fast if Open MPI looks for no other.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OMPI_MCA_pml": "ob1"}


@dataclass
class Run:
    instructions: int
    points: int
    kinds: list[str]
    bits: bytes


def callgrind(folder: Path) -> list[str]:
    return [
        "valgrind",
        "--tool=callgrind",
        f"--callgrind-out-file={folder / 'callgrind'}",
        "--collect-atstart=no",
        "--toggle-collect=mpm::Simulation::step()",
    ]


def run(program: Path, scene: Path, counts: bool) -> Run:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bits = folder / "bits"
        command = [program, scene, str(CELL_SIZES[scene.stem]), str(STEPS), bits]
        if counts:
            command = callgrind(folder) + command
        environment = {**os.environ, **ALONE}
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        found = re.search(r"Collected : (\d+)", done.stderr) if counts else ["", "0"]
        if done.returncode != 0 or not found:
            sys.exit(f"{program} failed:\n{done.stderr}")
        points = re.search(r"^points (\d+)$", done.stdout, re.MULTILINE)
        kinds = re.search(r"^has (.*)$", done.stdout, re.MULTILINE)
        return Run(int(found[1]), int(points[1]), kinds[1].split(), bits.read_bytes())


def compare(programs: Path, scene: Path, counts: bool) -> bool:
    full = run(programs / "mpm_with_all", scene, counts)
    bare = run(programs / f"mpm_with_{scene.stem}", scene, counts)
    absent = len(set(full.kinds) - set(bare.kinds))
    same = full.bits == bare.bits
    row = f"| {scene.stem} | {full.points} | {absent} | {'same' if same else 'DIFFERENT'} |"
    if counts:
        difference = full.instructions / bare.instructions - 1
        same = same and abs(difference) <= MOST_DIFFERENCE
        each = [run.instructions / (run.points * STEPS) for run in (bare, full)]
        row += f" {each[0]:.1f} | {each[1]:.1f} | {100 * difference:.4f} % |"
    print(row, flush=True)
    return same and absent > 0


def main(programs: Path, scenes: Path, names: list[str], counts: bool) -> int:
    unknown = [name for name in names if name not in CELL_SIZES]
    if unknown:
        sys.exit(f"no such scene: {unknown[0]}; choose from: {', '.join(CELL_SIZES)}")
    print("Programs with what the scene names, and with all. Instructions: per point and step.")
    header = "| scene | points | not named | bits |" + " named | all | difference |" * counts
    print(header, "|" + "---|" * (header.count("|") - 1), sep="\n")
    results = [compare(programs, scenes / f"{name}.yaml", counts) for name in names]
    return 0 if all(results) else 1


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("compare.py PROGRAMS SCENES [--bits-only] [SCENE ...]")
    names = [name for name in sys.argv[3:] if name != "--bits-only"] or list(CELL_SIZES)
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2]), names, "--bits-only" not in sys.argv))
