"""The first picture of every report: what a more exact balance costs, and what it saves."""

from __future__ import annotations

import numpy as np
import plot
from intervals import NOT_TOLD_APART, in_digits
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from methods import ACROSS, family, is_of_the_paper
from prices import CALL, CALLS, SIMULATION, STEPS, Price
from prices import all_prices, all_runs, exchange_rate, optimum
from results import Results

EXACT_AT = 2e-4  # where exact stands on an axis of what is above the mean
TICKS = {"1.1": 0.1, "1.05": 0.05, "1.01": 0.01, "1.001": 0.001, "exact": EXACT_AT}


def draw_price(results: Results) -> Figure | None:
    """The price of accuracy. Left, the time of a call as a share of Zoltan's RCB over the imbalance
    asked for; the paper's methods, which take no tolerance, stand at what they left. Over several
    workloads: geometric means, and bands from the least to the most end of the 95 % intervals.
    Right, the simulation on the critical path: seconds that its calls and the unbalance of its
    steps cost, over those of ideally balanced steps. What noise of the processors and messages of
    the steps add is the same under all and left out. price.csv has the numbers."""
    prices = all_prices(results)
    calls = [price for price in prices if price.panel == CALL]
    rows, runs = results.calls, all_runs(results)
    has_runs = len(_ours(prices, SIMULATION)) > 1
    if not _ours(prices, CALL) or not any(price.method == "zoltan-rcb" for price in calls):
        return None
    figure, grid = plot.panels(1, 1 + has_runs, 12 if has_runs else 8, 5.2)
    left, right = grid[0, 0], grid[0, -1]
    handles = _draw_calls(left, calls)
    number = rows["case"].nunique()
    over = f"; geometric mean of {number}, bands over all" if number > 1 else ""
    first = rows.iloc[0]
    left.set_title(f"A call: {first['points']:,} points, {first['ranks']} ranks{over}")
    if has_runs:
        handles += _draw_runs(right, prices)
        steps, every = runs.iloc[-1][["steps", "every"]]
        when = f"every {every}" if every else "when it pays"
        right.set_title(f"The simulation: {steps:,} steps, rebalanced {when}")
        right.text(0.5, -0.17, exchange_rate(runs).replace("; ", ";\n"), ha="center", va="top",
                   fontsize=8, transform=right.transAxes)  # fmt: skip
    return plot.legend_above(figure, handles, inches=3.9)


def _ours(prices: list[Price], panel: str) -> list[Price]:
    """Of RRCB's lines, the loosest first."""
    ours = [p for p in prices if p.panel == panel and p.tolerance in TICKS]
    ours = [p for p in ours if p.method.startswith("rrcb") and not is_of_the_paper(p.method)]
    return sorted(ours, key=_place, reverse=True)


def _place(price: Price) -> float:
    """What is above the mean, as asked for or left."""
    return TICKS.get(price.tolerance) or max(float(price.tolerance) - 1, EXACT_AT)


def _draw_calls(axes: Axes, calls: list[Price]) -> list:
    _draw_all_across(axes, calls)
    handles = _draw_families(axes, _ours(calls, CALL)) + _draw_papers(axes, calls)
    _show_tolerances(axes, calls, "time of a call [% of Zoltan's RCB]")
    return handles


def _draw_families(axes: Axes, ours: list[Price]) -> list:
    """A line with its band for each mesh; the automatic one is thick."""
    handles = []
    for name, style in plot.distinct_styles(family(price.method) for price in ours).items():
        line = [price for price in ours if family(price.method) == name]
        is_plain = name == "rrcb"
        handles.append(
            plot.draw_line(
                axes, [_place(p) for p in line], [p.value * 100 for p in line],
                0.22 if is_plain else 0.05, **style.look, markersize=6 - 2 * ("[" in name),
                linewidth=2.2 if is_plain else 1,
                label=name + " to the tolerance asked for" * is_plain,
            )
        )  # fmt: skip
        for price in line if is_plain else ():
            _write_percent(axes, _place(price), 100 * price.value.number, -9)
    return handles


