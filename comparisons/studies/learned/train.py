"""Learns a prior of how points lie in a cell from the moments of 3 x 3 cells, and prints how well it
describes the cells of other clouds: its cross-entropy, and that of an even prior."""

from __future__ import annotations

import argparse
import sys

import numpy as np
from cells import FOUND, NUM_INPUTS, SUB, sample_cells, tilted
from clouds import Array

TRAINING_SEED, TEST_SEED = 1, 2
SIZES = (NUM_INPUTS, 64, 64, SUB**2)
BATCH = 1024
RATE, DECAY = 1.5e-3, (0.9, 0.999)
PULL_TO_EVEN = 1e-3  # prior exponents that nothing speaks for stay 0


class Network:
    """Layers of exponents; the inner ones cut off below 0."""

    def __init__(self, random: np.random.Generator) -> None:
        pairs = list(zip(SIZES, SIZES[1:]))
        self.weights = [random.normal(0, np.sqrt(2 / a), (a, b)) for a, b in pairs]
        self.weights[-1] *= 0.1
        self.offsets = [np.zeros(b) for _, b in pairs]
        self._values: list[Array] = []

    def __call__(self, inputs: Array) -> Array:
        self._values = [inputs]
        last = len(self.weights) - 1
        for k, (weights, offsets) in enumerate(zip(self.weights, self.offsets)):
            sums = self._values[-1] @ weights + offsets
            self._values.append(np.maximum(sums, 0) if k < last else sums)
        return self._values[-1]

    def gradients(self, of_result: Array) -> list[Array]:
        """Of weights, then offsets, for the inputs of the last call."""
        of_weights, of_offsets = [], []
        for k in reversed(range(len(self.weights))):
            of_weights.append(self._values[k].T @ of_result)
            of_offsets.append(of_result.sum(axis=0))
            of_result = (of_result @ self.weights[k].T) * (self._values[k] > 0)
        return of_weights[::-1] + of_offsets[::-1]


def cross_entropy(shares: Array, truth: Array) -> float:
    return float(-(truth * np.log(np.maximum(shares, 1e-12))).sum(axis=1).mean())


def train(inputs: Array, shares: Array, target: Array, epochs: int, seed: int) -> Network:
    """The network whose tilted priors make the shares most likely: stochastic gradients, Adam.

    The tilt maximises that likelihood over its own exponents, so that its gradient by those of the
    prior is what is left: tilted shares - true shares.
    """
    random = np.random.default_rng(seed)
    network = Network(random)
    parameters = network.weights + network.offsets
    first, second = ([np.zeros_like(p) for p in parameters] for _ in range(2))
    num_batches = len(inputs) // BATCH
    step = 0
    for epoch in range(epochs):
        order = random.permutation(len(inputs))
        loss = 0.0
        for batch in np.split(order[: num_batches * BATCH], num_batches):
            prior = network(inputs[batch])
            found, off = tilted(prior, target[batch], rounds=6)
            loss += cross_entropy(found, shares[batch]) / num_batches
            misfit = np.where(off[:, None] < FOUND, found - shares[batch], 0)
            slopes = network.gradients((misfit + PULL_TO_EVEN * prior) / BATCH)
            step += 1
            rate = RATE * min(1, step / 200) * (1 + np.cos(np.pi * step / (epochs * num_batches))) / 2
            for p, m, v, slope in zip(parameters, first, second, slopes):
                m += (1 - DECAY[0]) * (slope - m)
                v += (1 - DECAY[1]) * (slope**2 - v)
                scale = np.sqrt(v / (1 - DECAY[1] ** step)) + 1e-8
                p -= rate * m / (1 - DECAY[0] ** step) / scale
        print(f"epoch {epoch + 1}: {loss:.5f}", file=sys.stderr, flush=True)
    return network


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--clouds", type=int, default=2000)
    options.add_argument("--epochs", type=int, default=16)
    arguments = options.parse_args()
    cells = sample_cells(TRAINING_SEED, arguments.clouds)
    print(f"{len(cells[0])} cells of {arguments.clouds} clouds", file=sys.stderr, flush=True)
    network = train(*cells, arguments.epochs, TRAINING_SEED)
    inputs, shares, target = sample_cells(TEST_SEED, max(1, arguments.clouds // 10))
    found = cross_entropy(tilted(network(inputs), target)[0], shares)
    even = cross_entropy(tilted(np.zeros_like(shares), target)[0], shares)
    print(f"cross-entropy {found:.5f}, with an even prior {even:.5f}: {len(inputs)} other cells")


if __name__ == "__main__":
    main()
