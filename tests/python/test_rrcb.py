"""Checks results against numpy over all points of all ranks."""
import itertools
import os
import pickle
import sys
import tempfile

import numpy as np
from mpi4py import MPI

import rrcb
import runner
from runner import Skip, comm, on_rank, same_error

RANKS, ME = comm.size, comm.rank


def cloud(dimension, count=700, dtype=np.float64, empty=None, seed=1):
    """Positions of this rank, clustered at 0; none on the rank `empty`."""
    rng = np.random.default_rng([seed, ME])
    here = 0 if ME == empty else count + 37 * ME
    return (rng.random((here, dimension)) ** 2).astype(dtype)


def ids(count):
    """Numbers of points, unique over the ranks."""
    return np.arange(count, dtype=np.int64) + ME * 1_000_000


def everywhere(array):
    return np.concatenate(comm.allgather(array))


def check_balance(balance, x, weights=None, tolerance=1.01, num_parts=RANKS):
    """Recomputes parts and imbalance from the boxes."""
    positions = np.asarray(x, dtype=np.float64)
    boxes = balance.cuts.boxes()
    assert boxes.shape == (num_parts, 2, positions.shape[1])
    mine = boxes[balance.parts]
    assert (positions >= mine[:, 0]).all() and (positions <= mine[:, 1]).all()
    inside = [
        ((positions >= lower) & (positions < upper)).all(axis=1) for lower, upper in boxes
    ]
    assert (np.sum(inside, axis=0) <= 1).all()
    counted = np.bincount(balance.parts, weights, minlength=num_parts).astype(float)
    sums = comm.allreduce(counted)
    assert np.isclose(sums.max() / sums.mean(), balance.report.imbalance, rtol=1e-12)
    assert balance.report.within_tolerance == (balance.report.imbalance <= tolerance)
    assert balance.report.num_points == comm.allreduce(len(positions))
    assert np.array_equal(balance.cuts.part_of(x), balance.parts)


def test_continues_from_saved_bytes():
    x = cloud(2)
    made = rrcb.balance(x, num_parts=5, comm=comm)
    loaded = rrcb.Cuts.load(made.cuts.save())
    assert (loaded.part_of(x) == made.cuts.part_of(x)).all()
    same_error(lambda: rrcb.Cuts.load(made.cuts.save()[:-8]), "pass all bytes")
    controller = rrcb.Controller(comm)
    model = rrcb.experimental.CostModel(controller, 2, comm)
    for step in range(30):
        cells = 10 + 20 * ME + step % 7
        model.step(100 + 5 * cells, [100, cells])
    again = rrcb.Controller.load(controller.save(), comm)
    model_again = rrcb.experimental.CostModel.load(model.save(), again, comm)
    assert model_again.report() == model.report()
    assert (model_again.costs == model.costs).all()
    assert again.due == controller.due
    same_error(lambda: rrcb.Controller.load(model.save(), comm), "not of a Controller")
    again.free()
    controller.free()


def joined_by_hand(keys):
    """The least key that each row of keys is connected to, -1 for a row without keys."""
    least = {}

    def root(key):
        while least.setdefault(key, key) != key:
            key = least[key]
        return key

    for row in keys:
        lowest, *others = sorted({root(key) for key in row if key >= 0}) or [-1]
        least.update({other: lowest for other in others})
    return np.array([min((root(k) for k in row if k >= 0), default=-1) for row in keys])


