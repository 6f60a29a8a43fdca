"""Own parts, other numbers of parts, their weights, and groups of points."""
import sys

import numpy as np

import rrcb
import runner
from runner import comm, same_error

RANKS, RANK = comm.size, comm.rank


def positions(count=200):
    return np.random.default_rng(RANK).random((count, 2))


def test_moves_points_to_any_parts():
    x = positions()
    to = (np.arange(200) + RANK) % RANKS
    here = rrcb.plan(to, comm=comm).transfer({"from": np.full(200, RANK), "to": to, "x": x})
    assert np.all(here["to"] == RANK)
    sent = comm.allgather(np.bincount(to, minlength=RANKS))
    assert np.array_equal(np.bincount(here["from"], minlength=RANKS), [n[RANK] for n in sent])
    same_error(lambda: rrcb.plan(to + RANKS, RANKS, comm), "parts")
    same_error(lambda: rrcb.plan(runner.on_rank(RANKS - 1, x, to), RANKS, comm), "parts must be integers")
    same_error(lambda: rrcb.plan(to, 0, comm), "")
    if RANKS > 1:
        same_error(lambda: rrcb.plan(to, RANKS + (RANK == 0), comm), "num_parts")


def test_weighs_parts_and_moves():
    x, weights = positions(), np.arange(200.0)
    balance = rrcb.balance(x, weights, comm, num_parts=3)
    mine = np.bincount(balance.parts, weights, minlength=3)
    assert np.allclose(balance.part_weights(weights), comm.allreduce(mine))
    assert np.array_equal(balance.part_weights(), comm.allreduce(np.bincount(balance.parts, minlength=3)))
    whole = rrcb.balance(x, weights, comm)
    leaves = comm.allreduce(weights[whole.parts != RANK].sum()) / comm.allreduce(weights.sum())
    assert np.isclose(whole.moved_fraction(weights), leaves)
    same_error(lambda: whole.part_weights(weights[1:]), "weights must have the shape")


def test_gives_parts_sizes_for_even_loads():
    sizes = rrcb.balanced_sizes([1, 2, 4])
    expected = np.array([1, 2, 4]) ** -0.7
    assert np.allclose(sizes, 3 * expected / expected.sum())
    assert np.allclose(rrcb.balanced_sizes([5, 5], sizes[:2]), sizes[:2])
    same_error(lambda: rrcb.balanced_sizes([1, -1]), "loads must be finite, 0 or more")
    same_error(lambda: rrcb.balanced_sizes([1, 1], [1]), "one entry per part: 2, not 1")


def test_gives_parts_the_numbers_with_which_points_stay():
    x = rrcb.balance(positions(), comm=comm).transfer(positions())
    turned = x[:, ::-1].copy()  # the same boxes under other numbers
    balance = rrcb.balance(turned, comm=comm)
    kept = balance.remap()
    assert sorted(kept.numbers) == list(range(RANKS))
    assert np.array_equal(kept.parts, kept.numbers[balance.parts])
    assert kept.moved_fraction() <= balance.moved_fraction()
    assert np.array_equal(balance.remap(balance.parts).parts, balance.parts)
    here = kept.transfer(turned)
    everything = np.concatenate(comm.allgather(turned))
    box = balance.cuts.boxes()[list(kept.numbers).index(RANK)]
    outside = np.maximum(np.maximum(box[0] - everything, everything - box[1]), 0)
    near = int(np.sum(np.hypot(*outside.T) <= 0.05)) - len(here)
    assert kept.ghosts(here, 0.05).count == near
    same_error(lambda: balance.remap(balance.parts[1:]), "parts must have the shape")


def test_keeps_groups_together():
    x = positions()
    keys = np.arange(200) // 2 + 1000  # of all ranks
    weights = np.full(200, 0.5)
    groups = rrcb.groups(x, keys, weights, comm)
    assert comm.allreduce(len(groups.x)) == 100
    assert np.all(groups.weights == RANKS)
    balance = rrcb.balance(groups.x, groups.weights, comm)
    parts = groups.to_points(balance.parts)
    here = rrcb.plan(parts, comm=comm).transfer({"key": keys, "x": x})
    held = comm.allgather(np.unique(here["key"]))
    assert len(np.unique(np.concatenate(held))) == sum(map(len, held)) == 100
    sums = groups.sums(np.column_stack([weights, x]))
    assert np.allclose(sums[:, 0], groups.weights)
    assert np.allclose(sums[:, 1:] / (2 * RANKS), groups.x)
    alone = rrcb.groups(x, np.full(200, -1), comm=comm)
    assert comm.allreduce(len(alone.x)) == 200 * RANKS
    same_error(lambda: rrcb.groups(x, runner.on_rank(0, keys[1:], keys), comm=comm), "keys must have")
    same_error(lambda: rrcb.groups(x, keys, comm=comm, place="x"), "place must be one of")
    same_error(lambda: groups.sums(weights[1:]), "values must have a row")


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
