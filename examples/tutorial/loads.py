"""What all parallel steps of the tutorial measure: pairs, and how evenly the ranks count them."""
from mpi4py import MPI


class Loads:
    def __init__(self, pairs=0.0):
        self.pairs = pairs  # of all ranks in all steps
        self.heaviest = 0.0  # pairs of the busiest rank of each step, added up

    def add(self, own, comm):
        self.pairs += comm.allreduce(own)
        self.heaviest += comm.allreduce(own, MPI.MAX)

    def print(self, comm):
        """The imbalance is the work of the busiest rank over the mean."""
        if comm.rank == 0:
            print(f"{self.pairs:.0f} pairs")
            print(f"imbalance {self.heaviest * comm.size / self.pairs:.2f}")
