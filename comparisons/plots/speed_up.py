"""Speed-up of the simulation over the serial one: figure 5, table 1 and figure 6 of the paper."""

from __future__ import annotations

import csv
import os
from dataclasses import dataclass
from pathlib import Path
from statistics import mode

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from results import Simulation, read_simulations, read_study_history
from settings import SETTING, draw_lines, legend_above, setting_of, values_of
from style import method_style, multiplier_colour, save

SIMULATIONS = "sweep_simulation.csv"
STANDARD = "rrcb-sampled[mesh=4,k=1.5,fraction=1]"  # the paper's RRCB
OTHERS = ("none", "zoltan-rcb", "root-rcb", "rrcb", "rrcb-exact")
KINDS = {
    "critical_path": "critical path: a core for every rank",
    "points": "points alone: no costs of balancing and messages",
    "wall": "wall time on this machine",
}


@dataclass(frozen=True)
class SpeedUp:
    """How many times as fast as the serial simulation, each way of looking at it."""

    run: Simulation
    critical_path: float
    every_step: float  # the critical path, were every step followed by a rebalance
    points: float
    wall: float


def read_speed_ups(directory: Path) -> list[SpeedUp]:
    runs = read_simulations(directory, SIMULATIONS)
    serial = next((run for run in reversed(runs) if run.method == "serial"), None)
    if serial is None:
        return []
    return [
        _speed_up(run, serial) for run in runs if _size_of(run) == _size_of(serial)
    ]


def _size_of(run: Simulation) -> tuple[int, int, int]:
    return run.points, run.steps, run.every


