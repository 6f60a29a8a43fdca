"""Exponential tilt of a prior on sub-cells to the moments of its cell."""

from __future__ import annotations

import numpy as np
from cells import SUB

Array = np.ndarray

CENTRES = (np.arange(SUB) + 0.5) / SUB - 0.5
_x, _y = np.meshgrid(CENTRES, CENTRES, indexing="ij")
STATISTICS = np.stack([_x, _y, _x**2, _y**2]).reshape(4, -1)
WITHIN = 1 / (12 * SUB**2)  # variance inside of a sub-cell
SCALE = np.array([0.2887, 0.2887, 0.0745, 0.0745])[:, None]  # deviations of an even density


def targets(mean: Array, deviation: Array) -> Array:
    """(n, 4): means of the statistics."""
    return np.concatenate([mean, deviation**2 + mean**2 - WITHIN], axis=1)


def is_reachable(target: Array) -> Array:
    """Whether weights on the sub-cells have these means, with some room."""
    mean, square = target[:, :2], target[:, 2:]
    lower = np.clip(np.floor((mean - CENTRES[0]) * SUB), 0, SUB - 2).astype(int)
    a, b = CENTRES[lower], CENTRES[lower + 1]
    least = (a + b) * mean - a * b  # the chord between the neighbours
    most = CENTRES[-1] ** 2
    room = 0.004
    inside = np.abs(mean) < CENTRES[-1] - 0.01
    return np.all(inside & (square > least + room) & (square < most - room), axis=1)


def tilted(prior: Array, target: Array, rounds: int = 12) -> tuple[Array, Array]:
    """Shares exp(prior + c . statistics) with the means of the target, by damped Newton steps, and
    how far off they are."""
    statistics = (STATISTICS / SCALE).astype(prior.dtype)
    aim = (target / SCALE.T).astype(prior.dtype)
    c = np.zeros((len(prior), 4), dtype=prior.dtype)
    value, p, off = _dual(prior, statistics, aim, c)
    step = np.ones(len(prior), dtype=prior.dtype)
    for _ in range(rounds):
        means = aim + off
        second = (p @ _pairs(statistics)).reshape(-1, 4, 4) - means[:, :, None] * means[:, None, :]
        second[:, range(4), range(4)] += 1e-6
        move = np.linalg.solve(second, off[..., None])[..., 0]
        next_c = c - step[:, None] * move
        next_value, next_p, next_off = _dual(prior, statistics, aim, next_c)
        better = next_value <= value + 1e-9
        c = np.where(better[:, None], next_c, c)
        value = np.where(better, next_value, value)
        p = np.where(better[:, None], next_p, p)
        off = np.where(better[:, None], next_off, off)
        step = np.where(better, np.minimum(1, 2 * step), step / 4).astype(prior.dtype)
    return p, np.abs(off).max(axis=1)


def _pairs(statistics: Array) -> Array:
    return np.einsum("ik,jk->kij", statistics, statistics).reshape(statistics.shape[1], 16)


def _dual(prior: Array, statistics: Array, aim: Array, c: Array) -> tuple[Array, Array, Array]:
    exponent = prior + c @ statistics
    top = exponent.max(axis=1, keepdims=True)
    p = np.exp(exponent - top)
    total = p.sum(axis=1, keepdims=True)
    p /= total
    value = (top + np.log(total))[:, 0] - np.sum(c * aim, axis=1)
    return value, p, p @ statistics.T - aim
