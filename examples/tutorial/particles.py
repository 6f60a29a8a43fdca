"""A column of water that collapses: positions of particles, a flow, and pairs within a radius."""
import numpy as np

NUM_STEPS = 40
RADIUS = 0.045
TRAVEL = 0.05  # more than a particle moves in a step
WIDTH = 1.5  # of the tank, from x = 0


def column_of_water():
    """Returns the positions of 30 x 60 particles in the left part of the tank, one row each."""
    i, j = np.meshgrid(np.arange(30), np.arange(60), indexing="ij")
    return np.stack([(i.ravel() + 0.5) / 60, (j.ravel() + 0.5) / 60], axis=1)


def move(x):
    """Moves the particles for a step: down, and to the right."""
    x *= [1.025, 0.975]


def count_pairs(own, everything):
    """Counts for each of `own` the particles of `everything` within the radius.

    This stands for the forces of a real code. A particle in both meets itself.
    """
    dx = own[:, None, 0] - everything[None, :, 0]
    dy = own[:, None, 1] - everything[None, :, 1]
    return float(np.count_nonzero(dx * dx + dy * dy <= RADIUS * RADIUS))
