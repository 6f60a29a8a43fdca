"""Speed-up of the simulation over the serial one: figure 5 and table 1 of the paper."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import mode

import pandas as pd
import plot
from intervals import Value, interval95, median_of
from machine import CORES
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from methods import parse, setting_of, values_of
from results import Results

OTHERS = ("none", "zoltan-rcb", "root-rcb", "rrcb", "rrcb-exact")
KINDS = {
    "critical_path": "critical path: a core for every rank",
    "points": "points alone: no costs of balancing and messages",
    "wall": "wall time on this machine",
}
SIZE = ["points", "steps", "every"]


@dataclass(frozen=True)
class SpeedUp:
    """How many times as fast as the serial simulation: medians over the repeats of a run."""

    run: object  # of medians
    kinds: dict[str, Value]  # each way of looking at it, and the mean imbalance

    @property
    def numbers(self) -> dict:
        """A row of speed_up.csv."""
        run = self.run
        setting = parse(run.method)[1] if setting_of(run.method) else {}
        row = {"method": run.method}
        row |= {name: setting.get(name, "") for name in ("mesh", "k", "fraction")}
        row |= {"ranks": run.ranks, "cores": CORES, "points": run.points, "steps": run.steps}
        row |= {"every": run.every, "repeats": self.kinds["wall"].count}
        for kind, name in (
            ("critical_path", "speed_up_critical_path"),
            ("every_step", "speed_up_critical_path_every_step"),
            ("points", "speed_up_points"),
            ("wall", "speed_up_wall"),
            ("mean_imbalance", "mean_imbalance"),
        ):
            value, digits = self.kinds[kind], 6 if kind == "mean_imbalance" else 4
            row[name] = f"{value.number:.{digits}g}"
            for end in ("low", "high"):
                row[f"{name}_{end}"] = f"{getattr(value, end):.{digits}g}".replace("nan", "")
        return {**row, "worst_imbalance": f"{run.worst_imbalance:.6g}"}


def middle_runs(runs: pd.DataFrame) -> pd.DataFrame:
    """Medians over the repeats of each simulation, with their intervals."""
    if runs.empty:
        return runs
    groups = runs.groupby(SIZE + ["method", "ranks"], sort=False)
    middle = groups.median(numeric_only=True)
    for name in ("wall_s", "mean_imbalance", "critical_path_s"):
        ends = groups[name].agg(list).map(interval95)
        middle[f"{name}_low"], middle[f"{name}_high"] = ends.str[0], ends.str[1]
    return middle.reset_index()


def read_speed_ups(runs: pd.DataFrame) -> list[SpeedUp]:
    """One per method and number of ranks, over the median of the serial runs like the last one."""
    serial = runs[runs["method"] == "serial"] if len(runs) else runs
    if serial.empty:
        return []
    size = serial.iloc[-1][SIZE]
    runs, serial = (rows[(rows[SIZE] == size).all(axis=1)] for rows in (runs, serial))
    step = runs["step_path_s"] + runs["step_network_s"]
    balance = runs["balance_path_s"] + runs["balance_network_s"]
    rebalances = -(-runs["steps"] // runs["every"])
    work = serial["step_path_s"].median()
    kinds = pd.DataFrame(
        {
            "critical_path": work / (step + balance),
            "every_step": work / (step + balance / rebalances * runs["steps"]),
            "points": runs["points"] * runs["steps"] / runs["path_points"],
            "wall": serial["wall_s"].median() / runs["wall_s"],
            "mean_imbalance": runs["mean_imbalance"],
        }
    )
    groups = kinds.groupby([runs["method"], runs["ranks"]])
    found = []
    for run in middle_runs(runs).itertuples():
        repeats = groups.get_group((run.method, run.ranks))
        found.append(SpeedUp(run, {kind: median_of(values) for kind, values in repeats.items()}))
    return found


def draw_speed_up(results: Results) -> Figure | None:
    """Figure 5 of the paper: speed-up of the simulation over the serial one. Top, with a core for
    every rank, reckoned from the processor time of each rank outside MPI and a network of 1.5 µs
    and 12 GB/s; middle, by the points of the fullest rank alone; bottom, as the clock on this
    machine saw it. Bars and bands: 95 % intervals of what was run more than once."""
    speed_ups = read_speed_ups(results.swept_runs)
    rows = [s for s in speed_ups if setting_of(s.run.method)]
    if not rows:
        return None
    ranks = mode(s.run.ranks for s in rows)
    rows = [s for s in rows if s.run.ranks == ranks]
    others = [s for s in speed_ups if s.run.ranks == ranks and s.run.method in OTHERS]
    fractions = values_of([s.run.method for s in rows], 2)[::-1]
    width = 2.8 * max(2, len(fractions)) + 0.6
    figure, grid = plot.panels(3, len(fractions), width, 9, sharey="row")
    for kind, line in zip(KINDS, grid):
        for axes, fraction in zip(line, fractions):
            chosen = [s for s in rows if setting_of(s.run.method)[2] == fraction]
            _draw_kind(axes, chosen, others, kind)
        is_shared = kind == "wall" and CORES < ranks
        title = f"wall time: {ranks} ranks share {CORES} cores" if is_shared else KINDS[kind]
        line[0].set_title(title, loc="left", fontsize=9)
    cells = "support mesh, cells per axis\n"
    plot.label_edges(grid, [f"{cells}{100 * fraction:g} % of the points" for fraction in fractions],
                ["speed-up over serial"] * len(grid))  # fmt: skip
    return plot.legend_above(figure, grid[0, 0])


def _draw_kind(axes: Axes, settings: list[SpeedUp], others: list[SpeedUp], kind: str) -> None:
    numbers = [(s.run.method, s.kinds[kind].number) for s in settings]
    plot.draw_settings(axes, pd.DataFrame(numbers, columns=["method", kind]), kind)
    for s in settings:
        mesh, reach = setting_of(s.run.method)[0], s.kinds[kind].reach
        if s.kinds[kind].has_interval:
            axes.plot([mesh, mesh], reach, color="#222222", linewidth=2.5, alpha=0.6)
    for s in others:
        style = plot.method_style(s.run.method)
        plot.draw_across(axes, s.kinds[kind], style, linewidth=1, label=s.run.method)


def draw_ranks(results: Results) -> Figure | None:
    """Table 1 of the paper: speed-up over the number of ranks."""
    table = by_ranks(read_speed_ups(results.swept_runs))
    if not table:
        return None
    figure, grid = plot.panels(1, len(KINDS), 3.9 * len(KINDS), 3.9)
    for axes, kind in zip(grid[0], KINDS):
        for method, rows in table.items():
            values = [s.kinds[kind] for s in rows.values()]
            look = {**plot.method_style(method).look, "markersize": 4, "label": method}
            plot.draw_line(axes, list(rows), values, 0.2, **look)
        most = max(ranks for rows in table.values() for ranks in rows)
        if kind != "wall" or most <= CORES:
            axes.plot([1, most], [1, most], color="#BBBBBB", linewidth=0.8, label="ideal")
        axes.set_title(kind.replace("_", " ") + f" ({CORES} cores)" * (kind == "wall"))
        axes.grid(True)
    plot.label_edges(grid, ["ranks"] * len(KINDS), ["speed-up over serial"])
    return plot.legend_above(figure, grid[0, 0])


def by_ranks(speed_ups: list[SpeedUp]) -> dict[str, dict[int, SpeedUp]]:
    """Of the methods that were run at more than one number of ranks, by this."""
    found: dict[str, dict[int, SpeedUp]] = {}
    for s in sorted(speed_ups, key=lambda s: s.run.ranks):
        found.setdefault(s.run.method, {})[s.run.ranks] = s
    names = dict.fromkeys(s.run.method for s in speed_ups)
    names = [name for name in names if name in OTHERS or name.startswith("rrcb-sampled")]
    return {name: found[name] for name in names if len(found[name]) > 1}


def rank_table(speed_ups: list[SpeedUp], kind: str) -> list[dict[str, str]]:
    """A row per method, a column per number of ranks: table 1 of the paper."""
    table = by_ranks(speed_ups)
    numbers = sorted({ranks for rows in table.values() for ranks in rows})
    return [
        {"method": method, "1 rank": "1.00"}
        | {f"{n} ranks": rows[n].kinds[kind].text(2) if n in rows else "–" for n in numbers}
        for method, rows in table.items()
    ]


def speed_up_table(speed_ups: list[SpeedUp]) -> list[dict[str, str]]:
    columns = {
        "critical path": ("critical_path", 2), "rebalanced at every step": ("every_step", 2),
        "points": ("points", 2), "wall": ("wall", 2), "mean imbalance": ("mean_imbalance", 4),
    }  # fmt: skip
    return [
        {"method": s.run.method, "ranks": str(s.run.ranks), "runs": str(s.kinds["wall"].count)}
        | {name: s.kinds[kind].text(digits) for name, (kind, digits) in columns.items()}
        for s in sorted(speed_ups, key=lambda s: s.run.ranks)
    ]
