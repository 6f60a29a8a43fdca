"""Step 6: restart on other ranks. A first run stops half-way and writes a file, a second goes on.

    mpirun -n 4 python3 step6.py particles.npz && mpirun -n 3 python3 step6.py particles.npz
"""
import os
import sys

import numpy as np
from loads import Loads
from mpi4py import MPI
from particles import NUM_STEPS, RADIUS, TRAVEL, column_of_water, count_pairs, move

import rrcb

comm = MPI.COMM_WORLD
name = sys.argv[1] if len(sys.argv) > 1 else "particles.npz"
first, done, own = 0, 0.0, np.empty((0, 2))
if comm.rank == 0:
    own = column_of_water()
    if os.path.exists(name):
        with np.load(name) as file:
            first, done, own = int(file["step"]), float(file["pairs"]), file["x"]
first, done = comm.bcast((first, done))
last = NUM_STEPS if first else NUM_STEPS // 2
loads = Loads(done)
cuts = None
with rrcb.Controller(comm) as controller:  # begins anew, as the ranks may be others
    for step in range(first, last):
        if cuts is None or controller.due:
            balance = rrcb.balance(own, comm=comm, previous=cuts)
            own = balance.transfer(own)
            cuts = balance.cuts
            neighbours = rrcb.Neighbours(cuts, RADIUS, TRAVEL, comm=comm)
            controller.rebalanced(balance.report, 2000.0)
        else:
            own = neighbours.migrate(own, own)
        neighbours.find_ghosts(own)
        ghosts = neighbours.fetch(own)
        pairs = count_pairs(own, own) + count_pairs(own, ghosts)
        move(own)
        controller.step(pairs)
        loads.add(pairs, comm)
everything = comm.gather(own)
if comm.rank == 0:
    np.savez(name, step=last, pairs=loads.pairs, x=np.concatenate(everything))
    print(f"{loads.pairs:.0f} pairs after {last} steps")

# Output of the second run, on 3 ranks:
# 1605164 pairs after 40 steps
