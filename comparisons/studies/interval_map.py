"""What rebalances and unbalance cost over the interval between rebalances.

interval_map.py DIRECTORY with the files of rrcb_intervals
"""

from __future__ import annotations

import sys
from pathlib import Path

import pandas as pd
import plot
from document import markdown_table
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import read_all

REFERENCE, NONE, CONTROLLER = "zoltan-rcb", "none", "auto"
COLUMNS = 4  # panels beside one another
CASE = ["scene", "ranks"]
GREY = "#666666"


def predicted(best: pd.Series, every: float) -> float:
    """Overhead of linear growth: see docs/rebalancing.md."""
    return best["cost_steps"] / every + best["floor"] + best["growth"] * (every - 1) / 2


def misses(bests: pd.DataFrame) -> pd.Series:
    """Of the predictions, over the overheads they are for."""
    return (bests["predicted_overhead"] / bests["overhead"] - 1).abs()


def table_of(bests: pd.DataFrame, overheads: pd.DataFrame) -> str:
    """Markdown: a row per case, and of each method what a rebalance takes, the best overhead and
    the controller's; in mean loads of a step, and in percent of the ideal time."""
    none = overheads[overheads["method"] == NONE].set_index(CASE)["overhead"]
    methods = list(bests["method"].unique())
    titles = [f"{what}: `{methods[0]}`" for what in ("steps a rebalance", "best, %", "`auto`, %")]
    titles = [title for first in titles for title in (first, *(f"`{m}`" for m in methods[1:]))]
    lines = [["scene", "ranks", *titles, "`none`, %"]]
    for case, rows in bests.groupby(CASE, sort=False):
        texts = [f"{value:.2f}" for value in rows["cost_steps"]]
        texts += [
            f"{100 * value:.2f}" for name in ("overhead", "auto_overhead") for value in rows[name]
        ]
        lines.append([case[0], str(case[1]), *texts, f"{100 * none[case]:.1f}"])
    return markdown_table(lines)


def draw_map(bests: pd.DataFrame, overheads: pd.DataFrame) -> Figure:
    """A panel per case, those of one number of ranks on lines of their own."""
    cases = {ranks: list(rows.groupby(CASE, sort=False)) for ranks, rows in bests.groupby("ranks")}
    lines = [all_[i : i + COLUMNS] for all_ in cases.values() for i in range(0, len(all_), COLUMNS)]
    columns = max(map(len, lines))
    figure, grid = plot.panels(len(lines), columns, 1 + 3 * columns, 1 + 2.6 * len(lines))
    of_case = dict(list(overheads.groupby(CASE)))
    for line, panels in zip(lines, grid):
        panels[0].set_ylabel("overhead, % of the ideal time")
        for axes in panels[len(line) :]:
            axes.set_visible(False)
        for (case, rows), axes in zip(line, panels):
            draw_case(axes, rows, of_case[case])
            axes.set_title(f"{case[0]}, {case[1]} ranks")
    handles = [
        plot.key(method, color=style.colour, linestyle=style.line)
        for method, style in plot.distinct_styles([NONE, *bests["method"]]).items()
    ]
    handles += [
        plot.key("best", color=GREY, marker="o", markersize=5),
        plot.key("prediction", color=GREY, linestyle="-", linewidth=0.7),
        plot.key("its best", color=GREY, marker="o", markersize=8, markerfacecolor="none"),
        plot.key(CONTROLLER, color=GREY, marker="_", markersize=12, markeredgewidth=2),
    ]
    figure.supxlabel("Points of a replay, counted in parts: without the noise of measured steps")
    return plot.legend_above(figure, handles)


def draw_case(axes: Axes, bests: pd.DataFrame, overheads: pd.DataFrame) -> None:
    none = plot.method_style(NONE)
    of_none = 100 * overheads.loc[overheads["method"] == NONE, "overhead"].item()
    axes.axhline(of_none, color=none.colour, linestyle=none.line)
    for _, best in bests.iterrows():
        style = plot.method_style(best["method"])
        rows = overheads[overheads["method"] == best["method"]]
        rows = rows[rows["every"] != CONTROLLER]
        every = rows["every"].astype(int)
        look = {"color": style.colour}
        axes.plot(every, 100 * rows["overhead"], linestyle=style.line, **look)
        axes.plot(every, 100 * predicted(best, every), linewidth=0.7, **look)
        axes.plot(best["best_every"], 100 * best["overhead"], "o", markersize=5, **look)
        axes.plot(best["predicted_every"], 100 * best["predicted_overhead"], "o", markersize=8,
                  markerfacecolor="none", **look)  # fmt: skip
        axes.plot(1.5 * every.max(), 100 * best["auto_overhead"], "_", markersize=12,
                  markeredgewidth=2, **look)  # fmt: skip
    least = 100 * bests[["overhead", "auto_overhead"]].min().min()
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(0.7 * least, 2 * max(of_none, 3 * least))
    axes.set_xlabel("steps between rebalances")
    axes.grid(True)


def draw_steps(steps: pd.DataFrame) -> Figure:
    """Imbalance and lost time over the steps, on the fewest ranks, of none, REFERENCE and rrcb."""
    steps = steps[steps["ranks"] == steps["ranks"].min()]
    steps = steps[steps["method"].isin([NONE, REFERENCE, "rrcb"])]
    figure, grid = plot.panels(2, 1, 9, 6, sharex=True)
    above, below = grid[:, 0]
    for (method, every), run in steps.fillna({"every": ""}).groupby(["method", "every"]):
        style = plot.method_style(method)
        when = {"": "", CONTROLLER: ", auto"}.get(every, f", every {every}")
        is_auto = every == CONTROLLER
        look = {"color": style.colour, "linestyle": "-" if is_auto else "--"}
        above.plot(run["step"], run["imbalance"], linewidth=1, **look)
        below.plot(run["step"], run["lost"], label=method + when, **look)
        rebalanced = run[run["rebalanced"] == 1]
        below.plot(rebalanced["step"], rebalanced["lost"], "|" if is_auto else ".",
                   color=style.colour)  # fmt: skip
    of_methods = steps[steps["method"] != NONE]
    above.set_ylim(0.999, 1 + 1.2 * (of_methods["imbalance"].max() - 1))
    below.set_ylim(0, 1.3 * of_methods["lost"].max())
    above.set_ylabel("heaviest load / mean")
    below.set_ylabel("lost so far, in mean loads of a step")
    below.set_xlabel("step")
    above.set_title(f"{steps['scene'].iloc[0]}, {steps['ranks'].iloc[0]} ranks; marks: rebalances")
    for axes in (above, below):
        axes.grid(True)
    return plot.legend_above(figure, below, inches=2)


def main() -> None:
    directory = Path(sys.argv[1])
    bests = read_all(directory / "intervals_optimum.csv")
    overheads = read_all(directory / "intervals.csv")
    plot.use_style()
    plot.save(draw_map(bests, overheads), directory / "intervals.png")
    steps = read_all(directory / "intervals_steps.csv")
    plot.save(draw_steps(steps), directory / "intervals_steps.png")
    missed = 100 * misses(bests)
    print(table_of(bests, overheads))
    print(f"Prediction / best - 1: median {missed.median():.0f} %, at most {missed.max():.0f} %")


if __name__ == "__main__":
    main()
