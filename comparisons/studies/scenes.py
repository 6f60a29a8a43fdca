"""The balance of every method in several scenes: scenes.py DIRECTORY SCENE ...

DIRECTORY/<scene> has the files of a comparison. Prints a table of the imbalance over the steps and
writes scenes.png, its history.
"""

from __future__ import annotations

import sys
from pathlib import Path

import libraries  # noqa: F401, before what it looks for
import pandas as pd
import plot
from document import markdown_table
from history import TIME, draw_worst
from matplotlib.figure import Figure
from results import Results


def table(scenes: dict[str, Results]) -> str:
    """Markdown: the mean over the steps, and the worst step in brackets."""
    texts = pd.DataFrame(
        {
            scene: {r.method: f"{r.mean_imbalance:.4f} ({r.worst_imbalance:.3f})" for r in runs}
            for scene, results in scenes.items()
            if (runs := list(results.runs.itertuples()))
        }
    ).fillna("")
    lines = [[f"`{method}`", *row] for method, *row in texts.itertuples()]
    return markdown_table([["method", *scenes], *lines])


def draw(scenes: dict[str, Results]) -> Figure:
    figure, grid = plot.panels(len(scenes), 1, 9, 2.4 * len(scenes) + 1)
    for axes, (scene, results) in zip(grid[:, 0], scenes.items()):
        draw_worst(axes, results.histories())
        axes.set_title(scene)
    grid[-1, 0].set_xlabel(TIME)
    return plot.legend_above(figure, grid[0, 0], inches=3)


def main() -> int:
    if len(sys.argv) < 3 or not (directory := Path(sys.argv[1])).is_dir():
        print("usage: scenes.py DIRECTORY SCENE ...", file=sys.stderr)
        return 2
    scenes = {scene: Results(directory / scene) for scene in sys.argv[2:]}
    scenes = {scene: results for scene, results in scenes.items() if len(results.runs)}
    if not scenes:
        print(f"{directory}: no simulations of these scenes", file=sys.stderr)
        return 1
    plot.use_style()
    plot.save(draw(scenes), directory / "scenes.png")
    print(f"\nImbalance, mean over the steps (worst)\n\n{table(scenes)}")
    print(f"Picture: {directory / 'scenes.png'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