def test_joins_overlapping_groups():
    for empty in (None, RANKS - 1):
        x = cloud(2, count=60, empty=empty)
        rng = np.random.default_rng([5, ME])
        keys = rng.integers(-1, 90 * RANKS, (len(x), 2))
        expected = joined_by_hand(everywhere(keys))
        joined = rrcb.experimental.join_keys(keys, comm)
        assert (everywhere(joined).astype(np.int64) == expected).all()
        weights = rng.random(len(x))
        molecules = rrcb.groups(x, joined, weights, comm)
        assert np.isclose(comm.allreduce(molecules.weights.sum()), comm.allreduce(weights.sum()))
        made = rrcb.balance(molecules.x, molecules.weights, comm)
        parts = molecules.distribution(made)
        here = parts.transfer({"joined": joined, "x": x})
        assert comm.allreduce(len(here["x"])) == len(expected)
        own = set(here["joined"].tolist()) - {2**64 - 1}
        assert len(set().union(*comm.allgather(own))) == sum(comm.allgather(len(own)))
        # Centres of weight, by hand.
        rows, of = np.unique(expected[expected >= 0], return_inverse=True)
        everything = everywhere(x)[expected >= 0], everywhere(weights)[expected >= 0]
        sums = np.zeros((len(rows), 3))
        np.add.at(sums, of.ravel(), np.column_stack([everything[0] * everything[1][:, None], everything[1]]))
        centres = np.concatenate([sums[:, :2] / sums[:, 2:], everywhere(x)[expected < 0]])
        found = everywhere(molecules.x)
        assert np.allclose(found[np.lexsort(found.T)], centres[np.lexsort(centres.T)])


def test_balances_in_each_dimension_and_dtype():
    for dimension, dtype in itertools.product((1, 2, 3), (np.float64, np.float32)):
        for empty in (None, 0, RANKS - 1):
            if RANKS == 1 and empty is not None:
                continue
            x = cloud(dimension, dtype=dtype, empty=empty)
            balance = rrcb.balance(x, comm=comm)
            assert balance.parts.dtype == np.int32
            assert balance.report.imbalance <= 1.01
            check_balance(balance, x)


def test_balances_weights_and_tolerances():
    x = cloud(2, 10_000)
    weights = 1 + 9 * x[:, 0]
    balance = rrcb.balance(x, weights=weights, comm=comm, tolerance=1.001, num_parts=7)
    check_balance(balance, x, weights, 1.001, 7)
    assert balance.report.imbalance <= 1.001
    integers = rrcb.balance(x, weights=np.ones(len(x), dtype=np.int32), comm=comm)
    assert np.array_equal(integers.parts, rrcb.balance(x, comm=comm).parts)
    sizes = np.arange(1.0, RANKS + 1)
    uneven = rrcb.balance(x, comm=comm, part_sizes=sizes)
    counts = comm.allreduce(np.bincount(uneven.parts, minlength=RANKS))
    assert np.abs(counts / counts.sum() - sizes / sizes.sum()).max() < 0.01
    shape = {"tree__group_size": 2, "tree__larger_below": True, "tree__round_robin_block": 1}
    shaped = rrcb.balance(x, comm=comm, num_parts=6, axes__plain=True, **shape)
    assert shaped.cuts.__getstate__()[3] == (2, 1, 1)
    wide = rrcb.balance(x, comm=comm, num_parts=4, axes__min_width=(0.4, np.float32(0.1)))
    boxes = wide.cuts.finite_boxes(([0, 0], [1, 1]))
    assert (boxes[:, 1] - boxes[:, 0] >= (0.4, 0.1)).all()


def test_reads_any_layout():
    x = cloud(3)
    want = rrcb.balance(x, comm=comm).parts
    wide = np.zeros((len(x), 5))
    wide[:, 1:4] = x
    packed = np.zeros(len(x), dtype=[("a", "u1"), ("p", "f8", 3)])
    packed["p"] = x
    backward = np.ascontiguousarray(x[::-1])[::-1]
    thinned = np.repeat(x, 2, axis=0)[::2]
    records = np.zeros(len(x), dtype=[(name, "f8") for name in "xyz"])
    for axis, name in enumerate("xyz"):
        records[name] = x[:, axis]
    fields = tuple(records[name] for name in "xyz")
    layouts = [np.asfortranarray(x), wide[:, 1:4], packed["p"], backward, thinned]
    for layout in [*layouts, fields, tuple(x.T.copy()), x.tolist() if len(x) else x]:
        assert np.array_equal(rrcb.balance(layout, comm=comm).parts, want)
    x.flags.writeable = False
    assert np.array_equal(rrcb.balance(x, comm=comm).parts, want)


