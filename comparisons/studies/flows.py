"""Compares policies of rebalancing along flows of particles: which costs least?

Cost of a flow = H * ghosts of all calls + points moved between calls. H is the number of steps between calls, over the
number of ghosts of one step that cost as much as moving one point. Ghosts are counted within 1.2 spacings ("near") and
2.5 ("wide"). A ratio is that of a cost to the least cost of a policy of the same run.

Policies: "library" gives the cuts of the call before. "kept axes" gives them too, and the axes of the first call.
"fresh" knows nothing of the calls before. "in place" gives no cuts, but ranks hold the points of their parts. "+ remap"
renumbers the parts by rrcb::remap.

Writes flows.csv, a row for each flow, number of parts and policy, flows.png, and calls_PARTS.csv, a row for each call.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import pandas as pd
import plot
from document import markdown_table
from driver import OUT, PROGRAMS, build, on_ranks
from results import read_all

RUN = ["flow", "dim", "parts", "policy"]
FACTORS = (0.3, 1, 3, 10)  # H
RADII = ("near", "wide")
DRAWN = (1, 3)  # H of the picture
MOST_RANKS = 16  # a rank for each part up to there
BASE = "fresh"
QUICK = "rod,drops"
COLOURS = ("#0072B2", "#CC79A7", "#000000", "#666666", "#56B4E9", "#D55E00", "#E69F00")


def follow(program: Path, out: Path, ranks: int, parts: int, flows: str, policies: str) -> pd.DataFrame:
    """A row for each flow, policy and call."""
    file = out / f"calls_{parts}.csv"
    print(f"rrcb_flows {parts} {flows} on {ranks} ranks", file=sys.stderr, flush=True)
    with file.open("w") as rows:
        on_ranks(ranks, program, str(parts), flows, policies, stdout=rows, check=True)
    return read_all(file)


def ratio_name(factor: float, radius: str) -> str:
    return f"ratio_{factor:g}_{radius}"


def summary(calls: pd.DataFrame) -> pd.DataFrame:
    """A row for each run: sums over the calls, ghosts of a call on average, and the largest imbalance."""
    runs = calls.groupby(RUN, sort=False)
    rows = runs[["moved", "turned", "rounds", "messages", "bytes"]].sum()
    rows.insert(0, "calls", runs.size())
    rows.insert(1, "points", runs["points"].first())
    for radius in RADII:
        rows[f"ghosts_{radius}"] = runs[f"ghosts_{radius}"].mean()
    rows["imbalance"] = runs["imbalance"].max()
    return rows.reset_index()


def with_others(rows: pd.DataFrame, file: Path) -> pd.DataFrame:
    """Adds the runs of the same flows and parts by other policies that are in a flows.csv."""
    others = read_all(file).reindex(columns=list(rows))
    are_same = others.set_index(RUN[:3]).index.isin(rows.set_index(RUN[:3]).index)
    return pd.concat([rows, others[are_same & ~others["policy"].isin(rows["policy"])]], ignore_index=True)


def with_ratios(rows: pd.DataFrame) -> pd.DataFrame:
    """Adds the cost of each run over that of the best policy."""
    rows = rows.copy()
    for factor in FACTORS:
        for radius in RADII:
            cost = factor * rows["calls"] * rows[f"ghosts_{radius}"] + rows["moved"]
            least = cost.groupby([rows[name] for name in RUN[:3]]).transform("min")
            rows[ratio_name(factor, radius)] = cost / least
    return rows


def case_of(row: pd.Series) -> str:
    return f"{row['flow']}, {row['parts']} parts"


def cost_table(rows: pd.DataFrame, radius: str) -> list[list[str]]:
    """The mean and the worst ratio of each policy, over flows and numbers of parts."""
    lines = [["policy", *(f"H = {factor:g}: {of}" for factor in FACTORS for of in ("mean", "worst", "worst case"))]]
    for policy, own in rows.groupby("policy", sort=False):
        line = [policy]
        for factor in FACTORS:
            ratios = own[ratio_name(factor, radius)]
            line += [f"{ratios.mean():.3f}", f"{ratios.max():.3f}", case_of(own.loc[ratios.idxmax()])]
        lines.append(line)
    return lines


def traffic_table(rows: pd.DataFrame) -> list[list[str]]:
    """MPI calls, bytes and rounds of all flows, and the worst flow against the base."""
    counts = {"messages": "MPI calls", "bytes": "bytes"}
    lines = [["parts", "policy", "rounds a call", *(f"{text}{of}" for text in counts.values() for of in
              (" a call", f" / {BASE}", f", worst / {BASE}"))]]  # fmt: skip
    for (parts, policy), own in rows.groupby(["parts", "policy"], sort=False):
        line = [str(parts), policy, f"{own['rounds'].sum() / own['calls'].sum():.2f}"]
        base = rows[(rows["parts"] == parts) & (rows["policy"] == BASE)]
        for count in counts:
            line.append(f"{own[count].sum() / own['calls'].sum():,.0f}")
            ratios = own.set_index("flow")[count] / base.set_index("flow")[count]
            total = own[count].sum() / base[count].sum() if len(base) else float("nan")
            line += [f"{total:.2f}", f"{ratios.max():.2f}"]
        lines.append(line)
    return lines


def flow_table(rows: pd.DataFrame) -> list[list[str]]:
    """Counts of each run, for one look."""
    lines = [["flow", "parts", "policy", "moved / points", "cuts turned", "ghosts near", "ghosts wide", "imbalance",
              *(f"ratio at H = {factor:g}" for factor in DRAWN)]]  # fmt: skip
    for _, row in rows.iterrows():
        lines.append([
            row["flow"], str(row["parts"]), row["policy"], f"{row['moved'] / row['points']:.2f}", str(row["turned"]),
            f"{row['ghosts_near']:.0f}", f"{row['ghosts_wide']:.0f}", f"{row['imbalance']:.4f}",
            *(f"{row[ratio_name(factor, 'wide')]:.3f}" for factor in DRAWN),
        ])  # fmt: skip
    return lines


def draw(rows: pd.DataFrame, path: Path) -> None:
    """Ratios of each flow, a dot for each policy; a line of panels for each H, a column for each number of parts."""
    plot.use_style()
    flows, parts = list(rows["flow"].unique()), list(rows["parts"].unique())
    figure, grid = plot.panels(len(DRAWN), len(parts), 5 * len(parts), 3.2 * len(DRAWN), sharex=True, sharey=True)
    for factor, line in zip(DRAWN, grid):
        for number, axes in zip(parts, line):
            of_panel = rows[rows["parts"] == number]
            for colour, (policy, own) in zip(COLOURS, of_panel.groupby("policy", sort=False)):
                places = [flows.index(flow) for flow in own["flow"]]
                axes.plot(places, own[ratio_name(factor, "wide")], "o", ms=4, alpha=0.8, color=colour, label=policy)
            axes.set_title(f"{number} parts, H = {factor:g}")
            axes.set_xticks(range(len(flows)), flows, rotation=90)
            axes.set_yscale("log")
            axes.grid(axis="x")
    for axes in grid[:, 0]:
        axes.set_ylabel("cost / least cost")
    plot.save(plot.legend_above(figure, grid[0, 0]), path)


def main() -> None:
    parser = argparse.ArgumentParser(prog="comparisons/studies/run flows", description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)  # fmt: skip
    parser.add_argument("--out", type=Path, default=OUT / "flows", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help=f"the flows {QUICK} on 4 parts")
    parser.add_argument("--flows", help="names by commas; all")
    parser.add_argument("--parts", help="numbers by commas; 4,16")
    parser.add_argument("--ranks", type=int, default=MOST_RANKS, help=f"most ranks; {MOST_RANKS}")
    parser.add_argument("--policies", default="all", help="names by commas; all")
    parser.add_argument("--others", type=Path, help="flows.csv of an earlier run, for policies that are not run")
    parser.add_argument("--history", action="store_true", help="print each call and the counts of each flow")
    parser.add_argument("--driver", type=Path, help="a program beside rrcb_flows, which is not built then")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    if not given.driver:
        build("rrcb_flows")
    program = (given.driver.parent if given.driver else PROGRAMS) / "rrcb_flows"
    flows = given.flows or (QUICK if given.quick else "all")
    numbers = given.parts or ("4" if given.quick else "4,16")
    calls = pd.concat(
        follow(program, given.out, min(parts, given.ranks), parts, flows, given.policies)
        for parts in map(int, numbers.split(","))
    )
    rows = summary(calls)
    rows = with_ratios(with_others(rows, given.others) if given.others else rows)
    rows.to_csv(given.out / "flows.csv", index=False)
    if given.history:
        print(calls.to_string(index=False))
        print("\n" + markdown_table(flow_table(rows)))
    for radius in RADII:
        print(f"\nCost of a flow over that of the best policy, {radius} ghosts\n")
        print(markdown_table(cost_table(rows, radius)))
    print("\nTraffic, all ranks\n\n" + markdown_table(traffic_table(rows)))
    draw(rows, given.out / "flows.png")


if __name__ == "__main__":
    main()
