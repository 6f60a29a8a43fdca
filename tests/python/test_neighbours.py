"""Checks exchanges with neighbours against transfer() and ghosts(), which are collective."""
import sys

import numpy as np

import rrcb
import runner
from runner import comm, on_rank

RANKS, ME = comm.size, comm.rank
RADIUS, TRAVEL = 0.1, 0.05


def cloud(dtype=np.float64):
    """Points of this rank in the unit square, numbered; none on the last of several ranks."""
    rng = np.random.default_rng([7, ME])
    count = 0 if ME == RANKS - 1 > 0 else 300
    x = rng.random((count, 2)).astype(dtype)
    return {"x": x, "id": np.arange(count, dtype=np.int64) + 1000 * ME}


def balanced(dtype=np.float64):
    points = cloud(dtype)
    balance = rrcb.balance(points["x"], comm=comm)
    return balance, balance.transfer(points)


def drift(x, ids, step):
    moved = x + 0.5 * TRAVEL * np.sin(ids[:, np.newaxis] + 7 * step + np.array([0, 2]))
    return (moved - np.floor(moved)).astype(x.dtype)


def error_of(call):
    """The text of the error that reaches every rank, within as many calls as there are ranks."""
    for _ in range(RANKS + 1):
        try:
            call()
        except rrcb.Error as error:
            return str(error)
    raise AssertionError("no error")


def by_id(data):
    order = np.argsort(data["id"])
    return {name: values[order] for name, values in data.items()}


def check_steps(dtype, needs="scatter", radii=False):
    balance, here = balanced(dtype)
    neighbours = rrcb.Neighbours(balance, RADIUS, TRAVEL, period=1.0, needs=needs)
    assert ME not in neighbours.ranks and (np.diff(neighbours.ranks) > 0).all()
    for step in range(4):
        here["x"] = drift(here["x"], here["id"], step)
        before = {name: values.copy() for name, values in here.items()}
        assigned = rrcb.assign(here["x"], balance, comm)
        expected = assigned.transfer(here)
        moved = neighbours.migrate(here["x"], here)
        assert all(np.array_equal(before[name], here[name]) for name in here)
        here = moved
        a, b = by_id(here), by_id(expected)
        assert all(np.array_equal(a[name], b[name]) and a[name].dtype == b[name].dtype for name in a)

        x, ids = here["x"], here["id"]
        each = np.where(ids % 3, RADIUS, RADIUS / 2) if radii else RADIUS
        ghosts = rrcb.assign(x, balance, comm).ghosts(x, each, period=1.0, needs=needs)
        neighbours.find_ghosts(x, each if radii else None)
        assert neighbours.count == 0 and neighbours.sent.keys() == ghosts.sent.keys()
        for _ in range(2):
            near_ids, near_tags = neighbours.fetch((ids, x.astype("S9")))
            assert np.array_equal(near_ids, ghosts.fetch(ids))
            assert np.array_equal(near_tags, ghosts.fetch(x.astype("S9")))
        assert neighbours.count == ghosts.count
        near = neighbours.fetch_positions(x)
        assert near.dtype == x.dtype and np.array_equal(near, ghosts.fetch_positions(x))
        sums = neighbours.accumulate({"id": near_ids, "x": near})
        other = ghosts.accumulate({"id": near_ids, "x": near})
        assert all(np.array_equal(sums[name], other[name]) for name in other)


def test_gives_what_collective_calls_give():
    check_steps(np.float64)
    check_steps(np.float32)
    check_steps(np.float64, "symmetric", radii=True)


def test_takes_cuts_columns_and_single_arrays():
    balance, here = balanced()
    neighbours = rrcb.Neighbours(balance.cuts, travel=TRAVEL, comm=comm)
    x = tuple(here["x"].T)
    a, b, ids = neighbours.migrate(x, (*x, here["id"]))
    assert np.array_equal(np.stack([a, b], axis=1), here["x"]) and len(ids) == len(a)
    alone = neighbours.migrate(here["x"], here["x"])
    assert np.array_equal(alone, here["x"]) and alone is not here["x"]


def test_adds_shared_rows():
    balance, _ = balanced()
    neighbours = rrcb.Neighbours(balance, RADIUS)
    values = np.array([[1.0, 2.0], [10.0 * (ME + 1), ME]])
    shared = {int(rank): [1] for rank in neighbours.ranks}
    summed = neighbours.sum(shared, values)
    group = np.sort([*neighbours.ranks, ME])
    assert np.array_equal(summed, [[1.0, 2.0], [10.0 * np.sum(group + 1), np.sum(group)]])
    assert values[1, 1] == ME


def test_refuses_columns_of_other_types():
    balance, here = balanced()
    neighbours = rrcb.Neighbours(balance, RADIUS, TRAVEL)
    ids = on_rank(0, here["id"].astype(np.float64), here["id"])
    if RANKS > 1:
        assert "on rank" in error_of(lambda: neighbours.migrate(here["x"], (here["x"], ids)))
    neighbours = rrcb.Neighbours(balance, RADIUS, TRAVEL)
    text = error_of(lambda: neighbours.migrate(here["x"], on_rank(0, here["id"][1:], here["id"])))
    assert "but there are" in text if ME == 0 else "rank 0" in text, text
    neighbours = rrcb.Neighbours(balance, RADIUS, TRAVEL)
    neighbours.find_ghosts(here["x"])
    near = neighbours.fetch(here["x"])
    text = error_of(lambda: neighbours.accumulate(on_rank(0, near.astype(complex), near)))
    assert "complex" in text if ME == 0 else "rank 0" in text, text


def test_names_a_far_jump():
    balance, here = balanced()
    neighbours = rrcb.Neighbours(balance, RADIUS, TRAVEL, period=1.0)
    x = here["x"].copy()
    if ME == 0:
        x[0] = 1.7
    text = error_of(lambda: neighbours.migrate(x, (x, here["id"])))
    assert "rank 0: point 0 (the first is 0)" in text, text
    assert "make other Neighbours" in error_of(lambda: neighbours.migrate(x, x))
    rrcb.Neighbours(balance, RADIUS, TRAVEL).migrate(here["x"], here)


def test_refuses_bad_options():
    balance, _ = balanced()
    runner.same_error(lambda: rrcb.Neighbours(balance), "cutoff and travel are both 0")
    runner.same_error(lambda: rrcb.Neighbours(balance, on_rank(0, "near", 0.1)), "must be numbers")
    runner.same_error(lambda: rrcb.Neighbours(balance, 0.1, needs="all"), "needs must be one of")
    if RANKS > 1:
        runner.same_error(lambda: rrcb.Neighbours(balance, on_rank(0, 0.2, 0.1)), "the cutoff")


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
