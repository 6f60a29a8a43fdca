"""Writes the report of comparisons/run from the driver's files, simulation.csv and noise.csv."""

from __future__ import annotations

from pathlib import Path
from statistics import geometric_mean

import pandas as pd
import pictures
from document import Report, shared_cores, show
from intervals import NOT_TOLD_APART, ONE, Value, decimals, in_digits, mean_of, value_of
from results import Results, cases, row_of
from simulation import (
    balancing, limit_of, of_method, paired, slope_of_work, uneven_points, uneven_work,
)  # fmt: skip

ZOLTAN = "zoltan-rcb"
# Each method and the exact setting with the same interface: both use callbacks, or both use arrays.
INTERFACES = {"rrcb": "rrcb-exact", "rrcb-arrays": "rrcb-arrays[refine=exact]"}
DEFINITIONS = (
    "imbalance: heaviest part / mean part. time: slowest rank, median of the repeats. speed-up: Zoltan RCB's"
    " time / this method's. bytes and messages: of one call over all ranks. moved: weight that changes rank. ghosts:"
    " copies of points that parts need from others, the price of their shape. table.csv has more columns. gain"
    " kept: of what ideal balance without cost would gain; of even work: of what even counted work of all ranks would"
    " gain in the steps. count, learned: rrcb-arrays, whose points weigh 1 or the seconds that they cost; known: weights by"
    " counted instructions. wall: by the"
    " clock. In brackets: intervals of 95 %; if the interval of a ratio contains 1, the two methods are"
    " not told apart."
)


def write_report(folder: Path) -> None:
    results = Results(folder)
    for name, rows in (("simulation.csv", results.summary), ("noise.csv", results.noise)):
        if len(rows):
            rows.to_csv(folder / name, index=False)
    captions = pictures.draw_all(results)
    report = Report("RRCB compared with Zoltan's balancers", folder)
    for text in [*failures(results), *sentences(results)]:
        report.say(text)
    for case, rows in cases(results.table).items():
        caption = f"{case}: {rows['points'].iloc[0]:,} points, {rows['ranks'].iloc[0]} ranks"
        report.table(caption, method_table(rows))
        show(caption, short_table(rows))
    _add_simulations(report, results)
    report.table("Noise: a baseline measured twice", noise_table(results.noise))
    for name, caption in captions.items():
        report.picture(name, caption)
    report.text(DEFINITIONS)
    report.write(folder / "run.txt")


def _add_simulations(report: Report, results: Results) -> None:
    if (runs := results.runs).empty:
        return
    first = runs.iloc[-1]
    every = f"every {first['every']} steps" if first["every"] else "when it pays"
    every = every if runs["every"].nunique() == 1 else "as named"
    size = f"{first['points']:,} points, {first['steps']:,} steps, {first['ranks']} ranks"
    caption = f"Simulations: {size}, rebalanced {every}"
    report.table(caption, simulation_table(runs, results.rounds))
    report.table("Counted in the simulations, on any machine alike", counted_table(runs))
    shown = {
        "method": runs["method"],
        "imbalance": _numbers(runs["mean_imbalance"], ".4f"),
        "critical path s": _numbers(runs["critical_path_s"], ".4g"),
        "speed-up over none": _texts(runs, "speed_up_critical_path", 2),
    }
    show(caption, pd.DataFrame(shown))
    for text in (
        shared_cores(first["ranks"]),
        work_sentence(results.rounds),
        cost_sentence(results.rounds),
    ):
        report.text(text)
    report.table("What a step still pays: the busiest rank over the mean", paid_table(results.rounds))


# --- tables, in which every cell is a text ---


def _texts(rows: pd.DataFrame, name: str, digits: int) -> list[str]:
    return [value_of(row, name).text(digits) for row in rows.itertuples()]


def _numbers(values: pd.Series, form: str) -> list[str]:
    return ["–" if pd.isna(value) else format(value, form) for value in values]


def _ratio(ratio: Value, is_reference: bool = False) -> str:
    same = not is_reference and not ratio.is_apart(ONE)
    return "–" if pd.isna(ratio.number) else ratio.text(2) + f", {NOT_TOLD_APART}" * same


