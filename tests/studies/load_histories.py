"""Histories of loads, whenever the parts are made anew: generated, of other codes, recorded."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

TAU = 2 * np.pi
NOISES = ("white", "correlated", "slow core", "stalls")


@dataclass
class History:
    """Load of rank p in step t, with parts made before step s, over the mean of a first step:

    base[t] (1 + shows[t] (drift[t, p] - drift[s, p]) + kept[t, p] back(t - s)) (1 + slow fade^(t - s))
    """

    name: str
    drift: np.ndarray  # of steps and ranks
    cost: float | np.ndarray  # of a rebalance, in loads
    base: float | np.ndarray = 1.0
    shows: float | np.ndarray = 1.0  # share of the drift in a step: multirate steps
    kept: float | np.ndarray = 0.0  # what no rebalance removes
    decay: float = 0.0  # steps until half of it is back; 0: it never goes
    slow: float = 0.0  # steps after a rebalance
    fade: float = 0.0
    cost_is_known: bool = True  # of the parts at the start
    base_of: np.ndarray = field(init=False)
    cost_of: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        self.steps, self.ranks = self.drift.shape
        self.base_of = np.broadcast_to(np.asarray(self.base, float), self.steps)
        self.cost_of = np.broadcast_to(np.asarray(self.cost, float), self.steps)
        self.kept_of = np.broadcast_to(np.asarray(self.kept, float), self.drift.shape)
        self.shows_of = np.broadcast_to(np.asarray(self.shows, float), self.steps)

    def loads(self, made: np.ndarray | int, steps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Loads and points of each rank in `steps`, whose parts were made before `made`."""
        drift = self.drift[steps] - self.drift[made]
        age = (steps - made)[:, None]
        back = 1 - 0.5 ** (age / self.decay) if self.decay else 1.0
        share = np.maximum(0.05, 1 + self.shows_of[steps, None] * drift + self.kept_of[steps] * back)
        slow = 1 + self.slow * self.fade**age
        return self.base_of[steps, None] * share * slow, np.maximum(0.05, 1 + drift)


def even_out(values: np.ndarray) -> np.ndarray:
    return values - values.mean(-1, keepdims=True)


