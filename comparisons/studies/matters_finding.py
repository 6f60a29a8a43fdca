"""What rounds of simulations under several balancers and intervals show: matters.py measures them."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plot
from intervals import NOT_TOLD_APART, Value, median_of, value_of
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from simulation import AGAIN, paired

MARGIN = 0.01
ENOUGH = 6  # rounds
AUTO, NONE = "auto", "none"
CELL = ["cell", "scene", "points_a_rank", "ranks"]
SCENE_NAMES = {"dam_break": "dam break", "granular_flow": "granular flow"}


def prepared(runs: pd.DataFrame, cores: int) -> pd.DataFrame:
    """Adds seconds of all, of steps and of rebalances: by the clock if ranks have a core each."""
    runs = runs[runs["error"].isna()]
    has_cores = runs["ranks"] <= cores
    steps, balance = (runs[f"{of}_path_s"] + runs[f"{of}_network_s"] for of in ("step", "balance"))
    return runs.assign(
        label=runs["method"],
        method=runs["method"].str.split(" every ").str[0],
        every=runs["every"].astype(str),
        time=runs["wall_s"].where(has_cores, runs["critical_path_s"]),
        steps_time=runs["step_s"].where(has_cores, steps),
        balance_time=runs["balance_s"].where(has_cores, balance),
        by_clock=has_cores,
    )


def summary(runs: pd.DataFrame, cores: int) -> pd.DataFrame:
    """A row for each cell, method and interval: medians, and ratios to `none` in the same round."""
    rows = []
    for key, of_cell in prepared(runs, cores).groupby(CELL, sort=False):
        ideal = of_cell.groupby("label")["steps_time"].median().min()
        for (label, method, every), found in of_cell.groupby(["label", "method", "every"], sort=False):
            time = median_of(found["time"])
            ratio = ratio_of(of_cell, label, NONE)
            calls = found["rebalances"].median()
            rows.append({
                **dict(zip(CELL, key)), "by_clock": found["by_clock"].iloc[0], "points": found["points"].iloc[0],
                "steps": found["steps"].iloc[0], "rounds": len(found), "label": label, "method": method,
                "every": "" if method.startswith(NONE) else every, **columns("time_s", time),
                **columns("time_vs_none", ratio), "overhead": time.number / ideal - 1,
                "step_ms": 1e3 * found["steps_time"].median() / found["steps"].iloc[0],
                "call_ms": 1e3 * (found["balance_time"] / found["rebalances"]).median() if calls else np.nan,
                "rebalances": calls, "mean_imbalance": found["mean_imbalance"].median(),
            })  # fmt: skip
    return pd.DataFrame(rows)


def columns(name: str, value: Value) -> dict[str, float]:
    return {name: value.number, f"{name}_low": value.low, f"{name}_high": value.high}


def ratio_of(of_cell: pd.DataFrame, label: str, reference: str) -> Value:
    """Median over the rounds of time / time of the reference."""
    labelled = of_cell.assign(method=of_cell["label"])
    return paired(labelled, labelled["time"], label, reference)


def best(rows: pd.DataFrame, method: str) -> pd.Series | None:
    """The interval of a method with the least time, the controller included; of those that have
    enough rounds for an interval of 95 %, if any has."""
    of_method = rows[rows["method"] == method]
    of_method = of_method[of_method["rounds"] >= min(ENOUGH, of_method["rounds"].max())]
    return of_method.loc[of_method["time_vs_none"].idxmin()] if len(of_method) else None


def comparisons(runs: pd.DataFrame, rows: pd.DataFrame, cores: int, ours: str) -> pd.DataFrame:
    """Time of each method over that of ours: each at its best interval, and both with the controller."""
    found = []
    for key, of_cell in prepared(runs, cores).groupby(CELL, sort=False):
        of_rows = rows[rows["cell"] == key[0]]
        our_best = best(of_rows, "count" if "count" in set(of_rows["method"]) else ours)
        for method in dict.fromkeys(of_rows["method"]):
            if method == our_best["method"] or method.endswith(AGAIN):
                continue
            pairs = {"best": (best(of_rows, method)["label"], our_best["label"])}
            labels = [of_rows[(of_rows["method"] == m) & (of_rows["every"] == AUTO)] for m in (method, our_best["method"])]
            if all(map(len, labels)):
                pairs["controller"] = tuple(of["label"].iloc[0] for of in labels)
            for kind, (label, reference) in pairs.items():
                ratio = ratio_of(of_cell, label, reference)
                found.append({**dict(zip(CELL, key)), "method": method, "kind": kind, "label": label,
                              "reference": reference, **columns("ratio", ratio), "verdict": verdict(ratio)})  # fmt: skip
    return pd.DataFrame(found)


def verdict(ratio: Value) -> str:
    """Of a time over ours."""
    if not ratio.has_interval:
        return "too few rounds"
    if ratio.low > 1 + MARGIN:
        return "slower"
    if ratio.high < 1 / (1 + MARGIN):
        return "faster"
    within = ratio.low > 1 / (1 + MARGIN) and ratio.high < 1 + MARGIN
    return "within 1 %" if within else NOT_TOLD_APART


def rule(of_rows: pd.DataFrame, zoltan: str, ours: str) -> dict[str, float]:
    """Step over call time t_s / t_c, the limit X below which the balancer matters by the model, and
    the saving that it expects; of the best run of Zoltan's RCB, and r of the two calls there."""
    its, our_best = best(of_rows, zoltan), best(of_rows, ours)
    interval = its["steps"] / its["rebalances"]
    same = of_rows[(of_rows["method"] == ours) & (of_rows["every"] == its["every"])]
    quicker = its["call_ms"] / (same.iloc[0] if len(same) else our_best)["call_ms"]
    share = 1 - quicker**-0.5 if quicker > 1 else 0.0
    quotient = its["step_ms"] / its["call_ms"]
    return {"k": interval, "r": quicker, "quotient": quotient, "limit": 2 * share / (MARGIN * interval),
            "saving": 2 * share / (interval * quotient), "step_ms": its["step_ms"], "call_ms": its["call_ms"]}  # fmt: skip


