"""Step 4: ghosts. A rank gets copies of the particles near its box, not of all."""
import numpy as np
from loads import Loads
from mpi4py import MPI
from particles import NUM_STEPS, RADIUS, column_of_water, count_pairs, move

import rrcb

comm = MPI.COMM_WORLD
own = column_of_water() if comm.rank == 0 else np.empty((0, 2))
loads = Loads()
for step in range(NUM_STEPS):
    balance = rrcb.balance(own, comm=comm)
    own = balance.transfer(own)
    ghosts = balance.ghosts(own, cutoff=RADIUS).fetch(own)
    pairs = count_pairs(own, own) + count_pairs(own, ghosts)
    move(own)
    loads.add(pairs, comm)
loads.print(comm)

# Output on 4 ranks:
# 1605164 pairs
# imbalance 1.00
