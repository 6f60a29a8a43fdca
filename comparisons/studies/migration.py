"""How many points change rank when points that move are rebalanced.

migration.py DIRECTORY with the migration.csv of rrcb_migration
"""

from __future__ import annotations

import sys
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import pandas as pd
from document import markdown_table
from intervals import Value, median_of
from results import read_all

CASE = ["scene", "ranks"]
PLAIN, REUSING = "rrcb", "rrcb[reuse]"
TITLES = {
    "stay": "Points wait on their ranks for the call. A call moves, % of them:",
    "follow": "Points that cross a cut go to their new rank at once. Beyond that a call moves, % of them:",
}


def moved(rows: pd.DataFrame, column: str = "moved_fraction") -> Value:
    """Of one method in one case, over the seeds."""
    return median_of(rows[column])


def table_of(rows: pd.DataFrame, between: str) -> str:
    """Markdown: a row per case, and of each method what a call moves on average; of the one that
    starts from its last cuts what had crossed these, and over that of the one from nothing."""
    rows = rows[rows["between"] == between]
    methods = list(rows["method"].unique())
    lines = [[*CASE, *(f"`{m}`" for m in methods), "crossed", f"`{REUSING}` / `{PLAIN}`"]]
    for (scene, ranks), case in rows.groupby(CASE, sort=False):
        of = {method: case[case["method"] == method] for method in methods}
        cells = [(moved(of[method]) * 100).text(3) for method in methods]
        cells.append((moved(of[REUSING], "crossed_fraction") * 100).text(3))
        plain = moved(of[PLAIN]).number
        ratio = f"{moved(of[REUSING]).number / plain:.2f}" if plain > 0 else "-"
        lines.append([scene, str(ranks), *cells, ratio])
    return markdown_table(lines)


def main() -> None:
    directory = Path(sys.argv[1])
    rows = read_all(directory / "migration.csv")
    for between, title in TITLES.items():
        print(f"{title}\n\n{table_of(rows, between)}\n")


if __name__ == "__main__":
    main()
