"""The first picture of every report: what a more exact balance costs, and what it saves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from choice import cases
from intervals import NOT_TOLD_APART, in_digits
from prices import (
    ACROSS,
    CALL,
    CALLS,
    EXACT,
    SIMULATION,
    STEPS,
    Price,
    exchange_rate,
    family,
    is_of_the_paper,
    optimum,
    read_calls,
    read_prices,
    read_runs,
)
from settings import legend_above
from style import (
    CALL_COLOUR,
    UNBALANCE_COLOUR,
    distinct_styles,
    label_right,
    method_style,
    save,
)

EXACT_AT = 2e-4  # where exact stands on an axis of what is above the mean
TICKS = {"1.1": 0.1, "1.05": 0.05, "1.01": 0.01, "1.001": 0.001, EXACT: EXACT_AT}


def draw_price(directory: Path, picture: Path) -> bool:
    """Left a call, right the whole simulation where one was run."""
    prices = read_prices(directory)
    calls = [price for price in prices if price.panel == CALL]
    rows = read_calls(directory)
    has_runs = len(_ours(prices, SIMULATION)) > 1
    if not _ours(prices, CALL) or not any(price.method == "zoltan-rcb" for price in calls):
        return False
    figure, axes = plt.subplots(
        1, 1 + has_runs, figsize=(12 if has_runs else 8, 5.2), squeeze=False
    )
    handles = _draw_calls(axes[0, 0], calls)
    number = len(cases(rows))
    over = f"; geometric mean of {number}, bands over all" if number > 1 else ""
    axes[0, 0].set_title(f"A call: {rows[0].points:,} points, {rows[0].ranks} ranks{over}")
    if has_runs:
        handles += _draw_runs(axes[0, 1], prices)
        run = read_runs(directory)[-1]
        axes[0, 1].set_title(f"The simulation: {run.steps:,} steps, rebalanced every {run.every}")
        axes[0, 1].text(
            0.5, -0.17, exchange_rate(read_runs(directory)).replace("; ", ";\n"),
            transform=axes[0, 1].transAxes, ha="center", va="top", fontsize=8,
        )
    legend_above(figure, handles, inches=3.9)
    save(figure, picture)
    return True


def _ours(prices: list[Price], panel: str) -> list[Price]:
    """Of RRCB's lines, the loosest first."""
    ours = [p for p in prices if p.panel == panel and p.tolerance in TICKS]
    ours = [p for p in ours if p.method.startswith("rrcb") and not is_of_the_paper(p.method)]
    return sorted(ours, key=_place, reverse=True)


def _place(price: Price) -> float:
    """What is above the mean, as asked for or left."""
    if price.tolerance in TICKS:
        return TICKS[price.tolerance]
    return max(float(price.tolerance) - 1, EXACT_AT)


def _draw_calls(axes: Axes, calls: list[Price]) -> list:
    labels = _draw_across(axes, calls)
    handles = _draw_families(axes, _ours(calls, CALL)) + _draw_papers(axes, calls)
    axes.set_yscale("log")
    axes.set_ylabel("time of a call [% of Zoltan's RCB]")
    _show_tolerances(axes)
    label_right(axes, labels)
    return handles


def _draw_families(axes: Axes, ours: list[Price]) -> list:
    """A line with its band for each mesh; the automatic one is thick."""
    handles = []
    for name, style in distinct_styles([family(price.method) for price in ours]).items():
        line = [price for price in ours if family(price.method) == name]
        at = [_place(price) for price in line]
        is_plain = name == "rrcb"
        handles += axes.plot(
            at, [100 * p.value for p in line], color=style.colour, linestyle=style.line,
            marker=style.marker, markersize=6 - 2 * ("[" in name),
            linewidth=2.2 if is_plain else 1, label=name + " to the tolerance asked for" * is_plain,
        )  # fmt: skip
        low, high = ([100 * getattr(p, end) for p in line] for end in ("low", "high"))
        if len(line) > 1:
            axes.fill_between(
                at, low, high, color=style.colour, alpha=0.22 if is_plain else 0.05, linewidth=0
            )
        for price in line if is_plain else []:
            _write_percent(axes, _place(price), 100 * price.value, -9)
    return handles


