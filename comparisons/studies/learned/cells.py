"""Cells of random clouds to learn from: their moments, those around them, and what lies in their
sub-cells; and the tilt of a prior on the sub-cells to the moments of the cell."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor

import numpy as np
from clouds import Array, random_cloud
from numpy.lib.stride_tricks import sliding_window_view

SUB = 8  # sub-cells per axis
EVEN = np.sqrt(1 / 12)  # deviation of an even density, in cells
OUTSIDE = np.array([0, 0, 0, -2, -2, 1.0])  # inputs of a cell outside the mesh
NUM_INPUTS = 9 * len(OUTSIDE) + 1
MOST_OF_A_CLOUD, FEWEST_POINTS = 300, 8  # cells; points of a cell

CENTRES = (np.arange(SUB) + 0.5) / SUB - 0.5
_x, _y = np.meshgrid(CENTRES, CENTRES, indexing="ij")
SCALE = np.array([0.2887, 0.2887, 0.0745, 0.0745])  # deviations of an even density
STATISTICS = np.stack([_x, _y, _x**2, _y**2]).reshape(4, -1) / SCALE[:, None]
PAIRS = np.einsum("ik,jk->kij", STATISTICS, STATISTICS).reshape(-1, 16)
WITHIN = 1 / (12 * SUB**2)  # variance inside of a sub-cell
FOUND = 1e-3  # a tilt that is farther off has not converged, and is left out


def sample_cells(seed: int, num_clouds: int) -> tuple[Array, Array, Array]:
    """Inputs, shares of the sub-cells and means of the statistics of the cells of as many clouds."""
    with ProcessPoolExecutor(2) as pool:
        found = pool.map(_cells_of_cloud, [(seed, k) for k in range(num_clouds)], chunksize=16)
        found = [cells for cells in found if cells is not None]
    return tuple(np.concatenate(parts).astype(float) for parts in zip(*found))


def _cells_of_cloud(key: tuple[int, int]) -> tuple[Array, Array, Array] | None:
    random = np.random.default_rng(key)
    points = random_cloud(random)
    if len(points) < 500:
        return None
    per_axis = np.exp(random.uniform(np.log(5), np.log(40)) + random.normal(0, 0.2, 2))
    number = np.maximum(2, per_axis.astype(int))
    count, mean, deviation, shares = moments(points, number)
    inputs = _inputs_of(number, count, mean, deviation)
    target = np.concatenate([mean, deviation**2 + mean**2 - WITHIN], axis=1) / SCALE
    _, off = tilted(np.zeros_like(shares), target)
    usable = np.flatnonzero((count >= FEWEST_POINTS) & (off < FOUND))
    # More of the cells that an even density does not describe.
    uneven = np.abs(mean).max(axis=1) + 2 * np.abs(deviation - EVEN).max(axis=1)
    chance = np.clip(0.15 + 2 * uneven[usable], 0.15, 1)
    size = min(MOST_OF_A_CLOUD, len(usable))
    chosen = random.choice(usable, size, replace=False, p=chance / chance.sum()) if size else usable
    return inputs[chosen].astype(np.float32), shares[chosen].astype(np.float32), target[chosen]


def moments(points: Array, number: Array) -> tuple[Array, Array, Array, Array]:
    """Of each cell, those along the last axis running fastest: count, mean from the centre and
    deviation in cells, and the shares of the sub-cells."""
    lower, upper = points.min(axis=0), points.max(axis=0)
    place = (points - lower) / (upper - lower) * number
    cell = np.minimum(place.astype(int), number - 1)
    inside = place - cell
    sub = np.minimum((inside * SUB).astype(int), SUB - 1)
    total, index = number.prod(), cell[:, 0] * number[1] + cell[:, 1]
    count = np.bincount(index, minlength=total)
    safe = np.maximum(count, 1)[:, None]

    def mean_of(values: Array) -> Array:
        return np.stack([np.bincount(index, v, total) for v in values.T], axis=1) / safe

    mean = mean_of(inside - 0.5)
    deviation = np.sqrt(mean_of((inside - 0.5 - mean[index]) ** 2))
    place = index * SUB**2 + sub[:, 0] * SUB + sub[:, 1]
    return count, mean, deviation, np.bincount(place, minlength=total * SUB**2).reshape(total, -1) / safe


def _inputs_of(number: Array, count: Array, mean: Array, deviation: Array) -> Array:
    """(cells, 55): of each of the 3 x 3 cells around, its share of it and the cell together, mean and
    deviation per axis, and whether it lies outside the mesh; then the count."""
    uneven = np.where(count[:, None] > 0, 8 * (deviation - EVEN), OUTSIDE[3])
    each = np.concatenate([count[:, None], 4 * mean, uneven, np.zeros((len(count), 1))], axis=1)
    padded = np.tile(OUTSIDE, (*(number + 2), 1))
    padded[1:-1, 1:-1] = each.reshape(*number, -1)
    around = sliding_window_view(padded, (3, 3), (0, 1)).transpose(0, 1, 3, 4, 2)
    around = around.reshape(len(count), 9, -1)
    around[..., 0] /= np.maximum(around[..., 0] + count[:, None], 1)
    return np.concatenate([around.reshape(len(count), -1), np.log2(count[:, None] + 1) / 8], axis=1)


def tilted(prior: Array, target: Array, rounds: int = 12) -> tuple[Array, Array]:
    """Shares exp(prior + c . statistics) with the means of the target, by damped Newton steps, and
    how far off they are."""

    def dual(c: Array) -> tuple[Array, Array, Array]:
        exponent = prior + c @ STATISTICS
        top = exponent.max(axis=1, keepdims=True)
        p = np.exp(exponent - top)
        total = p.sum(axis=1, keepdims=True)
        p /= total
        value = (top + np.log(total))[:, 0] - np.sum(c * target, axis=1)
        return value, p, p @ STATISTICS.T - target

    c = np.zeros((len(prior), 4))
    value, p, off = dual(c)
    step = np.ones(len(prior))
    for _ in range(rounds):
        means = target + off
        second = (p @ PAIRS).reshape(-1, 4, 4) - means[:, :, None] * means[:, None, :]
        second[:, range(4), range(4)] += 1e-6
        next_c = c - step[:, None] * np.linalg.solve(second, off[..., None])[..., 0]
        found = dual(next_c)
        better = found[0] <= value + 1e-9
        c, p, off = (np.where(better[:, None], new, old)
                     for new, old in ((next_c, c), (found[1], p), (found[2], off)))  # fmt: skip
        value = np.where(better, found[0], value)
        step = np.where(better, np.minimum(1, 2 * step), step / 4)
    return p, np.abs(off).max(axis=1)
