"""The options that all studies have, and the programs that they build and run, above all rrcb_compare."""

from __future__ import annotations

import argparse
import subprocess
import sys
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "comparisons/out"
PROGRAMS = ROOT / "build/release/comparisons"
COMPARE = PROGRAMS / "rrcb_compare"


def build(*targets: str, multijagged: bool = False) -> None:
    """Builds targets. Ends the program if that fails. Zoltan2 takes a minute to compile; continues without it if it
    cannot be installed."""
    if multijagged and subprocess.run([ROOT / "tools/set_up", "--for", "multijagged"]).returncode:
        print("Going on without Zoltan2, so without zoltan2-mj.", file=sys.stderr)
    option = f"-DRRCB_MULTIJAGGED={'ON' if multijagged else 'OFF'}"
    if subprocess.run([ROOT / "tools/build", option, *targets]).returncode:
        sys.exit(1)


def has_multijagged(program: Path = COMPARE) -> bool:
    text = subprocess.run([program, "--help"], capture_output=True, text=True).stdout
    return "zoltan2-mj" in text


@cache
def launcher() -> list[str]:
    version = subprocess.run(["mpirun", "--version"], capture_output=True, text=True).stdout
    flags = ["--mca", "orte_execute_quiet", "1", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none"]
    return ["mpirun", *(flags if "Open MPI" in version else [])]


def on_ranks(ranks: int, program: Path, *arguments: str, **how) -> subprocess.CompletedProcess:
    command = [*launcher(), "-n", str(ranks), str(program), *arguments]
    return subprocess.run(command, stdin=subprocess.DEVNULL, **how)


def options(study: str, text: str, quick: str = "", command: str = "") -> argparse.ArgumentParser:
    """Returns a parser of the options that all studies have. Without a text on it there is no --quick."""
    parser = argparse.ArgumentParser(prog=command or f"comparisons/studies/run {study}", description=text,
                                     formatter_class=argparse.RawTextHelpFormatter)  # fmt: skip
    parser.add_argument("--out", type=Path, default=OUT / study, help=f"folder of the results; comparisons/out/{study}")
    parser.add_argument("--driver", type=Path, help="a program in the folder of those to run, which are not built then")
    if quick:
        parser.add_argument("--quick", action="store_true", help=quick)
    return parser


def prepare(given: argparse.Namespace, *targets: str, multijagged: bool = False) -> Path:
    """Makes the folder of the results, and builds the programs unless --driver is given. Returns the first program."""
    given.out.mkdir(parents=True, exist_ok=True)
    if given.driver:
        return given.driver.with_name(targets[0])
    build(*targets, multijagged=multijagged)
    return PROGRAMS / targets[0]


class Driver:
    """Runs one build of the driver. Each run has its own folder below `out`."""

    def __init__(self, out: Path, program: Path = COMPARE, quick: bool = False) -> None:
        self.out, self.program, self.quick = out, program, quick

    def run(self, name: str, ranks: int, methods: list[str], *arguments: str) -> Path:
        """Returns the folder of the results. Ends the program if the driver fails."""
        print(f"Running {name} on {ranks} ranks", file=sys.stderr, flush=True)
        words = [f"--out={self.out / name}", f"--methods={','.join(methods)}", *arguments]
        words += ["--quick"] * self.quick
        found = on_ranks(ranks, self.program, *words, capture_output=True, text=True)
        if found.returncode:
            sys.exit(f"rrcb_compare {' '.join(words)}\n{found.stdout}{found.stderr}")
        return self.out / name


def driver_of(given: argparse.Namespace, *targets: str, multijagged: bool = False) -> Driver:
    program = prepare(given, COMPARE.name, *targets, multijagged=multijagged)
    return Driver(given.out, program, given.quick)