def _doubt(ratio: Value) -> str:
    """Returns a remark to put behind a ratio and its noun if the ratio may be 1; otherwise an empty text."""
    return "" if ratio.is_apart(ONE) else f" ({NOT_TOLD_APART})"


def method_table(rows: pd.DataFrame) -> pd.DataFrame:
    speeds = [ONE / value_of(row, "time_vs_zoltan_rcb") for row in rows.itertuples()]
    return pd.DataFrame(
        {
            "method": rows["method"],
            "imbalance": _texts(rows, "imbalance", 5),
            "time ms": _texts(rows, "time_ms", 2),
            "speed-up": [_ratio(v, m == ZOLTAN) for v, m in zip(speeds, rows["method"])],
            "bytes": _numbers(rows["bytes"], ","),
            "messages": _numbers(rows["messages"], ","),
            "moved %": _numbers(100 * rows["moved_fraction"], ".1f"),
            "ghosts": _numbers(rows["ghosts"], ",.0f"),
            "% of the points": _numbers(100 * rows["ghosts"] / rows["points"], ".1f"),
        }
    )


def short_table(rows: pd.DataFrame) -> pd.DataFrame:
    """Returns the columns that fit a terminal, without intervals."""
    return pd.DataFrame(
        {
            "method": rows["method"],
            "imbalance": _numbers(rows["imbalance"], ".5f"),
            "time ms": _numbers(rows["time_ms"], ".2f"),
            "speed-up": _numbers(1 / rows["time_vs_zoltan_rcb"], ".2f"),
            "bytes": _numbers(rows["bytes"], ","),
            "ghosts": _numbers(rows["ghosts"], ",.0f"),
        }
    )


def simulation_table(runs: pd.DataFrame, rounds: pd.DataFrame) -> pd.DataFrame:
    digits = decimals(runs["critical_path_s"], 4)
    speeds = [value_of(run, "speed_up_critical_path") for run in runs.itertuples()]
    as_zoltan = [
        paired(rounds, 1 / rounds["critical_path_s"], method, ZOLTAN) or Value(float("nan"))
        for method in runs["method"]
    ]
    return pd.DataFrame(
        {
            "method": runs["method"],
            "mean imbalance": _texts(runs, "mean_imbalance", 4),
            "critical path s": _texts(runs, "critical_path_s", digits),
            "speed-up over none": [_ratio(v, m == "none") for v, m in zip(speeds, runs["method"])],
            f"speed-up over {ZOLTAN}": [_ratio(v, m == ZOLTAN) for v, m in zip(as_zoltan, runs["method"])],
            "gain kept %": _numbers(100 * runs["gain_kept"], ".1f"),
            "of even work %": _numbers(100 * runs["gain_kept_work"], ".1f"),
            "rebalances": _numbers(runs["rebalances"], ".0f"),
            "moved %": _numbers(100 * runs["moved_fraction"], ".1f"),
            "wall s": _texts(runs, "wall_s", digits),
        }
    )


def counted_table(runs: pd.DataFrame) -> pd.DataFrame:
    """Work by the points of the fullest rank, which the others wait for, and messages."""
    steps, rebalances = runs["steps"], runs["rebalances"].where(runs["rebalances"] > 0)
    none = runs.loc[runs["method"] == "none", "path_points"]
    gain = (none.iloc[0] if len(none) else float("nan")) / runs["path_points"]
    return pd.DataFrame(
        {
            "method": runs["method"],
            "imbalance, mean of the steps": _numbers(runs["mean_imbalance"], ".3f"),
            "largest": _numbers(runs["worst_imbalance"], ".3f"),
            "work of the fullest rank: none / this": _numbers(gain, ".2f"),
            "messages in a step": _numbers(runs["step_messages"] / steps, ".1f"),
            "kB in a step": _numbers(runs["step_bytes"] / steps / 1e3, ".1f"),
            "rebalances": _numbers(runs["rebalances"], ".0f"),
            "messages in a rebalance": _numbers(runs["balance_messages"] / rebalances, ".1f"),
            "kB in a rebalance": _numbers(runs["balance_bytes"] / rebalances / 1e3, ".1f"),
        }
    )


