"""The cases that tests/hosts/run runs."""

from __future__ import annotations

from lammps import LAMMPS_CASES
from pysph import PYSPH_CASES
from python_hosts import PYTHON_CASES
from result import Case

CASES: list[Case] = [*LAMMPS_CASES, *PYTHON_CASES, *PYSPH_CASES]