def _speed_up(run: Simulation, serial: Simulation) -> SpeedUp:
    step = run.step_path + run.step_network
    balance = run.balance_path + run.balance_network
    rebalances = -(-run.steps // run.every)
    return SpeedUp(
        run,
        serial.step_path / (step + balance),
        serial.step_path / (step + balance / rebalances * run.steps),
        run.points * run.steps / run.path_points,
        serial.wall / run.wall,
    )


def write_speed_ups(directory: Path) -> None:
    """speed_up.csv: a row per simulation; nothing without simulations."""
    speed_ups = read_speed_ups(directory)
    if not speed_ups:
        return
    with (directory / "speed_up.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(
            "method,mesh,k,fraction,ranks,cores,points,steps,every,speed_up_critical_path,"
            "speed_up_critical_path_every_step,speed_up_points,speed_up_wall,mean_imbalance,"
            "worst_imbalance".split(",")
        )
        for s in speed_ups:
            match = SETTING.fullmatch(s.run.method)
            writer.writerow(
                [s.run.method, *(match.groups() if match else ("", "", ""))]
                + [s.run.ranks, os.cpu_count(), s.run.points, s.run.steps, s.run.every]
                + [f"{value:.4g}" for value in (s.critical_path, s.every_step, s.points, s.wall)]
                + [f"{s.run.mean_imbalance:.6g}", f"{s.run.worst_imbalance:.6g}"]
            )


def draw_speed_up(directory: Path, picture: Path) -> bool:
    """Figure 5: a column per fraction, a row per way of looking at it."""
    speed_ups = read_speed_ups(directory)
    grid_rows = [s for s in speed_ups if SETTING.fullmatch(s.run.method)]
    if not grid_rows:
        return False
    ranks = mode([s.run.ranks for s in grid_rows])
    rows = [s for s in grid_rows if s.run.ranks == ranks]
    others = [s for s in speed_ups if s.run.ranks == ranks and s.run.method in OTHERS]
    fractions = values_of([s.run.method for s in rows], 3)
    figure, grid = plt.subplots(
        len(KINDS),
        len(fractions),
        figsize=(2.8 * max(2, len(fractions)) + 0.6, 2.7 * len(KINDS) + 0.9),
        squeeze=False,
        sharey="row",
    )
    for kind, axes_row in zip(KINDS, grid):
        for axes, fraction in zip(axes_row, fractions):
            chosen = [s for s in rows if setting_of(s.run.method)[2] == fraction]
            draw_lines(axes, chosen, lambda s: s.run.method, lambda s: getattr(s, kind))
            _draw_others(axes, others, kind)
        axes_row[0].set_ylabel("speed-up over serial")
        axes_row[0].set_title(_title(kind, rows[0].run), loc="left", fontsize=9)
    for axes, fraction in zip(grid[-1], fractions):
        axes.set_xlabel(f"support mesh, cells per axis\n{100 * fraction:g} % of the points")
    legend_above(figure, grid[0, 0].get_legend_handles_labels()[0])
    save(figure, picture)
    return True


def _title(kind: str, run: Simulation) -> str:
    text = KINDS[kind]
    cores = os.cpu_count() or 1
    if kind == "wall" and cores < run.ranks:
        text = f"wall time: {run.ranks} ranks share {cores} cores"
    return text


def _draw_others(axes: Axes, others: list[SpeedUp], kind: str) -> None:
    for s in others:
        style = method_style(s.run.method)
        axes.axhline(
            getattr(s, kind), color=style.colour, linestyle=style.line, linewidth=1,
            label=s.run.method,
        )


def draw_ranks(directory: Path, picture: Path) -> bool:
    """Table 1 as a picture: the standard settings over the number of ranks."""
    table = speed_up_table(read_speed_ups(directory))
    if not table or len({s.run.ranks for speed_ups in table.values() for s in speed_ups}) < 2:
        return False
    figure, grid = plt.subplots(1, len(KINDS), figsize=(3.9 * len(KINDS), 3.9), squeeze=False)
    for axes, kind in zip(grid[0], KINDS):
        most = 1
        for method, speed_ups in table.items():
            style = method_style(method)
            ranks = [s.run.ranks for s in speed_ups]
            most = max(most, *ranks)
            axes.plot(
                ranks,
                [getattr(s, kind) for s in speed_ups],
                color=style.colour,
                linestyle=style.line,
                marker=style.marker,
                markersize=4,
                label=method,
            )
        if kind != "wall" or most <= (os.cpu_count() or 1):
            axes.plot([1, most], [1, most], color="#BBBBBB", linewidth=0.8, label="ideal")
        axes.set_title(kind.replace("_", " ") + f" ({os.cpu_count()} cores)" * (kind == "wall"))
        axes.set_xlabel("ranks")
        axes.grid(True)
    grid[0, 0].set_ylabel("speed-up over serial")
    legend_above(figure, grid[0, 0].get_legend_handles_labels()[0])
    save(figure, picture)
    return True


def speed_up_table(speed_ups: list[SpeedUp]) -> dict[str, list[SpeedUp]]:
    """Of the methods that were run at more than one number of ranks, else at any: by ranks."""
    by_method: dict[str, list[SpeedUp]] = {}
    for s in speed_ups:
        if s.run.method in OTHERS or s.run.method.startswith("rrcb-sampled"):
            by_method.setdefault(s.run.method, []).append(s)
    several = {m: rows for m, rows in by_method.items() if len({s.run.ranks for s in rows}) > 1}
    return {m: sorted(rows, key=lambda s: s.run.ranks) for m, rows in several.items()}


def rank_table(speed_ups: list[SpeedUp], kind: str) -> tuple[list[str], list[list[str]]]:
    """A row per method, a column per number of ranks: table 1 of the paper."""
    table = speed_up_table(speed_ups)
    numbers = sorted({s.run.ranks for rows in table.values() for s in rows})
    lines = []
    for method, rows in table.items():
        by_ranks = {s.run.ranks: f"{getattr(s, kind):.2f}" for s in rows}
        lines.append([method, "1.00", *(by_ranks.get(number, "–") for number in numbers)])
    return ["method", "1 rank", *(f"{number} ranks" for number in numbers)], lines


def draw_study_history(directory: Path, picture: Path) -> bool:
    """Figure 6: worst |Lu| over the steps, a panel per mesh and fraction, a line per k."""
    runs = [s.run for s in read_speed_ups(directory) if SETTING.fullmatch(s.run.method)]
    if not runs:
        return False
    histories = read_study_history(directory, mode([run.ranks for run in runs]))
    if not histories:
        return False
    methods = sorted(histories, key=setting_of)
    meshes = sorted(values_of(methods, 1))
    fractions = values_of(methods, 3)
    figure, grid = plt.subplots(
        len(meshes),
        len(fractions),
        figsize=(2.8 * len(fractions) + 0.6, 1.7 * len(meshes) + 0.9),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    for method in methods:
        mesh, k, fraction = setting_of(method)
        axes = grid[meshes.index(mesh), fractions.index(fraction)]
        colour = multiplier_colour(k)
        axes.plot(*_worst_over_time(histories[method]), color=colour, linewidth=0.9, label=f"k = {k:g}")
    for axes, fraction in zip(grid[0], fractions):
        axes.set_title(f"{100 * fraction:g} % of the points")
    for axes, mesh in zip(grid[:, 0], meshes):
        axes.set_ylabel(f"mesh {mesh:g}\nlargest |Lu| [%]")
    for axes in grid.flat:
        axes.set_yscale("log")
        axes.grid(True, axis="y")
    for axes in grid[-1]:
        axes.set_xlabel("time simulated [s]")
    legend_above(figure, grid[0, 0].get_legend_handles_labels()[0])
    save(figure, picture)
    return True


def _worst_over_time(history: dict[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    times, where = np.unique(history["time"], return_inverse=True)
    worst = np.zeros(len(times))
    np.maximum.at(worst, where, np.abs(history["lu_percent"]))
    return times, worst
