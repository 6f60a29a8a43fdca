"""petsc_client.py [points]: Poisson's equation by PETSc's conjugate gradients with its preconditioner ML.

ML repartitions the coarse levels by Zoltan's RCB. Prints what tests/clients/real_programs compares;
ends with 77 where PETSc for Python is not installed.
"""
import glob
import sys

# Debian keeps it apart from other modules.
sys.path += glob.glob("/usr/lib/petscdir/petsc*/*-real/lib/python3/dist-packages")
try:
    import mpi4py.MPI as mpi
    import numpy
    import petsc4py
except ImportError as missing:
    print(f"skipped: {missing} (Debian package python3-petsc4py-real)")
    sys.exit(77)

petsc4py.init(
    "petsc -pc_type ml -pc_ml_repartition -pc_ml_repartitionType Zoltan"
    " -pc_ml_repartitionZoltanScheme RCB -pc_ml_repartitionMaxMinRatio 1.1"
    " -pc_ml_repartitionMinPerProc 20 -pc_ml_repartitionPutOnSingleProc 1".split()
)
from petsc4py import PETSc  # noqa: E402


def uneven_planes(points, comm):
    """A later rank has more planes, so that there is something to balance."""
    parts = comm.size * (comm.size + 1)
    return [points * rank * (rank + 1) // parts for rank in (comm.rank, comm.rank + 1)]


def indices_of(begin, end, points):
    rows = numpy.arange(begin, end)
    return numpy.stack([rows % points, rows // points % points, rows // points**2], axis=1)


def matrix_of(begin, end, points):
    indices = indices_of(begin, end, points)
    steps = numpy.array([points**2, points, 1])[[0, 1, 2, 2, 1, 0]] * [-1, -1, -1, 1, 1, 1]
    inside = numpy.hstack([indices[:, ::-1] > 0, indices < points - 1])
    inside = numpy.insert(inside, 3, True, axis=1)
    columns = numpy.arange(begin, end)[:, None] + numpy.insert(steps, 3, 0)
    values = numpy.broadcast_to([-1.0, -1, -1, 6, -1, -1, -1], columns.shape)
    starts = numpy.concatenate([[0], numpy.cumsum(inside.sum(axis=1))])
    csr = [part.astype(PETSc.IntType) for part in (starts, columns[inside])] + [values[inside]]
    sizes = (end - begin, None)
    return PETSc.Mat().createAIJ((sizes, sizes), csr=csr)


def coarse_imbalance(preconditioner, comm):
    """Of the first coarse level, which is what RCB divides first."""
    matrix = preconditioner.getMGSmoother(preconditioner.getMGLevels() - 2).getOperators()[0]
    rows = matrix.getLocalSize()[0]
    filled = comm.allreduce(1 if rows > 0 else 0)
    return comm.allreduce(rows, mpi.MAX) * filled / comm.allreduce(rows)


def main():
    comm = mpi.COMM_WORLD
    points = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    begin, end = [plane * points**2 for plane in uneven_planes(points, comm)]
    matrix = matrix_of(begin, end, points)
    solver = PETSc.KSP().create()
    solver.setType("cg")
    solver.setOperators(matrix)
    solver.setTolerances(rtol=1e-10, max_it=100)
    solver.setFromOptions()
    solver.getPC().setCoordinates((indices_of(begin, end, points) + 1.0) / (points + 1))
    solution, right = matrix.createVecs()
    right.set(1)
    solver.solve(right, solution)
    largest, norm = solution.max()[1], solution.norm()
    imbalance = coarse_imbalance(solver.getPC(), comm)
    if comm.rank == 0:
        print(f"result objects {points**3} imbalance {imbalance:.4f}", end=" ")
        print(f"answer {largest:.12g} {norm:.12g}")
        print(f"{solver.getIterationNumber()} iterations")
    # 0.0562 in the centre is known from the solution's series.
    solved = solver.getConvergedReason() > 0 and abs(largest / (points + 1) ** 2 - 0.0562) < 0.001
    return 0 if solved else 1


sys.exit(main())