def test_does_not_copy_positions():
    from rrcb._arrays import Points

    for x in (cloud(3), cloud(2, dtype=np.float32), np.zeros((9, 4))[:, :3]):
        assert Points(x)._as_parameter_._obj.axes[0] == x.ctypes.data


def test_balances_from_earlier_cuts():
    x = cloud(2)
    first = rrcb.balance(x, comm=comm)
    again = rrcb.balance(x, comm=comm, previous=first)
    assert np.array_equal(first.cuts.tree, again.cuts.tree)
    moved = x * 0.98
    later = rrcb.balance(moved, comm=comm, previous=pickle.loads(pickle.dumps(first.cuts)))
    check_balance(later, moved)
    assert later.report.imbalance <= 1.01
    assert "imbalance" in repr(later.report) and len(repr(later.report).splitlines()) == 12


def test_keeps_uncounted_cuts_within_the_tolerance_only():
    x = np.random.default_rng([5, ME]).random((2000, 2))
    balance = rrcb.balance(x, comm=comm, refine="NONE", imbalance_tolerance=1.1)
    first = balance.cuts
    for _ in range(6):
        balance = rrcb.balance(
            x, comm=comm, previous=balance, refine="NONE", imbalance_tolerance=1.1
        )
        counts = comm.allreduce(np.bincount(balance.parts, minlength=RANKS).astype(float))
        assert counts.max() / counts.mean() < 1.15
        x = x**1.2
    assert RANKS == 1 or not np.array_equal(balance.cuts.tree, first.tree)


def test_keeps_numbers_of_parts_in_cuts():
    tree = np.array([(0, 0, (1, 0, 0)), (0, 0, (2, 0, 0))], dtype=rrcb.balance(
        cloud(1), comm=comm, num_parts=3).cuts.tree.dtype)
    cuts = rrcb.Cuts(1, 3, tree, numbers=np.array([2, 0, 1], dtype=">i4"), debt=0.5)
    for read in (cuts, pickle.loads(pickle.dumps(cuts)), rrcb.Cuts.load(cuts.save())):
        assert list(read.part_of(np.array([[0.5], [1.5], [2.5]]))) == [2, 0, 1]
        assert read.save() == cuts.save()


def test_reads_cuts_of_the_other_byte_order():
    cuts = rrcb.balance(cloud(2), comm=comm, num_parts=7).cuts
    dimension, num_parts, tree, *others = cuts.__getstate__()
    pickled = dimension, num_parts, tree.astype(tree.dtype.newbyteorder()), *others
    read = rrcb.Cuts.__new__(rrcb.Cuts)
    read.__setstate__(pickle.loads(pickle.dumps(pickled)))
    assert np.array_equal(read.boxes(), cuts.boxes())


def test_divides_on_part_of_the_ranks():
    if RANKS < 2:
        raise Skip("needs 2 ranks")
    part = comm.Split(ME % 2, ME)
    x = cloud(2)
    balance = rrcb.balance(x, comm=part)
    assert balance.cuts.num_parts == part.size
    counts = part.allreduce(np.bincount(balance.parts, minlength=part.size))
    assert len(balance.transfer(x)) == counts[part.rank]
    part.Free()


def columns_of(x):
    count = len(x)
    return {
        "x": x,
        "id": ids(count),
        "flag": ids(count) % 3 == 0,
        "tensor": np.arange(count * 6, dtype=np.float32).reshape(count, 2, 3) + ME,
        "name": np.array([f"{ME}-{k}" for k in range(count)], dtype="U12"),
        "time": ids(count).astype("datetime64[s]"),
        "nothing": np.zeros((count, 0)),
        "complex": x[:, 0] * 1j,
    }


