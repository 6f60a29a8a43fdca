"""pysph_client.py [option ...]: PySPH's dam break in three dimensions, balanced by Zoltan's RCB at every step.

The options are the example's own. Prints what tests/clients/real_programs compares; ends with 77
where PySPH is not installed.
"""
import sys

try:
    import mpi4py.MPI as mpi
    import numpy
    from pyzoltan.core import zoltan  # noqa: F401
    from pysph.examples.dam_break_3d import DamBreak3D
except ImportError as missing:
    print(f"skipped: {missing} (Debian packages python3-pysph and python3-pyzoltan)")
    sys.exit(77)

OPTIONS = ["--zoltan-lb-method=RCB", "--lb-freq=1", "--no-adaptive-timestep", "--disable-output"]


def moments_of(array):
    """Sums that a particle lost, doubled or moved changes, over the particles that this rank owns."""
    num_particles = array.get_number_of_particles(True)
    position = numpy.stack([array.x, array.y, array.z])[:, :num_particles]
    velocity = numpy.stack([array.u, array.v, array.w])[:, :num_particles]
    return numpy.concatenate([((position + 1) ** 2).sum(axis=1), (velocity**2).sum(axis=1)])


def main():
    comm = mpi.COMM_WORLD
    program = DamBreak3D(fname="dam_break")
    program.run(OPTIONS + sys.argv[1:])
    arrays = program.particles
    num_particles = sum(array.get_number_of_particles(True) for array in arrays)
    total, most = comm.allreduce(num_particles), comm.allreduce(num_particles, mpi.MAX)
    answer = comm.allreduce(sum(moments_of(array) for array in arrays))
    ghosts = comm.allreduce(sum(array.get_number_of_particles() for array in arrays)) - total
    if comm.rank == 0:
        print(f"result objects {total} imbalance {most * comm.size / total:.4f} answer", end=" ")
        print(*(f"{value:.12g}" for value in answer))
        print(f"ghosts {ghosts / comm.size}")


main()
