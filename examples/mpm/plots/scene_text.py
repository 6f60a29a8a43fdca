"""Reads numbers from the text of a scene file."""

from __future__ import annotations

import re

NUMBER = r"[-+0-9.eE]+"


def number_in(scene: str, key: str) -> float:
    return float(re.search(rf"^ +{key}: (\S+)$", scene, re.M)[1])


def list_in(scene: str, key: str) -> list[float]:
    """Returns a list that is on one line. Rows follow one another."""
    return [float(x) for x in re.findall(NUMBER, re.search(rf"^ +{key}: (.*)$", scene, re.M)[1])]
