"""Cells of random clouds to learn from: their moments, those around them, and what lies in their
sub-cells; and the tilt of a prior on the sub-cells to the moments of the cell."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor

import numpy as np
from clouds import Array, random_cloud
from numpy.lib.stride_tricks import sliding_window_view

SUB = 8  # sub-cells per axis
EVEN = np.sqrt(1 / 12)  # deviation of an even density, in cells
OUTSIDE = np.array([0, 0, 0, -2, -2, 1])  # inputs of a cell outside the mesh
NUM_INPUTS = 9 * len(OUTSIDE) + 1
MOST_OF_A_CLOUD, FEWEST_POINTS = 300, 8  # cells; points of a cell

CENTRES = (np.arange(SUB) + 0.5) / SUB - 0.5
_x, _y = np.meshgrid(CENTRES, CENTRES, indexing="ij")
STATISTICS = np.stack([_x, _y, _x**2, _y**2]).reshape(4, -1)
WITHIN = 1 / (12 * SUB**2)  # variance inside of a sub-cell
SCALE = np.array([0.2887, 0.2887, 0.0745, 0.0745])[:, None]  # deviations of an even density


def sample_cells(seed: int, num_clouds: int) -> tuple[Array, Array, Array]:
    """Inputs, shares of the sub-cells and means of the statistics of the cells of as many clouds."""
    with ProcessPoolExecutor(2) as pool:
        clouds = pool.map(_cells_of_cloud, [(seed, k) for k in range(num_clouds)], chunksize=16)
        found = [cells for cells in clouds if cells is not None]
    return tuple(np.concatenate(parts).astype(float) for parts in zip(*found))


def _cells_of_cloud(key: tuple[int, int]) -> tuple[Array, Array, Array] | None:
    random = np.random.default_rng(key)
    points, weights = random_cloud(random)
    if len(points) < 500:
        return None
    per_axis = np.exp(random.uniform(np.log(5), np.log(40)))
    stretch = np.exp(random.normal(0, 0.4, 2)) if random.uniform() < 0.3 else np.ones(2)
    number = np.array([max(2, int(n)) for n in per_axis * stretch])
    count, weight, mean, deviation, shares = moments(points, weights, number)
    inputs = _inputs_of(number, count, weight, mean, deviation)
    target = np.concatenate([mean, deviation**2 + mean**2 - WITHIN], axis=1)
    usable = np.flatnonzero((count >= FEWEST_POINTS) & _is_reachable(target))
    if len(usable) == 0:
        return None
    # More of the cells that an even density does not describe, chance aside.
    ratios = inputs[:, : NUM_INPUTS - 1 : len(OUTSIDE)]
    uneven = np.abs(mean).max(axis=1) + 2 * np.abs(deviation - EVEN).max(axis=1)
    uneven += np.abs(ratios - 0.5).max(axis=1) - 1 / np.sqrt(np.maximum(count, 1))
    chance = np.clip(0.15 + 2 * uneven[usable], 0.15, 1)
    size = min(MOST_OF_A_CLOUD, len(usable))
    chosen = random.choice(usable, size, replace=False, p=chance / chance.sum())
    return inputs[chosen].astype(np.float32), shares[chosen].astype(np.float32), target[chosen]


def moments(points: Array, weights: Array, number: Array) -> tuple[Array, ...]:
    """Of each cell, those along the last axis running fastest: count, weight, mean from the centre and
    deviation in cells, and the shares of the sub-cells."""
    lower, upper = points.min(axis=0), points.max(axis=0)
    place = (points - lower) / np.where(upper > lower, upper - lower, 1) * number
    cell = np.minimum(place.astype(int), number - 1)
    inside = place - cell
    sub = np.minimum((inside * SUB).astype(int), SUB - 1)
    total, index = number.prod(), cell[:, 0] * number[1] + cell[:, 1]
    count = np.bincount(index, minlength=total)
    weight = np.bincount(index, weights, total)
    safe = np.where(weight > 0, weight, 1)[:, None]

    def mean_of(values: Array) -> Array:
        return np.stack([np.bincount(index, weights * v, total) for v in values.T], axis=1) / safe

    mean = mean_of(inside - 0.5)
    deviation = np.sqrt(mean_of((inside - 0.5 - mean[index]) ** 2))
    place = index * SUB**2 + sub[:, 0] * SUB + sub[:, 1]
    shares = np.bincount(place, weights, total * SUB**2).reshape(total, SUB**2) / safe
    return count, weight, mean, deviation, shares


def _inputs_of(number: Array, count: Array, weight: Array, mean: Array, deviation: Array) -> Array:
    """(cells, 55): of each of the 3 x 3 cells around, its share of it and the cell together, mean and
    deviation per axis, and whether it lies outside the mesh; then the count."""
    uneven = np.where(weight[:, None] > 0, 8 * (deviation - EVEN), OUTSIDE[3])
    each = np.concatenate([weight[:, None], 4 * mean, uneven, np.zeros((len(weight), 1))], axis=1)
    padded = np.tile(OUTSIDE.astype(float), (*(number + 2), 1))
    padded[1:-1, 1:-1] = each.reshape(*number, -1)
    around = sliding_window_view(padded, (3, 3), (0, 1)).transpose(0, 1, 3, 4, 2).reshape(len(weight), 9, -1)
    ratio = around[..., 0] / np.where(weight > 0, weight, 1)[:, None]
    around[..., 0] = ratio / (1 + ratio)
    level = np.log2(np.maximum(count, 1)) / 8
    return np.concatenate([around.reshape(len(weight), -1), level[:, None]], axis=1)


def mirrored(inputs: Array, shares: Array, target: Array, symmetry: int) -> tuple[Array, Array, Array]:
    """The cells of the mirrored clouds: bits of `symmetry` for each axis and for their exchange."""
    around = inputs[:, :-1].reshape(-1, 3, 3, len(OUTSIDE)).copy()
    shares = shares.reshape(-1, SUB, SUB)
    target = target.copy()
    for axis in (axis for axis in range(2) if symmetry >> axis & 1):
        around, shares = (np.flip(values, axis + 1).copy() for values in (around, shares))
        around[..., 1 + axis] *= -1
        target[:, axis] *= -1
    if symmetry & 4:
        around = around.transpose(0, 2, 1, 3)[..., [0, 2, 1, 4, 3, 5]]
        shares, target = shares.transpose(0, 2, 1), target[:, [1, 0, 3, 2]]
    inputs = np.concatenate([around.reshape(len(inputs), -1), inputs[:, -1:]], axis=1)
    return inputs, shares.reshape(-1, SUB**2), target


def _is_reachable(target: Array) -> Array:
    """Whether weights on the sub-cells have these means, with some room."""
    mean, square = target[:, :2], target[:, 2:]
    lower = np.clip(np.floor((mean - CENTRES[0]) * SUB), 0, SUB - 2).astype(int)
    a, b = CENTRES[lower], CENTRES[lower + 1]
    least, most = (a + b) * mean - a * b, CENTRES[-1] ** 2  # the chord between the neighbours
    inside = np.abs(mean) < CENTRES[-1] - 0.01
    return np.all(inside & (square > least + 0.004) & (square < most - 0.004), axis=1)


def tilted(prior: Array, target: Array, rounds: int = 12) -> tuple[Array, Array]:
    """Shares exp(prior + c . statistics) with the means of the target, by damped Newton steps, and
    how far off they are."""
    statistics, aim = STATISTICS / SCALE, target / SCALE.T
    pairs = np.einsum("ik,jk->kij", statistics, statistics).reshape(-1, 16)

    def dual(c: Array) -> tuple[Array, Array, Array]:
        exponent = prior + c @ statistics
        top = exponent.max(axis=1, keepdims=True)
        p = np.exp(exponent - top)
        total = p.sum(axis=1, keepdims=True)
        p /= total
        value = (top + np.log(total))[:, 0] - np.sum(c * aim, axis=1)
        return value, p, p @ statistics.T - aim

    c = np.zeros((len(prior), 4))
    value, p, off = dual(c)
    step = np.ones(len(prior))
    for _ in range(rounds):
        means = aim + off
        second = (p @ pairs).reshape(-1, 4, 4) - means[:, :, None] * means[:, None, :]
        second[:, range(4), range(4)] += 1e-6
        next_c = c - step[:, None] * np.linalg.solve(second, off[..., None])[..., 0]
        found = dual(next_c)
        better = found[0] <= value + 1e-9
        c, p, off = (np.where(better[:, None], new, old)
                     for new, old in ((next_c, c), (found[1], p), (found[2], off)))  # fmt: skip
        value = np.where(better, found[0], value)
        step = np.where(better, np.minimum(1, 2 * step), step / 4)
    return p, np.abs(off).max(axis=1)
