"""The balance of every method in several scenes."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import plot
from document import markdown_table
from history import TIME, draw_worst
from matplotlib.figure import Figure
from results import Results


def report_scenes(folder: Path, names: list[str]) -> None:
    """Prints the imbalance over the steps and draws scenes.png, its history."""
    scenes = {name: results for name in names if len((results := Results(folder / name)).runs)}
    if not scenes:
        return
    plot.use_style()
    plot.save(draw(scenes), folder / "scenes.png")
    rows = table(scenes)
    print("\nImbalance, mean over the steps (worst)\n")
    print(markdown_table([list(rows), *rows.values.tolist()]))
    print(f"Picture: {folder / 'scenes.png'}")


def table(scenes: dict[str, Results]) -> pd.DataFrame:
    """A row for each method: the mean over the steps, and the worst step in brackets."""
    texts = {
        scene: {f"`{r.method}`": f"{r.mean_imbalance:.4f} ({r.worst_imbalance:.3f})"
                for r in results.runs.itertuples()}
        for scene, results in scenes.items()
    }  # fmt: skip
    return pd.DataFrame(texts).fillna("").rename_axis("method").reset_index()


def draw(scenes: dict[str, Results]) -> Figure:
    figure, grid = plot.panels(len(scenes), 1, 9, 2.4 * len(scenes) + 1)
    for axes, (scene, results) in zip(grid[:, 0], scenes.items()):
        draw_worst(axes, results.histories())
        axes.set_title(scene)
    grid[-1, 0].set_xlabel(TIME)
    return plot.legend_above(figure, grid[0, 0], inches=3)
