"""Checks rrcb.mpipartition against all points of all ranks."""
import itertools
import sys

import numpy as np

import rrcb
import runner
from rrcb._arrays import Columns
from rrcb.mpipartition import Partition, distribute, exchange, overload
from runner import comm, on_rank, same_error
from test_rrcb import ME, RANKS, everywhere, ids

BOX = 50.0


def catalogue(dimensions, count=400):
    """A clustered catalogue: half of the points in a tenth of the box."""
    rng = np.random.default_rng([7, ME])
    x = rng.random((count, dimensions)) * BOX
    x[::2] *= 0.1
    data = {key: np.ascontiguousarray(x[:, axis]) for axis, key in enumerate("xyzuv"[:dimensions])}
    return {**data, "id": ids(count), "group": rng.integers(-1, 60, count) + 100 * ME}


def keys_of(dimensions):
    return list("xyzuv"[:dimensions])


def stack(data, dimensions):
    return np.stack([data[key] for key in keys_of(dimensions)], axis=1)


def test_divides_the_cube_evenly_at_first():
    for dimensions in (1, 2, 3, 4):
        partition = Partition(dimensions)
        volumes = np.prod(partition.boxes[:, 1] - partition.boxes[:, 0], axis=1)
        assert np.allclose(volumes, 1 / RANKS) and partition.ranklist.ndim == dimensions
        assert np.allclose(partition.extent, partition.boxes[ME, 1] - partition.origin)


def test_distributes_evenly():
    for dimensions in (1, 2, 3, 4):
        partition, data = Partition(dimensions, comm=comm), catalogue(dimensions)
        got = distribute(partition, BOX, data, keys_of(dimensions))
        counts = comm.allgather(len(got["id"]))
        assert max(counts) <= 1.01 * np.mean(counts) + 1
        assert sorted(everywhere(got["id"])) == sorted(everywhere(data["id"]))
        lower, upper = partition.boxes[ME]
        x = stack(got, dimensions) / BOX
        assert (x >= lower).all() and (x <= upper).all()
        again = distribute(partition, BOX, got, keys_of(dimensions))
        assert np.array_equal(again["id"], got["id"])


def test_an_empty_catalogue_leaves_the_partition_to_the_next():
    partition, none = Partition(2, comm=comm), catalogue(2, 0)
    assert len(distribute(partition, BOX, none, keys_of(2))["id"]) == 0
    got = distribute(partition, BOX, catalogue(2), keys_of(2))
    assert max(comm.allgather(len(got["id"]))) <= 1.01 * 400 + 1
    few = Partition(2, comm=comm)
    distribute(few, BOX, catalogue(2, int(ME == 0)), keys_of(2))
    assert min(few.extent) >= 0


def expected(partition, data, dimensions, length):
    """Returns the ids of points of other ranks in the margin of this rank's part."""
    x, owner = everywhere(stack(data, dimensions)), everywhere(np.full(len(data["id"]), ME))
    lower, upper = partition.boxes[ME] * BOX
    near = np.zeros(len(x), dtype=bool)
    for shift in itertools.product((-BOX, 0, BOX), repeat=dimensions):
        image = x + shift
        near |= ((image >= lower - length) & (image < upper + length)).all(axis=1)
    return everywhere(data["id"])[near & (owner != ME)]


def test_overloads():
    for dimensions, length in itertools.product((1, 2, 3), (0.0, 2.0, 0.4 * BOX)):
        partition = Partition(dimensions, comm=comm)
        data = distribute(partition, BOX, catalogue(dimensions), keys_of(dimensions))
        got = overload(partition, BOX, data, length, keys_of(dimensions))
        here = len(data["id"])
        assert np.array_equal(got["id"][:here], data["id"])
        assert sorted(got["id"][here:]) == sorted(expected(partition, data, dimensions, length))


def test_overloads_structures():
    partition = Partition(2, comm=comm)
    data = distribute(partition, BOX, catalogue(2), keys_of(2))
    # Structures of one rank, as mpipartition takes them.
    data["group"] = np.where(data["id"] % 5 == 0, -1, data["id"] % 20 + 1000 * ME)
    got = overload(partition, BOX, data, 2.0, keys_of(2), structure_key="group")
    all_ids, all_groups = everywhere(data["id"]), everywhere(data["group"])
    near = set(expected(partition, data, 2, 2.0))
    tags = {g for k, g in zip(all_ids, all_groups) if k in near and g != -1}
    wanted = near | {k for k, g in zip(all_ids, all_groups) if g in tags}
    assert set(got["id"][len(data["id"]) :]) == wanted - set(data["id"])
    assert len(set(got["id"])) == len(got["id"])


def test_raises_on_every_rank():
    partition, data = Partition(2, comm=comm), catalogue(2)
    outside = {**data, "x": data["x"] + on_rank(RANKS - 1, BOX, 0.0)}
    if RANKS > 1:
        same_error(lambda: distribute(partition, BOX, outside, keys_of(2)), "between 0 and the box")
        same_error(lambda: overload(partition, BOX, outside, 1.0, keys_of(2)), "between 0")
        columns = Columns(data, len(data["id"]), "points", 0)
        beyond = {(ME + 1) % RANKS: np.array([on_rank(RANKS - 1, 400, 0)])}
        same_error(lambda: exchange(comm, columns, beyond), "out of bounds")
    same_error(lambda: partition.neighbors, "neighbor_ranks")
    same_error(lambda: Partition(2, create_neighbor_topo=True), "topology")
    assert isinstance(rrcb.Error("text"), RuntimeError)


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
