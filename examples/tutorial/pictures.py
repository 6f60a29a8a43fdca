"""Draws the pictures of docs/tutorial.md, one for each step.

    mpirun -n 4 python3 examples/tutorial/pictures.py docs/figures

Needs matplotlib. Ranks hold the particles as in the steps; rank 0 draws.
"""
import sys
from pathlib import Path

import matplotlib
import numpy as np
from mpi4py import MPI
from particles import NUM_STEPS, RADIUS, TRAVEL, WIDTH, column_of_water, count_pairs, move

import rrcb

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

comm = MPI.COMM_WORLD
COLOURS = np.array(["#B197FF", "#E5D870", "#FF7D70", "#7DA43C"])


def water_after(steps):
    x = column_of_water()
    for _ in range(steps):
        move(x)
    return x


def tank(axes, x, colours, boxes=()):
    """Draws particles in the tank, and the boxes of ranks."""
    axes.scatter(*x.T, s=2, c=colours)
    for lower, upper in boxes:
        lower, upper = np.clip(lower, 0, [WIDTH, 1]), np.clip(upper, 0, [WIDTH, 1])
        axes.add_patch(plt.Rectangle(lower, *(upper - lower), fill=False, linewidth=1))
    axes.set(xlim=(0, WIDTH), ylim=(0, 1), aspect="equal", xlabel="x", ylabel="y")


def saved(folder, number, *draw, size=(9, 3.2)):
    figure, grid = plt.subplots(1, len(draw), figsize=size, squeeze=False)
    for axes, function in zip(grid[0], draw):
        function(axes)
    figure.tight_layout()
    figure.savefig(folder / f"tutorial_figure_{number}.png", dpi=110)
    plt.close(figure)


def strips(steps):
    x = water_after(steps)
    colours = COLOURS[np.minimum((x[:, 0] / WIDTH * 4).astype(int), 3)]
    boxes = [((WIDTH * k / 4, 0), (WIDTH * (k + 1) / 4, 1)) for k in range(4)]
    return lambda axes: (tank(axes, x, colours, boxes), axes.set_title(f"step {steps}"))


def parts(steps, num_parts=4):
    """Returns the parts of all particles by RRCB. Every rank balances its share of the particles.
    """
    x = water_after(steps)[comm.rank :: comm.size]
    balance = rrcb.balance(x, num_parts=num_parts, comm=comm)
    gathered = comm.gather((x, balance.parts))
    if comm.rank > 0:
        return None
    x, number = (np.concatenate(each) for each in zip(*gathered))
    boxes = balance.cuts.boxes()
    return lambda axes: (tank(axes, x, COLOURS[number], boxes),
                         axes.set_title(f"step {steps}, {num_parts} ranks"))


def ghosts_of(rank, steps):
    balance = rrcb.balance(water_after(steps)[comm.rank :: comm.size], comm=comm)
    own = balance.transfer(water_after(steps)[comm.rank :: comm.size])
    near = balance.ghosts(own, cutoff=RADIUS).fetch(own)
    everything, copies = comm.gather(own), comm.gather(near)
    if comm.rank > 0:
        return None
    colours = np.concatenate([np.full(len(x), COLOURS[k]) for k, x in enumerate(everything)])

    def draw(axes):
        tank(axes, np.concatenate(everything), colours, balance.cuts.boxes())
        axes.scatter(*copies[rank].T, s=4, c="black")
        axes.set_title(f"step {steps}: the ghosts of rank {rank}")

    return draw


def history(policy):
    """Returns the imbalance of each step with strips, with a balance in each step, and with the
    controller."""
    own = column_of_water() if comm.rank == 0 else np.empty((0, 2))
    cuts, found, made = None, [], []
    with rrcb.Controller(comm) as controller:
        for step in range(NUM_STEPS):
            everything = np.concatenate(comm.allgather(own))
            if policy == "fixed strips":
                strip = np.minimum((everything[:, 0] / WIDTH * comm.size).astype(int), comm.size - 1)
                own = everything[strip == comm.rank]
            elif cuts is None or policy == "balance in each step" or controller.due:
                balance = rrcb.balance(own, comm=comm, previous=cuts)
                own, cuts = balance.transfer(own), balance.cuts
                neighbours = rrcb.Neighbours(cuts, RADIUS, TRAVEL, comm=comm)
                controller.rebalanced(balance.report, 2000.0)
                made.append(step)
            else:
                own = neighbours.migrate(own, own)
            pairs = count_pairs(own, everything)
            controller.step(pairs)
            found.append(comm.allreduce(pairs, MPI.MAX) * comm.size / comm.allreduce(pairs))
            move(own)
    return found, made


def main():
    folder = Path(sys.argv[1])
    # All ranks take part in these calls.
    middle, end, three, near = parts(0), parts(NUM_STEPS), parts(20, 3), ghosts_of(1, 20)
    four = parts(20)
    lines = {name: history(name) for name in ("fixed strips", "balance in each step", "controller")}
    if comm.rank > 0:
        return

    def draw_lines(axes):
        for (name, (found, made)), style in zip(lines.items(), ("--", ":", "-")):
            axes.plot(found, style, label=name)
            if name == "controller":
                axes.plot(made, np.array(found)[made], "o", color="black", label="rebalance")
        axes.set(xlabel="step", ylabel="busiest rank / mean", ylim=(0.9, None))
        axes.legend()

    def water(steps):
        return lambda axes: (tank(axes, water_after(steps), "#3CA4FF"), axes.set_title(f"step {steps}"))

    saved(folder, 1, water(0), water(NUM_STEPS))
    saved(folder, 2, strips(0), strips(NUM_STEPS))
    saved(folder, 3, middle, end)
    saved(folder, 4, near, size=(5.4, 3.4))
    saved(folder, 5, draw_lines, size=(6, 3.2))
    saved(folder, 6, four, three)


main()
