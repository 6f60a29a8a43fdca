"""Divides a cloud of points and draws the parts.

    mpirun -n 4 python3 examples/python/quick_start.py [parts.png]

The picture needs matplotlib.
"""
import sys

import numpy as np
from mpi4py import MPI

import rrcb

comm = MPI.COMM_WORLD

# Each rank has 10,000 points at random positions, which are densest at the origin.
rng = np.random.default_rng(comm.rank)
x = rng.random((10_000, 2)) ** 2
mass = rng.random(len(x))

balance = rrcb.balance(x, weights=mass, comm=comm, tolerance=1.01)
here = balance.transfer({"x": x, "mass": mass})

# The ghosts are copies of other ranks' points within 0.02 of this rank's box.
ghosts = balance.ghosts(here["x"], cutoff=0.02)
near = ghosts.fetch(here)

loads = comm.allgather(here["mass"].sum())
copies = comm.allgather(len(near["x"]))
if comm.rank == 0:
    print(f"imbalance {max(loads) * comm.size / sum(loads):.4f}")
    print(f"the report has {balance.report.imbalance:.4f}")
    print(f"ghosts on each rank: {copies}")

# Draw the parts with a tenth of the points.
drawn = comm.gather(here["x"][::10])
if drawn is not None and len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")
    ax = balance.cuts.plot(within=([0, 0], [1, 1]))
    for points in drawn:
        ax.plot(*points.T, ".", markersize=1)
    ax.figure.savefig(sys.argv[1], dpi=150)