def noise_table(noise: pd.DataFrame) -> pd.DataFrame:
    ratios = [Value(row.ratio, row.low, row.high) for row in noise.itertuples()]
    return noise[["workload", "what"]].assign(ratio=[_ratio(ratio) for ratio in ratios])


# --- three sentences: cost of a call, gain of the simulation, when the choice matters ---


def failures(results: Results) -> list[str]:
    """Returns a sentence for each method and workload that failed. The tables leave them out."""
    found = [
        f"{row.method} failed on {getattr(row, 'workload', 'the simulation')}: {row.error}"
        for rows in (results.all_rows, results.all_runs)
        if "error" in rows
        for row in rows[rows["error"].notna()].itertuples()
    ]
    return list(dict.fromkeys(found))


def sentences(results: Results) -> list[str]:
    rows, rounds = results.table, results.rounds
    exact = [_exactness(rows, results.turns, *names) for names in INTERFACES.items()]
    first = " ".join(filter(None, [_call(rows), *exact]))
    return list(filter(None, [first, _gain(rounds), _matter(rounds) or _ghosts(rows)]))


def _pairs(rows: pd.DataFrame, first: str, second: str) -> list[tuple]:
    """Returns the rows of two methods in each case that has both."""
    found = [(row_of(case, first), row_of(case, second)) for case in cases(rows).values()]
    return [(a, b) for a, b in found if a and b]


def _imbalance(rows: object) -> str:
    return f"{geometric_mean(row.imbalance for row in rows):.5f}"


def _call(rows: pd.DataFrame) -> str:
    if not (pairs := _pairs(rows, "rrcb", ZOLTAN)):
        return ""
    speed_up = ONE / mean_of(value_of(ours, "time_vs_zoltan_rcb") for ours, _ in pairs)
    over = f" (geometric means over {len(pairs)} workloads)" * (len(pairs) > 1)
    return (
        f"A call of rrcb left an imbalance of {_imbalance(ours for ours, _ in pairs)} and had a speed-up of"
        f" {speed_up.text(2)} over {ZOLTAN}{_doubt(speed_up)}, which left"
        f" {_imbalance(zoltan for _, zoltan in pairs)}{over}."
    )


def _exactness(rows: pd.DataFrame, turns: pd.DataFrame, method: str, exact: str) -> str:
    if not (pairs := _pairs(rows, exact, method)):
        return ""
    calls = [turns[turns["workload"] == a.workload] for a, _ in pairs]
    time = mean_of(paired(c, c["time_ms"], exact, method, "turn") for c in calls)
    size = geometric_mean([a.bytes / b.bytes for a, b in pairs])
    return (
        f"{exact} took {time.text(2)} times as long as {method}{_doubt(time)} and sent"
        f" {in_digits(size, 3)} times its bytes, and left {_imbalance(a for a, _ in pairs)}."
    )


def _gain(rounds: pd.DataFrame) -> str:
    gain, zoltan = (
        paired(rounds, rounds["critical_path_s"], other, "rrcb") if len(rounds) else None
        for other in ("none", ZOLTAN)
    )
    if not gain:
        return ""
    text = f"With a core for every rank the simulation under rrcb had a speed-up of {gain.text(2)} over none"
    text += _doubt(gain)
    if zoltan:
        text += f" and of {zoltan.text(3)} over {ZOLTAN}{_doubt(zoltan)}"
    return f"{text}; medians of {gain.count} pairs."


