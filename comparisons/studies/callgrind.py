"""Counts the instructions of a program's own functions with Callgrind, separately for each call of a function."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

from driver import launcher

# Waiting for messages is a busy loop, so the instructions of MPI and of WAITS depend on the machine and are left out.
# Those of libraries count for the program's functions that call them.
OURS = re.compile(r"^rrcb_")
HELPERS = re.compile(r"^(libc|libm|libstdc\+\+|libgcc_s|ld-linux.*)[.-]")
WAITS = re.compile(r"^rrcb::(wait_watched|pause|Deadline::|mpi::Watch::)|^rrcb::NeighbourExchange::(run|receive|look_for)"
                   r"|steady_clock::now|nanosleep|clock_gettime")  # fmt: skip
BELOW = "(below main)"  # calls main; counts the rest
# Callgrind counts one instruction for each byte that `rep movsb` moves, so these settings avoid it. They also bind
# symbols before the first call.
EVEN = {
    "GLIBC_TUNABLES": "glibc.cpu.x86_rep_movsb_threshold=1000000000:glibc.cpu.x86_rep_stosb_threshold=1000000000",
    "LD_BIND_NOW": "1",
}


def is_here() -> bool:
    return shutil.which("valgrind") is not None


def run(command: list[str], ranks: int, function: str, folder: Path) -> tuple[str, list[list[Path]]]:
    """Returns what the command printed, and for each rank a file of every call of the function."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("calls.*"):
        old.unlink()
    tool = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/calls.%p", "--collect-atstart=no",
            f"--toggle-collect={function}", f"--dump-after={function}"]  # fmt: skip
    done = subprocess.run([*launcher(), "-n", str(ranks), *tool, *command], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, env={**os.environ, **EVEN})  # fmt: skip
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    files: dict[int, list[tuple[int, Path]]] = {}
    for path in folder.glob("calls.*.*"):
        _, process, part = path.name.split(".")
        files.setdefault(int(process), []).append((int(part), path))
    return done.stdout, [[path for _, path in sorted(parts)] for _, parts in sorted(files.items())]  # mpirun starts them in order


def own_instructions(path: Path) -> Counter[str]:
    """Returns the instructions in a file by function of the program. A library function counts for its caller."""
    names: dict[tuple[str, str], str] = {}
    found: Counter[str] = Counter()
    now = {"ob": "", "fn": "", "cob": "", "cfn": ""}
    is_call = False
    for line in path.read_text().splitlines():
        if named := re.match(r"(ob|fn|cob|cfn)=(\(\d+\))(?: (.*))?$", line):
            field, number, name = named.groups()
            kind = field.lstrip("c")
            now[field] = names.setdefault((kind, number), name or "")
            if field == "ob":
                now["cob"] = now["ob"]
        elif line.startswith("calls="):
            is_call = True
        elif re.match(r"[-+*\d]", line):
            cost = int(line.split()[1])
            name = _counted_as(now, is_call)
            if name and not WAITS.search(name):
                found[name] += cost
            if is_call:
                now["cob"] = now["ob"]
            is_call = False
    return found


def short(function: str) -> str:
    """Returns the name without templates, parameters and unnamed namespaces."""
    name = function.replace("(anonymous namespace)::", "").replace("operator()", "call")
    while (shorter := re.sub(r"<[^<>]*>", "", name)) != name:
        name = shorter
    return name.split("(")[0].split(" ")[-1]


def _counted_as(now: dict[str, str], is_call: bool) -> str:
    """Returns the function that a cost counts for, or an empty text for MPI and for the callers of the program's
    functions."""
    # The layer that counts messages shadows functions of MPI.
    if not OURS.match(Path(now["ob"]).name) or now["fn"].startswith("MPI_"):
        return ""
    if not is_call:
        return now["fn"]
    is_helper = HELPERS.match(Path(now["cob"]).name) and now["fn"] != BELOW
    return now["cfn"] if is_helper else ""