def _draw_papers(axes: Axes, prices: list[Price]) -> list:
    """Marks of the paper's methods at the imbalance they leave."""
    handles = {}
    for price in prices:
        if not is_of_the_paper(price.method):
            continue
        style = plot.method_style(price.method)
        value = price.value * 100
        whiskers = [[value.number - value.reach[0]], [value.reach[1] - value.number]]
        axes.errorbar([_place(price)], [value.number], yerr=np.maximum(whiskers, 0), markersize=7,
                      elinewidth=0.9, **style.mark)  # fmt: skip
        is_other = style == plot.method_style("rrcb-sampled")
        name = "rrcb-sampled" if is_other else price.method
        handles[name] = style.key(name)
    return list(handles.values())


def _draw_runs(axes: Axes, prices: list[Price]) -> list:
    """RRCB's costs over the tolerance and their sum, the other methods as lines and marks."""
    parts = {(p.panel, p.method): 100 * p.value.number for p in prices}
    all_totals = [p for p in prices if p.panel == SIMULATION]
    totals = [p for p in _ours(all_totals, SIMULATION) if family(p.method) == "rrcb"]
    at = [_place(price) for price in totals]
    handles = [
        plot.draw_line(axes, at, [p.value * 100 for p in totals], 0.22, linewidth=2.2, marker="o",
                       color=plot.method_style("rrcb").colour, label="sum of both (right)")
    ]  # fmt: skip
    for panel, shade, line, label in (
        (CALLS, plot.CALL_COLOUR, "--", "what RRCB's calls cost"),
        (STEPS, plot.UNBALANCE_COLOUR, "-.", "what the unbalance it leaves costs in the steps"),
    ):
        values = [parts[panel, p.method] for p in totals]
        handles += axes.plot(at, values, color=shade, linestyle=line, marker=".", label=label)
        sums = [100 * p.value.number for p in totals]
        for x, value in zip(at, values if panel == STEPS else sums):
            _write_percent(axes, x, value, -7 if panel == STEPS else 7)
    _draw_all_across(axes, all_totals)
    _draw_papers(axes, all_totals)
    _mark_optimum(axes, prices)
    _show_tolerances(axes, all_totals, "beyond ideal balance without calls [%]")
    return handles


def _write_percent(axes: Axes, x: float, percent: float, offset: float) -> None:
    axes.annotate(
        f"{in_digits(percent, 2)} %", (x, percent), (0, offset), textcoords="offset points",
        ha="center", va="bottom" if offset > 0 else "top", fontsize=9, color="#222222",
        bbox={"boxstyle": "square,pad=0.05", "fc": "white", "ec": "none", "alpha": 0.7},
    )  # fmt: skip


def _draw_all_across(axes: Axes, prices: list[Price]) -> None:
    """Methods without a tolerance."""
    for price in prices:
        if price.method in ACROSS:
            style = plot.method_style(price.method)
            plot.draw_across(axes, price.value * 100, style, linewidth=1.2)


def _mark_optimum(axes: Axes, prices: list[Price]) -> None:
    if (found := optimum(prices)) is None:
        return
    best, others = found
    text = "optimum"
    if others:
        text += f"\n({NOT_TOLD_APART}\nfrom " + ", ".join(p.tolerance for p in others) + ")"
    axes.annotate(
        text, (_place(best), 100 * best.value.low), (0, -30), ha="center", va="top", fontsize=8,
        textcoords="offset points", arrowprops={"arrowstyle": "->"},
    )  # fmt: skip


def _show_tolerances(axes: Axes, prices: list[Price], y_label: str) -> None:
    axes.set_yscale("log")
    axes.set_ylabel(y_label)
    axes.set_xscale("log")
    axes.set_xticks(list(TICKS.values()), list(TICKS))
    axes.set_xticks([], minor=True)
    left, right = axes.get_xlim()
    axes.set_xlim(max(left, right, 0.15), EXACT_AT / 1.6)
    low, high = axes.get_ylim()
    axes.set_ylim(low / 1.25, 1.25 * high)  # room for numbers and names
    axes.set_xlabel("imbalance asked for (of the paper's methods: left)")
    axes.grid(True, axis="y")
    across = [p for p in prices if p.method in ACROSS]
    plot.label_right(
        axes, ((100 * p.value.number, p.method, plot.method_style(p.method).colour) for p in across)
    )
