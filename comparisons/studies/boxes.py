"""The paper's statistical domain without its random points: the boxes they are drawn from."""

from __future__ import annotations

import numpy as np
from methods import setting_of
from results import Results

AXES = ("x", "y")


def excess_of_boxes(results: Results, workload: str, setting: str) -> float:
    """How far the fullest part is above the mean if the boxes of mean ± k σ are bisected."""
    cells = results.data("cells", workload)
    points = results.data("points", workload, setting)[list(AXES)].to_numpy()
    k = setting_of(setting)[1]
    mean, sigma = (cells[[f"{of}_{a}" for a in AXES]].to_numpy() for of in ("mean", "sigma"))
    weight = cells["weight"].to_numpy(float)
    sizes = divide(mean - k * sigma, mean + k * sigma, weight, points, cells["rank"].nunique())
    return max(sizes) * len(sizes) / len(points) - 1


def divide(
    lower: np.ndarray, upper: np.ndarray, weight: np.ndarray, points: np.ndarray, parts: int
) -> list[int]:
    """Numbers of points in each part of the bisection of evenly filled boxes."""
    if parts == 1:
        return [len(points)]
    axis = int(np.argmax(upper.max(axis=0) - lower.min(axis=0)))
    low, high = lower[:, axis], upper[:, axis]
    below = parts // 2
    cut = _quantile(low, high, weight, below / parts)
    share = _share_below(low, high, cut)
    sides = []
    for is_upper, of_side in ((False, share), (True, 1 - share)):
        kept = of_side * weight > 0
        ends = [lower[kept].copy(), upper[kept].copy()]
        ends[1 - is_upper][:, axis] = (np.maximum if is_upper else np.minimum)(
            ends[1 - is_upper][:, axis], cut
        )
        inside = points[(points[:, axis] >= cut) == is_upper]
        number = parts - below if is_upper else below
        sides += divide(*ends, (of_side * weight)[kept], inside, number)
    return sides


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
    """Share of the drawn points that lie in squares without a material point; NaN without files."""
    drawn = results.data("statistical", workload)
    files = sorted((results.folder / "data").glob(f"points_{workload}_*.csv"))
    if drawn.empty or not files:
        return float("nan")
    real = np.loadtxt(files[0], delimiter=",", skiprows=1, usecols=(0, 1))
    squares = {tuple(square) for square in np.floor(real / side).astype(int)}
    places = np.floor(drawn[list(AXES)].to_numpy() / side).astype(int)
    return float(np.mean([tuple(place) not in squares for place in places]))
