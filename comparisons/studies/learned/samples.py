"""Cells of random clouds, to learn from."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor

import numpy as np
from cells import CELL_INPUTS, EVEN, NUM_INPUTS, SUB, bin_points, inputs_of
from clouds import random_cloud
from tilt import is_reachable, targets

Array = np.ndarray

MOST_OF_A_CLOUD = 300
FEWEST_POINTS = 8  # of a cell


def sample_cells(seed: int, num_clouds: int) -> tuple[Array, Array, Array]:
    """Inputs, shares of the sub-cells and moments of the cells of as many clouds."""
    with ProcessPoolExecutor(2) as pool:
        clouds = pool.map(_cells_of_cloud, [(seed, k) for k in range(num_clouds)], chunksize=16)
        found = [cells for cells in clouds if cells is not None]
    inputs, shares, moments = (np.concatenate(parts).astype(float) for parts in zip(*found))
    return inputs, shares, moments


def _cells_of_cloud(key: tuple[int, int]) -> tuple[Array, Array, Array] | None:
    random = np.random.default_rng(key)
    points, weights = random_cloud(random)
    if len(points) < 500:
        return None
    per_axis = np.exp(random.uniform(np.log(5), np.log(40)))
    stretch = np.exp(random.normal(0, 0.4, 2)) if random.uniform() < 0.3 else np.ones(2)
    across, up = (max(2, int(n)) for n in per_axis * stretch)
    mesh = bin_points(points, weights, (across, up))
    inputs = inputs_of(mesh).reshape(-1, NUM_INPUTS)
    mean, deviation = mesh.mean.reshape(-1, 2), mesh.deviation.reshape(-1, 2)
    moments = targets(mean, deviation)
    count = mesh.count.ravel()
    usable = np.flatnonzero((count >= FEWEST_POINTS) & is_reachable(moments))
    if len(usable) == 0:
        return None
    chance = _chance(inputs[usable], mean[usable], deviation[usable], count[usable])
    number = min(MOST_OF_A_CLOUD, len(usable))
    chosen = random.choice(usable, number, replace=False, p=chance / chance.sum())
    shares = mesh.histogram.reshape(-1, SUB**2)
    return (
        inputs[chosen].astype(np.float32),
        shares[chosen].astype(np.float32),
        moments[chosen],
    )


def _chance(inputs: Array, mean: Array, deviation: Array, count: Array) -> Array:
    """More of the cells that an even density does not describe, chance aside."""
    ratios = inputs[:, : 9 * CELL_INPUTS : CELL_INPUTS]
    uneven = np.abs(mean).max(axis=1) + 2 * np.abs(deviation - EVEN).max(axis=1)
    uneven += np.abs(ratios - 0.5).max(axis=1) - 1 / np.sqrt(count)
    return np.clip(0.15 + 2 * uneven, 0.15, 1)
