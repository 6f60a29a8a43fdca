"""Measurements of all parallel steps of the tutorial: pairs, and how evenly the ranks count them.
"""
from mpi4py import MPI


class Loads:
    def __init__(self, pairs=0.0):
        self.pairs = pairs  # sum over all ranks and steps
        self.heaviest = 0.0  # sum over the steps of the pairs on the busiest rank

    def add(self, own, comm):
        self.pairs += comm.allreduce(own)
        self.heaviest += comm.allreduce(own, MPI.MAX)

    def print(self, comm):
        """The imbalance is the work of the busiest rank over the mean."""
        if comm.rank == 0:
            print(f"{self.pairs:.0f} pairs")
            print(f"imbalance {self.heaviest * comm.size / self.pairs:.2f}")
