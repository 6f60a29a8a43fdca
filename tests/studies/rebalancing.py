"""Compares the controller with fixed intervals and other rules of when to rebalance."""

from __future__ import annotations

import argparse
import ctypes
from collections.abc import Iterator
from pathlib import Path

import support  # noqa: F401, before the studies

import numpy as np
import pandas as pd
import plot
from document import markdown_table
from driver import OUT, ROOT, Driver, build
from load_histories import NOISES, History, false_starts, foreign, generated, noise, recorded, strangers
from matplotlib.figure import Figure

OURS, LOAD_ONLY, BEST = "controller", "controller, load alone", "best interval or never"
LEVELS = (0.03, 0.06, 0.1)
SEEDS = (1, 2)
SCENES = ("slope", "dam_break")
NUMBERS = ctypes.POINTER(ctypes.c_double)


class Replay:
    """The library's rule over a history, told of each step and rebalance."""

    def __init__(self, library: Path) -> None:
        self.library = ctypes.CDLL(str(library))
        self.library.rule_replay_create.restype = ctypes.c_void_p
        self.library.rule_replay_free.argtypes = [ctypes.c_void_p]
        self.library.rule_replay_rebalanced.argtypes = [ctypes.c_void_p, ctypes.c_double]
        self.library.rule_replay_run.argtypes = [ctypes.c_void_p, NUMBERS, NUMBERS, ctypes.c_int]

    def rebalances(self, history: History, factors: np.ndarray, has_points: bool) -> list[int]:
        """Steps before which it rebalances."""
        rule = self.library.rule_replay_create(history.ranks)
        if history.cost_is_known:
            self.library.rule_replay_rebalanced(rule, history.cost_of[0])
        made, step, found = 0, 0, []
        while step < history.steps:
            steps = np.arange(step, min(step + 64, history.steps))
            loads, points = history.loads(made, steps)
            arrays = [np.ascontiguousarray(loads * factors[steps]), np.ascontiguousarray(points)]
            first, second = (array.ctypes.data_as(NUMBERS) for array in arrays)
            taken = self.library.rule_replay_run(rule, first, second if has_points else None, len(steps))
            step += taken or len(steps)
            if taken and step < history.steps:
                made = step
                found.append(step)
                self.library.rule_replay_rebalanced(rule, history.cost_of[step])
        self.library.rule_replay_free(rule)
        return found


def when_waste_is_cost(history: History, factors: np.ndarray) -> list[int]:
    """Menon's rule: once the waste since the last rebalance is what it cost."""
    made, found = 0, []
    while made < history.steps:
        loads = history.loads(made, np.arange(made, history.steps))[0] * factors[made:]
        waste = np.cumsum(loads.max(1) - loads.mean(1))
        later = np.flatnonzero(waste >= history.cost_of[made])
        if not len(later) or made + later[0] + 1 >= history.steps:
            break
        made += int(later[0]) + 1
        found.append(made)
    return found


def cost_of(history: History, factors: np.ndarray, rebalances: list[int]) -> float:
    """The heaviest loads of all steps and the rebalances."""
    steps = np.arange(history.steps)
    starts = np.array([0, *rebalances])
    made = starts[np.searchsorted(starts, steps, side="right") - 1]
    loads = history.loads(made, steps)[0] * factors
    return float(loads.max(1).sum() + history.cost_of[rebalances].sum())


def intervals(steps: int) -> list[int]:
    """A fifth apart, and `steps`, which is never."""
    return sorted({round(x) for x in np.geomspace(1, steps, int(np.log(steps) / np.log(1.2)) + 2)})


def rows_of(replay: Replay, trace: str, history: History, factors: np.ndarray) -> Iterator[dict]:
    """A row per rule; fixed intervals only where there is no noise."""
    steps = history.steps
    fixed = {every: cost_of(history, factors, [*range(every, steps, every)]) for every in intervals(steps)}
    best = min(fixed.values())
    costs = {BEST: best, "never": fixed[steps]}
    costs["waste is cost"] = cost_of(history, factors, when_waste_is_cost(history, factors))
    calls = {}
    for rule, has_points in ((OURS, True), (LOAD_ONLY, False)):
        calls[rule] = replay.rebalances(history, factors, has_points)
        costs[rule] = cost_of(history, factors, calls[rule])
    if np.all(factors == 1):
        costs |= {f"every {every}": cost for every, cost in fixed.items() if every < steps}
    for rule, cost in costs.items():
        yield {"trace": trace, "rule": rule, "cost": cost, "regret": cost / best - 1, "calls": len(calls.get(rule, []))}


def study(replay: Replay, groups: dict[str, list[History]]) -> pd.DataFrame:
    rows = []
    cases = [("no noise", 0.0)] + [(kind, level) for level in LEVELS for kind in NOISES]
    for group, histories in groups.items():
        for seed, history in enumerate(histories):
            for kind, level in cases:
                factors = noise(kind, level, history, seed) if level else np.ones(history.drift.shape)
                trace = f"{group}: {history.name}; {kind}" + (f" {level:.0%}" if level else "")
                rows += [{**row, "group": group, "history": history.name, "level": level}
                         for row in rows_of(replay, trace, history, factors)]  # fmt: skip
    return pd.DataFrame(rows)


