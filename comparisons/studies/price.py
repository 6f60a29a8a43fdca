"""What accuracy costs: one call of RRCB at nine tolerances on twelve sorted clouds, six shapes in 2-D and 3-D.

Methods take turns, each turn in an order drawn anew, and times are ratios to Zoltan's RCB of the same turn.
Rounds, bytes, imbalance and ghosts are exact counts, which no busy machine disturbs.
The time that a step takes for a point is measured in the simulation of a slope, on the same cores.
"""

from __future__ import annotations

from math import inf
from pathlib import Path

import numpy as np
import pandas as pd
import plot
from document import CORES, Report
from driver import Driver, driver_of, has_multijagged, options
from intervals import ONE, Value, in_digits, mean_of, median_of
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from results import measurements, read
from simulation import AGAIN, paired

CLOUDS = {
    "uniform": "#000000", "slope": "#0072B2", "spiral": "#009E73",
    "clusters": "#D55E00", "lattice": "#CC79A7", "shell": "#E69F00",
}  # fmt: skip
ZOLTAN, EXACT = "zoltan-rcb", "rrcb-exact"
TOLERANCES = {
    "none": "rrcb[refine=none]", "1.1": "rrcb[tol=1.1]", "1.05": "rrcb[tol=1.05]", "1.02": "rrcb[tol=1.02]",
    "1.01": "rrcb", "1.003": "rrcb[tol=1.003]", "1.001": "rrcb[tol=1.001]", "1.0003": "rrcb[tol=1.0003]",
    "exact": EXACT,
}  # fmt: skip
RIVALS = {
    ZOLTAN: "Zoltan's RCB", "zoltan-hsfc": "Zoltan's HSFC", "hilbert-counts": "counted keys",
    "zoltan2-mj": "multijagged",
}  # fmt: skip
EVERY = {1: "#D55E00", 10: "#E69F00", 100: "#0072B2", 1000: "#000000"}  # steps between two calls
GAIN = Value(0.31, 0.21, 0.33)  # % more counted work of a step for 1 % more points on the fullest part; by comparisons/run
HARD = ("clusters", "lattice")  # clouds in which a call to 1.01 counts in several rounds
MOST_A_CORE = 8  # ranks per core up to which calls are timed; with more the scheduler dominates
LOOKS = {
    "time": "time / Zoltan's RCB", "rounds": "rounds of counting", "bytes": "bytes / Zoltan's RCB",
    "excess_percent": "imbalance left [%]",
}  # fmt: skip


def measure(driver: Driver, parts: list[int], points: int, repeats: int) -> None:
    driver.run("step", 4, ["none"], "--scene=slope", "--only=simulations",
               f"--steps={20 if driver.quick else 200}")  # fmt: skip
    methods = [*TOLERANCES.values(), *RIVALS]
    if not has_multijagged(driver.program):
        methods.remove("zoltan2-mj")
    for number in parts:
        turns = repeats if number <= MOST_A_CORE * CORES else 1
        words = ["--no-data", f"--repeats={turns}", f"--points={points}"]
        for cloud in list(CLOUDS)[:: len(CLOUDS) if driver.quick else 1]:
            for dimension in (2, 3):
                driver.run(f"{cloud}-{dimension}-{number}", number, methods, f"--cloud={cloud}", f"--dim={dimension}", *words)


def rows_of(out: Path) -> pd.DataFrame:
    """Returns a row for each cloud, number of parts and method, with times as ratios to Zoltan's RCB and to exact cuts.
    """
    found = []
    for folder in sorted(path.parent for path in out.glob("*/call_times.csv")):
        turns = read(folder / "call_times.csv")
        for row in measurements(read(folder / "table.csv")).to_dict("records"):
            times = {of: _ratio(turns, row["method"], of) for of in (ZOLTAN, EXACT)}
            found.append(row | {"cloud": row["workload"], "time": times[ZOLTAN], "time_over_exact": times[EXACT],
                                "is_timed": row["repeats"] > 1, "turns": turns})  # fmt: skip
    rows = pd.DataFrame(found)
    for name in ("bytes", "ghosts"):
        of = rows[rows["method"] == ZOLTAN].set_index(["case", "ranks"])[name]
        keys = pd.MultiIndex.from_frame(rows[["case", "ranks"]])
        rows[f"{name}_over_zoltan"] = rows[name] / of.reindex(keys).to_numpy()
    return rows


def _ratio(turns: pd.DataFrame, method: str, reference: str) -> Value:
    return paired(turns, turns["time_ms"], method, reference, "turn") or Value(float("nan"))


def step_of(out: Path) -> Value:
    """Returns the nanoseconds that a step of the slope takes for a point, as median of the rounds."""
    runs = read(out / "step/simulation_runs.csv")
    return median_of(1e9 * runs["step_work_s"] / runs["points"] / runs["steps"])


