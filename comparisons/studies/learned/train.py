"""Learns a prior of how points lie in a cell from the moments of 3 x 3 cells, and prints how well it
describes the cells of other clouds: its cross-entropy, and that of an even prior."""

from __future__ import annotations

import argparse
import sys

import numpy as np
from network import cross_entropy, train
from samples import sample_cells
from tilt import tilted

TRAINING_SEED, TEST_SEED = 1, 2


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--clouds", type=int, default=2000)
    options.add_argument("--epochs", type=int, default=16)
    arguments = options.parse_args()
    inputs, shares, moments = sample_cells(TRAINING_SEED, arguments.clouds)
    say(f"{len(inputs)} cells of {arguments.clouds} clouds")
    network = train(inputs, shares, moments, arguments.epochs, TRAINING_SEED, say)
    inputs_2, shares_2, moments_2 = sample_cells(TEST_SEED, max(1, arguments.clouds // 10))
    found = cross_entropy(tilted(network(inputs_2), moments_2)[0], shares_2)
    even = cross_entropy(tilted(np.zeros_like(shares_2), moments_2)[0], shares_2)
    print(f"cross-entropy {found:.5f}, with an even prior {even:.5f}: {len(inputs_2)} other cells")


def say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
