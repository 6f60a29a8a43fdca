"""Runs the paper's RRCB with and without its random points, in repeated calls on points that do not move."""

from __future__ import annotations

from statistics import mean

import numpy as np
from methods import setting_of
from results import Results

AXES = ["x", "y"]
CALLS, FIRST = 12, 4  # each call starts from the parts of the previous one; calls from number FIRST on count


def excesses(
    points: np.ndarray, setting: str, parts: int, random: np.random.Generator | None
) -> float:
    """Returns the mean excess of the fullest part over the mean part. If `random` is None, no points are drawn."""
    mesh, k, fraction = setting_of(setting)
    owners = np.argsort(np.argsort(points[:, 0], kind="stable")) * parts // len(points)
    found = []
    for _ in range(CALLS):
        cells = [cells_of(points[owners == part], int(mesh)) for part in range(parts)]
        count, center, sigma = (np.concatenate(of) for of in zip(*cells))
        lower, upper = center - k * sigma, center + k * sigma
        if random is not None:
            drawn = np.repeat(np.arange(len(count)), np.round(count * fraction).astype(int))
            lower = upper = random.uniform(lower[drawn], upper[drawn])
            count = np.ones(len(drawn))
        owners = divide(lower, upper, count, points, parts)
        found.append(np.bincount(owners, minlength=parts).max() * parts / len(points) - 1)
    return mean(found[FIRST:])


def cells_of(points: np.ndarray, mesh: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns the number, mean and standard deviation of the points in each non-empty cell of a mesh."""
    low, high = points.min(axis=0), points.max(axis=0)
    places = np.minimum(((points - low) / (high - low) * mesh).astype(int), mesh - 1)
    _, cell, count = np.unique(places @ (mesh, 1), return_inverse=True, return_counts=True)
    center = np.stack([np.bincount(cell, x) / count for x in points.T], axis=1)
    square = (points - center[cell]) ** 2
    return count, center, np.sqrt(np.stack([np.bincount(cell, x) / count for x in square.T], axis=1))


def divide(
    lower: np.ndarray, upper: np.ndarray, weight: np.ndarray, points: np.ndarray, parts: int
) -> np.ndarray:
    """Returns the part of each point in the bisection of uniformly filled boxes."""
    if parts == 1:
        return np.zeros(len(points), int)
    axis = int(np.argmax(upper.max(axis=0) - lower.min(axis=0)))
    below = parts // 2
    cut = _quantile(lower[:, axis], upper[:, axis], weight, below / parts)
    share = _share_below(lower[:, axis], upper[:, axis], cut)
    is_upper, owners = points[:, axis] >= cut, np.zeros(len(points), int)
    for side, of_side, number in ((False, share, below), (True, 1 - share, parts - below)):
        kept = of_side * weight > 0
        ends = lower[kept].copy(), upper[kept].copy()
        clip, end = (np.maximum, ends[0]) if side else (np.minimum, ends[1])
        end[:, axis] = clip(end[:, axis], cut)
        inside = is_upper == side
        owners[inside] = below * side + divide(*ends, (of_side * weight)[kept], points[inside], number)
    return owners


def _share_below(low: np.ndarray, high: np.ndarray, cut: float) -> np.ndarray:
    width = np.where(high > low, high - low, 1)
    return np.where(high > low, np.clip((cut - low) / width, 0, 1), low < cut)


def _quantile(low: np.ndarray, high: np.ndarray, weight: np.ndarray, share: float) -> float:
    first, last = low.min(), high.max()
    for _ in range(60):
        middle = (first + last) / 2
        if (_share_below(low, high, middle) * weight).sum() < share * weight.sum():
            first = middle
        else:
            last = middle
    return last


def drawn_outside(results: Results, workload: str, side: float = 1.0) -> float:
    """Returns the share of the drawn points in squares without a material point; NaN if there are no files."""
    drawn, real = results.data("statistical", workload), material_points(results, workload)
    if drawn.empty or not len(real):
        return float("nan")
    squares = {tuple(square) for square in np.floor(real / side).astype(int)}
    places = np.floor(drawn[AXES].to_numpy() / side).astype(int)
    return float(np.mean([tuple(place) not in squares for place in places]))


def material_points(results: Results, workload: str) -> np.ndarray:
    files = sorted((results.folder / "data").glob(f"points_{workload}_*.csv"))
    return np.loadtxt(files[0], delimiter=",", skiprows=1, usecols=(0, 1)) if files else np.empty(0)
