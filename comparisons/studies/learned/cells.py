"""Cells of a support mesh: their moments, what lies in their sub-cells, and what is read of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Array = np.ndarray

SUB = 8  # sub-cells per axis
EVEN = np.sqrt(1 / 12)  # deviation of an even density, in cells
CELL_INPUTS = 6
NUM_INPUTS = 9 * CELL_INPUTS + 1


@dataclass
class Mesh:
    """Per cell, the cells along the last axis running fastest; lengths in cells."""

    count: Array
    weight: Array  # (nx, ny)
    mean: Array  # (nx, ny, 2), from the centre
    deviation: Array  # (nx, ny, 2)
    histogram: Array  # (nx, ny, 8, 8), shares


def bin_points(points: Array, weights: Array, cells: tuple[int, int]) -> Mesh:
    lower, upper = points.min(axis=0), points.max(axis=0)
    number = np.array(cells)
    place = (points - lower) / np.where(upper > lower, upper - lower, 1) * number
    cell = np.minimum(place.astype(int), number - 1)
    inside = place - cell
    sub = np.minimum((inside * SUB).astype(int), SUB - 1)
    index = cell[:, 0] * cells[1] + cell[:, 1]
    total = cells[0] * cells[1]

    def sums(values: Array) -> Array:
        return np.bincount(index, weights * values, total)

    count = np.bincount(index, minlength=total)
    weight = sums(np.ones(len(points)))
    safe = np.where(weight > 0, weight, 1)
    mean = np.stack([sums(inside[:, a] - 0.5) / safe for a in range(2)], axis=1)
    off = inside - 0.5 - mean[index]
    deviation = np.stack([np.sqrt(sums(off[:, a] ** 2) / safe) for a in range(2)], axis=1)
    histogram = np.bincount(
        index * SUB**2 + sub[:, 0] * SUB + sub[:, 1], weights, total * SUB**2
    ).reshape(total, SUB**2)
    return Mesh(
        count.reshape(cells),
        weight.reshape(cells),
        mean.reshape(*cells, 2),
        deviation.reshape(*cells, 2),
        (histogram / safe[:, None]).reshape(*cells, SUB, SUB),
    )


def inputs_of(mesh: Mesh) -> Array:
    """(nx, ny, 55): of each of the 3 x 3 cells, the share of the heaviest and that on a logarithmic
    scale, mean and deviation per axis, and whether it lies outside the mesh; then the count."""
    nx, ny = mesh.weight.shape
    around = np.zeros((nx, ny, 3, 3, CELL_INPUTS))
    weight = np.pad(mesh.weight, 1)
    mean = np.pad(mesh.mean, ((1, 1), (1, 1), (0, 0)))
    deviation = np.pad(mesh.deviation, ((1, 1), (1, 1), (0, 0)))
    shares = np.stack([[weight[i : i + nx, j : j + ny] for j in range(3)] for i in range(3)])
    own = np.where(mesh.weight > 0, mesh.weight, 1)
    for i in range(3):
        for j in range(3):
            here = np.s_[i : i + nx, j : j + ny]
            filled = (weight[here] > 0)[..., None]
            ratio = shares[i, j] / own
            around[:, :, i, j, 0] = ratio / (1 + ratio)
            around[:, :, i, j, 1:3] = 4 * mean[here]
            around[:, :, i, j, 3:5] = np.where(filled, 8 * (deviation[here] - EVEN), -2)
    outside = np.pad(np.zeros((nx, ny)), 1, constant_values=1)
    for i in range(3):
        for j in range(3):
            around[:, :, i, j, 5] = outside[i : i + nx, j : j + ny]
    level = np.log2(np.maximum(mesh.count, 1)) / 8
    return np.concatenate([around.reshape(nx, ny, -1), level[..., None]], axis=2)


def turned(inputs: Array, transpose: bool, flip: tuple[bool, bool]) -> Array:
    """Inputs of the mirrored cloud."""
    around = inputs[:, :-1].reshape(-1, 3, 3, CELL_INPUTS).copy()
    for axis in range(2):
        if flip[axis]:
            around = np.flip(around, axis + 1).copy()
            around[..., 1 + axis] *= -1
    if transpose:
        around = around.transpose(0, 2, 1, 3)[..., [0, 2, 1, 4, 3, 5]]
    return np.concatenate([around.reshape(len(inputs), -1), inputs[:, -1:]], axis=1)


def turned_histogram(histogram: Array, transpose: bool, flip: tuple[bool, bool]) -> Array:
    for axis in range(2):
        if flip[axis]:
            histogram = np.flip(histogram, axis + 1)
    return histogram.transpose(0, 2, 1) if transpose else histogram