def noise_of(out: Path) -> Value:
    """Returns the ratio of Zoltan's RCB to itself: an A/A test, whose interval must contain 1. A run counts once,
    because all its turns have both arms at the same places in memory."""
    runs = [read(path) for path in sorted(out.glob("*/call_times.csv"))]
    return median_of(_ratio(turns, ZOLTAN + AGAIN, ZOLTAN).number for turns in runs if turns["turn"].max() > 1)


def break_even(row: pd.Series, exact: pd.Series, turns: pd.DataFrame, step_ns: Value) -> Value:
    """Returns the number of steps between two calls above which exact cuts pay: their additional cost in a turn,
    divided by what each step then saves. Calls and steps share the cores in the same way."""
    times = turns.pivot_table("time_ms", "turn", "method")
    dearer = median_of((times[EXACT] - times[row["method"]]).clip(lower=0))
    ms = 1e-6 * (row["imbalance"] - exact["imbalance"]) * row["points"] / min(CORES, row["ranks"])
    ends = [(step_ns.number, GAIN.number), (step_ns.reach[1], GAIN.high), (step_ns.reach[0], GAIN.low)]
    steps = [time / (ms * ns * gain) if ms * gain > 0 else inf if time > 0 else 0.0
             for time, (ns, gain) in zip((dearer.number, *dearer.reach), ends)]  # fmt: skip
    return Value(*steps)


def table_of(rows: pd.DataFrame, parts: int, step_ns: Value) -> pd.DataFrame:
    """Returns a line for each setting, with the median of the clouds and the worst cloud in brackets."""
    rows = rows[rows["ranks"] == parts].set_index("case")
    by_method = dict(iter(rows.groupby("method")))
    exact, lines = by_method[EXACT], []
    for name, method in [*TOLERANCES.items(), *((name, method) for method, name in RIVALS.items())]:
        if method not in by_method:
            continue
        of = by_method[method].loc[exact.index]
        line = {"setting": name, "imbalance left, %": _both(100 * (of["imbalance"] - 1), ".3f"),
                "bytes / exact": _both(of["bytes"] / exact["bytes"], ".2f"),
                "rounds": _both(of["rounds"], ".0f") if of["rounds"].notna().all() else "–",
                "ghosts / Zoltan's RCB": _both(of["ghosts_over_zoltan"], ".2f")}  # fmt: skip
        if of["is_timed"].all():
            steps = [break_even(of.loc[case], exact.loc[case], of.loc[case, "turns"], step_ns) for case in exact.index]
            line["time / exact"] = mean_of(of["time_over_exact"]).text(2) if method != EXACT else "1"
            line["exact pays from, steps"] = _middle(steps) if name in TOLERANCES and method != EXACT else "–"
        lines.append(line)
    return pd.DataFrame(lines).fillna("–")


def _middle(values: list[Value]) -> str:
    """Returns the median cloud, and the medians of the ends of the intervals."""
    return Value(*(float(np.median(ends)) for ends in zip(*((v.number, *v.reach) for v in values)))).text(0)


def _both(values: pd.Series, form: str) -> str:
    return f"{values.median():{form}} ({values.max():{form}})"


def choice_table(rows: pd.DataFrame, parts: int) -> pd.DataFrame:
    """Returns for each cloud the finest tolerance that costs at most 10 % more rounds and bytes than the widest."""
    lines = []
    for case, of in rows[rows["ranks"] == parts].groupby("case", sort=False):
        by = of.set_index("method")
        least = by.loc[TOLERANCES["1.1"]]
        free = [name for name, method in TOLERANCES.items() if name != "none"
                and by.loc[method, "rounds"] <= least["rounds"] and by.loc[method, "bytes"] <= 1.1 * least["bytes"]]
        default, exact = by.loc["rrcb"], by.loc[EXACT]
        lines.append({
            "points": case.removesuffix(" sorted"), "costs no more than 1.1": free[-1],
            "rounds of 1.01": f"{default['rounds']:.0f}", "of exact": f"{exact['rounds']:.0f}",
            "bytes of exact / of 1.01": in_digits(exact["bytes"] / default["bytes"], 2),
            "left at 1.01, %": f"{100 * (default['imbalance'] - 1):.3f}",
        })  # fmt: skip
    return pd.DataFrame(lines)


