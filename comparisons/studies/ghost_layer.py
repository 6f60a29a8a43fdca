"""Draws the points that one rank receives as ghosts: those within the radius of its box, or those whose own radius
reaches the box."""

from pathlib import Path

import numpy as np

import plot
from matplotlib.patches import Circle, FancyBboxPatch, Rectangle

FIGURES = Path(__file__).resolve().parents[2] / "docs" / "figures"
RADIUS = 0.09


def halves(points: np.ndarray, box: np.ndarray, parts: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Returns boxes with equal numbers of points, cut across their longest side, and their points."""
    if parts == 1:
        return [(box, points)]
    axis = int(np.argmax(box[1] - box[0]))
    cut = np.median(points[:, axis])
    lower, upper = box.copy(), box.copy()
    lower[1, axis] = upper[0, axis] = cut
    above = points[:, axis] >= cut
    return halves(points[~above], lower, parts // 2) + halves(points[above], upper, parts // 2)


def draw_layer() -> plot.Figure:
    """Draws the ghosts of rank 3 of eight ranks."""
    points = np.random.default_rng(5).beta(1.3, 1.9, (700, 2)) * [1.6, 1]
    ranks = halves(points, np.array([[0, 0], [1.6, 1]]), 8)
    figure, grid = plot.panels(1, 1, 7.2, 4.6)
    axes = grid[0, 0]
    mine = 3
    box = ranks[mine][0]
    for rank, (each, inside) in enumerate(ranks):
        beyond = np.maximum(np.maximum(box[0] - inside, inside - box[1]), 0)
        near = (np.hypot(*beyond.T) <= RADIUS) & (rank != mine)
        colour = plot.PART_COLOURS[rank]
        axes.plot(*inside[~near].T, ".", color=colour, markersize=6 if rank == mine else 5)
        axes.plot(*inside[near].T, "o", color=colour, markersize=6, markeredgecolor="black")
        axes.add_patch(Rectangle(each[0], *(each[1] - each[0]), fill=False, edgecolor="black"))
        axes.text(*(each.mean(axis=0)), f"rank {rank}", ha="center", va="center",
                  bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5})
    axes.add_patch(FancyBboxPatch(box[0], *(box[1] - box[0]), fill=False, linestyle="--",
                                  boxstyle=f"round,pad={RADIUS},rounding_size={RADIUS}"))
    axes.set(xlim=(0, 1.6), ylim=(0, 1), aspect="equal", xticks=[], yticks=[])
    return figure


def draw_radii() -> plot.Figure:
    """Draws two points near a cut. The other rank needs the one whose radius crosses the cut, but not the other one."""
    figure, grid = plot.panels(1, 1, 4.6, 2.7)
    axes = grid[0, 0]
    points = {"A": (0.7, 0.5, 0.42, "rank 1 gets A as a ghost"), "B": (1.5, 0.5, 0.27, "rank 0 does not get B")}
    for rank, (name, (x, y, radius, text)) in enumerate(points.items()):
        colour = plot.PART_COLOURS[rank + 2]
        axes.add_patch(Rectangle((rank, 0), 1, 1, fill=False, edgecolor="black"))
        axes.add_patch(Circle((x, y), radius, facecolor=colour, alpha=0.3))
        axes.add_patch(Circle((x, y), radius, fill=False, linestyle="--"))
        axes.plot(x, y, "o", color=colour, markersize=8, markeredgecolor="black")
        axes.annotate("", (x, y + radius), (x, y), arrowprops={"arrowstyle": "->", "shrinkA": 4, "shrinkB": 0})
        axes.text(x + 0.04, y, name, va="center")
        axes.text(x - 0.02, y + 0.45 * radius, "radius", ha="right", va="center")
        axes.text(rank + 0.03, 0.97, f"rank {rank}", va="top")
        axes.text(rank + 0.5, -0.04, text, ha="center", va="top")
    axes.set(xlim=(-0.02, 2.02), ylim=(-0.16, 1.02), aspect="equal")
    axes.axis("off")
    return figure


def main() -> None:
    plot.use_style()
    plot.save(draw_layer(), FIGURES / "ghost_layer.png")
    plot.save(draw_radii(), FIGURES / "radii.png")


if __name__ == "__main__":
    main()
