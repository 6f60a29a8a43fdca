"""Programs of Zoltan with the plug-in preloaded: PySPH, and dccrg, the grid of Vlasiator."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

from programs import BUILD, HOSTS, ROOT, first_failure, run
from result import Case, Failed, Result

AGREEMENT = 1e-9
DCCRG = HOSTS / "dccrg"
DCCRG_ADDRESS = "https://github.com/fmihpc/dccrg.git"
DCCRG_COMMIT = "f27e1c5312eb7d870b9cd095f9edb3c9c7814549"


def run_counted(ranks: int, command: list, variables: dict, with_rrcb: bool, folder: Path):
    """Seconds of the program, the match of its result, and what it asks of Zoltan."""
    libraries = [BUILD / "tests" / "clients" / "libzoltan_calls.so"]
    variables = variables | {"RRCB_TEST_CALLS": folder / "calls"}
    if with_rrcb:
        libraries.append(BUILD / "src" / "zoltan" / "librrcb_zoltan.so")
        variables["RRCB_REPLACE"] = "RCB"
    variables["LD_PRELOAD"] = ":".join(map(str, libraries))
    seconds, output, code = run(ranks, command, variables, folder)
    result = re.search(r"^result (.*)(?:\nghosts (\S+))?$", output, re.MULTILINE)
    if code != 0 or result is None:
        raise Failed(output.strip().split("\n")[-1])
    spent = dict(line.split() for line in (folder / "calls").read_text().splitlines())
    if spent["plug_in"] != str(int(with_rrcb)) or spent["calls"] == "0":
        raise Failed(f"answered by the wrong one: {spent}")
    return seconds, result, spent


def launch_pysph(interval: int, ranks: int, with_rrcb: bool, folder: Path) -> Result:
    # PySPH keeps the modules that it compiles in the home directory.
    home = BUILD / "tests" / "clients" / "home"
    home.mkdir(parents=True, exist_ok=True)
    command = ["/usr/bin/python3", ROOT / "tests" / "clients" / "pysph_client.py", "--dx=0.04",
               "--max-steps=50", f"--lb-freq={interval}", f"--directory={folder / 'out'}"]
    seconds, result, spent = run_counted(ranks, command, {"HOME": home}, with_rrcb, folder)
    objects, answer = re.fullmatch(r"objects (\d+) .* answer (.*)", result[1]).groups()
    moved = 100 * float(spent["exported"]) / int(spent["calls"]) / int(objects)
    return Result(seconds, float(spent["seconds"]), moved, float(result[2]), sums_of(answer))


def launch_dccrg(method: str, ranks: int, with_rrcb: bool, folder: Path) -> Result:
    command = [HOSTS / "dccrg_grid", "RCB" if with_rrcb else method, 10]
    seconds, result, spent = run_counted(ranks, command, {}, with_rrcb, folder)
    cells, moved, ghosts, most, weights, heaviest, imbalance, checksum = result[1].split()
    notes = {"most ghosts": most, "weight of ghosts": weights, "most": heaviest,
             "imbalance": imbalance}
    return Result(seconds, float(spent["seconds"]), float(moved), float(ghosts) / ranks,
                  sums_of(f"{cells} {checksum}"), {name: float(word) for name, word in notes.items()})


def sums_of(words: str) -> dict[str, float]:
    return {f"sum {i}": float(word) for i, word in enumerate(words.split())}


def compare(plain: Result, rrcb: Result) -> str:
    for name, value in plain.answer.items():
        if not abs(rrcb.answer[name] - value) <= AGREEMENT * abs(value):
            raise Failed(f"{name} is {rrcb.answer[name]} instead of {value}")
    notes = [f"{name} {value:,.5g}, {rrcb.notes[name]:,.5g}" for name, value in plain.notes.items()]
    return "; ".join(["same sums", *notes])


def build_dccrg() -> str:
    """Returns why dccrg cannot be had, or nothing."""
    clone = [] if DCCRG.exists() else [["git", "clone", "-q", DCCRG_ADDRESS, DCCRG]]
    return first_failure([
        *clone, ["git", "-C", DCCRG, "checkout", "-q", DCCRG_COMMIT],
        ["mpicxx", "-O2", "-std=c++17", "-I", DCCRG, "-I", "/usr/include/trilinos",
         Path(__file__).parent / "dccrg_grid.cpp", "-o", HOSTS / "dccrg_grid",
         "-ltrilinos_zoltan"]])


TARGETS = ["rrcb_zoltan", "zoltan_calls"]
ZOLTAN_CASES = [
    *(Case(f"pysph.{interval}", f"PySPH, dam break, 50 steps, balanced in every {word}",
           ["python3-pysph", "python3-pyzoltan"], TARGETS, partial(launch_pysph, interval), compare)
      for interval, word in [(1, "step"), (10, "10th")]),
    *(Case(f"dccrg.{method.lower()}", f"dccrg with {method}, a magnetosphere",
           ["libtrilinos-zoltan-dev", "libboost-dev"], TARGETS, partial(launch_dccrg, method),
           compare, build_dccrg, DCCRG_COMMIT[:7])
      for method in ["HSFC", "RIB", "RCB"]),
]