def draw(rows: pd.DataFrame) -> Figure:
    """The price of accuracy: a call of RRCB over the tolerance. Each cloud has a line (solid in 2-D, dashed in 3-D), and
    each number of parts a column. Grey lines are other methods, as geometric means over the clouds."""
    parts = sorted(rows["ranks"].unique())
    names = [name for name in LOOKS if name != "time" or rows["is_timed"].any()]
    figure, grid = plot.panels(len(names), len(parts), 3.6 * len(parts) + 0.6, 2.2 * len(names) + 0.9,
                               sharex=True, sharey="row")  # fmt: skip
    for column, number in enumerate(parts):
        here = rows[rows["ranks"] == number]
        for axes, name in zip(grid[:, column], names):
            if name == "time" and not here["is_timed"].all():
                axes.text(0.5, 0.5, "too many ranks a core\nto be timed", ha="center", transform=axes.transAxes)
            else:
                _draw_panel(axes, here, name)
        grid[0, column].set_title(f"{number} parts")
    for axes, name in zip(grid[:, 0], names):
        axes.set_ylabel(LOOKS[name])
    for axes in grid[-1]:
        axes.set_xticks(range(len(TOLERANCES)), TOLERANCES, rotation=60)
        axes.set_xlabel("tolerance asked for")
    return plot.legend_above(figure, grid[0, 0], inches=1.2)


def _draw_panel(axes: Axes, rows: pd.DataFrame, name: str) -> None:
    for (cloud, dimension), of in rows.groupby(["cloud", "dim"], sort=False):
        values = [_value(of[of["method"] == method].iloc[0], name) for method in TOLERANCES.values()]
        look = {"color": CLOUDS[cloud], "linestyle": "-" if dimension == 2 else "--", "marker": ".",
                "label": cloud if dimension == 2 else None}  # fmt: skip
        numbers, lows, highs = zip(*((v.number, *v.reach) for v in values))
        plot.draw_line(axes, range(len(values)), numbers, lows, highs, **look)
    if name != "rounds":
        _draw_rivals(axes, rows, name)
        axes.set_yscale("log")
    axes.grid(True, axis="y")


def _draw_rivals(axes: Axes, rows: pd.DataFrame, name: str) -> None:
    """Draws a level for each method. Levels that are too close for separate labels share one."""
    levels = {}
    for method, of in rows[rows["method"].isin(RIVALS)].groupby("method"):
        levels[RIVALS[method]] = float(np.mean([np.log10(_value(row, name).number) for _, row in of.iterrows()]))
    labels: list[tuple[float, list[str]]] = []
    for rival, level in sorted(levels.items(), key=lambda item: item[1]):
        axes.axhline(10**level, color="#999999", linewidth=0.8, zorder=0)
        if not labels or level - labels[-1][0] > 0.25:
            labels.append((level, []))
        labels[-1][1].append(rival)
    for level, names in labels:
        axes.text(0, 10**level, ", ".join(names), fontsize=7, color="#666666", va="bottom")


def _value(row: pd.Series, name: str) -> Value:
    if name == "time":
        return row["time"]
    return Value({"rounds": row["rounds"], "bytes": row["bytes_over_zoltan"],
                  "excess_percent": 100 * row["excess"]}[name])  # fmt: skip


def above_even(rows: pd.DataFrame, every: int, step_ns: float) -> pd.Series:
    """Returns the time above even parts and free calls in % of a step: imbalance left + call / (every steps). Calls and
    steps share the cores in the same way, and 1 % more points are assumed to take 1 % more time."""
    step_ms = 1e-6 * step_ns * rows["points"] / rows["ranks"].clip(upper=CORES)
    return 100 * (rows["imbalance"] - 1 + rows["time_ms"] / (every * step_ms))


def cost_rows(rows: pd.DataFrame, parts: int, step_ns: float) -> pd.DataFrame:
    """Returns a row for each kind of cloud, interval and setting, with the mean, least and most of the clouds."""
    rows = rows[rows["ranks"] == parts]
    found = []
    for kind, of in rows.groupby(np.where(rows["cloud"].isin(HARD), "hard", "easy")):
        for every in EVERY:
            for name, method in [*TOLERANCES.items(), ("Zoltan's RCB", ZOLTAN)]:
                costs = above_even(of[of["method"] == method], every, step_ns)
                found.append((kind, every, name, costs.mean(), costs.min(), costs.max()))
    return pd.DataFrame(found, columns=["clouds", "every", "setting", "cost", "least", "most"])


def cost_table(costs: pd.DataFrame) -> pd.DataFrame:
    """Returns a line for each setting with the means of the clouds; the best tolerance is bold."""
    best = costs.loc[costs[costs["setting"] != "Zoltan's RCB"].groupby(["clouds", "every"])["cost"].idxmin()].index
    text = costs["cost"].map(lambda cost: in_digits(cost, 2 if cost < 100 else 3))
    cells = text.where(~costs.index.isin(best), "**" + text + "**")
    names = costs["clouds"] + ", every " + costs["every"].map("{:,} steps".format)
    table = costs.assign(cell=cells, column=names.str.replace("every 1 steps", "every step"))
    return table.pivot(index="setting", columns="column", values="cell").loc[
        costs["setting"].unique(), table["column"].unique()].reset_index()  # fmt: skip


