"""Where the error of an estimate comes from: from the points to the samples, stage by stage."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import geometric_mean

from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from intervals import Spread, spread_of
from results import read_rows, unique
from settings import legend_above
from style import MULTIPLIER_COLOURS, method_style, save

OF_THE_PAPER = 1.5


@dataclass(frozen=True)
class Source:
    """A row of error_sources.csv."""

    case: str
    domain: str
    mesh: int
    k: float
    fraction: float
    seed: int
    points: int
    ranks: int
    imbalance: float

    @property
    def excess(self) -> float:
        return max(self.imbalance - 1, self.ranks / self.points)


@dataclass(frozen=True)
class Stage:
    """A line of the picture and the rows it is drawn of."""

    label: str
    colour: str
    line: str
    takes: Callable[[Source], bool]


def _boxes(k: float) -> Callable[[Source], bool]:
    return lambda row: row.domain == "boxes" and abs(row.k - k) < 1e-6


def _sampled(fraction: float) -> Callable[[Source], bool]:
    return lambda row: row.domain == "sampled" and row.fraction == fraction


CELLS, CUT_OFF, WHOLE = (
    method_style(name).colour for name in ("rrcb", "rrcb[tol=1.05]", "rrcb[tol=1.1]")
)
FEW, AS_MANY, MORE = (
    method_style(f"rrcb-sampled{setting}").colour
    for setting in ("[mesh=2,k=1.5,fraction=0.25]", "", "[mesh=8,k=2,fraction=0.125]")
)
K_1, K_1_5, _, K_2_5 = MULTIPLIER_COLOURS
STAGES = (
    Stage("cells, as RRCB does", CELLS, "-", lambda r: r.domain == "cells"),
    Stage("boxes of √3 σ, cut off at the cell", CUT_OFF, ":", lambda r: r.domain == "in_cells"),
    Stage("boxes of √3 σ, cut off at all points", CUT_OFF, "-.", lambda r: r.domain == "in_all"),
    Stage("boxes of √3 σ", WHOLE, "--", _boxes(3**0.5)),
    Stage("boxes of 1 σ", K_1, ":", _boxes(1)),
    Stage("boxes of 1.5 σ", K_1_5, "-", _boxes(OF_THE_PAPER)),
    Stage("boxes of 2.5 σ", K_2_5, "-.", _boxes(2.5)),
    Stage("samples of 1.5 σ, 400 %", MORE, "--", _sampled(4)),
    Stage("samples of 1.5 σ, 100 %", AS_MANY, "-", _sampled(1)),
    Stage("samples of 1.5 σ, 12.5 %", FEW, "-.", _sampled(0.125)),
)


def read_sources(directory: Path) -> list[Source]:
    return [
        Source(
            f"{row['workload']} {row['dim']}-D {row['layout']}",
            row["domain"],
            int(row["mesh"]),
            float(row["k"]),
            float(row["fraction"]),
            int(row["seed"]),
            int(row["points"]),
            int(row["ranks"]),
            float(row["imbalance"]),
        )
        for row in read_rows(directory / "error_sources.csv")
        if not row["error"]
    ]


def draw_sources(directory: Path, picture: Path) -> bool:
    """A panel per cloud: the imbalance each stage leaves, over the support mesh."""
    rows = read_sources(directory)
    if not rows:
        return False
    names = unique([row.case for row in rows])
    columns = min(4, len(names))
    lines = -(-len(names) // columns)
    figure, grid = plt.subplots(
        lines,
        columns,
        figsize=(3.1 * columns + 0.6, 2.5 * lines + 1.1),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    for axes, name in zip(grid.flat, names):
        _draw_case(axes, [row for row in rows if row.case == name])
        axes.set_title(name, fontsize=9)
    for axes in grid.flat[len(names) :]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel("support mesh, cells per axis")
    for axes in grid[:, 0]:
        axes.set_ylabel("imbalance − 1, at least a point")
    legend_above(figure, grid[0, 0].get_legend_handles_labels()[0], inches=2.4)
    save(figure, picture)
    return True


def _draw_case(axes: Axes, rows: list[Source]) -> None:
    exact = next(row for row in rows if row.domain == "points")
    axes.axhline(exact.excess, color="#000000", linewidth=0.8, label="all points")
    for stage in STAGES:
        by_mesh = _by_mesh([row for row in rows if stage.takes(row)])
        if not by_mesh:
            continue
        meshes = list(by_mesh)
        spreads = [spread_of(values) for values in by_mesh.values()]
        axes.plot(
            meshes,
            [spread.median for spread in spreads],
            color=stage.colour,
            linestyle=stage.line,
            marker=".",
            label=stage.label,
        )
        axes.fill_between(
            meshes,
            [spread.low for spread in spreads],
            [spread.high for spread in spreads],
            color=stage.colour,
            alpha=0.15,
            linewidth=0,
        )
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_yscale("log")
    axes.grid(True)


def _by_mesh(rows: list[Source]) -> dict[int, list[float]]:
    meshes = sorted({row.mesh for row in rows})
    return {mesh: [row.excess for row in rows if row.mesh == mesh] for mesh in meshes}


def source_table(rows: list[Source]) -> tuple[list[str], list[list[str]]]:
    """Imbalance beyond 1 in percent, per mesh and stage: geometric mean over the clouds of the
    medians over the seeds, with that of the ends of their intervals."""
    meshes = sorted({row.mesh for row in rows if row.mesh > 0})
    header = ["what is bisected", *(f"mesh {mesh}" for mesh in meshes)]
    exact = mean_excess([row for row in rows if row.domain == "points"])
    table = [["all points (one point at least)", *([_text(exact)] * len(meshes))]]
    for stage in STAGES:
        chosen = [row for row in rows if stage.takes(row)]
        if chosen:
            table.append(
                [
                    stage.label,
                    *(_text(mean_excess([r for r in chosen if r.mesh == mesh])) for mesh in meshes),
                ]
            )
    return header, table


def mean_excess(rows: list[Source]) -> Spread:
    """In percent, over the clouds of these rows."""
    by_case = [
        spread_of([row.excess for row in rows if row.case == case])
        for case in unique([row.case for row in rows])
    ]
    middle = 100 * geometric_mean([spread.median for spread in by_case])
    if not all(spread.interval for spread in by_case):
        return Spread(middle, None, len(by_case))
    ends = ([spread.low for spread in by_case], [spread.high for spread in by_case])
    low, high = (100 * geometric_mean(values) for values in ends)
    return Spread(middle, (low, high), len(by_case))


def _text(excess: Spread) -> str:
    if excess.interval is None:
        return f"{excess.median:.3g}"
    return f"{excess.median:.3g} [{excess.low:.3g}, {excess.high:.3g}]"
