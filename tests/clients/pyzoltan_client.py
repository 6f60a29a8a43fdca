"""pyzoltan_client.py [plug-in] [points]: PyZoltan's geometric partitioner on random points.

Prints what tests/clients/real_programs compares; ends with 77 where PyZoltan is not installed. With
"plug-in", fails unless the plug-in stands in front of Zoltan; without it, if the plug-in does.
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


def ids_of(comm, num_points):
    """A later rank has more points, so that there is something to balance."""
    begin = num_points * comm.rank * (comm.rank + 1) // 2
    return numpy.arange(begin, begin + num_points * (comm.rank + 1), dtype=numpy.uint32)


def partitioner_of(comm, ids):
    random = numpy.random.RandomState(comm.rank)
    x, y = random.rand(2, len(ids))
    coordinates = [array_of(DoubleArray, values) for values in (x, x * y, numpy.zeros_like(x))]
    partitioner = zoltan.ZoltanGeometricPartitioner(
        2, comm, *coordinates, array_of(UIntArray, ids), obj_weight_dim="0")
    partitioner.set_lb_method("RCB")
    partitioner.Zoltan_Set_Param("DEBUG_LEVEL", "0")
    return partitioner


def plug_in_is_active():
    program = ctypes.CDLL(None)
    return hasattr(program, "RRCB_Zoltan_Active") and program.RRCB_Zoltan_Active() == 1


def ids_after_moving(partitioner, ids):
    ids = set(ids.tolist())
    ids -= set(partitioner.exportGlobalids.get_npy_array()[: partitioner.numExport].tolist())
    return ids | set(partitioner.importGlobalids.get_npy_array()[: partitioner.numImport].tolist())


def main():
    comm = mpi.COMM_WORLD
    expected = "plug-in" in sys.argv[1:]
    numbers = [int(word) for word in sys.argv[1:] if word != "plug-in"]
    own_ids = ids_of(comm, numbers[0] if numbers else 1000)
    partitioner = partitioner_of(comm, own_ids)
    partitioner.Zoltan_LB_Balance()
    ids = ids_after_moving(partitioner, own_ids)
    total = comm.allreduce(len(ids))
    imbalance = comm.allreduce(len(ids), mpi.MAX) * comm.size / total
    sums = comm.allreduce(sum(ids)), comm.allreduce(sum(id**2 for id in ids))
    if comm.rank == 0:
        print(f"result objects {total} imbalance {imbalance:.4f} answer {sums[0]} {sums[1]}")
        print(f"plug-in active: {plug_in_is_active()}")
    return 0 if imbalance < 1.02 and plug_in_is_active() == expected else 1


sys.exit(main())