def check_rows(sent, got, of):
    """Compares rows that arrived with those of the same id on all ranks."""
    for name, column in sent.items():
        assert got[name].dtype == column.dtype, name
        assert np.array_equal(everywhere(column)[of], got[name]), name


def test_distributes_any_columns():
    for empty in (None, RANKS - 1) if RANKS > 1 else (None,):
        x = cloud(2, empty=empty)
        balance = rrcb.balance(x, comm=comm)
        data = columns_of(x)
        here = balance.transfer(data)
        all_ids, parts = everywhere(data["id"]), everywhere(balance.parts)
        mine = all_ids[parts == ME]
        assert sorted(here["id"]) == sorted(mine)
        stay = mine[mine // 1_000_000 == ME]
        come = mine[mine // 1_000_000 != ME]
        assert np.array_equal(here["id"], np.concatenate([stay, come]))
        rows = np.array([np.flatnonzero(all_ids == k)[0] for k in here["id"]], dtype=int)
        check_rows(data, here, rows)
        backward = dict(reversed(list(data.items()))) if ME % 2 else data
        assert list(balance.transfer(backward)) == list(backward)
        record = np.zeros(len(x), dtype=[("x", "f8", 2), ("id", "i8"), ("c", "S3")])
        record["x"], record["id"], record["c"] = x, data["id"], b"abc"
        got = balance.transfer(record)
        assert got.dtype == record.dtype and np.array_equal(got["id"], here["id"])
        assert np.array_equal(got["x"], here["x"]) and (got["c"] == b"abc").all()
        pair = balance.transfer((x, data["id"]))
        assert isinstance(pair, tuple) and np.array_equal(pair[1], here["id"])
        strided = np.zeros((len(x), 4))
        strided[:, ::2] = x
        assert np.array_equal(balance.transfer(strided[:, ::2]), here["x"])


def test_distributes_frames():
    try:
        import pandas
    except ImportError:
        raise Skip("pandas is not installed")
    x = cloud(2, empty=RANKS - 1 if RANKS > 1 else None)
    number = ids(len(x))
    frame = pandas.DataFrame({"a": x[:, 0], "b": number, "c": x[:, 1].astype("f4")})
    frame["when"] = number.astype("datetime64[s]").astype("datetime64[ns]")
    balance = rrcb.balance(frame[["a", "c"]].to_numpy(), comm=comm)
    got = balance.transfer(frame)
    assert list(got.columns) == list(frame.columns) and (got.dtypes == frame.dtypes).all()
    assert np.array_equal(got["b"], balance.transfer(number))
    named = balance.transfer(frame.set_index("b"))
    assert named.index.name == "b" and np.array_equal(named.index, got["b"])
    assert np.array_equal(named["a"], got["a"])
    same_error(lambda: balance.transfer(frame.assign(s="text").astype({"s": object})), "fixed size")


def expected_ghosts(balance, x, numbers, radius, period):
    """Returns id and shift of the ghosts of this rank, by all images of all points."""
    dimension = x.shape[1]
    lower, upper = balance.cuts.boxes()[ME]
    everything, owner = everywhere(x), everywhere(np.full(len(x), ME))
    radii = everywhere(np.broadcast_to(np.asarray(radius, dtype=float), len(x)))
    if np.ndim(radius) == 1:
        mine = radii[owner == ME]
        radii = np.maximum(radii, mine.max() if mine.size else 0)
    found = set()
    lengths = np.zeros(dimension) if period is None else np.where(np.isinf(period), 0, period)
    # Images are needed in the part of a region that is in the box.
    lower = np.where(lengths > 0, np.maximum(lower, 0), lower)
    upper = np.where(lengths > 0, np.minimum(upper, lengths), upper)
    choices = [(-1, 0, 1) if length else (0,) for length in lengths]
    for shift in itertools.product(*choices):
        images = everything + np.array(shift) * lengths
        distance = np.linalg.norm(images - np.clip(images, lower, upper), axis=1)
        near = (distance <= radii) & ((owner != ME) | any(shift))
        found |= {(k, shift) for k in everywhere(numbers)[near]}
    return found


def test_finds_ghosts():
    periods = (None, lambda d: 1.0, lambda d: [1.0] + [np.inf] * (d - 1))
    for dimension, make, dtype in itertools.product((1, 2, 3), periods, (np.float64, np.float32)):
        x = cloud(dimension, 150, dtype, empty=0 if RANKS > 2 else None)
        balance = rrcb.balance(x, comm=comm)
        here = balance.transfer({"x": x, "id": ids(len(x))})
        period = None if make is None else np.broadcast_to(make(dimension), dimension)
        ghosts = balance.ghosts(here["x"], 0.11, period=None if make is None else make(dimension))
        got = ghosts.fetch(here)
        pairs = list(zip(got["id"], map(tuple, ghosts.shifts)))
        expected = expected_ghosts(balance, here["x"].astype(float), here["id"], 0.11, period)
        assert len(set(pairs)) == len(pairs) == ghosts.count and set(pairs) == expected
        if make is None and ghosts.count:
            owners = dict(zip(everywhere(here["id"]), everywhere(np.full(len(here["id"]), ME))))
            assert [owners[k] for k in got["id"]] == list(ghosts.ranks)
        images = ghosts.fetch_positions(here["x"])
        lengths = 0 if make is None else np.where(np.isinf(period), 0, period)
        assert images.dtype == dtype
        assert np.array_equal(images, (got["x"].astype(float) + ghosts.shifts * lengths).astype(dtype))
        by_axis = ghosts.fetch_positions(tuple(here["x"].T))
        assert np.array_equal(np.stack(by_axis, axis=1), images)


def test_finds_ghosts_by_radii():
    x = cloud(2, 150)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer(x)
    numbers = ids(len(here))
    radii = np.where(numbers % 5 == 0, 0.2, 0.05)
    ghosts = balance.ghosts(here, radii)
    got = ghosts.fetch({"x": here, "r": radii, "id": numbers})
    all_x, all_r, all_ids = everywhere(here), everywhere(radii), everywhere(numbers)
    assert np.array_equal(got["x"], all_x[np.searchsorted(all_ids, got["id"])])
    held = [set(part) for part in comm.allgather(np.concatenate([numbers, got["id"]]))]
    owner = all_ids // 1_000_000
    distance = np.linalg.norm(all_x[:, None] - all_x[None], axis=2)
    near = np.argwhere(np.triu(distance <= np.maximum(all_r[:, None], all_r[None]), 1))
    for i, j in near:
        assert all_ids[i] in held[owner[j]] or all_ids[j] in held[owner[i]]


def test_finds_ghosts_within_the_radii_of_receivers():
    x = cloud(2, 150)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer(x)
    numbers = ids(len(here))
    radii = np.where(numbers % 5 == 0, 0.2, 0.05)
    all_x, all_r, all_ids = everywhere(here), everywhere(radii), everywhere(numbers)
    distance = np.linalg.norm(all_x[None] - here[:, None], axis=2)
    for needs in ("gather", "symmetric"):
        ghosts = balance.ghosts(here, radii, needs=needs)
        held = np.concatenate([numbers, ghosts.fetch(numbers)])
        assert len(set(held)) == len(held)
        reach = np.maximum(radii[:, None], all_r[None] if needs == "symmetric" else 0)
        needed = all_ids[(distance <= reach).any(axis=0)]
        assert np.isin(needed, held).all()
        assert needs == "symmetric" or ghosts.count <= balance.ghosts(here, 0.2).count
    same_error(lambda: balance.ghosts(here, radii, needs="all"), "needs must be one of scatter")


def test_finds_all_pairs_in_a_tilted_box():
    tilt, radius = 0.3, 0.1
    stretch = (tilt + np.sqrt(tilt**2 + 4)) / 2
    straight = np.random.default_rng(1).random((200, 2))
    balance = rrcb.balance(straight[ME::RANKS], comm=comm)
    here = balance.transfer(straight[ME::RANKS])
    images = balance.ghosts(here, radius * stretch, period=1.0).fetch_positions(here)
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=2)))
    every = (straight[:, None] + shifts).reshape(-1, 2)
    tilted = np.array([[1, 0], [tilt, 1]])
    counts = [
        (np.linalg.norm((x[None] - here[:, None]) @ tilted, axis=2) <= radius).sum(axis=1)
        for x in (np.concatenate([here, images]), every)
    ]
    assert np.array_equal(*counts)