def table_of(rows: pd.DataFrame) -> str:
    """Markdown: regrets of the rules, mean and worst, by group and level of noise."""
    lines = [["histories", "noise", *(f"{rule}: mean, worst" for rule in (OURS, LOAD_ONLY, "waste is cost", "never"))]]
    for (group, level), of_case in rows.groupby(["group", "level"], sort=False):
        texts = []
        for rule in (OURS, LOAD_ONLY, "waste is cost", "never"):
            regrets = 100 * of_case.loc[of_case["rule"] == rule, "regret"]
            texts.append(f"{regrets.mean():.1f}, {regrets.max():.1f} %")
        lines.append([group, f"{level:.0%}", *texts])
    return markdown_table(lines)


def summary(rows: pd.DataFrame) -> str:
    """What the table does not show: histories above 5 %, and how far numbers of calls differ."""
    ours = rows[rows["rule"] == OURS]
    worst = ours.groupby(["group", "history"])["regret"].max().sort_values(ascending=False)
    calls = ours.groupby(["group", "history"])["calls"]
    spread = calls.max() - calls.min()
    above = ", ".join(f"{name} ({100 * regret:.0f} %)" for (_, name), regret in worst[worst > 0.05].items())
    return (f"Above 5 % at any noise: {(worst > 0.05).sum()} of {len(worst)}: {above}\n"
            f"Calls within 1: {(spread <= 2).sum()} of {len(spread)}, at most {spread.max()} apart")  # fmt: skip


def draw_regrets(rows: pd.DataFrame) -> Figure:
    """Regret of each history, sorted, of the controller and of the rules that need no tuning."""
    groups = list(rows["group"].unique())
    figure, grid = plot.panels(1, len(groups), 1 + 3.2 * len(groups), 4)
    colours = {OURS: plot.method_style("rrcb").colour, LOAD_ONLY: "#AA7700", "waste is cost": "#B0005E", "never": "#888888"}
    for group, axes in zip(groups, grid[0]):
        for rule, colour in colours.items():
            regrets = rows.loc[(rows["group"] == group) & (rows["rule"] == rule), "regret"]
            axes.plot(np.linspace(0, 100, len(regrets)), 100 * np.sort(regrets), color=colour, label=rule)
        axes.axhline(5, color="#BBBBBB", linewidth=0.8)
        axes.set(yscale="symlog", ylim=(-20, 1000), title=group, xlabel="share of the histories, %")
        axes.grid(True, axis="y")
    grid[0, 0].set_ylabel("cost above the best interval or never, %")
    return plot.legend_above(figure, grid[0, 0])


def draw_intervals(rows: pd.DataFrame) -> Figure:
    """Cost over the interval of recorded histories, with that of the controller."""
    even = rows[(rows["level"] == 0) & (rows["group"] == "recorded")]
    names = list(even["history"].unique())
    figure, grid = plot.panels(1, len(names), 1 + 3 * len(names), 3.6)
    for name, axes in zip(names, grid[0]):
        of_name = even[even["history"] == name]
        fixed = of_name[of_name["rule"].str.startswith("every ")]
        axes.plot(fixed["rule"].str[6:].astype(int), 100 * fixed["regret"], color="#888888")
        ours = of_name.loc[of_name["rule"] == OURS, "regret"].item()
        axes.axhline(100 * ours, color=plot.method_style("rrcb").colour)
        axes.set(xscale="log", yscale="symlog", title=name, xlabel="steps between rebalances")
        axes.grid(True)
    grid[0, 0].set_ylabel("cost above the best interval, %")
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(prog="tests/studies/rebalancing.py", description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT, help="folder of the results; comparisons/out")
    parser.add_argument("--quick", action="store_true", help="coarse scenes, one seed")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    build("rrcb_rule_replay", "rrcb_compare")
    driver = Driver(arguments.out, quick=arguments.quick)
    flags = ["--every=25", "--repeats=1", "--only=simulations"]
    runs = [driver.run(scene, 4, ["zoltan-rcb", "rrcb"], f"--scene={scene}", *flags) for scene in SCENES]
    groups = {
        "generated": [h for seed in SEEDS[: 1 if arguments.quick else 2] for h in generated(seed)],
        "other codes": foreign(SEEDS[0]),
        "strangers": strangers(SEEDS[0]),
        "false starts": false_starts(SEEDS[0]),
        "recorded": [history for run in runs for history in recorded(run)],
    }
    rows = study(Replay(ROOT / "build/release/tests/studies/librrcb_rule_replay.so"), groups)
    columns = ["trace", "rule", "cost", "regret"]
    rows[columns].to_csv(arguments.out / "controller.csv", index=False, float_format="%.6g")
    plot.use_style()
    plot.save(draw_regrets(rows), arguments.out / "controller.png")
    plot.save(draw_intervals(rows), arguments.out / "intervals.png")
    print(table_of(rows), summary(rows), sep="\n")


if __name__ == "__main__":
    main()
