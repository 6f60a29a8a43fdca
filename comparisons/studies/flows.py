"""Compares policies of rebalancing along flows of particles: which costs least?

Cost of a flow = H * ghosts of all calls + points moved between calls. H is the number of steps between calls, over the
number of ghosts of one step that cost as much as moving one point. Ghosts are counted within 1.2 spacings ("near") and
2.5 ("wide"). A ratio is that of a cost to the least cost of a policy of the same run.

Policies: "library" gives the cuts of the call before. "kept axes" gives them too, and the axes of the first call.
"fresh" knows nothing of the calls before. "+ remap" renumbers the parts by rrcb::remap.

Writes flows.csv, a row for each flow, number of parts and policy, and calls_PARTS.csv, a row for each call.
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd
from document import markdown_table
from driver import options, prepare
from results import printed

RUN = ["flow", "dim", "parts", "policy"]
FACTORS = (1, 10)  # H
RADII = ("near", "wide")
MOST_RANKS = 16  # up to this number each part has a rank
BASE = "fresh"
QUICK = "rod,drops"


def follow(program: Path, out: Path, parts: int, flows: str, policies: str) -> pd.DataFrame:
    """Returns a row for each flow, policy and call."""
    return printed(min(parts, MOST_RANKS), program, str(parts), flows, policies, file=out / f"calls_{parts}.csv")


def ratio_name(factor: float, radius: str) -> str:
    return f"ratio_{factor:g}_{radius}"


def summary(calls: pd.DataFrame) -> pd.DataFrame:
    """Returns a row for each run: sums over the calls, the mean number of ghosts per call, and the cost divided by that
    of the best policy."""
    runs = calls.groupby(RUN, sort=False)
    rows = runs[["moved", "messages"]].sum()
    rows.insert(0, "calls", runs.size())
    for radius in RADII:
        rows[f"ghosts_{radius}"] = runs[f"ghosts_{radius}"].mean()
    for factor in FACTORS:
        for radius in RADII:
            cost = factor * rows["calls"] * rows[f"ghosts_{radius}"] + rows["moved"]
            rows[ratio_name(factor, radius)] = cost / cost.groupby(level=RUN[:3]).transform("min")
    return rows.reset_index()


def cost_table(rows: pd.DataFrame, radius: str) -> list[list[str]]:
    """Returns the mean and the worst ratio of each policy, over all flows and numbers of parts."""
    lines = [["policy", *(f"H = {factor:g}: {of}" for factor in FACTORS for of in ("mean", "worst", "worst case"))]]
    for policy, own in rows.groupby("policy", sort=False):
        line = [policy]
        for factor in FACTORS:
            ratios = own[ratio_name(factor, radius)]
            worst = own.loc[ratios.idxmax()]
            line += [f"{ratios.mean():.3f}", f"{ratios.max():.3f}", f"{worst['flow']}, {worst['parts']} parts"]
        lines.append(line)
    return lines


def traffic_table(rows: pd.DataFrame) -> list[list[str]]:
    """Returns the MPI calls of all flows, and the worst flow compared with the base."""
    lines = [["parts", "policy", f"MPI calls / {BASE}", f"worst / {BASE}"]]
    for (parts, policy), own in rows.set_index("flow").groupby(["parts", "policy"], sort=False)["messages"]:
        base = rows[(rows["parts"] == parts) & (rows["policy"] == BASE)].set_index("flow")["messages"]
        lines.append([str(parts), policy, f"{own.sum() / base.sum():.2f}", f"{(own / base).max():.2f}"])
    return lines


def main() -> None:
    parser = options("flows", __doc__, f"the flows {QUICK} on 4 parts")
    parser.add_argument("--flows", help="names by commas; all")
    parser.add_argument("--parts", help="numbers by commas; 4,16")
    parser.add_argument("--policies", default="all", help="names by commas; all")
    given = parser.parse_args()
    program = prepare(given, "rrcb_flows")
    flows = given.flows or (QUICK if given.quick else "all")
    numbers = given.parts or ("4" if given.quick else "4,16")
    rows = summary(pd.concat(
        follow(program, given.out, parts, flows, given.policies) for parts in map(int, numbers.split(","))
    ))  # fmt: skip
    rows.to_csv(given.out / "flows.csv", index=False)
    for radius in RADII:
        print(f"\nCost of a flow over that of the best policy, {radius} ghosts\n")
        print(markdown_table(cost_table(rows, radius)))
    print("\nTraffic, all ranks\n\n" + markdown_table(traffic_table(rows)))


if __name__ == "__main__":
    main()
