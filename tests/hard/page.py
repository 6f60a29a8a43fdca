#!/usr/bin/env python3
"""page.py PAGE CLOUD_CASE FAULT_CASE [CLOUD_TABLE FAULT_TABLE]

Fails unless docs/hard_cases.md has as many clouds and faults as the programs list and, if the tables that
cloud_table and fault_table wrote are given, sums them up as they are.
"""
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

# Beginnings of cells, in the tables and on the page.
BY_ZOLTAN = {"hangs": "hangs", "crashes": "crashes", "OK on": "`ZOLTAN_OK`", "FATAL on": "`ZOLTAN_FATAL`",
             "MPI ends": "MPI ends the program"}  # fmt: skip


def rows(text):
    """Cells of the rows of all tables, except their heads."""
    lines = re.findall(r"^\| (.*) \|$", re.sub(r"^\|.*\|\n(?=\|---)", "", text, flags=re.M), re.M)
    return [line.split(" | ") for line in lines]


def table_of(page, head):
    """The rows of the page's table that begins with the head."""
    return rows(next(part for part in page.split("\n\n") if part.startswith(f"| {head}")))


def length_of_list(program):
    return len(subprocess.run([program, "--list"], check=True, capture_output=True).stdout.splitlines())


def stated_faults(page):
    """How many faults the page says Zoltan answers with what, and what RRCB does about them."""
    found, by_rrcb = Counter(), {}
    for fault, zoltan, rrcb in table_of(page, "fault"):
        number = re.search(r"\((\d+)\)$", fault)
        found[zoltan] += int(number[1]) if number else 1
        by_rrcb[zoltan] = rrcb
    return found, by_rrcb


def faults_differ(page, table):
    stated, by_rrcb = stated_faults(page)
    found = Counter()
    for fault, zoltan, rrcb in table:
        does = next(cell for key, cell in BY_ZOLTAN.items() if zoltan.startswith(key))
        found[does] += 1
        if by_rrcb.get(does) == "`ZOLTAN_FATAL`" and not rrcb.startswith("FATAL on"):
            yield f"{fault}: the page has ZOLTAN_FATAL, the table {rrcb}"
    if stated != found:
        yield f"faults under Zoltan's RCB: the page has {dict(stated)}, the table {dict(found)}"


def clouds_differ(page, table):
    stated = {row[0].split()[0]: row[1:] for row in table_of(page, f"{len(table)} clouds")}
    number = lambda cell, k: int(cell.split(", ")[k - 2])  # noqa: E731, look-ups 0, moves 1 from the end
    by_name = {row[0]: row[2:] for row in table}
    lost = sum(number(row[2], 0) > 0 for row in table)
    moves = [number(row[2], 1) for row in table if number(row[2], 1)]
    for words, found in ((stated["look-ups"][0], [lost]), (stated["objects"][0], moves)):
        if list(map(int, re.findall(r"\d+", words))) != found:
            yield f"the page has '{words}', the table {found}"
    if any(number(cell, k) for row in table for cell in row[3:] for k in (0, 1)):
        yield "the table has look-ups or moves of RRCB"
    if stated["no"] != ["`ZOLTAN_MEMERR`", "works"] or not by_name["none"][0].startswith("MEMERR"):
        yield f"no objects: {stated['no']}, the table {by_name['none']}"
    stated_zero = [float(re.search(r"[\d.]+", cell)[0]) for cell in stated["all"]]
    found_zero = [float(cell.split(",")[0]) for cell in by_name["weights all zero"][:2]]
    if stated_zero != found_zero:
        yield f"all weights 0: {stated_zero}, the table {found_zero}"


def main():
    text = Path(sys.argv[1]).read_text()
    listed = [length_of_list(program) for program in sys.argv[2:4]]
    numbers = [re.search(rf"(\d+) {noun}", text) for noun in ("hard clouds", "faults")]
    problems = [f"the page has {number[0]}, the program {size}" for number, size in zip(numbers, listed)
                if int(number[1]) != size]  # fmt: skip
    if sum(stated_faults(text)[0].values()) != listed[1]:
        problems.append(f"the rows of the page add up to other than {listed[1]} faults")
    for check, path in zip((clouds_differ, faults_differ), sys.argv[4:]):
        problems += check(text, rows(Path(path).read_text()))
    print("\n".join(problems) or "the page is as the programs and the tables")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
