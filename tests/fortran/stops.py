#!/usr/bin/env python3
"""stops.py PROGRAM LAUNCHER...: checks how a Fortran program ends after an error without `error`.

Every rank ends with a status above 0. One of them prints the text if the call is collective, some do
otherwise. None prints anything else.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

RANKS = 3
# The launcher ends the others as soon as one rank has ended, so each waits.
WRAPPER = (
    '"$0" "$1"; echo $? > "$2/$$.new"; mv "$2/$$.new" "$2/$$.status"; '
    f'while [ "$(ls "$2" | grep -c status)" -lt {RANKS} ]; do sleep 0.1; done'
)


def ends_of(program, launcher, call):
    """Returns the texts of the library, the other lines about an end, and the statuses."""
    with tempfile.TemporaryDirectory() as folder:
        command = [*launcher, str(RANKS), "sh", "-c", WRAPPER, program, call, folder]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        statuses = [int(file.read_text()) for file in Path(folder).iterdir()]
    print(done.stdout)
    lines = done.stdout.splitlines()
    texts = [line for line in lines if line.startswith("rrcb: ")]
    others = [line for line in lines if "STOP" in line or "acktrace" in line]
    return texts, others, statuses


def main():
    program, *launcher = sys.argv[1:]
    texts, others, statuses = ends_of(program, launcher, "balance")
    assert texts == ["rrcb: rank 2: coordinate of point 0 on axis 0 is NaN or infinite (2 such "
                     "values on this rank)"], texts
    assert not others, others
    assert statuses == [1] * RANKS, statuses
    texts, others, statuses = ends_of(program, launcher, "set")
    assert texts and "no option \"colour\"" in texts[0], texts
    assert not others, others
    assert statuses == [1] * RANKS, statuses


if __name__ == "__main__":
    main()
