"""The loop of examples/loop in Python. It prints the same numbers on the same number of ranks, and
writes the same file."""
import os
import sys

import numpy as np
from mpi4py import MPI

import rrcb

comm = MPI.COMM_WORLD
RADIUS = 0.01
TRAVEL = 0.005  # largest distance that a particle moves in a step
STRIDE = 104  # number of cells in a row, with empty cells at the ends

# Here loads and the cost of a rebalance are numbers of pairs, so that all runs print the same. A
# simulation uses the seconds of its own work, and those of its rebalances including the migration.
COST = 100_000.0


def strip():
    """Returns this rank's strip of a unit square of 200 x 200 particles."""
    rows = np.arange(200 * comm.rank // comm.size, 200 * (comm.rank + 1) // comm.size)
    i, j = np.meshgrid(rows, np.arange(200), indexing="ij")
    return np.stack([(i.ravel() + 0.5) / 200, (j.ravel() + 0.5) / 200], axis=1)


def count_neighbours(x, count):
    """Counts for each of the first `count` particles how many of x are within the radius."""
    cells = np.floor(x / RADIUS).astype(int) + 2
    numbers = cells @ [STRIDE, 1]
    order = np.argsort(numbers, kind="stable")
    ends = np.cumsum(np.bincount(numbers, minlength=STRIDE**2))
    neighbours = np.zeros(count)
    for row in (-1, 0, 1):  # Three neighbouring cells of a row are consecutive.
        middle = numbers[:count] + row * STRIDE
        first = ends[middle - 2]
        lengths = ends[middle + 1] - first
        point = np.repeat(np.arange(count), lengths)
        within = np.arange(len(point)) - np.repeat(np.cumsum(lengths) - lengths, lengths)
        other = order[np.repeat(first, lengths) + within]
        near = np.hypot(*(x[point] - x[other]).T) <= RADIUS
        neighbours += np.bincount(point[near], minlength=count)
    return neighbours


def write_run(path, *records):
    """Writes records on rank 0: the number of values, then the values. Arrays are gathered from all
    ranks."""
    gathered = [comm.gather(r.ravel()) if isinstance(r, np.ndarray) else r for r in records]
    if comm.rank == 0:
        with open(path, "wb") as file:
            for record in gathered:
                values = record if isinstance(record, bytes) else np.concatenate(record)
                np.uint64(len(values)).tofile(file)
                file.write(bytes(values))


def read_run(path):
    """Returns the records. Of the arrays each rank gets its part, or an equal share if the number
    of ranks differs."""
    with open(path, "rb") as file:

        def next_of(kind):
            return np.fromfile(file, kind, int(np.fromfile(file, np.uint64, 1)[0]))

        numbers = next_of(float)
        states = [next_of(np.uint8).tobytes() for _ in range(3)]
        sizes, x, columns = next_of(float), next_of(float), next_of(float)
    begins = np.cumsum(np.append(0, sizes)).astype(int) // 2
    if len(sizes) != comm.size:
        states[2] = b""
        begins = begins[-1] * np.arange(comm.size + 1) // comm.size
    mine = slice(*begins[comm.rank : comm.rank + 2])
    return numbers, states, x.reshape(-1, 2)[mine].copy(), columns.reshape(-1, 2)[mine].copy()


num_steps = int(sys.argv[1]) if len(sys.argv) > 1 else 100
path = sys.argv[2] if len(sys.argv) > 2 else None
cuts = None
if path and os.path.exists(path):
    (first, rebalances, heaviest, total), saved, x, columns = read_run(path)
    controller = rrcb.Controller.load(saved[0], comm)
    model = rrcb.experimental.CostModel.load(saved[1], controller, comm)
    if saved[2]:
        cuts = rrcb.Cuts.load(saved[2])
        near = rrcb.Neighbours(cuts, RADIUS, TRAVEL, comm=comm)
    if comm.rank == 0:
        print(f"continued at step {first:.0f}: {model.report()}")
else:
    first = rebalances = heaviest = total = 0.0
    x = strip()
    columns = np.zeros((len(x), 2))
    controller = rrcb.Controller(comm)
    model = rrcb.experimental.CostModel(controller, 2, comm)
with controller, model:
    for step in range(int(first), num_steps):
        if cuts is None or controller.due:
            balance = rrcb.balance(x, weights=model.weights(columns), comm=comm, previous=cuts)
            x = balance.transfer(x)
            cuts = balance.cuts
            near = rrcb.Neighbours(cuts, RADIUS, TRAVEL, comm=comm)
            controller.rebalanced(balance.report, COST)
            rebalances += 1
        else:
            x = near.migrate(x, x)
        near.find_ghosts(x)
        neighbours = count_neighbours(np.concatenate([x, near.fetch(x)]), len(x))
        columns = np.stack([np.ones(len(x)), neighbours], axis=1)
        load = neighbours.sum()
        # All particles move towards the wall at x = 0, where they become dense.
        x[:, 0] -= 0.02 * x[:, 0] * (1 - x[:, 0])
        model.step(load, [len(x), load])
        heaviest += comm.allreduce(load, MPI.MAX)
        total += comm.allreduce(load)
    if path:
        numbers = np.array([num_steps, rebalances, heaviest, total] if comm.rank == 0 else [])
        states = controller.save(), model.save(), cuts.save()
        write_run(path, numbers, *states, np.array([2.0 * len(x)]), x, columns)
if comm.rank == 0:
    print(f"{total:.0f} pairs of neighbours met in {num_steps} steps")
    print(f"{rebalances:.0f} rebalances, mean imbalance {heaviest * comm.size / total:.9f}")

# Output on 4 ranks:
# 66744352 pairs of neighbours met in 100 steps
# 6 rebalances, mean imbalance 1.101568684