def test_verifies_ghosts():
    x = cloud(2, 150, empty=0 if RANKS > 2 else None)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer({"x": x, "id": ids(len(x))})
    ghosts = balance.ghosts(here["x"], np.where(here["id"] % 5 == 0, 0.2, 0.05), 1.0, "symmetric")
    seen = rrcb.experimental.verify(ghosts, here["x"], 10**6, ids=here["id"], ids_before=ids(len(x)))
    assert seen.num_faults == 0 and len(seen.missing) == 0 and seen.num_pairs > 0
    narrow = balance.ghosts(here["x"], 0.05)
    seen = rrcb.experimental.verify(narrow, here["x"], 10**6, cutoff=0.1, ids=here["id"])
    assert comm.allreduce(len(seen.missing)) == seen.num_faults
    assert np.isin(seen.missing["needed_by"], here["id"]).all()
    wide = balance.ghosts(here["x"], 0.1).fetch(here["id"])
    assert np.isin(seen.missing["id"], wide).all() and (seen.missing["rank"] != ME).all()
    assert RANKS == 1 or seen.num_faults > 0
    changed = here["id"] + 500 * (len(here["id"]) > 0)
    seen = rrcb.experimental.verify(narrow, here["x"], 0, ids=changed, ids_before=here["id"])
    assert len(seen.missing) == len(seen.not_mine) == len(changed)


