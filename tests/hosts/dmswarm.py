"""dmswarm.py cells|rrcb: PETSc's particles (DMSwarm) of a cluster that circles in a square.

Particles migrate to the ranks of their cells, or to those that RRCB gives them. A step costs
arithmetic for each particle. Prints what tests/hosts/run compares.
"""
import glob
import sys
import time

sys.path += glob.glob("/usr/lib/petscdir/petsc*/*-real/lib/python3/dist-packages")
import mpi4py.MPI as mpi  # noqa: E402
import numpy as np  # noqa: E402
import petsc4py  # noqa: E402

petsc4py.init()
from petsc4py import PETSc  # noqa: E402
from rrcb_library import Balancer  # noqa: E402

PARTICLES, STEPS, CELLS, RADIUS = 200_000, 40, 64, 0.01


def ranks_of_cells(x, comm):
    """As a DMDA places the cells of a grid."""
    across = PETSc.DMDA().create([CELLS, CELLS], comm=comm).getProcSizes()
    cells = np.clip((x * CELLS).astype(int), 0, CELLS - 1)
    i, j = (cells * across // CELLS).T
    return (j * across[0] + i).astype(np.int32)


def field(swarm, name, change):
    array = swarm.getField(name)
    result = change(array)
    swarm.restoreField(name)
    return result


def copy_of(swarm):
    return field(swarm, "x", lambda x: x.reshape(-1, 2).copy())


def num_ghosts(x, comm):
    """Particles of other ranks in the squares of side RADIUS next to those of this rank."""
    side = int(1 / RADIUS) + 3
    here = np.zeros((side, side), np.int64)
    np.add.at(here, tuple((x / RADIUS).astype(int).T + 1), 1)
    everywhere = comm.allreduce(here)
    near = sum(np.roll(here > 0, shift, (0, 1)) for shift in np.ndindex(3, 3))
    near = np.roll(near, (-1, -1), (0, 1)) > 0
    return int((everywhere - here)[near].sum())


def main():
    comm, method = mpi.COMM_WORLD, sys.argv[1]
    swarm = PETSc.DMSwarm().create(comm=comm)
    swarm.setDimension(2)
    swarm.setType(PETSc.DMSwarm.Type.BASIC)
    swarm.initializeFieldRegister()
    swarm.registerField("x", 2, dtype=PETSc.ScalarType)
    swarm.finalizeFieldRegister()
    local = PARTICLES * (comm.rank + 1) // comm.size - PARTICLES * comm.rank // comm.size
    swarm.setLocalSizes(local, local // 4)
    random = np.random.default_rng(comm.rank)
    cloud = np.clip(random.normal([0.3, 0.5], 0.08, (local, 2)), 0, 0.999)
    field(swarm, "x", lambda x: x.reshape(-1, 2).__setitem__(slice(None), cloud))
    balancer = Balancer(comm) if method == "rrcb" else None
    balancing, moved, uneven = 0.0, 0, 0.0
    comm.Barrier()
    begin = time.perf_counter()
    for step in range(STEPS):
        turn = 2 * np.pi / 100
        spin = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        field(swarm, "x", lambda x: x.reshape(-1, 2).__setitem__(
            slice(None), np.clip((x.reshape(-1, 2) - 0.5) @ spin + 0.5, 0, 0.999)))
        x = copy_of(swarm)
        start = time.perf_counter()
        ranks = balancer.parts_of(x) if balancer else ranks_of_cells(x, comm)
        balancing += time.perf_counter() - start
        moved += comm.allreduce(int((ranks != comm.rank).sum()))
        field(swarm, "DMSwarm_rank", lambda array: array.ravel().__setitem__(slice(None), ranks))
        swarm.migrate(remove_sent_points=True)
        x = copy_of(swarm)
        for _ in range(20):
            np.sin(x, out=x)
        uneven += comm.allreduce(len(x), mpi.MAX) * comm.size / PARTICLES
    seconds = time.perf_counter() - begin
    x = copy_of(swarm)
    sums = comm.allreduce(np.array([len(x), *x.sum(axis=0), *(x**2).sum(axis=0)]))
    ghosts = comm.allreduce(num_ghosts(x, comm)) / comm.size
    if comm.rank == 0:
        print("result", seconds, balancing, 100 * moved / PARTICLES / STEPS, ghosts, uneven / STEPS,
              *sums)


main()