def _matter(rounds: pd.DataFrame) -> str:
    """Describes how often points must need a rebalance for the choice of the balancer to matter."""
    if not {"rrcb", ZOLTAN} <= set(rounds.get("method", ())):
        return ""
    each = balancing(rounds) / rounds["rebalances"].where(rounds["rebalances"] > 0)
    ours, theirs = (of_method(rounds, each, method).number for method in ("rrcb", ZOLTAN))
    step = (rounds["step_work_s"] / rounds["ranks"] / rounds["steps"]).median()
    if not (ours > 0 and theirs > 0):
        return ""
    times = [f"{in_digits(1e3 * s, 3)} ms, {in_digits(s / step, 2)} steps," for s in (ours, theirs)]
    return (
        f"One rebalance with all that it moves took {times[0]} under rrcb and {times[1]} under"
        " Zoltan's RCB: the choice of the balancer matters by more than 1 % if a rebalance pays every"
        f" {limit_of(theirs, ours, step):.0f} steps or more often."
    )


def _ghosts(rows: pd.DataFrame) -> str:
    pairs = [(a, b) for a, b in _pairs(rows, "rrcb", ZOLTAN) if a.ghosts > 0 and b.ghosts > 0]
    if not pairs:
        return ""
    ratio = geometric_mean([ours.ghosts / zoltan.ghosts for ours, zoltan in pairs])
    share = 100 * geometric_mean([ours.ghosts / ours.points for ours, _ in pairs])
    return (
        f"In every step the application then pays for ghosts: those of rrcb's parts are"
        f" {in_digits(share, 3)} % of the points, {in_digits(ratio, 3)} times those of Zoltan's RCB."
    )


def cost_sentence(rounds: pd.DataFrame) -> str:
    """Describes the gain of learned and of known costs of points compared with counting them."""
    names = ("learned", "known")
    times = [paired(rounds, rounds["critical_path_s"], name, "count") for name in names]
    if None in times:
        return ""
    works = [paired(rounds, rounds["counted_path"], name, "count").text(3) for name in names]
    uneven = [of_method(rounds, uneven_work(rounds), name).text(3) for name in ("count", *names)]
    return (
        f"Compared with counting points, the busiest ranks of the steps do {works[0]} of the counted work with learned"
        f" costs and {works[1]} with known ones; the busiest rank of a step does {', '.join(uneven)} times the mean"
        f" (counting, learned, known). By the clock the critical path takes {times[0].text(2)}{_doubt(times[0])} and"
        f" {times[1].text(2)}{_doubt(times[1])} times as long."
    )


def work_sentence(rounds: pd.DataFrame) -> str:
    """Describes what an uneven number of points costs the steps; empty if balanced methods do not differ in it."""
    if (slope := slope_of_work(rounds)) is None:
        return ""
    zero = Value(0, 0, 0)
    doubt = "" if slope.is_apart(zero) else f" ({NOT_TOLD_APART} from 0)"
    text = f"Among balanced runs 1 % more points on the fullest rank added {slope.text(2)} % of counted work to the steps"
    return f"{text}{doubt}."


def paid_table(rounds: pd.DataFrame) -> pd.DataFrame:
    """Returns the losses that remain in a step with each method, in percent. Seconds are the least of all rounds. While
    the points are at rest, the seconds exceed the counted work by what the cores of the machine differ."""
    total = rounds["critical_path_s"]
    is_last = rounds["round"] == rounds.groupby("method")["round"].transform("max")
    columns = {
        "uneven points %": uneven_points(rounds) - 1,
        "uneven work, counted %": uneven_work(rounds) - 1,
        "uneven seconds %": uneven_work(rounds, "least_s").where(is_last) - 1,
        "work at rest, counted %": uneven_work(rounds, "counted_at_rest") - 1,
        "seconds at rest %": uneven_work(rounds, "least_at_rest_s").where(is_last) - 1,
        "rebalances, of all %": balancing(rounds) / total,
        "deciding, of all %": (rounds["decide_path_s"] + rounds["decide_network_s"]) / total,
    } | {
        f"{name} of rank 0, of all %": rounds[f"{phase}_root_s"] / total
        for phase, name in (("step", "steps"), ("balance", "rebalances"), ("decide", "deciding"))
    }
    methods = list(dict.fromkeys(rounds["method"]))
    texts = {name: [of_method(rounds, 100 * values, m).text(2) for m in methods] for name, values in columns.items()}
    return pd.DataFrame({"method": methods} | texts)
