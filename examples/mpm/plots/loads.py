"""Draws the times of ranks in a history of comparisons/run --cost=learned, and prints what the
slowest ranks take.

    loads.py history.csv [PICTURE]
"""
import csv
import sys

from matplotlib import pyplot


STEPS = 100  # number of steps over which a value is the mean


def read(path, method):
    """Returns the steps, and rows with the mean seconds of all ranks."""
    bins = {}
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["method"] == method and int(row["step"]) > 0:
                times = bins.setdefault(int(row["step"]) // STEPS, {})
                times.setdefault(int(row["part"]), []).append(float(row["seconds"]))
    loads = [[sum(times[part]) / len(times[part]) for part in sorted(times)] for times in bins.values()]
    return [STEPS * number for number in bins], loads


def imbalance(loads):
    """Returns the sum of the slowest ranks divided by the sum of the means."""
    return sum(max(row) for row in loads) * len(loads[0]) / sum(map(sum, loads))


def main(history, picture=None):
    pyplot.rcParams.update({"axes.spines.top": False, "axes.spines.right": False})
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 3.6), sharey=True, layout="constrained")
    for axis, cost in zip(axes, ("count", "learned")):
        steps, loads = read(history, cost)
        print(f"{cost}: the slowest ranks take {imbalance(loads):.3f} times the mean")
        for rank, column in enumerate(zip(*loads)):
            axis.plot(steps, [1e6 * seconds for seconds in column], label=f"rank {rank}")
        mean = [1e6 * sum(row) / len(row) for row in loads]
        axis.plot(steps, mean, "k--", linewidth=1, label="mean")
        axis.set_title(f"--cost={cost}: slowest ranks {imbalance(loads):.2f} times the mean")
        axis.set_xlabel("step")
    axes[0].set_ylabel("time of a step [µs]")
    axes[0].set_ylim(bottom=0)
    axes[0].legend(fontsize=8)
    if picture:
        figure.savefig(picture, dpi=110)


main(*sys.argv[1:])
