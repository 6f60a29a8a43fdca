"""Runs the comparison driver, rrcb_compare, for the studies."""

from __future__ import annotations

import subprocess
import sys
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMPARE = ROOT / "build/release/comparisons/rrcb_compare"


@cache
def _launcher() -> list[str]:
    version = subprocess.run(["mpirun", "--version"], capture_output=True, text=True).stdout
    flags = ["--quiet", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none"]
    return ["mpirun", *(flags if "Open MPI" in version else [])]


class Driver:
    """Calls of one build of the driver, each into a folder of its own below `out`."""

    def __init__(self, out: Path, program: Path = COMPARE, quick: bool = False) -> None:
        self.out, self.program, self.quick = out, program, quick

    def run(self, name: str, ranks: int, methods: list[str], *arguments: str) -> Path:
        """Returns the folder of the results. Ends the program if the driver fails."""
        print(f"Running {name} on {ranks} ranks", file=sys.stderr, flush=True)
        folder = self.out / name
        command = [*_launcher(), "-n", str(ranks), str(self.program), f"--out={folder}"]
        command += [f"--methods={','.join(methods)}", *arguments] + ["--quick"] * self.quick
        found = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if found.returncode:
            sys.exit(f"{' '.join(command)}\n{found.stdout}{found.stderr}")
        return folder
