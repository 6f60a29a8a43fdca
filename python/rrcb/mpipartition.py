"""The interface of the package mpipartition, with parts of equal load in place of equal blocks.

    from rrcb.mpipartition import Partition, distribute, overload

The first distribute() of a partition balances its points; later ones use the same cuts, so that
several catalogues stay together. Parts are boxes, but not those of a Cartesian grid. Any number of
ranks and any overload length can be used.
"""

from __future__ import annotations

import math
from typing import Any, Sequence

import numpy as np
from mpi4py import MPI

from . import _library as c
from ._agreement import communicator, prepare
from ._arrays import Array, Columns
from ._balance import Distribution, assign_all, balance
from ._cuts import CUT, Cuts
from ._ghosts import Ghosts

__all__ = ["Partition", "distribute", "overload"]

Data = dict[str, Array]


def even_cuts(dimension: int, num_parts: int) -> Cuts:
    """Returns the cuts of the unit cube into parts of one volume."""
    tree = np.zeros(num_parts - 1, dtype=CUT)
    tree["at"] = -np.inf

    def divide(node: int, parts: int, lower: Array, upper: Array) -> None:
        if parts == 1:
            return
        axis = int(np.argmax(upper - lower))
        below = parts // 2
        at = lower[axis] + (upper[axis] - lower[axis]) * below / parts
        tree[node]["axis"] = axis
        tree[node]["at"][axis] = at
        middle_upper, middle_lower = upper.copy(), lower.copy()
        middle_upper[axis] = middle_lower[axis] = at
        divide(node + 1, below, lower, middle_upper)
        divide(node + below, parts - below, middle_lower, upper)

    divide(0, num_parts, np.zeros(dimension), np.ones(dimension))
    return Cuts(dimension, num_parts, tree)


class Partition:
    """A partition of the unit cube among the ranks of `comm`, as mpipartition.Partition.

    With more than three dimensions the first three are divided.
    """

    def __init__(
        self,
        dimensions: int = 3,
        *,
        comm: MPI.Intracomm | None = None,
        create_neighbor_topo: bool = False,
        commensurate_topo: list[int] | None = None,
    ) -> None:
        if dimensions < 1:
            raise c.Error(f"dimensions must be 1 or more, not {dimensions}")
        if create_neighbor_topo or commensurate_topo is not None:
            raise c.Error("parts of equal load have no Cartesian topology: use neighbor_ranks")
        self.comm = communicator(comm)
        self.dimensions = dimensions
        self.rank = self.comm.Get_rank()
        self.nranks = self.comm.Get_size()
        #: ranks along each axis of the grid of mpipartition, on which the parts are not
        self.decomposition = MPI.Compute_dims(self.nranks, [0] * dimensions)
        #: whether the cuts are those of points
        self.balanced = False
        self._use(even_cuts(min(dimensions, 3), self.nranks))

    def _use(self, cuts: Cuts) -> None:
        self.cuts = cuts
        boxes = np.zeros((self.nranks, 2, self.dimensions))
        boxes[:, 1] = 1.0
        boxes[:, :, : cuts.dimension] = np.clip(cuts.boxes(), 0.0, 1.0)
        #: lower and upper corners of all parts, (nranks, 2, dimensions)
        self.boxes = boxes

    def balance(
        self,
        box_size: float,
        data: Data,
        coord_keys: Sequence[str],
        weights: Any = None,
        tolerance: float | None = None,
    ) -> Distribution:
        """Chooses the cuts for points, if there are any. Collective."""
        x = prepare(self.comm, lambda: positions_of(self, box_size, data, coord_keys))
        made = balance(x, weights, self.comm, tolerance)
        if made.report.num_points > 0:
            self._use(made.cuts)
            self.balanced = True
        return made

    @property
    def origin(self) -> list[float]:
        """Lower corner of this rank's part."""
        return [float(x) for x in self.boxes[self.rank, 0]]

    @property
    def extent(self) -> list[float]:
        """Length of this rank's part along each axis."""
        return [max(0.0, float(x)) for x in self.boxes[self.rank, 1] - self.boxes[self.rank, 0]]

    @property
    def ranklist(self) -> Array:
        """All ranks, in the shape of `decomposition`."""
        return np.arange(self.nranks, dtype=np.int32).reshape(self.decomposition)

    @property
    def neighbor_ranks(self) -> list[int]:
        """Ranks whose parts touch this rank's part in the periodic cube."""
        lower, upper = self.boxes[self.rank]
        others = self.boxes
        touches = np.ones(self.nranks, dtype=bool)
        for axis in range(self.dimensions):
            along = np.zeros(self.nranks, dtype=bool)
            for shift in (-1.0, 0.0, 1.0):
                along |= (others[:, 0, axis] + shift <= upper[axis]) & (
                    others[:, 1, axis] + shift >= lower[axis]
                )
            touches &= along
        return [int(rank) for rank in np.flatnonzero(touches) if rank != self.rank]

    @property
    def neighbors(self) -> Array:
        """Raises Error: parts have no Cartesian neighbours."""
        raise c.Error("parts of equal load have no Cartesian neighbors: use neighbor_ranks")

    def get_neighbor(self, di: list[int]) -> int:
        """Raises Error: parts have no Cartesian neighbours."""
        return int(self.neighbors[tuple(di)])


