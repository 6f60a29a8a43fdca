#!/usr/bin/env python3
"""baseline.py SOURCE CC LIBRARY: compares the interface in C with the headers of 1.0.0-rc1, the first baseline.

Fails unless each value of an enumeration, each member with its offset and type, and each function of the baseline is
still there, and the library has each function with the version of 1.0. A struct with a size may have more members
at its end.
"""
import re
import subprocess
import sys
from pathlib import Path

from interface import functions, printed, texts

BASELINE = Path(__file__).with_name("1.0.0-rc1")


def table_of(source, compiler):
    """Lines of what compiled programs rely on, without the sizes of structs that may grow."""
    text = texts(source)
    lines = printed(source, compiler, text)
    growing = {line.split()[0] for line in lines if line.endswith(" 0 size_t size")}
    return {line for line in lines if not (line.endswith(" end") and line.split()[0] in growing)} | {*functions(text)}


def main():
    source, compiler, library = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    promised = table_of(BASELINE, compiler)
    problems = [f"programs of 1.0.0-rc1 rely on: {line}" for line in promised - table_of(source, compiler)]
    shown = subprocess.run(["nm", "--dynamic", "--defined-only", library], check=True, capture_output=True, text=True)
    exported = {*re.findall(r" T (rrcb_\w+)@@RRCB_C_1\.0$", shown.stdout, re.M)}
    needed = {re.search(r"(rrcb_\w+)\(", line)[1] for line in functions(texts(BASELINE))}
    problems += [f"the library does not have {name}@RRCB_C_1.0" for name in needed - exported]
    print("\n".join(sorted(problems)) or f"{len(promised)} lines and {len(needed)} functions are as in 1.0.0-rc1")
    return 1 if problems or not needed else 0


if __name__ == "__main__":
    sys.exit(main())
