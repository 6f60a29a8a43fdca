"""Checks that an error of one rank is raised on all."""
import copy
import pickle
import sys
import unittest.mock

import numpy as np
from mpi4py import MPI

import rrcb
import runner
from runner import Skip, comm, on_rank, same_error
from test_rrcb import RANKS, check_balance, cloud


def test_names_the_calls_of_ranks_that_differ():
    if RANKS == 1:
        raise Skip("a single rank")
    x = cloud(2)
    balance = rrcb.balance(x, comm=comm)
    controller = rrcb.Controller(comm)

    def different():
        if comm.rank == 1:
            rrcb.assign(x, balance, comm)
        else:
            balance.ghosts(x, 0.1)

    same_error(different, "rank 0 calls ghost_plan, rank 1 calls rrcb_balancer_create (Python: balance, assign);")
    same_error(lambda: controller.step(1), "make another controller")
    controller.free()
    assert rrcb.balance(x, comm=comm).report == balance.report


class CudaArray:
    """As arrays of CuPy and Numba: the host must not touch the address."""

    __cuda_array_interface__ = {"shape": (8, 2), "typestr": "<f8", "data": (16, False), "version": 3}

    def __array__(self, *_, **__):
        raise AssertionError("was read")


class DeviceTensor:
    """As tensors of DLPack on a device of ROCm."""

    def __dlpack_device__(self):
        return 10, 0

    def __array__(self, *_, **__):
        raise AssertionError("was read")


def test_refuses_arrays_on_a_device():
    last = RANKS - 1
    x = cloud(2)
    balance = rrcb.balance(x, comm=comm)
    for array in (CudaArray(), DeviceTensor()):
        given = on_rank(last, array, x)
        weights = on_rank(last, array, np.ones(len(x)))
        axes = on_rank(last, (array, array), (x[:, 0], x[:, 1]))
        text = f"{type(array).__name__} is on a device, which Python calls cannot read: copy it"
        same_error(lambda: rrcb.balance(given, comm=comm), text)
        same_error(lambda: rrcb.balance(axes, comm=comm), text)
        same_error(lambda: rrcb.balance(x, weights=weights, comm=comm), text)
        same_error(lambda: balance.transfer({"x": given}), text)
        same_error(lambda: rrcb.experimental.join_keys(on_rank(last, array, x[:, :1].astype(int)), comm), text)


def test_raises_the_error_of_one_rank_on_all():
    last = RANKS - 1
    x = cloud(2)
    balance = rrcb.balance(x, comm=comm)
    nan = x.copy()
    nan[3] = np.nan
    for bad, text in (
        (x.astype(int), "must be float64 or float32, not int64"),
        (x.astype(np.float16), "float16"),
        (x.astype(">f8"), ">f8"),
        (x + 0j, "complex128"),
        (np.zeros((4, 4)), "1 to 3 axes, not 4"),
        (np.zeros((4, 2, 1)), "shape (n, d)"),
        ((x[:, 0], x[1:, 1]), "1-D arrays of one length"),
        ((x[:, 0], x[:, 1].astype("f4")), "one dtype"),
        ("text", "positions"),
        (np.ma.masked_less(x, 0.5), "masked"),
        (nan, ""),
    ):
        given = on_rank(last, bad, x)
        same_error(lambda: rrcb.balance(given, comm=comm), text)
    keys = np.zeros((len(x), 2), dtype=int)
    for bad, text in ((keys[1:], "shape"), (keys + 0.5, "integers"), (keys[:, 0], "(n, k)")):
        given = on_rank(last, bad, keys)
        if bad.shape != keys[1:].shape:
            same_error(lambda: rrcb.experimental.join_keys(given, comm), text)
        same_error(lambda: rrcb.groups(x, on_rank(last, bad[:, 0] if bad.ndim > 1 else bad[1:], keys[:, 0]), comm=comm), "keys")
    if RANKS > 1:
        same_error(lambda: rrcb.experimental.join_keys(on_rank(last, keys[:, :1], keys), comm), "of the shape (n, 1) on rank")
        same_error(lambda: rrcb.groups(x, keys[:, 0], comm=comm, place=on_rank(last, "first_point", "centre")), "place")
        given = on_rank(last, cloud(3), x)
        same_error(lambda: rrcb.balance(given, comm=comm), "dimension")
        different = on_rank(last, 1.2, 1.1)
        same_error(lambda: rrcb.balance(x, comm=comm, tolerance=different), "tolerance")
        earlier = on_rank(last, balance, None)
        same_error(lambda: rrcb.balance(x, comm=comm, previous=earlier), "previous differs between rank")
        alone = rrcb.balance(x, comm=MPI.COMM_SELF, num_parts=RANKS)
        same_error(lambda: rrcb.balance(x, comm=comm, previous=alone), "previous differs")
    for call in (
        lambda given: rrcb.balance(x, comm=comm, previous=given),
        lambda given: rrcb.assign(x, given, comm),
    ):
        same_error(lambda: call(on_rank(last, 3, balance)), "give a balance or its cuts, not int")
    for bad, text in ((["a"], "part_sizes must be numbers, not ['a']"), (np.ones(RANKS + 1), "")):
        given = on_rank(last, bad, np.ones(RANKS))
        same_error(lambda: rrcb.balance(x, comm=comm, part_sizes=given), text)
    for bad, text in ((np.ones(3), "weights must have the shape"), (["a"] * len(x), "numbers"),
                      (-np.ones(len(x)), "")):
        given = on_rank(0, bad, np.ones(len(x)))
        same_error(lambda: rrcb.balance(x, weights=given, comm=comm), text)
    for name, value, text in (
        ("nonsense", 1, "nonsense"),
        ("refine", "WRONG", "refine"),
        ("refine", None, "refine"),
        ("tolerence", 1.1, "did you mean imbalance_tolerance?"),
        ("cell_per_axis", 8, "did you mean cells_per_axis?"),
        ("tree__larger_below", 2, "tree__larger_below takes OFF or ON"),
    ):
        given = on_rank(last, {name: value}, {})
        same_error(lambda: rrcb.balance(x, comm=comm, **given), text)