def draw_cost(costs: pd.DataFrame) -> Figure:
    """Cost of a tolerance in your run: time above even parts and free calls, in % of a step, for a call each 1 to 1,000
    steps. Lines are means over clouds on 16 ranks, and bands reach from the least to the most. Rings mark the best
    tolerance, squares are Zoltan's RCB. If your step takes ten times as long, read the line of ten times as many steps."""
    figure, grid = plot.panels(1, 2, 9, 4, sharey=True)
    for axes, (kind, here) in zip(grid[0], costs.groupby("clouds")):
        for every, of in here.groupby("every"):
            ours, zoltan = of.iloc[:-1], of.iloc[-1]
            label = f"a call each {every:,} steps" if every > 1 else "a call in each step"
            plot.draw_line(axes, range(len(ours)), ours["cost"], ours["least"], ours["most"], color=EVERY[every],
                           marker=".", label=label)  # fmt: skip
            best = int(ours["cost"].to_numpy().argmin())
            axes.plot(best, ours["cost"].iloc[best], "o", ms=11, mfc="none", mew=1.6, color=EVERY[every])
            axes.errorbar(len(ours) + 0.3, zoltan["cost"], [[zoltan["cost"] - zoltan["least"]],
                          [zoltan["most"] - zoltan["cost"]]], fmt="s", color=EVERY[every])  # fmt: skip
        axes.axvline(list(TOLERANCES).index("1.01"), color="#999999", linewidth=0.8, zorder=0)
        axes.set(yscale="log", xlabel="tolerance", title=f"{kind} clouds: " + (
            ", ".join(HARD) if kind == "hard" else ", ".join(cloud for cloud in CLOUDS if cloud not in HARD)))  # fmt: skip
        axes.set_xticks([*range(len(TOLERANCES)), len(TOLERANCES) + 0.3], [*TOLERANCES, "Zoltan's\nRCB"], fontsize=8)
        axes.get_xticklabels()[list(TOLERANCES).index("1.01")].set_weight("bold")
        axes.grid(True, axis="y")
    grid[0, 0].set_ylabel("time above even parts\nand free calls [% of a step]")
    return plot.legend_above(figure, grid[0, 0], inches=2)


def report(out: Path) -> None:
    rows = rows_of(out)
    timed, parts = bool(rows["is_timed"].any()), sorted(rows["ranks"].unique())
    most = max(number for number in parts if number <= max(16, parts[0]))
    step_ns = step_of(out)
    counts = rows[["cloud", "dim", "ranks", "method", "imbalance", "rounds", "bytes", "ghosts"]]
    counts.to_csv(out / "price.csv", index=False, float_format="%.9g")
    plot.use_style()
    plot.save(draw(rows), out / "price.png")
    pictures, tables = {"price.png": draw}, {}
    if timed:
        costs = cost_rows(rows, most, step_ns.number)
        costs.to_csv(out / "cost.csv", index=False, float_format="%.4g")
        plot.save(draw_cost(costs), out / "cost.png")
        pictures = {"cost.png": draw_cost} | pictures
        tables[f"{most} parts: time above even parts and free calls, % of a step"] = cost_table(costs)
    tables |= {f"{most} parts: median of the clouds, worst in brackets": table_of(rows, most, step_ns),
              f"{most} parts: by cloud": choice_table(rows, most)}  # fmt: skip
    found = Report("What accuracy costs", out)
    for name, make in pictures.items():
        found.picture(name, " ".join(make.__doc__.split()))
    for caption, table in tables.items():
        found.table(caption, table, is_shown=True)
    if timed:
        again = noise_of(out)
        verdict = (
            "too few runs to tell" if not again.has_interval else "not told apart" if not again.is_apart(ONE)
            else "told apart from itself: do not believe the times"
        )  # fmt: skip
        found.say(f"A/A: Zoltan's RCB over itself {again.text(3)}, {verdict}. A step takes {step_ns.text(1)} ns a point.")
    found.write(next(out.glob("*/run.txt"), out))


def main() -> None:
    parser = options("price", __doc__, "a small run of everything", "comparisons/run --price")
    parser.add_argument("--parts", default="4,16,64", help="numbers of parts, one a rank; 4,16,64")
    parser.add_argument("--points", type=int, default=100_000, help="of each cloud; 100000")
    parser.add_argument("--repeats", type=int, default=6,
                        help=f"turns, best an even number; 6. With 1, and beyond {MOST_A_CORE} ranks a core, counts"
                        " alone, no times")
    parser.add_argument("--keep", action="store_true", help="report what is in the folder")
    given = parser.parse_args()
    if not given.keep:
        measure(driver_of(given, multijagged=True), sorted(map(int, given.parts.split(","))), given.points, given.repeats)
    report(given.out)


if __name__ == "__main__":
    main()