def generated(seed: int) -> list[History]:
    """1000 steps on 8 ranks, of ten kinds; a rebalance costs 0.3 to 20 steps."""
    steps, ranks = 1000, 8
    t = np.arange(steps)[:, None]
    random = np.random.default_rng(seed)

    def among(low: float, high: float) -> float:
        return low * (high / low) ** random.random()

    def spread(*shape: int) -> np.ndarray:
        return even_out(random.uniform(-1, 1, (*shape, ranks)))

    def growth() -> np.ndarray:
        return t * spread() * among(0.0005, 0.02)

    def jumps() -> np.ndarray:
        size, often = random.uniform(0.2, 1), 1 / random.uniform(30, 150)
        return np.cumsum((random.random(steps) < often)[:, None] * size * spread(steps), 0)

    def swings() -> np.ndarray:
        phase = TAU * t / among(10, 300) + np.pi * spread()
        return random.uniform(0.05, 0.4) * spread() * np.sin(phase)

    def walk() -> np.ndarray:
        return np.cumsum(spread(steps) * among(0.005, 0.05), 0)

    def bursts() -> np.ndarray:
        rates = [spread() * among(0.002, 0.03) * random.integers(2) for _ in range(10)]
        return np.cumsum(np.repeat(rates, steps // 10, 0), 0)

    still, varies = 0 * t * spread(), 1 + 0.5 * np.sin(TAU * t[:, 0] / among(5, 100))
    kinds: dict[str, dict] = {
        "growth": {"drift": growth()},
        "slow growth": {"drift": growth() / 5},
        "jumps": {"drift": jumps()},
        "swings": {"drift": swings()},
        "nothing": {"drift": still},
        "bursts": {"drift": bursts()},
        "random walk": {"drift": walk()},
        "growth, costs grow": {"drift": growth(), "grows": 5 ** (t[:, 0] / steps)},
        "growth, some returns": {
            "drift": growth(), "kept": 0.4 * spread(), "decay": among(2, 40), "base": varies,
        },
        "all at once": {
            "drift": growth() + jumps() + swings() + walk(), "kept": 0.1 * spread(),
            "base": varies, "grows": 0.3 ** (t[:, 0] / steps),
        },
    }  # fmt: skip
    return [
        History(f"{name} {seed}", cost=among(0.3, 20) * kind.pop("grows", 1.0),
                cost_is_known=seed % 2 == 1, **kind)
        for name, kind in kinds.items()
    ]  # fmt: skip


def foreign(seed: int) -> list[History]:
    """About 60 of other codes, of 2 to 64 ranks and 200 to 5000 steps."""
    random = np.random.default_rng(seed)
    histories: list[History] = []

    def add(name: str, drift: np.ndarray, cost: float, **others: object) -> None:
        """Each seed has its own size of drift and cost."""
        factor, dear = 2.5 ** random.uniform(-1, 1, 2)
        histories.append(History(f"{name} {seed}", factor * drift, dear * cost, **others))

    def t(steps: int) -> np.ndarray:
        return np.arange(steps)[:, None] * 1.0

    def one(ranks: int) -> np.ndarray:
        return np.where(np.arange(ranks) == random.integers(ranks), 1, -1 / (ranks - 1))

    def spread(ranks: int) -> np.ndarray:
        return even_out(random.uniform(-1, 1, ranks))

    for ranks, steps, rate, cost in [(2, 200, 2e-3, 0.5), (4, 1000, 1e-3, 2), (16, 2000, 5e-4, 10),
                                     (64, 5000, 2e-4, 30), (8, 500, 1e-2, 1), (32, 1000, 3e-3, 50),
                                     (6, 3000, 5e-5, 5), (4, 500, 1e-2, 0.02), (4, 1000, 2e-3, 100)]:  # fmt: skip
        add(f"growth {rate:g}, {ranks} ranks", t(steps) * rate * one(ranks), cost)
    for ranks, steps, cost in [(4, 1000, 3), (16, 2000, 8), (64, 600, 1)]:
        add(f"growth as root, {ranks} ranks", 0.02 * np.sqrt(t(steps)) * spread(ranks), cost)
        add(f"growth as square, {ranks} ranks", 2e-6 * t(steps) ** 2 * spread(ranks), cost)
        add(f"growth that ends, {ranks} ranks", (1 - np.exp(-t(steps) / 80)) * spread(ranks), cost)
        front = (t(steps) / steps * 1.4 - 0.2 - np.arange(ranks) / ranks) * ranks / 2
        add(f"a front, {ranks} ranks", 0.8 * np.exp(-(front**2)), cost)
    for every, size, cost, ranks, steps in [(10, 0.1, 0.5, 8, 1000), (10, 0.3, 2, 8, 1000),
                                            (10, 0.5, 1, 4, 400), (50, 0.4, 5, 16, 2000),
                                            (250, 0.2, 20, 4, 2000), (1000, 0.5, 40, 32, 5000)]:  # fmt: skip
        sizes = size * even_out(random.uniform(-1, 1, (steps, ranks)))
        add(f"jumps of {size} every {every} steps", np.cumsum((t(steps) % every == 0) * sizes, 0), cost)
    for first, last in [(700, 2000), (3, 2000), (400, 430)]:
        at = (t(2000) >= first) & (t(2000) < last)
        add(f"from step {first} to {last}", 0.4 * at * one(12), 6)
    for slow, fade, cost in [(1, 0.5, 1), (2, 0.8, 3), (0.5, 0.95, 5), (4, 0.6, 0.5)]:
        add(f"slow by {slow} after a rebalance", t(1000) * 0.002 * one(8), cost, slow=slow, fade=fade)
    for period, size, cost, ranks in [(20, 0.2, 1, 4), (100, 0.3, 2, 8), (400, 0.5, 5, 16), (40, 0.5, 20, 8)]:
        add(f"sawtooth of {period} steps", size * (t(1200) % period / period) * spread(ranks), cost)
        add(f"swings of {period} steps", size * np.sin(TAU * (t(1200) / period + random.random(ranks))), cost)
    for k in (2, 3, 4, 5):
        for rate, cost, ranks in [(0.004, 2, 8), (0.001, 10, 16)]:
            shows = np.where(np.arange(2000) % k == 0, 1.5, 0)
            add(f"in one step of {k}, {ranks} ranks", t(2000) * rate * one(ranks), cost, shows=shows, base=1 + shows)
    add("nothing, cheap", 0 * t(1000) * one(8), 0.3)
    add("nothing, dear", 0 * t(3000) * one(32), 50)
    add("fixed imbalance", 0 * t(1000) * one(8), 2, kept=0.3 * spread(8))
    add("fixed and growth", t(2000) * 5e-4 * one(8), 4, kept=0.2 * one(8))
    add("imbalance that returns", t(1000) * 1e-3 * one(8), 3, kept=0.3 * spread(8), decay=10)
    add("stick and slip", np.cumsum((t(2000) % 300 < 60) * 0.004 * spread(10), 0), 4)
    for stride, steps, ranks, cost in [(0.002, 4000, 16, 10), (0.03, 400, 6, 2)]:
        add(f"random walk, {ranks} ranks", np.cumsum(stride * even_out(random.normal(size=(steps, ranks))), 0), cost)
    add("iterations vary", t(1500) * 0.002 * one(8), 5, base=1 + 3 * random.random(1500))
    add("work grows", t(1500) * 0.001 * one(8), 5, base=1 + np.arange(1500) / 300)
    add("cost falls", t(1500) * 0.003 * one(8), 20 * 0.1 ** (np.arange(1500) / 1500))
    add("cost unknown", t(800) * 0.005 * one(8), 12, cost_is_known=False)
    add("drift that turns", 0.4 * np.sin(TAU * t(3000) / 3000) * spread(24), 8)
    return histories


def strangers(seed: int) -> list[History]:
    """60 more of other codes, none of which the rule was chosen by; each seed has its own sizes."""
    random = np.random.default_rng([seed, 60])
    histories: list[History] = []
    ranks_of = (3, 6, 8, 12, 24, 48)

    def add(name: str, drift: np.ndarray, cost: float, **others: object) -> None:
        cost *= 3 ** random.uniform(-1, 1)
        histories.append(History(f"{name}, {drift.shape[1]} ranks {seed}", drift, cost, **others))

    def spread(*shape: int) -> np.ndarray:
        return even_out(random.uniform(-1, 1, shape))

    def some(low: float, high: float) -> float:
        return low * (high / low) ** random.random()

    def reverting(steps: int, ranks: int, over: float) -> np.ndarray:
        """Noise that is correlated over so many steps."""
        pushes, keeps = random.normal(size=(steps, ranks)), np.exp(-1 / over)
        for step in range(1, steps):
            pushes[step] = keeps * pushes[step - 1] + np.sqrt(1 - keeps**2) * pushes[step]
        return even_out(pushes)

    for number, ranks in enumerate(ranks_of):
        steps = int(some(600, 3000))
        t = np.arange(steps)
        grows = t[:, None] * spread(ranks) * some(3e-4, 4e-3)
        deepest = 1 << (1 + number)
        levels = np.gcd(t, deepest) / (1 + np.log2(deepest) / 2)
        add(f"block steps, {deepest} of the least", grows, some(1, 15), shows=levels, base=levels)
        every = (5, 7, 10, 20, 50, 100)[number]
        search = np.where(t % every == 0, some(2, 8), 0.1)
        add(f"contact search every {every} steps", grows, some(1, 10), shows=search, base=1 + search / 4)
        hiccups = 1 + some(3, 20) * (random.random(steps) < 1 / some(20, 200))
        add("stalls of all ranks", grows, some(1, 20), base=hiccups)
        place = (t[:, None] * some(1e-3, 2e-2) - np.arange(ranks) + ranks / 2) % ranks - ranks / 2
        add("a cluster that goes round", even_out(some(0.3, 3) * np.exp(-(place**2))), some(1, 20))
        length = int(some(5, 100))
        hot = (np.convolve(random.random(steps) < 1 / some(100, 400), np.ones(length))[:steps] > 0)[:, None]
        add(f"bursts of {length} steps", np.cumsum(hot * spread(ranks) * some(5e-3, 5e-2), 0), some(1, 15))
        add(f"explosions of {length} steps", hot * spread(ranks) * some(0.1, 0.8), some(1, 15))
        restarts = np.maximum.accumulate(np.where(random.random(steps) < 1 / some(50, 500), t, 0))
        add("linear growth and reset", (t - restarts)[:, None] * spread(ranks) * some(1e-3, 1e-2), some(1, 15))
        over = (3, 10, 30, 100, 300, 1000)[number]
        add(f"load that varies over {over} steps", some(0.02, 0.2) * reverting(steps, ranks, over), some(0.5, 15))
        slow = np.zeros((steps, ranks))
        slow[steps // 3 : steps // 3 + 200, number % ranks] = some(0.1, 1)
        add("a slow core for 200 steps", grows, some(1, 15), kept=slow)
        jumps = np.cumsum((random.random(steps) < 1 / some(20, 300))[:, None] * spread(steps, ranks), 0)
        add("refinement", some(0.05, 0.3) * jumps, some(1, 15), base=1 + np.arange(steps) / some(300, 3000),
            slow=some(0.1, 1), fade=0.7)  # fmt: skip
    return histories


def false_starts(seed: int) -> list[History]:
    """Slow first steps, uneven or not, and first rebalances that cost ten times as much as later ones."""
    random = np.random.default_rng([seed, 7])

    def between(low: float, high: float) -> float:
        return low * (high / low) ** random.random()

    histories = []
    for i in range(40):
        steps, ranks = int(between(300, 2000)), int(between(3, 32))
        t, cost = np.arange(steps), between(0.5, 10)
        each = even_out(random.uniform(-1, 1, ranks))
        drift = [
            t[:, None] * between(3e-4, 1e-2) * each,
            np.cumsum((random.random(steps) < 1 / 60)[:, None] * 0.3 * even_out(random.uniform(-1, 1, (steps, ranks))), 0),
            0.4 * np.sin(TAU * t / between(50, 800))[:, None] * each,
            np.cumsum(even_out(random.normal(size=(steps, ranks))) * between(0.005, 0.03), 0),
        ][i % 4]
        if i < 20:
            slow = t < random.integers(3, 8)
            kept = slow[:, None] * even_out(random.uniform(-0.5, 0.5, ranks)) * (i % 2)
            history = History(f"slow start {i}", drift, cost, np.where(slow, between(3, 30), 1), kept=kept)
        else:
            history = History(f"dear first rebalance {i}", drift, np.where(t == 0, 10 * cost, cost))
        histories.append(history)
    return histories


def recorded(folder: Path) -> list[History]:
    """Of each method of a run of `rrcb_compare --every=N`: its rebalances cost what was measured.

    The drift is what the points of the parts change by from record to record. Of the steps before
    a rebalance, from which they start anew, it is that of the record before.
    """
    points = pd.read_csv(folder / "history.csv")
    histories = []
    for row in pd.read_csv(folder / "simulation_runs.csv").itertuples():
        if not row.rebalances > 0:
            continue
        table = points[points["method"] == row.method].pivot(index="step", columns="part", values="points")
        shares = table.to_numpy() / table.to_numpy().mean(1, keepdims=True)
        change = np.diff(shares, axis=0, prepend=shares[:1])
        starts = np.flatnonzero(np.diff(table.index // int(row.every), prepend=-1))
        change[starts[1:]] = change[starts[1:] - 1]
        drift = np.cumsum(change, 0)
        at = np.arange(row.steps)
        drift = np.stack([np.interp(at, table.index, of_part) for of_part in drift.T], 1)
        mean_step = row.step_path_s / row.steps / row.mean_imbalance
        cost = (row.balance_path_s + row.balance_network_s) / row.rebalances / mean_step
        histories.append(History(f"{folder.name}, {row.method}", drift, cost))
    return histories


def noise(kind: str, level: float, history: History, seed: int) -> np.ndarray:
    """Factors of the loads of steps and ranks."""
    random = np.random.default_rng([seed, NOISES.index(kind), round(1000 * level)])
    shape = (history.steps, history.ranks)
    normal = random.normal(size=shape)
    if kind == "correlated":  # over 20 steps
        keeps = np.exp(-1 / 20)
        for step in range(1, history.steps):
            normal[step] = keeps * normal[step - 1] + np.sqrt(1 - keeps**2) * normal[step]
    factors = np.exp(level * normal / (1 if kind in ("white", "correlated") else 2))
    if kind == "slow core":  # for 200 steps
        start = random.integers(max(1, history.steps - 200))
        factors[start : start + 200, random.integers(history.ranks)] *= 1 + 3 * level
    if kind == "stalls":  # of one rank, in a step of 100 at 10 %
        stalled = random.random(shape) < level / 10 / history.ranks
        factors *= np.where(stalled, random.uniform(2, 10, shape), 1)
    return factors
