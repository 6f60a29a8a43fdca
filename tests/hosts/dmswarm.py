"""dmswarm.py cells|rrcb: PETSc's particles (DMSwarm) in a cluster that circles in a square migrate
to the ranks of their cells, or to those that RRCB gives them. Prints what tests/hosts/run compares."""
import glob
import sys
import time

sys.path += glob.glob("/usr/lib/petscdir/petsc*/*-real/lib/python3/dist-packages")
import numpy as np  # noqa: E402
import rrcb  # noqa: E402
from mpi4py import MPI  # noqa: E402
from petsc4py import PETSc  # noqa: E402

PARTICLES, STEPS, CELLS, RADIUS, ANGLE = 200_000, 40, 64, 0.01, 2 * np.pi / 100
SPIN = np.array([[np.cos(ANGLE), np.sin(ANGLE)], [-np.sin(ANGLE), np.cos(ANGLE)]])
comm, balance = MPI.COMM_WORLD, None


def field(name, new=None):
    view = swarm.getField(name)
    array = view.reshape(-1, 2).copy() if new is None else new
    view.reshape(array.shape)[:] = array
    swarm.restoreField(name)
    return array


def num_ghosts(x):
    """Particles of other ranks in the squares of side RADIUS next to those of this rank."""
    local = np.zeros([int(1 / RADIUS) + 3] * 2, np.int64)
    np.add.at(local, tuple((x / RADIUS).astype(int).T + 1), 1)
    near = sum(np.roll(local > 0, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1))
    return int((comm.allreduce(local) - local)[near > 0].sum())


x = np.random.default_rng(1).normal([0.3, 0.5], 0.08, (PARTICLES, 2))[comm.rank :: comm.size]
across = PETSc.DMDA().create([CELLS, CELLS], comm=comm).getProcSizes()[:2]
swarm = PETSc.DMSwarm().create(comm=comm)
swarm.setDimension(2)
swarm.setType(PETSc.DMSwarm.Type.BASIC)
swarm.registerField("x", 2, dtype=PETSc.ScalarType)
swarm.finalizeFieldRegister()
swarm.setLocalSizes(len(x), len(x) // 4)
balancing, moved, imbalance, begin = 0.0, 0.0, 0.0, time.perf_counter()
for step in range(STEPS):
    x = field("x", np.clip((x - 0.5) @ SPIN + 0.5, 0, 0.999))
    start = time.perf_counter()
    if sys.argv[1] == "rrcb":
        balance = rrcb.balance(x, comm=comm, previous=balance)
    cells = (x * CELLS).astype(int) * across // CELLS
    ranks = balance.parts if balance else (cells @ [1, across[0]]).astype(np.int32)
    balancing += time.perf_counter() - start
    moved += comm.allreduce(np.sum(ranks != comm.rank)) * 100 / PARTICLES
    field("DMSwarm_rank", ranks)
    swarm.migrate(remove_sent_points=True)
    x = field("x")
    np.sin(np.tile(x, (20, 1)))  # the work of a step
    imbalance += comm.allreduce(len(x), MPI.MAX) * comm.size / PARTICLES
sums = comm.allreduce(np.array([len(x), *x.sum(axis=0), *(x**2).sum(axis=0)]))
ghosts, seconds = comm.allreduce(num_ghosts(x)) / comm.size, time.perf_counter() - begin
if comm.rank == 0:
    print("result", seconds, balancing, moved / STEPS, ghosts, imbalance / STEPS, *sums)