def test_makes_one_part_for_each_rank_also_from_cuts_of_others():
    x = cloud(2, 150)
    alone = rrcb.balance(x, comm=MPI.COMM_SELF, num_parts=RANKS + 1)
    for options in ({}, {"num_parts": 0}):
        balance = rrcb.balance(x, comm=comm, previous=alone, **options)
        assert balance.cuts.num_parts == RANKS


def test_refuses_ghosts_from_before_a_transfer():
    if RANKS == 1:
        raise Skip("needs two ranks")
    x = cloud(2, 150)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer(x)
    ghosts = balance.ghosts(here, 0.1)
    assert len(ghosts.fetch(here)) == ghosts.count
    rrcb.assign(1 - here, balance, comm).transfer(here)
    same_error(lambda: ghosts.fetch(here), "the points were transferred since these ghosts")


def test_accumulates_at_points():
    x = cloud(2, 200)
    balance = rrcb.balance(x, comm=comm)
    here = balance.transfer({"x": x, "id": ids(len(x))})
    ghosts = balance.ghosts(here["x"], 0.1, period=1.0)
    number = ghosts.fetch(here["id"])
    values = {
        "force": np.stack([number, number + ME, number * 0 + 1], axis=1).astype(float),
        "count": np.ones(ghosts.count, dtype=np.int32),
    }
    sums = ghosts.accumulate(values)
    all_numbers, all_forces = everywhere(number), everywhere(values["force"])
    for k, one in enumerate(here["id"]):
        of_it = all_numbers == one
        assert np.allclose(sums["force"][k], all_forces[of_it].sum(axis=0), rtol=1e-14)
        assert sums["count"][k] == of_it.sum()
    replies = ghosts.reply({"of": number, "by": np.full(ghosts.count, ME)})
    rows = np.concatenate([np.zeros(0, dtype=np.uintp), *ghosts.sent.values()])
    assert np.array_equal(replies["of"], here["id"][rows])
    assert np.array_equal(replies["by"], np.repeat(list(ghosts.sent), [len(r) for r in ghosts.sent.values()]))
    for dtype in (np.int64, np.float32):
        one = ghosts.accumulate(np.ones(ghosts.count, dtype=dtype))
        assert one.dtype == dtype and np.array_equal(one, sums["count"])


