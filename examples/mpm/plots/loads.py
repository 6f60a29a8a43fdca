"""Draws loads.csv of two runs, counted and learned, and tells what their slowest ranks take.

    loads.py FOLDER [PICTURE]      FOLDER-count/loads.csv and FOLDER-learned/loads.csv
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot


def read(path):
    with open(path, encoding="utf-8") as file:
        rows = [[float(number) for number in row] for row in list(csv.reader(file))[1:]]
    return [row[0] for row in rows], [row[1:] for row in rows]


def imbalance(loads):
    """Sum of the slowest ranks over that of the means."""
    return sum(max(row) for row in loads) * len(loads[0]) / sum(map(sum, loads))


def main(folder, picture=None):
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 3.6), sharey=True, layout="constrained")
    for axis, cost in zip(axes, ("count", "learned")):
        steps, loads = read(f"{folder}-{cost}/loads.csv")
        print(f"{cost}: the slowest ranks take {imbalance(loads):.3f} times the mean")
        for rank, column in enumerate(zip(*loads)):
            axis.plot(steps, [1e6 * seconds for seconds in column], label=f"rank {rank}")
        mean = [1e6 * sum(row) / len(row) for row in loads]
        axis.plot(steps, mean, "k--", linewidth=1, label="mean")
        axis.set_title(f"--cost={cost}: slowest ranks {imbalance(loads):.2f} times the mean")
        axis.set_xlabel("step")
    axes[0].set_ylabel("processor time of a step, µs")
    axes[0].set_ylim(bottom=0)
    axes[0].legend(fontsize=8)
    if picture:
        figure.savefig(picture, dpi=110)


main(*sys.argv[1:])
