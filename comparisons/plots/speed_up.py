"""Speed-up of the simulation over the serial one: figure 5 and table 1 of the paper."""

from __future__ import annotations

import csv
import os
from dataclasses import dataclass, fields, replace
from pathlib import Path
from statistics import median, mode

from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from intervals import Spread, interval95, spread_of
from results import Simulation, read_simulations
from settings import SETTING, draw_lines, legend_above, setting_of, values_of
from style import method_style, save

SIMULATIONS = "sweep_simulation.csv"
EVERY_STEP = "paper_simulation.csv"  # rebalanced at every step
STANDARD = "rrcb-sampled[mesh=4,k=1.5,fraction=1]"  # the paper's RRCB
WINNERS = (  # the settings with which it was faster than RCB in the paper
    "rrcb-sampled[mesh=2,k=1.5,fraction=0.25]",
    "rrcb-sampled[mesh=4,k=2,fraction=0.125]",
    "rrcb-sampled[mesh=6,k=2,fraction=0.125]",
    "rrcb-sampled[mesh=8,k=2,fraction=0.125]",
)
OTHERS = ("none", "zoltan-rcb", "root-rcb", "rrcb", "rrcb-exact")
KINDS = {
    "critical_path": "critical path: a core for every rank",
    "points": "points alone: no costs of balancing and messages",
    "wall": "wall time on this machine",
}


@dataclass(frozen=True)
class SpeedUp:
    """How many times as fast as the serial simulation, each way of looking at it: medians."""

    run: Simulation  # of medians over the repeats
    critical_path: float
    every_step: float  # the critical path, were every step followed by a rebalance
    points: float
    wall: float
    spreads: dict[str, Spread]  # of these, by name, and of the mean imbalance


def read_speed_ups(directory: Path, name: str = SIMULATIONS) -> list[SpeedUp]:
    """One per method and number of ranks, over the median of the serial runs."""
    runs = read_simulations(directory, name)
    last = next((run for run in reversed(runs) if run.method == "serial"), None)
    if last is None:
        return []
    repeats = _repeats([run for run in runs if _size_of(run) == _size_of(last)])
    serial = middle_run(repeats["serial", 1])
    return [_speed_up(same, serial) for same in repeats.values()]


def middle_runs(runs: list[Simulation]) -> list[Simulation]:
    """Medians over the repeats of each simulation."""
    sizes = dict.fromkeys(_size_of(run) for run in runs)
    return [
        middle_run(same)
        for size in sizes
        for same in _repeats([run for run in runs if _size_of(run) == size]).values()
    ]


def middle_run(same: list[Simulation]) -> Simulation:
    numbers = {
        field.name: median(getattr(run, field.name) for run in same)
        for field in fields(Simulation)
        if all(isinstance(getattr(run, field.name), float) for run in same)
    }
    return replace(
        same[0],
        **numbers,
        wall_interval=interval95([run.wall for run in same]),
        imbalance_interval=interval95([run.mean_imbalance for run in same]),
        critical_path_interval=interval95([run.critical_path for run in same]),
    )


def _repeats(runs: list[Simulation]) -> dict[tuple[str, int], list[Simulation]]:
    repeats: dict[tuple[str, int], list[Simulation]] = {}
    for run in runs:
        repeats.setdefault((run.method, run.ranks), []).append(run)
    return repeats


def _size_of(run: Simulation) -> tuple[int, int, int]:
    return run.points, run.steps, run.every


def _speed_up(same: list[Simulation], serial: Simulation) -> SpeedUp:
    kinds = [_kinds(run, serial) for run in same]
    spreads = {kind: spread_of([of_run[kind] for of_run in kinds]) for kind in kinds[0]}
    medians = {kind: spread.median for kind, spread in spreads.items()}
    spreads["mean_imbalance"] = spread_of([run.mean_imbalance for run in same])
    return SpeedUp(middle_run(same), **medians, spreads=spreads)


def _kinds(run: Simulation, serial: Simulation) -> dict[str, float]:
    step = run.step_path + run.step_network
    balance = run.balance_path + run.balance_network
    rebalances = -(-run.steps // run.every)
    return {
        "critical_path": serial.step_path / (step + balance),
        "every_step": serial.step_path / (step + balance / rebalances * run.steps),
        "points": run.points * run.steps / run.path_points,
        "wall": serial.wall / run.wall,
    }


def write_speed_ups(directory: Path) -> None:
    """speed_up.csv: a row per method and number of ranks; nothing without simulations."""
    speed_ups = read_speed_ups(directory)
    if not speed_ups:
        return
    kinds = ("critical_path", "every_step", "points", "wall", "mean_imbalance")
    names = [f"speed_up_{kind}" for kind in ("critical_path", "critical_path_every_step")]
    names += ["speed_up_points", "speed_up_wall", "mean_imbalance"]
    with (directory / "speed_up.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(
            "method,mesh,k,fraction,ranks,cores,points,steps,every,repeats".split(",")
            + [f"{name}{end}" for name in names for end in ("", "_low", "_high")]
            + ["worst_imbalance"]
        )
        for s in speed_ups:
            match = SETTING.fullmatch(s.run.method)
            row = [s.run.method, *(match.groups() if match else ("", "", "")), s.run.ranks]
            row += [os.cpu_count(), s.run.points, s.run.steps, s.run.every]
            row.append(s.spreads["critical_path"].count)
            for kind in kinds:
                spread, digits = s.spreads[kind], 6 if kind == "mean_imbalance" else 4
                ends = spread.interval or ("", "")
                row += [number if number == "" else f"{number:.{digits}g}" for number in
                        (spread.median, *ends)]
            writer.writerow([*row, f"{s.run.worst_imbalance:.6g}"])


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
            _draw_intervals(axes, chosen, kind)
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


def _draw_intervals(axes: Axes, chosen: list[SpeedUp], kind: str) -> None:
    """Of the settings that were run more than once."""
    for s in chosen:
        spread = s.spreads[kind]
        if spread.interval:
            mesh = setting_of(s.run.method)[0]
            axes.plot([mesh, mesh], spread.interval, color="#222222", linewidth=2.5, alpha=0.6)


def _draw_others(axes: Axes, others: list[SpeedUp], kind: str) -> None:
    for s in others:
        style = method_style(s.run.method)
        axes.axhline(
            getattr(s, kind),
            color=style.colour,
            linestyle=style.line,
            linewidth=1,
            label=s.run.method,
        )
        axes.axhspan(
            s.spreads[kind].low, s.spreads[kind].high, color=style.colour, alpha=0.12, linewidth=0
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
            spreads = [s.spreads[kind] for s in speed_ups]
            lows, highs = [s.low for s in spreads], [s.high for s in spreads]
            axes.fill_between(ranks, lows, highs, color=style.colour, alpha=0.2, linewidth=0)
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
        by_ranks = {s.run.ranks: s.spreads[kind].text(2) for s in rows}
        lines.append([method, "1.00", *(by_ranks.get(number, "–") for number in numbers)])
    return ["method", "1 rank", *(f"{number} ranks" for number in numbers)], lines
