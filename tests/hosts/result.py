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
    notes: dict[str, float] = field(default_factory=dict)  # may differ


@dataclass
class Case:
    name: str
    title: str
    packages: list[str]  # of Debian
    targets: list[str]  # of the build
    launch: Callable[[int, bool, Path], Result]  # ranks, with RRCB, a folder to write to
    compare: Callable[[Result, Result], str]  # raises Failed if the results differ
    build: Callable[[], str] = lambda: ""  # returns why it cannot be built, or nothing
    version: str = ""  # default: of the first package