def test_looks_up_positions():
    balance = rrcb.balance(cloud(2), comm=comm, num_parts=5)
    cuts = balance.cuts
    grid = np.stack(np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, 1, 9)), axis=-1).reshape(-1, 2)
    parts = cuts.part_of(grid)
    boxes = cuts.boxes()
    for position, part in zip(grid, parts):
        assert (position >= boxes[part, 0]).all() and (position <= boxes[part, 1]).all()
        assert cuts.part_of(position) == cuts.part_of(tuple(position)) == part
    line = rrcb.balance(cloud(1), comm=comm).cuts
    assert isinstance(line.part_of(0.5), int) and line.part_of([0.1, 0.9]).shape == (2,)
    try:
        cuts.part_of([np.nan, 0.0])
    except rrcb.Error:
        pass
    else:
        raise AssertionError("NaN has no part")


def test_draws_parts():
    for dimension in (1, 2, 3):
        cuts = rrcb.balance(cloud(dimension), comm=comm, num_parts=5).cuts
        if ME > 0:
            continue
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "parts.vtk")
            cuts.to_vtk(path, within=([0] * dimension, [1] * dimension))
            with open(path, encoding="ascii") as file:
                text = file.read()
            assert f"POINTS {5 * 2 ** dimension} double" in text and "CELL_TYPES 5" in text
            boxes = cuts.finite_boxes(([0] * dimension, [1] * dimension))
            assert np.isclose(np.prod(boxes[:, 1] - boxes[:, 0], axis=1).sum(), 1)
            try:
                import matplotlib
            except ImportError:
                continue
            matplotlib.use("Agg")
            axes = cuts.plot()
            axes.figure.savefig(os.path.join(folder, "parts.png"))


def test_controls_a_loop():
    with rrcb.Controller(comm) as controller:
        due = [controller.due]
        for step in range(40):
            due.append(controller.step(1.0 + (ME == 0) * 0.2 * step))
            if due[-1]:
                controller.rebalanced(None, 0.01)
        assert any(due) == (RANKS > 1) and all(d == due for d in comm.allgather(due))
        controller.rebalanced(rrcb.balance(cloud(2), comm=comm).report, 0.1)
        assert not controller.step(1.0, 100)
    broken = rrcb.Controller(comm)
    broken.step(on_rank(0, "text", 1.0))
    same_error(lambda: [broken.step(1.0) for _ in range(3)], "")
    broken.free()
    broken.free()


def test_learns_costs():
    with rrcb.Controller(comm) as controller, rrcb.experimental.CostModel(controller, 2, comm) as model:
        rng = np.random.default_rng(ME)
        for _ in range(60):
            count = rng.integers(50, 100, size=2)
            model.step(1e-3 * count[0] + 4e-3 * count[1], count)
        rows = np.ones((5, 2))
        weights = model.weights(rows)
        assert weights.shape == (5,) and (weights > 0).all() and isinstance(model.report(), str)
        if model.uses_costs:
            assert np.allclose(model.costs, [1e-3, 4e-3], rtol=1e-3)
        assert len(set(comm.allgather(model.uses_costs))) == 1
        assert model.weights(np.zeros((0, 2))).shape == (0,)
    alone = rrcb.experimental.CostModel(None, 1, comm)
    alone.step(1.0, [10])
    alone.free()
    same_error(lambda: rrcb.experimental.CostModel(None, 0, comm), "")


if __name__ == "__main__":
    runner.run(sys.modules[__name__])