def finding(rows: pd.DataFrame, pairs: pd.DataFrame, zoltan: str, ours: str) -> tuple[str, list[pd.DataFrame]]:
    """Sentences, and tables of texts with a row for each cell: ratios, and the rule."""
    ratios, laws, rules = [], [], []
    for key, of_pairs in pairs.groupby(CELL, sort=False):
        of_rows = rows[rows["cell"] == key[0]]
        if zoltan not in set(of_rows["method"]):
            continue
        law = rule(of_rows, zoltan, ours)
        found = of_pairs[(of_pairs["method"] == zoltan) & (of_pairs["kind"] == "best")]["verdict"].item()
        rules.append({**law, "verdict": found})
        cell = {"scene": SCENE_NAMES.get(key[1], key[1]), "points a rank": f"{key[2]:,}", "ranks": f"{key[3]}"}
        others = [method for method in dict.fromkeys(of_pairs["method"]) if method != zoltan]
        ratios.append({
            **cell, "rounds": f"{of_rows['rounds'].max()}", zoltan: text_of(of_pairs, zoltan, "best"),
            "both by controller": text_of(of_pairs, zoltan, "controller"),
            **{method: text_of(of_pairs, method, "best") for method in others},
        })  # fmt: skip
        laws.append({
            **cell, "step, ms": f"{law['step_ms']:.3f}", "call, ms": f"{law['call_ms']:.2f}", "r": f"{law['r']:.1f}",
            "k": f"{law['k']:.0f}", "step / call": f"{law['quotient']:.2f}", "X": f"{law['limit']:.2f}",
            "expected": f"{1 + law['saving']:.3f}", "measured": text_of(of_pairs, zoltan, "best"), "verdict": found,
        })  # fmt: skip
    learned = pairs[(pairs["method"] == "learned") & (pairs["kind"] == "controller")]
    texts = [f"{found.cell}: {value_of(found, 'ratio').text(3)}, {found.verdict}" for found in learned.itertuples()]
    text = sentences(rules) + ("\nLearned costs over counting: " + "; ".join(texts) + ".") * bool(texts)
    return text, [pd.DataFrame(ratios).fillna(""), pd.DataFrame(laws)]


