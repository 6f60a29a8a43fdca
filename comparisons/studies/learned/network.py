"""A perceptron from the moments of 3 x 3 cells to a prior on the sub-cells of the middle one."""

from __future__ import annotations

import numpy as np
from cells import SUB, turned, turned_histogram
from tilt import tilted

Array = np.ndarray

HIDDEN = (64, 64)
BATCH = 1024
RATE = 1.5e-3
DECAY = (0.9, 0.999)
PULL_TO_EVEN = 1e-3  # prior exponents that nothing speaks for stay 0
FOUND = 1e-3  # a tilt that is farther off has not come to its end and says nothing
NUM_SYMMETRIES = 8


class Network:
    """Layers of exponents; the inner ones cut off below 0."""

    def __init__(self, sizes: list[int], random: np.random.Generator) -> None:
        pairs = list(zip(sizes, sizes[1:]))
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

    def parameters(self) -> list[Array]:
        return self.weights + self.offsets


def cross_entropy(shares: Array, truth: Array) -> float:
    return float(-(truth * np.log(np.maximum(shares, 1e-12))).sum(axis=1).mean())


def train(
    inputs: Array, shares: Array, moments: Array, epochs: int, seed: int, say=print
) -> Network:
    """The network whose tilted priors make the shares most likely: stochastic gradients, Adam.

    The tilt maximises that likelihood over its own exponents, so that its gradient by those of the
    prior is what is left: tilted shares - true shares.
    """
    random = np.random.default_rng(seed)
    network = Network([inputs.shape[1], *HIDDEN, SUB**2], random)
    parameters = network.parameters()
    first = [np.zeros_like(p) for p in parameters]
    second = [np.zeros_like(p) for p in parameters]
    num_batches = len(inputs) // BATCH
    num_steps = epochs * num_batches
    step = 0
    for epoch in range(epochs):
        x, truth, aims = mirrored(inputs, shares, moments, epoch % NUM_SYMMETRIES)
        order = random.permutation(len(x))
        loss = 0.0
        for batch in np.split(order[: num_batches * BATCH], num_batches):
            prior = network(x[batch])
            found, off = tilted(prior, aims[batch], rounds=6)
            loss += cross_entropy(found, truth[batch]) / num_batches
            misfit = np.where(off[:, None] < FOUND, found - truth[batch], 0)
            slopes = network.gradients((misfit + PULL_TO_EVEN * prior) / BATCH)
            step += 1
            rate = RATE * min(1, step / 200) * (1 + np.cos(np.pi * step / num_steps)) / 2
            for p, m, v, slope in zip(parameters, first, second, slopes):
                m += (1 - DECAY[0]) * (slope - m)
                v += (1 - DECAY[1]) * (slope**2 - v)
                scale = np.sqrt(v / (1 - DECAY[1] ** step)) + 1e-8
                p -= rate * m / (1 - DECAY[0] ** step) / scale
        say(f"epoch {epoch + 1}: {loss:.5f}")
    return network


def mirrored(
    inputs: Array, shares: Array, moments: Array, symmetry: int
) -> tuple[Array, Array, Array]:
    """The cells of the mirrored clouds: bits of `symmetry` for each axis and for their exchange."""
    flip = (bool(symmetry & 1), bool(symmetry & 2))
    exchange = bool(symmetry & 4)
    shares = turned_histogram(shares.reshape(-1, SUB, SUB), exchange, flip).reshape(-1, SUB**2)
    moments = moments * np.array([-1 if flip[0] else 1, -1 if flip[1] else 1, 1, 1])
    return turned(inputs, exchange, flip), shares, moments[:, [1, 0, 3, 2] if exchange else slice(4)]