def positions_of(
    partition: Partition, box_size: float, data: Data, coord_keys: Sequence[str]
) -> Array:
    """Returns positions in the unit cube along the axes that are divided."""
    if len(coord_keys) != partition.dimensions:
        raise c.Error(f"coord_keys must name {partition.dimensions} columns, not {len(coord_keys)}")
    for key in coord_keys:
        values = np.asarray(data[key])
        if not ((values >= 0) & (values <= box_size)).all():
            raise c.Error(f"positions {key} must be between 0 and the box size {box_size}")
    keys = coord_keys[: partition.cuts.dimension]
    return np.stack([np.asarray(data[key], dtype=np.float64) / box_size for key in keys], axis=1)


def distribute(
    partition: Partition,
    box_size: float,
    data: Data,
    coord_keys: list[str],
    *,
    verbose: bool | int = False,
    verify_count: bool = True,
    all2all_iterations: int = 1,
) -> Data:
    """Returns the data of this rank's part. Collective.

    The first call for a partition balances it. `verify_count` and `all2all_iterations` have no
    effect: points are always counted, and messages have a bounded size.
    """
    if partition.nranks == 1:
        return data
    if partition.balanced:
        x = prepare(partition.comm, lambda: positions_of(partition, box_size, data, coord_keys))
        assigned = assign_all(x, partition.cuts, partition.comm)
    else:
        assigned = partition.balance(box_size, data, coord_keys)
    moved: Data = assigned.distribute(data)
    if verbose:
        print_counts(partition, len(moved[coord_keys[0]]), "points after distribute")
    return moved


def print_counts(partition: Partition, count: int, what: str) -> None:
    """Prints the counts of all ranks. Collective."""
    counts = partition.comm.gather(count)
    if counts is not None:
        print(f"{what}: {min(counts)} to {max(counts)} per rank, {sum(counts)} in all", flush=True)


def overload(
    partition: Partition,
    box_size: float,
    data: Data,
    overload_length: float,
    coord_keys: list[str],
    *,
    structure_key: str | None = None,
    verbose: bool | int = False,
) -> Data:
    """Returns this rank's data and copies of those of other ranks near its part. Collective.

    Copies points that are nearer than `overload_length` along every axis in the periodic box, once
    for each rank, with their original positions; with `structure_key` also the sender's other
    points of their structures, which are integers (-1: none).
    """
    if partition.nranks == 1:
        return data
    comm = partition.comm
    own = c.OwnedHandle("create_fortran", "destroy", communicator(comm).py2f())

    def local() -> tuple[Array, Columns, Array | None, float]:
        x = positions_of(partition, box_size, data, coord_keys)
        columns = Columns(data, len(x), "points", 0)
        tags = None if structure_key is None else np.asarray(data[structure_key])
        partition.cuts.give(own)
        return x, columns, tags, float(overload_length / box_size)

    def signature(made: tuple[Array, Columns, Array | None, float]) -> str:
        return made[1].signature()

    x, columns, tags, length = prepare(comm, local, signature)
    # The cube around a part's box with the margin `length` is in the ball of this radius.
    near = Ghosts(comm, own, x, length * math.sqrt(x.shape[1]) * (1 + 1e-12), 1.0)
    rows = {}
    for rank, found in near.sent.items():
        if rank != partition.rank:
            inside = in_margin(x[found], partition.boxes[rank][:, : x.shape[1]], length)
            rows[rank] = np.unique(found[inside])
    if tags is not None:
        rows = {rank: with_structures(found, tags) for rank, found in rows.items()}
    arrived = exchange(comm, columns, rows)
    result = {name: np.concatenate([data[name], arrived[name]]) for name in data}
    if verbose:
        print_counts(partition, len(result[coord_keys[0]]), "points after overload")
    return result


def in_margin(x: Array, box: Array, length: float) -> Array:
    """Returns which points are in the box with a margin, in the periodic unit cube."""
    inside = np.ones(len(x), dtype=bool)
    for axis in range(x.shape[1]):
        along = np.zeros(len(x), dtype=bool)
        for shift in (-1.0, 0.0, 1.0):
            image = x[:, axis] + shift
            along |= (image >= box[0, axis] - length) & (image < box[1, axis] + length)
        inside &= along
    return inside


def with_structures(rows: Array, tags: Array) -> Array:
    """Returns rows, and all rows with the tags of those."""
    found = np.unique(tags[rows])
    return np.union1d(rows, np.flatnonzero(np.isin(tags, found[found != -1])))


def exchange(comm: MPI.Intracomm, columns: Columns, rows: dict[int, Array]) -> Data:
    """Returns the rows that other ranks send to this one. Collective."""
    size = comm.Get_size()
    sent = np.array([len(rows.get(rank, ())) for rank in range(size)], dtype=np.int64)
    received = np.empty_like(sent)
    comm.Alltoall(sent, received)
    order = np.concatenate([rows[k] for k in sorted(rows)] or [np.empty(0, dtype=int)]).astype(int)
    count = int(received.sum())

    def local() -> list[tuple[Array, Array]]:
        return [(a[order], np.empty((count, *a.shape[1:]), a.dtype)) for a in columns.arrays]

    results = {}
    for name, (here, there) in zip(columns.names, prepare(comm, local)):
        row = MPI.BYTE.Create_contiguous(there.itemsize * math.prod(there.shape[1:])).Commit()
        comm.Alltoallv([here, sent, None, row], [there, received, None, row])
        row.Free()
        results[name] = there
    return results
