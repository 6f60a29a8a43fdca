"""The cases that tests/hosts/run runs."""

from __future__ import annotations

from lammps import LAMMPS_CASES
from python_hosts import PYTHON_CASES
from result import Case
from zoltan_hosts import ZOLTAN_CASES

CASES: list[Case] = [*LAMMPS_CASES, *PYTHON_CASES, *ZOLTAN_CASES]
