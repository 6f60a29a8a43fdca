"""Compares RRCB with Zoltan's RCB on the same points. Without options a slope fails on 4 ranks.
The balancers divide snapshots of it, the complete simulation is timed six times with each of
them, and a table and pictures are written.

comparisons/run [option ...]
  --ranks=4             number of MPI ranks, 1 to 256
  --out=DIR             folder of the table, data and pictures. Default: comparisons/out; for
                        scenes other than the slope comparisons/out/NAME
  --price               measures the price of accuracy on twelve clouds; --price --help lists
                        its options
  --quick               a small run of everything, to check that it works
 points, one of
  --scene=slope         snapshots of a simulation: slope (the default), submarine_slide,
                        torpedo_anchor, dam_break, run_out, elastic_structure, or a scene file
  --cloud=NAME          generated points: uniform, slope, clusters, lattice, run_out, polygon,
                        shell or spiral, with
      --points=N            number of points on all ranks
      --dim=2               or 3
      --layout=sorted       distributed over the ranks by position, or scattered
  --file=points.csv     columns x, y and optionally z and weight
  --replay=DIR          a call that the plug-in has dumped (RRCB_DUMP)
 what is compared
  --methods=a,b,c       zoltan-rcb zoltan-rib zoltan-hsfc hilbert-counts root-rcb rrcb-sampled
                        rrcb rrcb-exact rrcb-arrays, and zoltan2-mj if Zoltan2 can be installed;
                        parameters in brackets: rrcb-sampled[mesh=4,k=2,fraction=0.25].
                        Default: zoltan-rcb, rrcb-sampled, rrcb and rrcb-exact.
                        all: every method, also zoltan-rcb[reuse], and rrcb-sampled and
                        rrcb with four settings each
  --lists=PARTS         or EXPORT, ALL: the lists that a call must return
  --repeats=6           repeats of each call, preferably an even number, and rounds of the
                        simulations, at most 6. With 6 or more, medians have 95 % intervals
  --radius=R            cut-off with which ghosts are counted: copies of points that parts need
                        from other parts. Default: twice the mean spacing
  --ranks-per-node=N    also counts ghosts between machines with N ranks each
  --seed=1              for the points of a cloud, --layout=scattered and the order of turns
  --steps=N             steps of the simulation. Default: to its end; the slope until it stops
  --every=auto          rebalances the simulation when it pays; or N: steps between two
                        rebalances; or several numbers separated by commas, in the same rounds
  --cost=learned        also compares weights from learned costs with counting in simulations;
                        default with the default methods, otherwise --cost=count
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import time
from pathlib import Path

from driver import COMPARE, OUT, build, on_ranks

MAX_RANKS = 256
MADE = ("history.csv", "simulation*.csv", "noise.csv")


def main() -> int:
    words = sys.argv[1:]
    if "--price" in words:
        others = [other for other in words if other != "--price"]
        os.execv(Path(__file__).with_name("run"), ["run", "price", *others])
    options, others = _read_options(words)
    build("rrcb_compare", multijagged="zoltan2-mj" in options.methods or options.methods == "all")
    others += ["--progress"] * sys.stderr.isatty()
    name = Path(options.scene).stem
    out = options.out or (OUT if name == "slope" else OUT / name)
    if options.methods:
        others.append(f"--methods={options.methods}")
    elif not re.search(r"--(cost|cloud|file|replay)\b", " ".join(others)):
        others.append("--cost=learned")
    if options.scene != "slope":
        others.append(f"--scene={options.scene}")
    return _compare(options.ranks, out, others)


def _read_options(words: list[str]) -> tuple[argparse.Namespace, list[str]]:
    """Returns the options needed here, and the words that are passed to the driver."""
    if {"--help", "-h"} & set(words):
        print(__doc__, end="")
        sys.exit()
    parser = argparse.ArgumentParser(prog="comparisons/run", add_help=False, allow_abbrev=False)
    parser.add_argument("--ranks", type=_ranks, default=4, metavar=f"1...{MAX_RANKS}")
    parser.add_argument("--out", type=_folder)
    parser.add_argument("--methods", default="")
    parser.add_argument("--scene", default="slope")
    return parser.parse_known_args(words)


def _ranks(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= MAX_RANKS:
        raise argparse.ArgumentTypeError(f"must be an integer from 1 to {MAX_RANKS}, not '{text}'")
    return int(text)


def _folder(text: str) -> Path:
    if not text:
        raise argparse.ArgumentTypeError("must name a folder")
    return Path(text)


def _compare(ranks: int, out: Path, words: list[str]) -> int:
    """Removes the files of an earlier comparison, runs the driver and reports what it wrote."""
    started = time.time() - 1
    status = on_ranks(ranks, COMPARE, f"--out={out}", *words).returncode
    table = out / "table.csv"
    if table.exists() and table.stat().st_mtime > started:
        for old in (path for pattern in MADE for path in out.glob(pattern)):
            if old.stat().st_mtime < started:
                old.unlink()
        from report import write_report  # its libraries take a second to load

        write_report(out)
    return status


if __name__ == "__main__":
    sys.exit(main())
