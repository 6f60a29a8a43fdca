"""Reads parameters from the names of methods."""

from __future__ import annotations

import re

RCB = "root-rcb"  # the paper's
STANDARD = "rrcb-sampled[mesh=4,k=1.5,fraction=1]"  # the paper's RRCB
WINNERS = (  # the settings with which it was faster than RCB in the paper
    "rrcb-sampled[mesh=2,k=1.5,fraction=0.25]",
    "rrcb-sampled[mesh=4,k=2,fraction=0.125]",
    "rrcb-sampled[mesh=6,k=2,fraction=0.125]",
    "rrcb-sampled[mesh=8,k=2,fraction=0.125]",
)


def parse(method: str) -> tuple[str, dict[str, str]]:
    name, _, inside = method.partition("[")
    return name, dict(re.findall(r"(\w+)=([^,\]]+)", inside))


def setting_of(method: str) -> tuple[float, ...]:
    """Returns the mesh, multiplier k and fraction of the paper's grid; empty for other methods."""
    name, parameters = parse(method)
    is_setting = name == "rrcb-sampled" and list(parameters) == ["mesh", "k", "fraction"]
    return tuple(map(float, parameters.values())) if is_setting else ()
