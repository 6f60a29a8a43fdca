"""The quick start in Python: balances points that are unevenly distributed over the ranks, moves them, and
fetches copies of the points near each rank's box.

    mpirun -n 4 python3 examples/python/quick_start.py [parts.png]

The picture needs matplotlib.
"""
import sys

import numpy as np
from mpi4py import MPI

import rrcb

comm = MPI.COMM_WORLD


def squares_of(rank):
    """Returns the points of this rank. Unit squares of 40 x 40 points form a row; rank r has r + 1 of them, which
    follow those of rank r - 1.
    """
    first = rank * (rank + 1) // 2
    x = first + (np.arange(40 * (rank + 1)) + 0.5) / 40
    y = (np.arange(40) + 0.5) / 40
    return np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)


coordinates = squares_of(comm.rank)

balance = rrcb.balance(coordinates, comm=comm)

# Columns of the points in this rank's box, and copies of others within 0.05 of it.
here = balance.transfer(coordinates)
near = balance.ghosts(here, cutoff=0.05)
ghosts = near.fetch(here)

moved = balance.moved_fraction()
if comm.rank == 0:
    kept = np.count_nonzero(balance.parts == comm.rank)
    print(f"{balance.report.num_points} points in {balance.cuts.num_parts} parts")
    print(f"imbalance {balance.report.imbalance:.4f}, moved {100 * moved:.0f} %")
    print(f"rank 0 sends {len(coordinates) - kept} points and receives {len(here) - kept}")
    print(f"it has {len(here)}, and copies of {len(ghosts)} near its box")

# A picture of the parts, with a tenth of the points.
drawn = comm.gather(here[::10])
if drawn is not None and len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")
    ax = balance.cuts.plot(within=([0, 0], [10, 1]))
    for points in drawn:
        ax.plot(*points.T, ".", markersize=1)
    ax.figure.savefig(sys.argv[1], dpi=150)

# Output on 4 ranks:
# 16000 points in 4 parts
# imbalance 1.0000, moved 50 %
# rank 0 sends 0 points and receives 2400
# it has 4000, and copies of 80 near its box
