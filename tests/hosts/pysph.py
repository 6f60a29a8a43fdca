"""PySPH's dam break in 3-D with the plug-in for Zoltan preloaded, by the client of tests/clients."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

from programs import BUILD, ROOT, run
from result import Case, Failed, Result

AGREEMENT = 1e-9


def launch(interval: int, ranks: int, with_rrcb: bool, folder: Path) -> Result:
    libraries = [BUILD / "tests" / "clients" / "libzoltan_calls.so"]
    variables = {"RRCB_TEST_CALLS": folder / "calls"}
    if with_rrcb:
        libraries.append(BUILD / "src" / "zoltan" / "librrcb_zoltan.so")
        variables["RRCB_REPLACE"] = "RCB"
    # PySPH keeps the modules that it compiles in the home directory.
    home = BUILD / "tests" / "clients" / "home"
    home.mkdir(parents=True, exist_ok=True)
    variables |= {"HOME": home, "LD_PRELOAD": ":".join(map(str, libraries))}
    client = [ROOT / "tests" / "clients" / "pysph_client.py", "--dx=0.04", "--max-steps=50",
              f"--lb-freq={interval}", f"--directory={folder / 'out'}"]
    seconds, output, code = run(ranks, ["/usr/bin/python3", *client], variables, folder)
    result = re.search(r"^result objects (\d+) .* answer(.*)\nghosts (\S+)$", output, re.MULTILINE)
    if code != 0 or result is None:
        raise Failed(output.strip().split("\n")[-1])
    spent = dict(line.split() for line in (folder / "calls").read_text().splitlines())
    if spent["plug_in"] != str(int(with_rrcb)) or spent["calls"] == "0":
        raise Failed(f"answered by the wrong one: {spent}")
    answer = {f"sum {i}": float(word) for i, word in enumerate(result[2].split())}
    moved = 100 * float(spent["exported"]) / int(spent["calls"]) / int(result[1])
    return Result(seconds, float(spent["seconds"]), moved, float(result[3]), answer)


def compare(plain: Result, rrcb: Result) -> str:
    for name, value in plain.answer.items():
        if not abs(rrcb.answer[name] - value) <= AGREEMENT * abs(value):
            raise Failed(f"{name} is {rrcb.answer[name]} instead of {value}")
    return "same sums of positions and speeds"


PYSPH_CASES = [
    Case(f"pysph.{interval}", f"PySPH, dam break, 50 steps, balanced in every {word}",
         ["python3-pysph", "python3-pyzoltan"], ["rrcb_zoltan", "zoltan_calls"],
         partial(launch, interval), compare)
    for interval, word in [(1, "step"), (10, "10th")]
]
