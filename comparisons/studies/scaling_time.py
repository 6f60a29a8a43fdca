"""How long a call takes on any number of ranks, reckoned from the counts of scaling_model.py.

time = latency * messages one after the other + bytes / bandwidth + counted work. A broadcast,
reduction or gather takes ceil(log2 ranks) messages one after the other and its bytes once, a
reduction to everybody its bytes twice. Work is counted in points and cells at stated costs each.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

import pandas as pd

import scaling_model as model
import scaling_wide as wide
from scaling_check import EXACT, JAGGED, ZOLTAN, Counted, read_exchange, read_rounds
from scaling_model import Sizes


@dataclass(frozen=True)
class Machine:
    """Network, points and what the work of one of them takes; s, bytes/s."""

    latency: float = 1.5e-6
    bandwidth: float = 12e9
    points: int = 50_000  # per rank
    partners: int = 4  # ranks that one exchanges points with, parts that old points lie in
    per_point: float = 20e-9  # moments and assignment
    per_look: float = 2e-9  # of the median search at a point
    per_cell: float = 50e-9  # merging, or splitting at a level of the bisection


@dataclass
class CallPath:
    """What is done one after the other."""

    machine: Machine
    messages: float = 0
    bytes: float = 0
    work: float = 0  # s
    root_bytes: float = 0

    def collective(self, ranks: int, size: float, times: float = 1, into_root: float = 0) -> None:
        self.messages += times * (ranks - 1).bit_length()
        self.bytes += times * size
        self.root_bytes += times * into_root

    @property
    def seconds(self) -> float:
        network = self.messages * self.machine.latency + self.bytes / self.machine.bandwidth
        return network + self.work


@dataclass(frozen=True)
class Searches:
    """The search below the regions on virtual ranks, with points sorted over them."""

    rounds_per_level: float
    bytes_per_step: float  # in the longest message of each, on the average
    most_into_rank: int  # bytes in a round


@dataclass(frozen=True)
class Observed:
    """What the points decide, from the runs here."""

    sizes: Sizes
    rounds_per_level: int
    bytes_per_cut: float  # of the records that a rank sends and gets in an exact search
    iterations: float  # of the median search in a set of Zoltan's RCB
    steps: float  # of the search of multijagged in a section
    to_tolerance: Searches | None = None
    exact: Searches | None = None


def observe(
    counted: dict[tuple[str, int], Counted], sizes: Sizes, virtual: pd.DataFrame
) -> Observed:
    """Largest rounds, mean of the iterations, over the numbers of ranks that were run."""
    exact, zoltan, jagged = (
        [row for row in counted.values() if row.method == method and row.ranks > least]
        for method, least in ((EXACT, 1), (ZOLTAN, 1), (JAGGED, 2))
    )
    refined = [(row.ranks - 1, read_rounds(row, sizes)) for row in exact]
    return Observed(
        sizes,
        max(ceil(of.rounds / cuts.bit_length()) for cuts, of in refined),
        max(of.record_bytes / cuts**2 for cuts, of in refined),
        _mean([read_exchange(row).iterations / sum(model.sets(row.ranks)) for row in zoltan]),
        _mean([_steps(row) for row in jagged]),
        _searches(virtual, is_exact=False),
        _searches(virtual, is_exact=True),
    )


def _searches(virtual: pd.DataFrame, is_exact: bool) -> Searches | None:
    """The most of any number of ranks whose points lie where their parts do."""
    if virtual.empty:
        return None
    asked = (virtual["tolerance"] == 1) == is_exact
    rows = virtual[asked & (virtual["layout"] == "by_part")]
    if rows.empty:
        return None
    levels = rows["ranks"].map(lambda ranks: wide.levels_below(1 if is_exact else 64, ranks))
    steps = rows["ranks"].map(lambda ranks: 2 * (ranks - 1).bit_length())
    return Searches(
        (rows["rounds"] / levels).max(),
        (rows["bytes_in_a_row"] / (rows["rounds"] * steps)).max(),
        int(rows["most_into_rank"].max()),
    )


def _mean(values: list[float]) -> float:
    return sum(values) / len(values) if values else 0.0


def _steps(row: Counted) -> float:
    sections = sum(model.expected_iterations(row.ranks, 1).values())
    return (row.traffic["Allreduce"].calls / row.ranks - 7 - sections) / sections


def rrcb_path(ranks: int, refine: str, observed: Observed, machine: Machine) -> CallPath:
    sizes = observed.sizes
    path = CallPath(machine, work=machine.points * machine.per_point)
    num_agreements, agreements = model.all_agreements(sizes, refine)
    per_agreement = agreements / num_agreements
    path.collective(ranks, 2 * per_agreement, num_agreements, per_agreement)
    _number_parts(path, ranks)
    rest = model.beyond_head(ranks, refine, sizes.parts)
    path.collective(ranks, 0, sizes.num_broadcasts + (rest > 0))
    path.bytes += sizes.broadcasts + 8 * ranks + rest
    _climb(path, ranks, sizes, model.place_bytes(ranks, refine, sizes.parts))
    cells = min(model.MOST_CELLS, ranks * model.MESH**model.DIMENSION)
    path.work += (cells * (ranks - 1).bit_length() + ranks) * machine.per_cell
    looks = model.LOOKS[refine]
    look = model.look_bytes(ranks, sizes.parts)
    path.collective(ranks, look, looks, look)
    path.collective(ranks, model.answer_bytes(ranks, sizes.parts), looks)
    if refine == "refined":
        levels = (ranks - 1).bit_length()
        _refine(path, ranks, levels, model.HISTOGRAM + model.ANSWER)
    if refine == "exact":
        rounds = observed.rounds_per_level * (ranks - 1).bit_length()
        _refine(path, ranks, rounds, observed.bytes_per_cut)
    return path


def wide_path(ranks: int, is_exact: bool, observed: Observed, machine: Machine) -> CallPath:
    """Parts made by many ranks where there are more than one makes alone, without the plug-in."""
    searches = observed.exact if is_exact else observed.to_tolerance
    parts, regions = observed.sizes.parts, 1 if is_exact else wide.REGIONS
    path = CallPath(machine, work=machine.points * machine.per_point)
    _climb(path, ranks, observed.sizes, 0, wide.MOST_CELLS)
    path.work += 2 * wide.MOST_CELLS * (regions - 1).bit_length() * machine.per_cell
    cuts = (regions - 1) * (parts.cut + parts.bracket)
    path.collective(ranks, parts.head)
    path.collective(ranks, cuts, cuts > parts.head - parts.verdict)
    if not is_exact:
        look = model.look_bytes(regions, parts)
        path.collective(ranks, look, 1, look)
        path.collective(ranks, model.answer_bytes(regions, parts))
    for size in (wide.BOX, wide.COUNT, parts.agreement, parts.agreement)[: 4 if is_exact else 3]:
        path.collective(ranks, 2 * size, 1, size)
    levels = wide.levels_below(regions, ranks)
    rounds, steps = ceil(searches.rounds_per_level * levels), (ranks - 1).bit_length()
    path.messages += (2 * rounds + 1) * steps
    if not is_exact:
        # The places of the ranks; in each step a record for each cut above that is open.
        records = steps * (steps + 1) // 2
        path.messages += 2 * steps
        path.bytes += records * (wide.PLACES + wide.CUT)
        path.root_bytes += records * wide.PLACES
    path.bytes += 2 * rounds * steps * searches.bytes_per_step
    path.root_bytes += rounds * searches.most_into_rank
    path.work += levels * machine.points * machine.per_look
    return path


def _climb(
    path: CallPath, ranks: int, sizes: Sizes, place: int, most_cells: int = model.MOST_CELLS
) -> None:
    """Up the tree of radix 8, at each level seven children one after the other."""
    below = 1
    while below < ranks:
        num_children = min(model.RADIX - 1, ceil(ranks / below) - 1)
        cells = min(most_cells, below * model.MESH**model.DIMENSION)
        records = cells * sizes.parts.cell + below * place
        size = sizes.parts.summary + records
        pieces = 1 + ceil(records / 65536)
        path.messages += num_children * pieces
        path.bytes += num_children * size
        path.root_bytes += num_children * size
        path.work += num_children * cells * path.machine.per_cell
        below *= model.RADIX


def _number_parts(path: CallPath, ranks: int) -> None:
    """Overlaps of scattered points to rank 0, which numbers the parts."""
    overlaps = ranks * min(ranks, 16 + 65536 // ranks)
    path.messages += (ranks - 1).bit_length()
    path.bytes += overlaps * model.OVERLAP
    path.root_bytes += overlaps * model.OVERLAP


def _refine(path: CallPath, ranks: int, rounds: int, bytes_per_cut: float) -> None:
    """Passes to rank 0 and back; every message of a pass is as long, as ranks have points anywhere."""
    levels = (ranks - 1).bit_length()
    size = levels * (ranks - 1) * bytes_per_cut
    path.messages += 2 * rounds * levels
    path.bytes += size + 2 * rounds * levels * model.HEAD
    path.root_bytes += size
    path.work += levels * path.machine.points * path.machine.per_look


def zoltan_path(ranks: int, observed: Observed, machine: Machine) -> CallPath:
    path = CallPath(machine)
    path.collective(ranks, 16, 11, 8)
    together = ranks
    while together > 1:
        path.collective(together, 2 * model.MEDIAN, observed.iterations, model.MEDIAN)
        path.collective(together, 2 * 24 * together, 1, 24 * together)
        path.collective(together, 8 * together)  # the communicator is split: who is where
        _exchange(path, together, 1, model.POINT_FIELDS, model.POINT_BYTES / 2)
        path.work += machine.points * observed.iterations * machine.per_look
        path.work += machine.points * machine.per_point / 2
        together = ceil(together / 2)
    path.collective(ranks, 2 * (8 + 8 * ranks), 1, 8 + 8 * ranks)
    path.collective(ranks, 4 * ranks, 1, 4 * ranks)
    overlaps = 12 * machine.partners * ranks
    path.collective(ranks, overlaps, 1, overlaps)
    _exchange(path, ranks, 1, model.POINT_FIELDS, model.POINT_BYTES)
    path.collective(ranks, 22, 3, 11)
    _exchange(path, ranks, machine.partners, model.LIST_FIELDS, model.LIST_BYTES)
    return path


def _exchange(path: CallPath, ranks: int, partners: int, fields: int, point_bytes: float) -> None:
    """A plan and a message of each field to each partner."""
    path.collective(ranks, 8, 2 + fields, 4)
    path.collective(ranks, 4 * ranks, 2, 4 * ranks)
    path.messages += partners * (1 + fields)
    path.bytes += path.machine.points * point_bytes
    path.root_bytes += path.machine.points * point_bytes


def jagged_path(ranks: int, observed: Observed, machine: Machine) -> CallPath:
    path = CallPath(machine)
    path.collective(ranks, 16, 7, 8)
    sections = model.expected_iterations(ranks, observed.steps)
    for parts, times in sections.items():
        path.collective(ranks, 2 * model.step_bytes(parts), times, model.step_bytes(parts))
    number = max(1, ceil(ranks**0.5))
    path.collective(ranks, 2 * 8 * (ranks + 1) * number, 1, 8 * (ranks + 1) * number)
    path.collective(ranks, 48, number, 24)
    path.work += 2 * machine.points * (observed.steps * machine.per_look + machine.per_point)
    return path


def all_paths(ranks: int, observed: Observed, machine: Machine) -> dict[str, CallPath]:
    found = {
        "rrcb, estimate alone": rrcb_path(ranks, "none", observed, machine),
        "rrcb, estimate accepted": rrcb_path(ranks, "accepted", observed, machine),
        "rrcb, refined": rrcb_path(ranks, "refined", observed, machine),
        "rrcb-exact": rrcb_path(ranks, "exact", observed, machine),
    }
    if ranks > wide.REGIONS and observed.to_tolerance and observed.exact:
        found["rrcb by many, accepted"] = wide_path(ranks, False, observed, machine)
        found["rrcb by many, exact"] = wide_path(ranks, True, observed, machine)
    if observed.iterations:
        found["zoltan-rcb"] = zoltan_path(ranks, observed, machine)
    if observed.steps:
        found["zoltan2-mj"] = jagged_path(ranks, observed, machine)
    return found
