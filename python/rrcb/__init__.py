"""Parallel load balancing of particles by reduced recursive coordinate bisection.

    balance = rrcb.balance(x, comm=comm)
    data = balance.transfer({"x": x, "mass": mass})
    ghosts = balance.ghosts(data["x"], cutoff=0.1)
    x_of_ghosts = ghosts.fetch_positions(data["x"])

The calls are collective over the communicator. An error raises the same rrcb.Error on every rank.
"""

from . import _library, experimental as experimental
from ._balance import Balance, Distribution, Plan, Report, assign, balance, balanced_sizes, plan
from ._controller import Controller
from ._cuts import Cuts
from ._ghosts import Ghosts
from ._groups import Groups, groups
from ._library import Error
from ._neighbours import Neighbours

__all__ = [
    "Balance",
    "Controller",
    "Cuts",
    "Distribution",
    "Error",
    "Ghosts",
    "Groups",
    "Neighbours",
    "Plan",
    "Report",
    "assign",
    "balance",
    "balanced_sizes",
    "build_info",
    "groups",
    "plan",
]
__version__: str = _library.text(_library.library.rrcb_version())


def build_info() -> str:
    """Returns version, commit, compiler and MPI of the library."""
    return _library.text(_library.library.rrcb_build_info())
