"""Random clouds to learn from; none of them is one of those that the prior is judged by. A shape
returns the density at candidates for points, or the points themselves."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

Array = np.ndarray


def random_cloud(random: Generator) -> tuple[Array, Array]:
    """Points in the unit square or so, and the weight of each."""
    num_points = int(np.exp(random.uniform(np.log(4e3), np.log(3e5))))
    shape = SHAPES[random.integers(len(SHAPES))]
    candidates = _lattice(random, num_points) if random.uniform() < 0.4 else None
    if shape in (mixture, strokes):
        points = shape(random, num_points)
    else:
        if candidates is None:
            candidates = random.uniform(size=(2 * num_points, 2))
        density = shape(random, candidates)
        points = candidates[random.uniform(size=len(density)) < density]
    points = _turn(random, points)
    weights = np.ones(len(points))
    if random.uniform() < 0.15:
        weights += random.uniform(0, 9) * (_side(random, points) > 0)
    return points, weights


def _turn(random: Generator, points: Array) -> Array:
    """Turned, stretched and, now and then, reduced to what one rank of several would hold."""
    if random.uniform() < 0.5:
        angle = random.uniform(0, 2 * np.pi)
        points = points @ np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    points = points * np.exp(random.normal(0, 0.3, size=2))
    if random.uniform() < 0.4 and len(points) > 100:
        axis = random.integers(2)
        at = np.quantile(points[:, axis], random.uniform(0.2, 0.8))
        is_lower = points[:, axis] < at
        points = points[is_lower if random.uniform() < 0.5 else ~is_lower]
    return points


def _lattice(random: Generator, num_points: int) -> Array:
    """A lattice as material points have it, bent and shaken."""
    side = int(np.sqrt(2 * num_points))
    x, y = np.meshgrid(*2 * [(np.arange(side) + 0.5) / side])
    points = np.stack([x.ravel(), y.ravel()], axis=1)
    points += random.normal(0, 1, size=points.shape) * random.choice([0.1, 0.25, 0.5]) / side
    for _ in range(2):
        wave = random.normal(0, 5, size=2)
        points += np.outer(np.sin(points @ wave + random.uniform(0, 6)), random.normal(0, 0.03, 2))
    return points


def _side(random: Generator, points: Array) -> Array:
    """Distance from a random line, with its sign."""
    angle = random.uniform(0, 2 * np.pi)
    centre = points.mean(axis=0) + random.normal(0, 0.15, 2)
    return (points - centre) @ np.array([np.cos(angle), np.sin(angle)])


def _gradient(random: Generator, points: Array) -> Array:
    """A density that is even, or grows along a direction."""
    if random.uniform() < 0.5:
        return np.ones(len(points))
    height = random.uniform(0.5, 4) * _side(random, points)
    return np.exp(height - height.max())


def polygon(random: Generator, points: Array) -> Array:
    """Three to nine corners about a centre, now and then with a hole."""
    corners = random.integers(3, 10)
    angles, radii = np.sort(random.uniform(0, 2 * np.pi, corners)), random.uniform(0.2, 0.6, corners)
    inside = _within(points - 0.5, angles, radii)
    if random.uniform() < 0.3:
        inside &= ~_within(points - random.uniform(0.3, 0.7, 2), angles[::-1] * 0.5, radii * 0.4)
    return inside * _gradient(random, points)


def _within(points: Array, angles: Array, radii: Array) -> Array:
    corners = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    inside = np.zeros(len(points), dtype=bool)
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        across = (a[1] > points[:, 1]) != (b[1] > points[:, 1])
        run = (b[0] - a[0]) / (b[1] - a[1] if b[1] != a[1] else 1)
        inside ^= across & (points[:, 0] < a[0] + run * (points[:, 1] - a[1]))
    return inside


def free_surface(random: Generator, points: Array) -> Array:
    """Below waves or a broken line."""
    if random.uniform() < 0.5:
        height = np.full(len(points), random.uniform(0.2, 0.8))
        for _ in range(random.integers(1, 5)):
            amplitude, number = random.normal(0, 0.08), random.uniform(2, 25)
            height += amplitude * np.sin(number * points[:, 0] + random.uniform(0, 6))
    else:
        bends = np.sort(random.uniform(0, 1, random.integers(2, 7)))
        height = np.interp(points[:, 0], bends, random.uniform(0.1, 0.9, len(bends)))
    return (points[:, 1] < height) * _gradient(random, points)


def heap(random: Generator, points: Array) -> Array:
    """A heap on level ground whose height falls to nothing."""
    height, length = random.uniform(0.1, 0.9, 2)
    fall = np.exp(random.uniform(np.log(0.6), np.log(5)))
    profile = height * np.clip(1 - points[:, 0] / length, 0, 1) ** fall
    return (points[:, 1] < profile) * _gradient(random, points)


def discs(random: Generator, points: Array) -> Array:
    """One to six ellipses, each of its own density."""
    density = np.zeros(len(points))
    for _ in range(random.integers(1, 7)):
        turn = random.normal(0, 1, (2, 2)) / random.uniform(0.1, 0.4)
        inside = np.sum(((points - random.uniform(0.1, 0.9, 2)) @ turn) ** 2, axis=1) < 1
        density = np.maximum(density, inside * random.uniform(0.2, 1))
    return density * _gradient(random, points)


def boxes(random: Generator, points: Array) -> Array:
    """One to six boxes, each of its own density."""
    density = np.zeros(len(points))
    for _ in range(random.integers(1, 7)):
        lower = random.uniform(-0.1, 0.8, 2)
        upper = lower + random.uniform(0.05, 0.7, 2)
        inside = np.all((points > lower) & (points < upper), axis=1)
        density = np.maximum(density, inside * random.uniform(0.1, 1))
    return density


def halves(random: Generator, points: Array) -> Array:
    """Everywhere, more on one side of each of some lines."""
    density = np.ones(len(points))
    for _ in range(random.integers(0, 4)):
        density *= np.where(_side(random, points) > 0, 1, random.uniform(0.02, 1))
    return density * _gradient(random, points)


def mixture(random: Generator, num_points: int) -> Array:
    """One to eight normal clusters of any widths, some in an even background."""
    number = random.integers(1, 9)
    centres = random.uniform(0, 1, (number, 2))
    widths = np.exp(random.uniform(np.log(0.003), np.log(0.25), (number, 1, 1)))
    spread = widths * random.normal(0, 1, (number, 2, 2))
    own = random.choice(number, num_points, p=random.dirichlet(np.ones(number)))
    points = centres[own] + np.einsum("nij,nj->ni", spread[own], random.normal(0, 1, (num_points, 2)))
    if random.uniform() < 0.3:
        even = random.uniform(size=num_points) < random.uniform(0.1, 0.9)
        points[even] = random.uniform(0, 1, (even.sum(), 2))
    return points


def strokes(random: Generator, num_points: int) -> Array:
    """Bands of some width along one to four random curves."""
    points = []
    for _ in range(random.integers(1, 5)):
        t = random.uniform(0, 1, num_points)[:, None]
        a, b, c = random.uniform(0, 1, (3, 2))
        middle = (1 - t) ** 2 * a + 2 * t * (1 - t) * b + t**2 * c
        width = np.exp(random.uniform(np.log(0.003), np.log(0.08)))
        points.append(middle + width * random.uniform(-1, 1, (num_points, 2)))
    return np.concatenate(points)[random.permutation(len(points) * num_points)[:num_points]]


SHAPES = (polygon, polygon, free_surface, free_surface, heap, discs, boxes, halves, mixture, mixture, strokes)
