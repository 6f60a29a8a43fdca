"""Counts the instructions of a program's functions with Callgrind."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

# A single process starts ten times as fast if Open MPI does not look for others.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OMPI_MCA_pml": "ob1"}
TOGETHER = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
}
# Waiting for messages is a busy loop, whose instructions depend on the machine. Only these objects count.
OURS = re.compile(r"rrcb|libm[.-]|libstdc")


def call(command: list[str], ranks: int = 1) -> str:
    """Runs a command and returns what it has printed."""
    if ranks > 1:
        command = ["mpirun", "-n", str(ranks), *command]
    environment = {**os.environ, **(ALONE if ranks == 1 else TOGETHER)}
    done = subprocess.run(
        command, capture_output=True, text=True, env=environment, stdin=subprocess.DEVNULL
    )
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def own_instructions(path: Path) -> int:
    """Returns the instructions of the program and its libraries without MPI, from a file of
    Callgrind."""
    names: dict[str, str] = {}
    total, is_ours, is_call = 0, False, False
    for line in path.read_text().splitlines():
        named = re.match(r"c?ob=(\(\d+\))(?: (.*))?", line)
        if named:
            name = names.setdefault(named[1], named[2])
            if line.startswith("ob="):
                is_ours = OURS.search(Path(name).name) is not None
        elif line.startswith("calls="):
            is_call = True
        elif re.match(r"[-+*\d]", line):
            # The line after a call contains the cost of the callee.
            total += 0 if is_call or not is_ours else int(line.split()[1])
            is_call = False
    return total


def count(command: list[str], function: str, folder: Path, ranks: int = 1) -> tuple[list[int], str]:
    """Returns the instructions within a function on each rank, and the output of the command."""
    tool = [
        "valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/callgrind.%p",
        "--collect-atstart=no", f"--toggle-collect={function}",
    ]  # fmt: skip
    printed = call([*tool, *command], ranks)
    files = sorted(folder.glob("callgrind.*"))
    counts = [own_instructions(file) for file in files]
    for file in files:
        file.unlink()
    return counts, printed
