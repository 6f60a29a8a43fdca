"""PyZoltan's geometric partitioner on random points; prints the method and the imbalance.

Ends with 77 where PyZoltan is not installed. With "plug-in" as argument, fails unless the plug-in
stands in front of Zoltan.
"""
import ctypes
import sys

try:
    import mpi4py.MPI as mpi
    import numpy
    from cyarray.api import DoubleArray, UIntArray
    from pyzoltan.core import zoltan
except ImportError as missing:
    print(f"skipped: {missing} (Debian package python3-pyzoltan)")
    sys.exit(77)


def array_of(kind, values):
    array = kind(len(values))
    array.set_data(values)
    return array


def partitioner_of(comm, num_points):
    random = numpy.random.RandomState(comm.rank)
    x, y = random.rand(2, num_points)
    ids = numpy.arange(num_points, dtype=numpy.uint32) + num_points * comm.rank
    coordinates = [array_of(DoubleArray, values) for values in (x, x * y, numpy.zeros_like(x))]
    partitioner = zoltan.ZoltanGeometricPartitioner(
        2, comm, *coordinates, array_of(UIntArray, ids), obj_weight_dim="0")
    partitioner.set_lb_method("RCB")
    partitioner.Zoltan_Set_Param("DEBUG_LEVEL", "0")
    return partitioner


def plug_in_is_active():
    program = ctypes.CDLL(None)
    return hasattr(program, "RRCB_Zoltan_Active") and program.RRCB_Zoltan_Active() == 1


def main():
    comm = mpi.COMM_WORLD
    num_points = 1000 * (comm.rank + 1)
    partitioner = partitioner_of(comm, num_points)
    partitioner.Zoltan_LB_Balance()
    kept = num_points - partitioner.numExport + partitioner.numImport
    largest = comm.allreduce(kept, mpi.MAX)
    imbalance = largest * comm.size / comm.allreduce(num_points)
    if comm.rank == 0:
        print(f"plug-in active: {plug_in_is_active()}, imbalance {imbalance:.4f}")
    expected = len(sys.argv) > 1 and sys.argv[1] == "plug-in"
    return 0 if imbalance < 1.02 and plug_in_is_active() == expected else 1


sys.exit(main())
