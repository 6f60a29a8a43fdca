"""Compares calls of Python and C++ on the same points, in turns in one program.

    mpirun -n 2 tests/python/overhead.py LIBRARY [points [turns]]

LIBRARY is the target rrcb_python_overhead. Prints medians over the turns of the slowest rank's
seconds, the pages that rank 0 got from the system in a turn, and the median ratio with its 95 %
bootstrap interval.
"""
import ctypes
import resource
import sys
import time

import numpy as np
from mpi4py import MPI

import rrcb

comm = MPI.COMM_WORLD
library = ctypes.CDLL(sys.argv[1])
POINTS = int(sys.argv[2]) if len(sys.argv) > 2 else 1_000_000
TURNS = int(sys.argv[3]) if len(sys.argv) > 3 else 41
x = np.random.default_rng(comm.rank).random((POINTS // comm.size, 3)) ** 2
there = (comm.py2f(), ctypes.c_void_p(x.ctypes.data), ctypes.c_size_t(len(x)))


def in_python(kept={}):
    def balance():
        kept["balance"] = rrcb.balance(x, comm=comm)

    def move():
        kept["moved"] = kept["balance"].transfer(x)

    return balance, move


def in_cpp():
    return lambda: library.balance_points(*there), lambda: library.move_points(*there)


def measure(call):
    """Seconds of the slowest rank, and page faults of this one."""
    faults = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    comm.Barrier()
    start = time.perf_counter()
    call()
    seconds = time.perf_counter() - start
    faults = resource.getrusage(resource.RUSAGE_SELF).ru_minflt - faults
    return comm.allreduce(seconds, MPI.MAX), faults


sides = [in_cpp(), in_python()]
# [turn, side, call, quantity]; the first turns are not counted. Each side is first in every other turn.
found = np.array([
    [[measure(call) for call in calls] for calls in sides[:: 1 - 2 * (turn % 2)]][:: 1 - 2 * (turn % 2)]
    for turn in range(TURNS + 3)
])[3:]
if comm.rank == 0:
    for k, name in enumerate(("balance", "transfer")):
        (cpp, cpp_pages), (python, pages) = np.median(found[:, :, k], axis=0)
        ratios = found[:, 1, k, 0] / found[:, 0, k, 0]
        medians = np.median(np.random.default_rng(0).choice(ratios, (2000, TURNS)), axis=1)
        lower, upper = np.quantile(medians, (0.025, 0.975))
        print(f"{name}: C++ {1e3 * cpp:.3f} ms, {cpp_pages:.0f} pages; ", end="")
        print(f"Python {1e3 * python:.3f} ms, {pages:.0f} pages; ", end="")
        print(f"ratio {np.median(ratios):.3f} [{lower:.3f}, {upper:.3f}]")
