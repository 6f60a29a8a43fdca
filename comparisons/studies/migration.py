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


def totals(rows: pd.DataFrame) -> list[str]:
    """A sentence for each cube: the points that each method moves in all calls."""
    texts = []
    cubes = rows[rows["scene"].str.startswith("cube") & (rows["between"] == "stay")]
    for (scene, ranks), case in cubes.groupby(CASE, sort=False):
        counts = [
            f"{moved(of_method, 'moved_points').text(0)} under `{method}`"
            for method, of_method in case.groupby("method", sort=False)
        ]
        texts.append(
            f"{scene} of the side a call, {ranks} ranks, {case['points'].iloc[0]} points that wait"
            f" for the call: {case['calls'].iloc[0]} calls move {', '.join(counts)};"
            f" {moved(case[case['method'] == REUSING], 'crossed_points').text(0)} had crossed its"
            " cuts."
        )
    return texts


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


def text_of(rows: pd.DataFrame) -> str:
    parts = ["\n".join(f"- {text}" for text in totals(rows))]
    parts += [f"{title}\n\n{table_of(rows, between)}" for between, title in TITLES.items()]
    return "\n\n".join(parts) + "\n"


def main() -> None:
    directory = Path(sys.argv[1])
    text = text_of(read_all(directory / "migration.csv"))
    (directory / "migration.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
