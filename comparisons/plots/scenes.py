"""The balance of every method in several scenes: scenes.py DIRECTORY SCENE ...

DIRECTORY/<scene> has the files of a comparison. Writes scenes.md, a table of the imbalance over the
steps, and scenes.png, its history.
"""

from __future__ import annotations

import sys
from pathlib import Path

from matplotlib import pyplot as plt

from history import draw_worst
from results import Simulation, read_history, read_simulations, unique
from settings import legend_above
from style import save, use_style


def table(runs: dict[str, list[Simulation]]) -> str:
    """Markdown: the mean over the steps, and the worst step in brackets."""
    methods = unique([run.method for scene in runs.values() for run in scene])
    lines = ["| method | " + " | ".join(runs) + " |", "|---" * (len(runs) + 1) + "|"]
    for method in methods:
        cells = [_cell(method, scene) for scene in runs.values()]
        lines.append(f"| `{method}` | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _cell(method: str, runs: list[Simulation]) -> str:
    for run in runs:
        if run.method == method:
            return f"{run.mean_imbalance:.4f} ({run.worst_imbalance:.3f})"
    return ""


def draw(directory: Path, scenes: list[str]) -> None:
    size = (9, 2.4 * len(scenes) + 1)
    figure, rows = plt.subplots(len(scenes), 1, figsize=size, squeeze=False)
    for axes, scene in zip(rows[:, 0], scenes):
        draw_worst(axes, read_history(directory / scene))
        axes.set_title(scene)
    rows[-1, 0].set_xlabel("time simulated [s]")
    legend_above(figure, rows[0, 0].get_legend_handles_labels()[0], inches=3)
    save(figure, directory / "scenes.png")


def main() -> int:
    if len(sys.argv) < 3 or not (directory := Path(sys.argv[1])).is_dir():
        print("usage: scenes.py DIRECTORY SCENE ...", file=sys.stderr)
        return 2
    runs = {scene: read_simulations(directory / scene) for scene in sys.argv[2:]}
    runs = {scene: found for scene, found in runs.items() if found}
    if not runs:
        print(f"{directory}: no simulations of these scenes", file=sys.stderr)
        return 1
    use_style()
    (directory / "scenes.md").write_text(table(runs))
    draw(directory, list(runs))
    print(f"\nImbalance, mean over the steps (worst)\n\n{table(runs)}")
    print(f"Table: {directory / 'scenes.md'}\nPicture: {directory / 'scenes.png'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
