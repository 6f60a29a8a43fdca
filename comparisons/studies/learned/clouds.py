"""Random clouds to learn from; none of them is one of those that the prior is judged by."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

Array = np.ndarray


def random_cloud(random: Generator) -> Array:
    """Points in the unit square or so."""
    num_points = int(np.exp(random.uniform(np.log(4e3), np.log(3e5))))
    shape = SHAPES[random.integers(len(SHAPES))]
    if shape in (clusters, bands):
        points = shape(random, num_points)
    else:
        points = _lattice(random, num_points)
        points = points[random.uniform(size=len(points)) < shape(random, points) * _gradient(random, points)]
    angle = random.uniform(0, 2 * np.pi) * random.integers(2)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    points = points @ turn * np.exp(random.normal(0, 0.3, size=2))
    # Now and then what one rank of several would hold.
    axis, share = random.integers(2), random.uniform(0.2, 0.8)
    return points[points[:, axis] < np.quantile(points[:, axis], share if random.uniform() < 0.4 else 1)]


def _lattice(random: Generator, num_points: int) -> Array:
    """A lattice as material points have it, bent and shaken, much or little."""
    side = int(np.sqrt(2 * num_points))
    x, y = np.meshgrid(*2 * [(np.arange(side) + 0.5) / side])
    points = np.stack([x.ravel(), y.ravel()], axis=1)
    points += random.normal(0, 1, size=points.shape) * random.choice([0.1, 0.25, 0.5, 4]) / side
    for _ in range(2):
        wave = random.normal(0, 5, size=2)
        points += np.outer(np.sin(points @ wave + random.uniform(0, 6)), random.normal(0, 0.03, 2))
    return points


def _gradient(random: Generator, points: Array) -> Array:
    """A density that is even, or grows along a direction."""
    angle, steepness = random.uniform(0, 2 * np.pi), random.uniform(0, 4) * random.integers(2)
    height = steepness * points @ np.array([np.cos(angle), np.sin(angle)])
    return np.exp(height - height.max())


def polygon(random: Generator, points: Array) -> Array:
    """Three to nine corners about a centre."""
    number = random.integers(3, 10)
    angles, radii = np.sort(random.uniform(0, 2 * np.pi, number)), random.uniform(0.2, 0.6, number)
    corners = 0.5 + np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    inside = np.zeros(len(points), dtype=bool)
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        across = (a[1] > points[:, 1]) != (b[1] > points[:, 1])
        run = (b[0] - a[0]) / (b[1] - a[1] if b[1] != a[1] else 1)
        inside ^= across & (points[:, 0] < a[0] + run * (points[:, 1] - a[1]))
    return inside


def waves(random: Generator, points: Array) -> Array:
    height = np.full(len(points), random.uniform(0.2, 0.8))
    for _ in range(random.integers(1, 5)):
        amplitude, number = random.normal(0, 0.08), random.uniform(2, 25)
        height += amplitude * np.sin(number * points[:, 0] + random.uniform(0, 6))
    return points[:, 1] < height


def heap(random: Generator, points: Array) -> Array:
    """Below a broken line, which falls to the ground at its end."""
    bends = np.sort(random.uniform(0, 1, random.integers(2, 7)))
    heights = np.append(random.uniform(0.1, 0.9, len(bends) - 1), 0)
    return points[:, 1] < np.interp(points[:, 0], bends, heights)


def clusters(random: Generator, num_points: int) -> Array:
    """One to eight normal ones of any widths."""
    number = random.integers(1, 9)
    centres = random.uniform(0, 1, (number, 2))
    widths = np.exp(random.uniform(np.log(0.003), np.log(0.25), (number, 1, 1)))
    spread = widths * random.normal(0, 1, (number, 2, 2))
    own = random.choice(number, num_points, p=random.dirichlet(np.ones(number)))
    return centres[own] + np.einsum("nij,nj->ni", spread[own], random.normal(0, 1, (num_points, 2)))


def bands(random: Generator, num_points: int) -> Array:
    """Of some width along one to four random curves."""
    points = []
    for _ in range(random.integers(1, 5)):
        t = random.uniform(0, 1, num_points)[:, None]
        a, b, c = random.uniform(0, 1, (3, 2))
        middle = (1 - t) ** 2 * a + 2 * t * (1 - t) * b + t**2 * c
        width = np.exp(random.uniform(np.log(0.003), np.log(0.08)))
        points.append(middle + width * random.uniform(-1, 1, (num_points, 2)))
    return random.permutation(np.concatenate(points))[:num_points]


SHAPES = (polygon, polygon, waves, heap, clusters, bands)