class Silent(MPI.Intracomm):
    """A communicator on which Python sends nothing."""

    def Allreduce(self, *arguments, **options):
        raise AssertionError("sent")


def test_only_failures_cost_a_message():
    x, silent = cloud(2), Silent(comm)
    balance = rrcb.balance(x, comm=silent)
    rrcb.balance(x, comm=silent, previous=balance)
    here = rrcb.assign(x, balance, comm).transfer(x)
    assert rrcb.assign(x, balance, silent).ghosts(here, 0.1).num_points == len(here)


def test_raises_errors_of_columns_on_all():
    last = RANKS - 1
    x = cloud(2)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer(x)
    for bad, text in ((x[1:], "points"), (np.array([None] * len(x)), "fixed size"),
                      (np.float64(1), "shape")):
        given = on_rank(last, bad, x)
        same_error(lambda: balance.transfer(given), text)
    if RANKS > 1:
        for bad in ({"x": x}, {"y": x[:, 0], "x": x.astype("f4")}, {"y": x, "x": x}):
            given = on_rank(last, bad, {"x": x, "y": x[:, 0]})
            same_error(lambda: balance.transfer(given), "same on every rank")
        given = on_rank(last, x.astype("f4"), x)
        text = f"float64 (2,) on rank 0, but float32 (2,) on rank {last}: give the same"
        same_error(lambda: balance.transfer(given), text)
        given = on_rank(last, {"x": x[:, 0], "y": x}, {"x": x, "y": x})
        same_error(lambda: balance.transfer(given), f"but x: float64, y: float64 (2,) on rank {last}")
    same_error(lambda: balance.ghosts(here, on_rank(0, -1.0, 0.1)), "")
    same_error(lambda: balance.ghosts(here, on_rank(0, np.ones(len(here) + 1), 0.1)), "cutoff")
    same_error(lambda: balance.ghosts(here, on_rank(0, "a", 0.1)), "cutoff must be numbers, not 'a'")
    same_error(lambda: balance.ghosts(here, 0.1, on_rank(last, [1, 2, 3], 1.0)), "period")
    same_error(lambda: balance.ghosts(here, 0.1, on_rank(0, "b", 1.0)), "period must be numbers")
    same_error(lambda: balance.ghosts(here + 5.0, 0.1, 1.0), "")
    ghosts = balance.ghosts(here, 0.1)
    ones = np.ones(ghosts.count)
    same_error(lambda: ghosts.accumulate(on_rank(last, ones[:, None] > 0, ones)), "are added")
    same_error(lambda: ghosts.accumulate(on_rank(last, np.ones(ghosts.count + 1), ones)), "ghosts")
    periodic = balance.ghosts(here, 0.3, 1.0)
    for bad, text in ((here.astype(int), "must be float64"), (here[:, 0], "2 axes, not 1")):
        given = on_rank(last, bad, here)
        same_error(lambda: periodic.fetch_positions(given), text)
    check_balance(rrcb.balance(x, comm=comm), x)


