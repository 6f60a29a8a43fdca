"""Draws and tabulates the errors of standard deviations: moments.py DIRECTORY with moments_error.csv.
"""

from __future__ import annotations

import csv
import math
import sys
from dataclasses import dataclass
from pathlib import Path

from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from style import method_style, save, use_style

FLOOR = 1e-17
# Colours that no balancer has, but for RRCB's own.
STYLES = {
    "naive sums": ("#7A5C4A", "--", "s"),
    "Welford": ("#B0005E", ":", "^"),
    "Chan, pairwise": ("#4B5D0B", "-.", "D"),
    "RRCB": (method_style("rrcb").colour, "-", "o"),
}


@dataclass(frozen=True)
class Error:
    """Relative error of a standard deviation; NaN where its square came out negative."""

    cloud: str
    offset: float
    points: int
    method: str
    error: float


def read_errors(file: Path) -> list[Error]:
    with file.open(newline="") as lines:
        return [
            Error(
                row["cloud"],
                float(row["offset"]),
                int(row["points"]),
                row["method"],
                float(row["error"]),
            )
            for row in csv.DictReader(lines)
        ]


def table_of(errors: list[Error]) -> str:
    """Markdown: a row per cloud, offset and number of points, a column per method."""
    methods = list(dict.fromkeys(error.method for error in errors))
    rows: dict[tuple[str, float, int], dict[str, float]] = {}
    for error in errors:
        rows.setdefault((error.cloud, error.offset, error.points), {})[error.method] = error.error
    lines = [
        "| points | offset | number | " + " | ".join(methods) + " |",
        "|---" * (3 + len(methods)) + "|",
    ]
    for (cloud, offset, points), values in rows.items():
        cells = [_text(values[method]) for method in methods]
        lines.append(f"| {cloud} | {offset:.0e} | {points:,} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def draw_errors(errors: list[Error], picture: Path) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.8), sharey=True)
    uniform = [error for error in errors if error.cloud == "uniform"]
    values = [error for error in errors if error.cloud != "uniform"]
    _draw_panel(axes[0], uniform, "offset")
    _draw_panel(axes[1], values, "points")
    axes[0].set_xlabel("offset of a uniform cloud of extent 1")
    axes[0].set_ylabel("relative error of sigma")
    axes[1].set_xlabel("number of points of two values, 0.7 apart at $10^6$")
    axes[0].set_ylim(FLOOR / 2, 1e17)
    axes[0].legend(loc="upper left")
    save(figure, picture)


def _text(error: float) -> str:
    return "no number" if math.isnan(error) else f"{error:.0e}" if error > 0 else "0"


def _draw_panel(axes: Axes, errors: list[Error], abscissa: str) -> None:
    for method, (colour, line, marker) in STYLES.items():
        mine = [e for e in errors if e.method == method and not math.isnan(e.error)]
        axes.plot(
            [getattr(e, abscissa) for e in mine],
            [max(e.error, FLOOR) for e in mine],
            color=colour,
            linestyle=line,
            marker=marker,
            markersize=4,
            label=method,
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.axhline(1e-12, color="#BBBBBB", linewidth=0.8)
    axes.grid(True)


def main() -> None:
    directory = Path(sys.argv[1])
    errors = read_errors(directory / "moments_error.csv")
    use_style()
    draw_errors(errors, directory / "moments_error.png")
    print(table_of(errors))


if __name__ == "__main__":
    main()
