"""What weights gain on points that cost differently: the busiest part by counted work, with each point counted as 1 and
with its cost as weight.

materials: a square of points of two materials, one of which costs four times the other; their border is not along an
axis. neighbours: SPH points whose density, and number of neighbours, rises from 10 to 60 along such a direction.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from document import markdown_table
from driver import Driver, driver_of, options
from intervals import median_of
from results import read

METHOD, RANKS, SEEDS = "rrcb-arrays", 4, 10


def materials(random: np.random.Generator, direction: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    points = random.random((count, 2))
    return points, np.where((points - 0.5) @ direction > 0, 4.0, 1.0)


def neighbours(random: np.random.Generator, direction: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    points = random.random((4 * count, 2))
    along = (points - 0.5) @ direction / np.abs(direction).sum() + 0.5
    cost = 10 + 50 * along
    kept = np.flatnonzero(random.random(len(cost)) < cost / 60)[:count]
    return points[kept], cost[kept]


def busiest(driver: Driver, name: str, points: np.ndarray, cost: np.ndarray, has_weights: bool) -> float:
    """Returns the work of the busiest part, over the mean."""
    table = pd.DataFrame({"x": points[:, 0], "y": points[:, 1]} | ({"weight": cost} if has_weights else {}))
    table.to_csv(driver.out / "points.csv", index=False, float_format="%.17g")
    folder = driver.run(name, RANKS, [METHOD], f"--file={driver.out / 'points.csv'}", "--repeats=1")
    found = read(next((folder / "data").glob(f"points_*_{METHOD}.csv")))
    of_point = pd.Series(cost, index=pd.MultiIndex.from_arrays(points.T))
    parts = of_point.loc[pd.MultiIndex.from_frame(found[["x", "y"]])].groupby(found["part"].to_numpy()).sum()
    return parts.max() / parts.mean()


def main() -> None:
    driver = driver_of(options("weights", __doc__, "one seed").parse_args())
    lines = [["points", "counted", "weighed", "time of a step, weighed / counted"]]
    for make in (materials, neighbours):
        pairs = []
        for seed in range(1 if driver.quick else SEEDS):
            random = np.random.default_rng(seed)
            angle = random.uniform(0.2, 1.37)  # at least 11 degrees from the axes
            points, cost = make(random, np.array([np.cos(angle), np.sin(angle)]), 20_000)
            points = points.round(8)  # digits that the driver writes
            pairs.append([busiest(driver, make.__name__, points, cost, weighed) for weighed in (False, True)])
        counted, weighed = np.array(pairs).T
        values = (counted, weighed, weighed / counted)
        lines.append([make.__name__, *(median_of(value).text(3) for value in values)])
    print(markdown_table(lines))


if __name__ == "__main__":
    main()