def test_refuses_ghosts_of_points_that_were_not_moved():
    x = cloud(2)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer(x)
    if RANKS > 1:
        text = "these are the points of the balance"
        same_error(lambda: balance.ghosts(x, 0.1), text)
        alone = rrcb.assign(here, balance, comm)
        same_error(lambda: balance.ghosts(on_rank(RANKS - 1, x, here), 0.1), text)
        assert alone.ghosts(here, 0.1).count == balance.ghosts(here, 0.1).count
    for num_parts in (2 * RANKS, max(RANKS - 1, 2)):
        other = rrcb.balance(x, comm=comm, num_parts=num_parts)
        other.ghosts(other.transfer(x), 0.1)
        if RANKS > 1:
            same_error(lambda: other.ghosts(x, 0.1), "these are the points of the balance")
    # As many points as before, of which some have crossed a cut.
    rows = np.resize(np.arange(len(here)), len(x))
    assert balance.ghosts(here[rows] * 0.99, 0.1).num_points == len(x)


def test_names_the_shape_of_no_points():
    x, last = cloud(2), RANKS - 1
    balance = rrcb.balance(x, comm=comm)
    here, given = balance.transfer(x), on_rank(last, np.array([]), x)
    if RANKS > 1:
        for call in (
            lambda: rrcb.balance(given, comm=comm),
            lambda: rrcb.balance(given, comm=comm, previous=balance),
            lambda: rrcb.assign(given, balance, comm),
            lambda: balance.ghosts(on_rank(last, np.array([]), here), 0.1),
        ):
            same_error(call, "without points np.empty((0, d))")
    for none, dimension in ((np.array([]), 1), ([], 1), (np.empty((0, 2)), 2)):
        balance = rrcb.balance(none, comm=comm)
        assert balance.cuts.dimension == dimension and balance.parts.shape == (0,)
        assert balance.report.imbalance == 1 and balance.report.within_tolerance
        assert balance.transfer(np.asarray(none)).shape == np.shape(none)


def test_refuses_what_is_no_communicator():
    for bad, text in ((MPI.COMM_NULL, "COMM_NULL"), (3, "int")):
        same_error(lambda: rrcb.balance(cloud(2), comm=bad), text)
        same_error(lambda: rrcb.Controller(bad), text)


def test_refuses_calls_when_mpi_is_not_running():
    x = cloud(2)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer(x)
    ghosts = balance.ghosts(here, 0.1)
    calls = (
        lambda: rrcb.balance(x, comm=comm),
        lambda: rrcb.assign(x, balance, comm),
        lambda: balance.transfer(x),
        lambda: balance.ghosts(here, 0.1),
        lambda: ghosts.fetch(here),
        lambda: copy.copy(balance.cuts).part_of(x),
        lambda: rrcb.Controller(comm),
        lambda: rrcb.experimental.CostModel(None, 2, comm),
    )
    for name, result in (("Is_initialized", False), ("Is_finalized", True)):
        for call in calls:
            try:
                with unittest.mock.patch.object(MPI, name, return_value=result):
                    call()
            except rrcb.Error as error:
                assert "MPI is not running" in str(error), error
            else:
                raise AssertionError(f"no error if {name} returns {result}")


def test_refuses_a_freed_communicator():
    freed, x = comm.Dup(), cloud(2)
    balance = rrcb.balance(x, comm=freed)
    ghosts = balance.ghosts(balance.transfer(x), 0.1)
    controller, later = rrcb.Controller(freed), rrcb.balance(x, comm=freed)
    freed.Free()
    for call in (
        lambda: rrcb.balance(x, comm=freed, previous=balance),
        lambda: balance.transfer(x),
        lambda: later.transfer(x),
        lambda: balance.ghosts(x, 0.1),
        lambda: ghosts.accumulate(np.ones(ghosts.count)),
        lambda: controller.step(1.0),
    ):
        same_error(call, "was freed")
    assert np.array_equal(balance.cuts.part_of(x), balance.parts)