def _draw_papers(axes: Axes, prices: list[Price]) -> list:
    """Marks of the paper's methods at the imbalance they leave."""
    handles = {}
    for price in prices:
        if not is_of_the_paper(price.method):
            continue
        style = method_style(price.method)
        whiskers = [[100 * (price.value - price.low)], [100 * (price.high - price.value)]]
        axes.errorbar(
            [_place(price)], [100 * price.value], yerr=np.maximum(whiskers, 0), color=style.colour,
            marker=style.marker, markersize=7, elinewidth=0.9, linestyle="",
        )  # fmt: skip
        name = price.method if style != method_style("rrcb-sampled") else "rrcb-sampled"
        handles[name] = Line2D(
            [], [], color=style.colour, marker=style.marker, linestyle="", label=name
        )
    return list(handles.values())


def _draw_runs(axes: Axes, prices: list[Price]) -> list:
    """RRCB's costs over the tolerance and their sum, the other methods as lines and marks."""
    parts = {(p.panel, p.method): 100 * p.value for p in prices}
    totals = [p for p in _ours(prices, SIMULATION) if family(p.method) == "rrcb"]
    at = [_place(price) for price in totals]
    colour = method_style("rrcb").colour
    handles = axes.plot(at, [100 * p.value for p in totals], "o-", color=colour, linewidth=2.2,
                        label="sum of both (right)")  # fmt: skip
    low, high = ([100 * getattr(p, end) for p in totals] for end in ("low", "high"))
    axes.fill_between(at, low, high, color=colour, alpha=0.22, linewidth=0)
    for panel, shade, line, label in (
        (CALLS, CALL_COLOUR, "--", "what RRCB's calls cost"),
        (STEPS, UNBALANCE_COLOUR, "-.", "what the unbalance it leaves costs in the steps"),
    ):
        values = [parts[panel, p.method] for p in totals]
        handles += axes.plot(at, values, color=shade, linestyle=line, marker=".", label=label)
        for x, value in zip(at, values if panel == STEPS else [100 * p.value for p in totals]):
            _write_percent(axes, x, value, 7)
    labels = _draw_across(axes, [p for p in prices if p.panel == SIMULATION])
    _draw_papers(axes, [p for p in prices if p.panel == SIMULATION])
    axes.set_yscale("log")
    _mark_optimum(axes, prices)
    axes.set_ylabel("beyond ideal balance without calls [%]")
    _show_tolerances(axes)
    label_right(axes, labels)
    return handles


def _write_percent(axes: Axes, x: float, percent: float, offset: float) -> None:
    axes.annotate(
        f"{in_digits(percent, 2)} %", (x, percent), (0, offset), textcoords="offset points", ha="center",
        va="bottom" if offset > 0 else "top", fontsize=9, color="#222222",
        bbox={"boxstyle": "square,pad=0.05", "fc": "white", "ec": "none", "alpha": 0.7},
    )  # fmt: skip


def _draw_across(axes: Axes, prices: list[Price]) -> list[tuple[float, str, str]]:
    """Methods without a tolerance; returns what to write beside their lines."""
    labels = []
    for price in prices:
        if price.method in ACROSS:
            style = method_style(price.method)
            axes.axhline(100 * price.value, color=style.colour, linestyle=style.line, linewidth=1.2)
            axes.axhspan(100 * price.low, 100 * price.high, color=style.colour, alpha=0.1, lw=0)
            labels.append((100 * price.value, price.method, style.colour))
    return labels


def _mark_optimum(axes: Axes, prices: list[Price]) -> None:
    found = optimum(prices)
    if found is None:
        return
    best, others = found
    text = "optimum"
    if others:
        text += f"\n({NOT_TOLD_APART}\nfrom " + ", ".join(p.tolerance for p in others) + ")"
    axes.annotate(
        text, (_place(best), 100 * best.low), (0, -30), ha="center", va="top", fontsize=8,
        textcoords="offset points", arrowprops={"arrowstyle": "->"},
    )  # fmt: skip


def _show_tolerances(axes: Axes) -> None:
    axes.set_xscale("log")
    axes.set_xticks(list(TICKS.values()), list(TICKS))
    axes.set_xticks([], minor=True)
    left, right = axes.get_xlim()
    axes.set_xlim(max(left, right, 0.15), EXACT_AT / 1.6)
    low, high = axes.get_ylim()
    axes.set_ylim(low / 1.25, 1.25 * high)  # room for numbers and names
    axes.set_xlabel("imbalance asked for (of the paper's methods: left)")
    axes.grid(True, axis="y")
