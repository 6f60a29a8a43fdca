"""A case of a host, and what a run of it gives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path


class Failed(Exception):
    """The program fails, or its results differ."""


@dataclass
class Result:
    seconds: float
    balancing: float | None = None  # seconds in the balancer, all calls
    moved: float | None = None  # percent of the points, mean of the calls
    ghosts: float | None = None  # mean of the ranks, at the end
    answer: dict[str, float] = field(default_factory=dict)


@dataclass
class Case:
    name: str
    title: str
    packages: list[str]  # of Debian; the version of the first is told
    targets: list[str]  # of the build
    launch: Callable[[int, bool, Path], Result]  # ranks, with RRCB, a folder to write to
    compare: Callable[[Result, Result], str]  # raises Failed if the results differ