def test_raises_errors_of_a_controller_on_all():
    last, balance = RANKS - 1, rrcb.balance(cloud(2), comm=comm)
    for given, cost in ((on_rank(last, 3, balance.report), 1.0), (None, on_rank(last, "text", 1.0))):
        with rrcb.Controller(comm) as controller:
            controller.rebalanced(given, cost)
            same_error(lambda: [controller.step(1.0) for _ in range(3)], "")
    given = on_rank(last, "a", 1)
    same_error(lambda: rrcb.experimental.CostModel(None, given, comm), "num_columns must be a whole number, not 'a'")
    with rrcb.experimental.CostModel(None, 2, comm) as model:
        model.step(1.0, on_rank(last, [[1], [1, 2]], [1, 2]))
        same_error(lambda: [model.step(1.0, [1, 2]) for _ in range(3)], "")


def test_frees_cost_models_with_their_controller():
    with rrcb.Controller(comm) as controller:
        model = rrcb.experimental.CostModel(controller, 2, comm)
    for use in (
        lambda: model.step(1.0, [1, 2]),
        lambda: model.weights(np.ones((1, 2))),
        lambda: model.costs,
        lambda: model.report(),
    ):
        same_error(use, "cost model was freed: make another")
    model.free()
    for use in (lambda: controller.step(1.0), lambda: controller.due):
        same_error(use, "controller was freed: make another")
    same_error(lambda: rrcb.experimental.CostModel(controller, 2, comm), "controller was freed")


def test_refuses_columns_of_cost_models_that_differ():
    last = RANKS - 1
    for bad in (2**32 + 2, 10**12):
        same_error(lambda: rrcb.experimental.CostModel(None, on_rank(last, bad, 2), comm), "must be an int32")
    same_error(lambda: rrcb.experimental.CostModel(on_rank(last, 3, None), 2, comm), "Controller, not int")
    with rrcb.experimental.CostModel(None, 2, comm) as model:
        for bad in (np.ones((4, 3)), np.ones(4), np.ones((2, 4))):
            same_error(lambda: model.weights(bad), "columns must have the shape (n, 2)")
        assert len(model.weights(np.empty((0, 2)))) == 0


def test_names_the_fix_for_data_of_other_kinds():
    last, x = RANKS - 1, cloud(2)
    points = np.zeros(5, [("x", float), ("y", float)])
    for bad, text in ((points, "a tuple of its fields"), ([x[:, 0], x[:, 1]], "a tuple of d columns")):
        given = on_rank(last, bad, x)
        same_error(lambda: rrcb.balance(given, comm=comm), text)
    same_error(lambda: rrcb.balance(x, comm), "weights must be numbers, not Intracomm")
    balance = rrcb.balance(x, comm=comm)
    given = on_rank(last, [x[:, 0], x[:, 1]], x)
    same_error(lambda: balance.transfer(given), "several columns as a tuple")
    for attempt in (pickle.dumps, copy.deepcopy):
        try:
            attempt(balance)
        except TypeError as error:
            assert "cuts" in str(error)
        else:
            raise AssertionError("no error")


def test_moves_series_and_refuses_categories():
    try:
        import pandas
    except ImportError:
        raise Skip("pandas is not installed")
    x = cloud(2)
    balance = rrcb.balance(x, comm=comm)
    series = pandas.Series(x[:, 0], index=np.arange(len(x)) * 3, name="a")
    got = balance.transfer(series)
    assert got.name == "a" and np.array_equal(got, balance.transfer(x[:, 0]))
    assert np.array_equal(got.index, balance.transfer(np.arange(len(x)) * 3))
    for labels in (["a", "b"], [1, 2]):
        frame = pandas.DataFrame({"c": pandas.Categorical(np.resize(labels, len(x)))})
        given = on_rank(RANKS - 1, frame, frame.assign(c=1))
        same_error(lambda: balance.transfer(given), "column c is categorical: give its .cat.codes")


def test_refuses_a_tree_of_another_length():
    tree = rrcb.balance(cloud(2), comm=MPI.COMM_SELF, num_parts=4).cuts.tree
    assert rrcb.Cuts(2, 4, tree).boxes().shape == (4, 2, 2)
    for wrong in (0, 3, 5):
        same_error(lambda: rrcb.Cuts(2, wrong, tree), "tree must have the shape")


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
