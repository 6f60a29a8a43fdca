"""Checks the memory of repeated calls, and communicators that are freed."""
import gc
import resource
import sys

import numpy as np

import rrcb
import runner
from runner import comm, same_error
from test_rrcb import ME, cloud

MANY = 200_000


def faults_of(call):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    result = call()
    return result, resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before


def test_repeated_balances_get_no_pages():
    x = np.random.default_rng(ME).random((MANY, 3))
    pages_of_parts = 4 * MANY // resource.getpagesize()
    balance, faults = None, []
    for _ in range(20):
        # A result is freed when the next one is made, as in a loop.
        balance, found = faults_of(lambda: rrcb.balance(x, comm=comm, previous=balance))
        faults.append(found)
    assert sum(faults[10:]) < pages_of_parts / 4, faults


def resident():
    """Bytes of memory of this process."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def round_of(x, kept):
    balance = rrcb.balance(x, comm=comm, previous=kept)
    here = balance.transfer({"x": x, "id": np.arange(len(x))})
    ghosts = balance.ghosts(here["x"], 0.05, 1.0)
    near = ghosts.fetch(here)
    ghosts.accumulate(near["id"])
    same_error(lambda: balance.transfer(np.zeros(1 + len(x) * 2)), "points")
    return balance


def test_many_rounds_keep_no_memory():
    x = cloud(2, 300)
    kept = None
    sizes = []
    for step in range(300):
        kept = round_of(x, kept if step % 3 else None)
        if step % 50 == 49:
            gc.collect()
            sizes.append(resident())
    assert sizes[-1] - sizes[1] < 2 << 20, sizes


def test_many_communicators_keep_no_memory():
    x = cloud(2, 50)
    sizes = []
    for step in range(300):
        part = comm.Split(ME % 2, ME)
        rrcb.balance(x, comm=part).transfer(x)
        part.Free()
        if step % 50 == 49:
            gc.collect()
            sizes.append(resident())
    assert sizes[-1] - sizes[1] < 4 << 20, sizes


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
