"""Draws and tabulates what rules of when to rebalance cost.

rebalancing.py DIRECTORY with controller.csv
"""

from __future__ import annotations

import sys
from pathlib import Path

import pandas as pd
import plot
from document import markdown_table
from matplotlib.figure import Figure
from results import read_all

OPTIMUM, OURS = "optimum", "controller"
# Rules, not balancers: the controller has RRCB's colour, and never that of none.
STYLES = {
    OURS: (plot.method_style("rrcb").colour, "o"),
    "plain criterion": ("#7A5C4A", "^"),
    "imbalance 1.35 for 3 steps; 100 of rest": ("#B0005E", "s"),
    "imbalance 1.1": ("#4B5D0B", "D"),
    "every 20": ("#AA7700", "<"),
    "every 100": ("#AA7700", ">"),
    "never": ("#888888", "x"),
    "best interval": ("#444444", "|"),
}



def regrets_of(rows: pd.DataFrame) -> pd.DataFrame:
    """A row per trace, a column per rule, both in the order of the file."""
    table = rows.pivot(index="trace", columns="rule", values="regret")
    return table.loc[rows["trace"].unique(), rows["rule"].unique()]


def table_of(regrets: pd.DataFrame) -> str:
    """Markdown: a row per rule, regrets of generated and recorded histories."""
    is_recorded = regrets.index.str.contains(", cost ")
    lines = [["rule", "generated: mean", "largest", "recorded: mean", "largest", "above 5 %"]]
    for rule, of_rule in regrets.drop(columns=OPTIMUM).items():
        texts = _mean_and_largest(of_rule[~is_recorded]) + _mean_and_largest(of_rule[is_recorded])
        lines.append([rule, *texts, f"{(of_rule > 0.05).sum()} of {len(of_rule)}"])
    return markdown_table(lines)


def _mean_and_largest(regrets: pd.Series) -> list[str]:
    if regrets.empty:
        return ["-", "-"]
    return [f"{100 * value:.1f} %" for value in (regrets.mean(), regrets.max())]


def draw_regrets(regrets: pd.DataFrame) -> Figure:
    figure, grid = plot.panels(1, 1, 9, 1.5 + 0.2 * len(regrets))
    axes = grid[0, 0]
    places = range(len(regrets))
    for rule, (colour, marker) in STYLES.items():
        is_ours = rule == OURS
        axes.scatter(100 * regrets[rule], places, color=colour, marker=marker, label=rule,
                     s=34 if is_ours else 18, zorder=3 if is_ours else 2)  # fmt: skip
    axes.axvline(5, color="#BBBBBB", linewidth=0.8)
    axes.set_xscale("symlog", linthresh=1)
    axes.set_xlim(-0.1, 2000)
    axes.set_yticks(places, regrets.index)
    axes.invert_yaxis()
    axes.set_xlabel("cost above the optimum, %; linear below 1")
    axes.grid(True, axis="x")
    axes.legend(loc="lower center", bbox_to_anchor=(0.4, 1), ncols=3, fontsize=8)
    return figure


def main() -> None:
    directory = Path(sys.argv[1])
    regrets = regrets_of(read_all(directory / "controller.csv"))
    plot.use_style()
    plot.save(draw_regrets(regrets), directory / "controller.png")
    print(table_of(regrets))


if __name__ == "__main__":
    main()
