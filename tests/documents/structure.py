#!/usr/bin/env python3
"""Checks the wall: folders of src include each other without a circle, and only passes/, services and
bindings read the coordinates of points."""

import re
import sys
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

MOST_ARROWS = 44
TOP = "src"  # files of no folder: a call and its steps
READS = re.compile(r"\bvisit_layout\b|\bfloat_axes\b|\bpoints_?\.axes\b|\bCollected\b"
                   r"|(\.|->)(position|coordinate)\(")  # fmt: skip
# Folders whose subject is points: passes of the engine, services, bindings, the paper's methods.
MAY_READ = {"passes", "lists", "paper", "zoltan", "c"}
# Options check the lengths of arrays, and stamp points.
STILL_READ = {"options/validation.cpp", "options/request.cpp"}


def folder_of(path: Path, root: Path) -> str:
    parts = path.relative_to(root).parts
    return parts[0] if len(parts) > 1 else TOP


def arrows(root: Path) -> dict[str, set[str]]:
    """Folders that the files of each folder include."""
    found: dict[str, set[str]] = {}
    for path in sorted(root.rglob("*.[ch]pp")):
        included = set(re.findall(r'^#include "([a-z_]+)/', path.read_text(), re.MULTILINE))
        found.setdefault(folder_of(path, root), set()).update(included - {folder_of(path, root)})
    return found


def readers(root: Path) -> list[str]:
    """Files beyond the wall that read coordinates and are not known to."""
    return [name for path in sorted(root.rglob("*.[ch]pp")) if READS.search(path.read_text())
            and folder_of(path, root) not in MAY_READ
            and (name := path.relative_to(root).as_posix()) not in STILL_READ]  # fmt: skip


def main(root: Path) -> int:
    below = arrows(root)
    # The steps of a call stand above all folders, and bindings above them.
    below.pop(TOP, None)
    faults = [f"{name} reads coordinates; only passes/ and services may" for name in readers(root)]
    try:
        TopologicalSorter(below).prepare()
    except CycleError as error:
        faults.append("folders include each other in a circle: " + " -> ".join(error.args[1]))
    number = sum(map(len, below.values()))
    if number > MOST_ARROWS:
        faults.append(f"{number} arrows between folders, more than {MOST_ARROWS}")
    print(*faults, f"{number} arrows between folders", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(Path(__file__).parents[2] / "src"))
