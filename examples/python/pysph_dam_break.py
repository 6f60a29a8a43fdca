"""PySPH's dam break in three dimensions, divided by RRCB instead of Zoltan.

    mpirun -n 4 python3 examples/python/pysph_dam_break.py [option of the dam break ...]

With --plain Zoltan divides the particles. Exits with 77 if PySPH is not installed.
"""
import sys

import numpy as np
from mpi4py import MPI

import rrcb

try:
    from pysph.examples.dam_break_3d import DamBreak3D
    from pysph.parallel.parallel_manager import ZoltanParallelManagerGeometric
    from pysph.solver import application
except ImportError as missing:
    print(f"skipped: {missing} (Debian packages python3-pysph and python3-pyzoltan)")
    sys.exit(77)

comm = MPI.COMM_WORLD


class RrcbManager(ZoltanParallelManagerGeometric):
    """Divides particles instead of cells, and finds the particles that other ranks need."""

    balance = None

    def positions(self):
        """Returns the positions of the particles of all arrays on this rank, and the end of each
        array."""
        xyz = np.concatenate([np.stack([a.x, a.y, a.z], axis=1) for a in self.particles])
        return xyz, np.cumsum([len(a.x) for a in self.particles])

    def load_balance(self):
        self.balance = rrcb.balance(self.positions()[0], comm=self.comm, previous=self.balance)
        self.changes = 1

    def create_particle_lists(self):
        """Lists the particles that leave."""
        self.send_to(self.balance.parts)

    def migrate_particles(self):
        """Moves particles that have crossed a cut, between two balances."""
        self.send_to(self.balance.cuts.part_of(self.positions()[0]))
        for exchange in self.pa_exchanges:
            exchange.lb_exchange_data()

    def compute_remote_particles(self):
        """Lists the particles that other ranks need."""
        radius = self.ghost_layers * self.cell_size
        sent = self.balance.ghosts(self.positions()[0], radius).sent
        ranks = [np.full(len(rows), rank) for rank, rows in sent.items()]
        self.export(np.concatenate([[], *sent.values()]), np.concatenate([[], *ranks]))

    def send_to(self, parts):
        rows = np.flatnonzero(parts != self.rank)
        self.export(rows, parts[rows])

    def export(self, rows, ranks):
        """Sets the rows and destinations of each array's particles."""
        first = 0
        for exchange, array, end in zip(self.pa_exchanges, self.particles, self.positions()[1]):
            mine = (rows >= first) & (rows < end)
            local = (rows[mine] - first).astype(np.uint32)
            exchange.reset_lists()
            for values, found in (
                (exchange.exportParticleLocalids, local),
                (exchange.exportParticleGlobalids, array.gid[local]),
                (exchange.exportParticleProcs, ranks[mine].astype(np.int32)),
            ):
                values.resize(len(found))
                values.set_data(found)
            exchange.numParticleExport = len(local)
            first = end


arguments = sys.argv[1:]
if "--plain" in arguments:
    arguments.remove("--plain")
else:
    application.ZoltanParallelManagerGeometric = RrcbManager
program = DamBreak3D(fname="dam_break")
program.run(["--no-adaptive-timestep", "--disable-output", *arguments])

counts = [array.get_number_of_particles(True) for array in program.particles]
here = [
    np.stack([a.x, a.y, a.z, a.u, a.v, a.w])[:, :count]
    for a, count in zip(program.particles, counts)
]
squares = comm.allreduce(sum((values**2).sum(axis=1) for values in here))
total, most = comm.allreduce(sum(counts)), comm.allreduce(sum(counts), MPI.MAX)
copies = comm.allreduce(sum(a.get_number_of_particles() for a in program.particles)) - total
if comm.rank == 0:
    print(f"{total} particles, imbalance {most * comm.size / total:.4f}, {copies} copies")
    print("sums of squares", *(f"{value:.10g}" for value in squares))
