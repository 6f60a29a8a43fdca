"""Draws and tabulates what rules for rebalancing cost: rebalancing.py DIRECTORY with controller.csv.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

from matplotlib import pyplot as plt

from style import method_style, save, use_style

OPTIMUM, OURS = "optimum", "controller"
# Rules, not balancers: the controller has RRCB's colour, and never that of none.
STYLES = {
    OURS: (method_style("rrcb").colour, "o"),
    "plain criterion": ("#7A5C4A", "^"),
    "imbalance 1.35 for 3 steps; 100 of rest": ("#B0005E", "s"),
    "imbalance 1.1": ("#4B5D0B", "D"),
    "every 20": ("#AA7700", "<"),
    "every 100": ("#AA7700", ">"),
    "never": ("#888888", "x"),
    "best interval": ("#444444", "|"),
}

Regrets = dict[str, dict[str, float]]


def read_regrets(file: Path) -> Regrets:
    """Of each trace, by rule."""
    regrets: Regrets = {}
    with file.open(newline="") as lines:
        for row in csv.DictReader(lines):
            regrets.setdefault(row["trace"], {})[row["rule"]] = float(row["regret"])
    return regrets


def table_of(regrets: Regrets) -> str:
    """Markdown: a row per rule, regrets of generated and recorded histories."""
    recorded = [trace for trace in regrets if ", cost " in trace]
    generated = [trace for trace in regrets if trace not in recorded]
    lines = [
        "| rule | generated: mean | largest | recorded: mean | largest | above 5 % |",
        "|---" * 6 + "|",
    ]
    for rule in next(iter(regrets.values())):
        if rule == OPTIMUM:
            continue
        cells = _mean_and_largest(regrets, rule, generated)
        cells += _mean_and_largest(regrets, rule, recorded)
        above = sum(of_trace[rule] > 0.05 for of_trace in regrets.values())
        lines.append(f"| {rule} | " + " | ".join(cells) + f" | {above} of {len(regrets)} |")
    return "\n".join(lines)


def _mean_and_largest(regrets: Regrets, rule: str, traces: list[str]) -> list[str]:
    if not traces:
        return ["-", "-"]
    values = [regrets[trace][rule] for trace in traces]
    return [f"{100 * sum(values) / len(values):.1f} %", f"{100 * max(values):.1f} %"]


def draw_regrets(regrets: Regrets, picture: Path) -> None:
    figure, axes = plt.subplots(figsize=(9, 1.5 + 0.2 * len(regrets)))
    for rule, (colour, marker) in STYLES.items():
        axes.scatter(
            [100 * of_trace[rule] for of_trace in regrets.values()],
            range(len(regrets)),
            color=colour,
            marker=marker,
            s=34 if rule == OURS else 18,
            zorder=3 if rule == OURS else 2,
            label=rule,
        )
    axes.axvline(5, color="#BBBBBB", linewidth=0.8)
    axes.set_xscale("symlog", linthresh=1)
    axes.set_xlim(-0.1, 2000)
    axes.set_yticks(range(len(regrets)), regrets)
    axes.invert_yaxis()
    axes.set_xlabel("cost above the optimum, %; linear below 1")
    axes.grid(True, axis="x")
    axes.legend(loc="lower center", bbox_to_anchor=(0.4, 1), ncols=3, fontsize=8)
    save(figure, picture)


def main() -> None:
    directory = Path(sys.argv[1])
    regrets = read_regrets(directory / "controller.csv")
    use_style()
    draw_regrets(regrets, directory / "controller.png")
    print(table_of(regrets))


if __name__ == "__main__":
    main()
