"""Starts programs under mpirun and finds Debian packages."""

from __future__ import annotations

import os
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
HOSTS = ROOT / "build" / "hosts"  # what is not of Debian
TIMEOUT_SECONDS = 600
MPIRUN = ("mpirun --oversubscribe --allow-run-as-root --bind-to none"
          " --mca mpi_yield_when_idle 1").split()


def query(package: str, field: str) -> str:
    """Empty if there is no such package, or no dpkg."""
    command = ["dpkg-query", "-W", f"-f=${{{field}}}", package]
    try:
        return subprocess.run(command, capture_output=True, text=True).stdout
    except FileNotFoundError:
        return ""


def installed(package: str) -> bool:
    return query(package, "Status") == "install ok installed"


def version_of(package: str) -> str:
    return query(package, "Version")


def first_failure(steps: list[list]) -> str:
    """Runs commands until one fails, of which it returns the last line."""
    for step in steps:
        done = subprocess.run(list(map(str, step)), capture_output=True, text=True,
                              stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            lines = (done.stderr or done.stdout).strip().split("\n")
            return f"{Path(step[0]).name}: {lines[-1]}"
    return ""


def run(ranks: int, command: list, variables: dict, folder: Path,
        mpirun: list = MPIRUN) -> tuple[float, str, int]:
    """Seconds of the whole program, its output and its code."""
    # Threads of BLAS would take the cores from other ranks.
    words = [f"{name}={value}" for name, value in {"OMP_NUM_THREADS": 1, **variables}.items()]
    start = time.monotonic()
    process = subprocess.Popen([*map(str, mpirun), "-n", str(ranks), "env", *words,
                                *map(str, command)],
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, cwd=folder,
                               stderr=subprocess.STDOUT, text=True, errors="replace",
                               env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
    try:
        output, _ = process.communicate(timeout=TIMEOUT_SECONDS)
    except subprocess.TimeoutExpired:
        # mpirun ends its ranks if it is asked to end.
        process.terminate()
        output = process.communicate()[0] + f"\ntakes longer than {TIMEOUT_SECONDS} s"
    return time.monotonic() - start, output, process.returncode
