"""The interface of the package mpipartition, with parts of equal load instead of equal blocks.

    mpirun -n 4 python3 examples/python/mpipartition.py

Copy this file to your program, and import Partition, distribute and overload from it. The first
distribute() of a partition balances its points. Later calls use the same cuts, so that several
catalogues stay together. Parts are boxes, but not those of a Cartesian grid. Any number of ranks
and any overload length can be used, in 1 to 3 dimensions.
"""
import math

import numpy as np
from mpi4py import MPI

import rrcb


class Partition:
    """The parts of the unit cube, one for each rank."""

    def __init__(self, dimensions=3, *, comm=MPI.COMM_WORLD):
        self.comm = comm
        self.dimensions = dimensions
        self.rank = comm.rank
        self.nranks = comm.size
        self.cuts = None  # set by the first call of distribute()

    @property
    def boxes(self):
        """Returns the lower and upper corners of all parts, with shape (nranks, 2, dimensions)."""
        return self.cuts.finite_boxes((np.zeros(self.dimensions), np.ones(self.dimensions)))

    @property
    def origin(self):
        return self.boxes[self.rank, 0]

    @property
    def extent(self):
        return self.boxes[self.rank, 1] - self.origin

    @property
    def neighbor_ranks(self):
        """Returns the ranks whose parts touch this rank's part in the periodic cube."""
        lower, upper = self.boxes.transpose(1, 0, 2)
        touches = np.zeros((self.nranks, self.dimensions), dtype=bool)
        for shift in (-1.0, 0.0, 1.0):
            touches |= (lower + shift <= upper[self.rank]) & (upper + shift >= lower[self.rank])
        return [r for r in np.flatnonzero(touches.all(axis=1)).tolist() if r != self.rank]


def positions_of(box_size, data, coord_keys):
    return np.stack([data[key] for key in coord_keys], axis=1) / box_size


def distribute(partition, box_size, data, coord_keys):
    """Returns the data of this rank's part. Collective."""
    x = positions_of(box_size, data, coord_keys)
    if partition.cuts is None:
        parts = rrcb.balance(x, comm=partition.comm)
        partition.cuts = parts.cuts
    else:
        parts = rrcb.assign(x, partition.cuts, partition.comm)
    return parts.transfer(data)


def overload(partition, box_size, data, overload_length, coord_keys):
    """Returns this rank's data and copies of those of other ranks near its part. Collective.

    A point is near if it is within `overload_length` along every axis in the periodic box. It comes
    once, with its original position.
    """
    x = positions_of(box_size, data, coord_keys)
    length = overload_length / box_size
    parts = rrcb.assign(x, partition.cuts, partition.comm)
    # The box of a part, extended by the margin, is within this radius of the part.
    ghosts = parts.ghosts(x, length * math.sqrt(x.shape[1]) * (1 + 1e-12), period=1.0)
    images = ghosts.fetch_positions(x)
    lower, upper = partition.boxes[partition.rank]
    near = ((images >= lower - length) & (images < upper + length)).all(axis=1)
    near &= ghosts.ranks != partition.rank
    # Several periodic images of a point may be near.
    points = np.stack([ghosts.ranks, ghosts.fetch(np.arange(len(x)))], axis=1)[near]
    first = np.unique(points, axis=0, return_index=True)[1]
    copies = ghosts.fetch(data)
    return {key: np.concatenate([data[key], copies[key][near][first]]) for key in data}


def main():
    comm = MPI.COMM_WORLD
    box_size, keys = 50.0, ["x", "y"]
    # Each rank reads 5,000 points of a catalogue, half of them in a tenth of the box.
    x = np.random.default_rng(comm.rank).random((5_000, 2)) * box_size
    x[::2] *= 0.1
    data = {"x": x[:, 0], "y": x[:, 1], "id": np.arange(len(x)) * comm.size + comm.rank}

    partition = Partition(2, comm=comm)
    data = distribute(partition, box_size, data, keys)
    near = overload(partition, box_size, data, 1.0, keys)

    counts = comm.gather(len(data["id"]))
    copies = comm.gather(len(near["id"]) - len(data["id"]))
    neighbors = comm.gather(len(partition.neighbor_ranks))
    if comm.rank == 0:
        print(f"{sum(counts)} points, imbalance {max(counts) * comm.size / sum(counts):.4f}")
        print(f"copies on each rank: {copies}")
        print(f"neighbors of each rank: {neighbors}")


if __name__ == "__main__":
    main()

# Output on 4 ranks:
# 20000 points, imbalance 1.0008
# copies on each rank: [2561, 4871, 2423, 2428]
# neighbors of each rank: [3, 3, 3, 3]