def text_of(pairs: pd.DataFrame, method: str, kind: str) -> str:
    found = pairs[(pairs["method"] == method) & (pairs["kind"] == kind)]
    return value_of(next(found.itertuples()), "ratio").text(3) if len(found) else ""


def sentences(rules: list[dict]) -> str:
    judged = [law for law in rules if law["verdict"] not in (NOT_TOLD_APART, "too few rounds")]
    matters = [law for law in judged if law["verdict"] == "slower"]
    right = sum((law["quotient"] < law["limit"]) == (law["verdict"] == "slower") for law in judged)
    share = np.median([1 - law["r"] ** -0.5 for law in rules if law["r"] > 1])
    return (
        f"Zoltan's RCB takes more than 1 % longer than rrcb, each at its best interval, in {len(matters)} of"
        f" {len(rules)} cells; {len(rules) - len(judged)} are {NOT_TOLD_APART} or have too few rounds.\n"
        f"Rule: if step time over call time is below X = {2 * share / MARGIN:.0f} / k, the balancer matters;"
        " k is the best interval in steps, and the call Zoltan's with all that it moves."
        f" The X of each cell agrees with {right} of the {len(judged)} cells that are told apart."
    )


def draw(rows: pd.DataFrame, column: str, label: str) -> Figure:
    """A panel for each cell: a column of the summary over the interval; without rebalancing a line."""
    rows = rows[~rows["method"].isin(["count", "learned"])]
    rows = rows[rows.groupby("cell")["every"].transform("nunique") > 2]
    names = list(dict.fromkeys(rows["cell"]))
    rows = rows[~rows["method"].str.endswith(AGAIN)]
    styles = plot.distinct_styles(m for m in rows["method"] if m != NONE)
    height = 2.4 * -(-len(names) // 3) + 1.2
    figure, grid = plot.panels(-(-len(names) // 3), min(3, len(names)), 9, height)
    for axes in grid.flat[len(names) :]:
        axes.set_visible(False)
    for name, axes in zip(names, grid.flat):
        draw_cell(axes, rows[rows["cell"] == name], column, styles)
    plot.label_edges(grid, "steps between rebalances", label)
    return plot.legend_above(figure, grid[0, 0], inches=1.6)


def draw_cell(axes: Axes, rows: pd.DataFrame, column: str, styles: dict) -> None:
    first = rows.iloc[0]
    axes.set_title(f"{SCENE_NAMES.get(first['scene'], first['scene'])}, {first['points_a_rank']:,} x {first['ranks']}")
    intervals = sorted({int(e) for e in rows["every"] if e not in ("", AUTO)})
    places = {str(every): every for every in intervals} | {AUTO: 10 * intervals[-1]}
    for method, style in styles.items():
        its = rows[(rows["method"] == method)].assign(at=lambda r: r["every"].map(places)).sort_values("at")
        fixed, auto = (its[its["every"].eq(AUTO) == is_auto] for is_auto in (False, True))
        look = {"color": style.colour, "marker": style.marker, "markersize": 4}
        axes.plot(fixed["at"], fixed[column], linestyle=style.line, label=method, **look)
        axes.plot(auto["at"], auto[column], linestyle="", **look)
    axes.axhline(rows.loc[rows["method"] == NONE, column].item(), color="#888888", linewidth=0.8)
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(list(places.values()), [*map(str, intervals), AUTO])
    axes.grid(True)
