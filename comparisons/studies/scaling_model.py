"""What a call moves, by formula, for any number of ranks; 2-D, points scattered over the ranks.

Every formula gives the calls and bytes by MPI function that the driver counts (see README.md): a
collective of n ranks is n calls, with the bytes each rank hands in and gets out. What the
library's messages are made of stands in message_sizes.csv, how many of them are fixed is read off a
run on two ranks; what depends on the points is an input of the run that is predicted: rounds,
partners, points moved.
"""

from __future__ import annotations

from math import ceil, isqrt
from typing import NamedTuple

DIMENSION = 2
MESH = 4
RADIX = 8
MOST_CELLS = 8192
LOOKS = {"none": 0, "accepted": 1, "refined": 2, "exact": 1}  # at what the parts weigh
MOST_PLACES = 4096  # ranks that hand them up
HEAD = 40  # of a message of records: length and flags
RECORD_HEAD = 16
HISTOGRAM = RECORD_HEAD + 8 * (1 + 7 + 2 * 66)  # 64 bins and two slots beside them
OVERLAP = RECORD_HEAD + 16  # of a rank and a part
ANSWER = RECORD_HEAD + 112  # the state of a search and the weight of its node


class Count(NamedTuple):
    calls: int = 0
    sent: int = 0  # bytes that ranks hand in
    got: int = 0  # bytes that ranks get out


class Traffic(dict[str, Count]):
    """Counts by MPI function, over all ranks; of a function that is not there they are 0."""

    def __missing__(self, function: str) -> Count:
        return Count()

    def add(self, function: str, calls: int, sent: int, got: int = 0) -> None:
        self[function] = Count(*map(sum, zip(self[function], (calls, sent, got))))

    def allreduce(self, ranks: int, size: int, times: int = 1) -> None:
        self.add("Allreduce", times * ranks, times * ranks * size, times * ranks * size)

    def reduce(self, ranks: int, size: int) -> None:
        self.add("Reduce", ranks, ranks * size, size)

    def broadcast(self, ranks: int, size: int) -> None:
        self.add("Bcast", ranks, size, (ranks - 1) * size)

    def scatter(self, ranks: int, size: int) -> None:
        self.add("Scatter", ranks, ranks * size, ranks * size)

    @property
    def messages(self) -> int:
        return sum(of.calls for name, of in self.items() if not name.startswith("Comm_"))

    @property
    def bytes(self) -> int:
        return sum(of.sent + of.got for of in self.values())


# --- RRCB ---------------------------------------------------------------------------------------


class Parts(NamedTuple):
    """The bytes of message_sizes.csv, where README.md defines them."""

    agreement: int
    cut: int
    bracket: int
    head: int
    verdict: int
    summary: int
    mesh: int
    cell: int
    place: int
    part_weight: int


class Sizes(NamedTuple):
    """Bytes of RRCB's fixed messages."""

    parts: Parts
    agreements: int  # all reductions to everybody together
    num_agreements: int
    broadcasts: int  # all broadcasts together, but for what grows with the parts, head included
    num_broadcasts: int


class Rounds(NamedTuple):
    """What the refinement did: nothing where the estimate was accepted or none was asked for."""

    rounds: int = 0  # of the search: records to rank 0, and answers back
    record_bytes: int = 0  # of them, and of the overlaps by which the plug-in numbers parts
    corrections: int = 0  # of all cuts at once, before the search
    answer_bytes: int = 0  # broadcast by them
    bin_bytes: int = 0  # of a rank, reduced by them


def children(rank: int, ranks: int) -> list[int]:
    """Ranks that send to `rank` in the tree of radix 8."""
    found, stride = [], 1
    while stride < ranks and rank % (stride * RADIX) == 0:
        found += range(rank + stride, min(ranks, rank + stride * RADIX), stride)
        stride *= RADIX
    return found


def subtree(rank: int, ranks: int) -> int:
    """Ranks whose cells pass through `rank` (> 0) on their way up."""
    stride = 1
    while rank % (stride * RADIX) == 0:
        stride *= RADIX
    return min(stride, ranks - rank)


def all_agreements(sizes: Sizes, refine: str) -> tuple[int, int]:
    """Number and bytes; a look at the parts tells of failures as well."""
    number, size = sizes.num_agreements, sizes.agreements
    if LOOKS[refine]:
        return number - 1, size - sizes.parts.agreement
    return number, size


def look_bytes(ranks: int, parts: Parts) -> int:
    """Weights of the parts, and whether the rank has failed."""
    return parts.part_weight * ranks + parts.agreement


def answer_bytes(ranks: int, parts: Parts) -> int:
    """The same of all ranks, and the imbalance."""
    return look_bytes(ranks, parts) + 8


def beyond_head(ranks: int, refine: str, parts: Parts) -> int:
    """Bytes of cuts and brackets that the head has no room for and a second broadcast takes."""
    cut = parts.cut + (0 if refine == "none" else parts.bracket)
    return max(0, cut * (ranks - 1) - (parts.head - parts.verdict))


def place_bytes(ranks: int, refine: str, parts: Parts) -> int:
    """Where a rank's points lie, by which the root may find that they are well where they are."""
    return parts.place if ranks <= MOST_PLACES and refine != "exact" else 0


def hand_up_bytes(ranks: int, refine: str, parts: Parts) -> int:
    """What a rank adds to what passes through the ranks above it."""
    return parts.mesh + MESH**DIMENSION * parts.cell + place_bytes(ranks, refine, parts)


def rrcb(ranks: int, sizes: Sizes, refine: str, rounds: Rounds = Rounds()) -> Traffic:
    """`refine`: none, accepted (one look at the estimate), refined (and one at the end), or exact."""
    traffic = Traffic()
    num_agreements, agreements = all_agreements(sizes, refine)
    traffic.add("Allreduce", ranks * num_agreements, ranks * agreements, ranks * agreements)
    once = sizes.broadcasts + 8 * ranks
    traffic.add("Bcast", ranks * sizes.num_broadcasts, once, (ranks - 1) * once)
    if rest := beyond_head(ranks, refine, sizes.parts):
        traffic.broadcast(ranks, rest)
    mine = hand_up_bytes(ranks, refine, sizes.parts)
    for rank in range(1, ranks):
        traffic.add("Send", 2, sizes.parts.summary + subtree(rank, ranks) * mine)
    for _ in range(LOOKS[refine]):
        traffic.reduce(ranks, look_bytes(ranks, sizes.parts))
        traffic.broadcast(ranks, answer_bytes(ranks, sizes.parts))
    _add_passes(traffic, ranks, rounds)
    return traffic


def _add_passes(traffic: Traffic, ranks: int, rounds: Rounds) -> None:
    answers, bins = rounds.answer_bytes, rounds.bin_bytes
    traffic.add("Bcast", ranks * rounds.corrections, answers, (ranks - 1) * answers)
    traffic.add("Reduce", ranks * rounds.corrections, ranks * bins, bins)
    messages = (ranks - 1) * (1 + 2 * rounds.rounds)
    traffic.add("Isend", messages, HEAD * messages + rounds.record_bytes)


# --- Zoltan's RCB -------------------------------------------------------------------------------

POINT_FIELDS, POINT_BYTES = 7, 36  # two of 8 bytes and five of 4, a message to a partner each
LIST_FIELDS, LIST_BYTES = 3, 12
MEDIAN = 72


class Exchange(NamedTuple):
    """What depends on the points in a call of Zoltan's RCB."""

    iterations: int  # of the median search, each counted on every rank of its set
    returned: bool  # points went to the ranks that the renumbered parts got
    plan_messages: int  # (rank, partner) pairs over all plans
    field_messages: int
    field_bytes: int
    overlap_bytes: int  # weights shared between old and new parts, 12 bytes a pair, from all ranks


def sets(ranks: int) -> list[int]:
    """Numbers of ranks that search for a median together, over all levels."""
    return [ranks, *sets(ranks // 2), *sets(ranks - ranks // 2)] if ranks > 1 else []


def _plan(traffic: Traffic, ranks: int, fields: int) -> None:
    traffic.allreduce(ranks, 4, 1 + fields)
    traffic.reduce(ranks, 4 * ranks)
    traffic.scatter(ranks, 4)
    traffic.broadcast(ranks, 4)


def zoltan_rcb(ranks: int, exchange: Exchange) -> Traffic:
    traffic = Traffic()
    for size in (12, 24, 4, 4, 4, 8, 4, 48):
        traffic.allreduce(ranks, size)
    traffic.broadcast(ranks, 4)
    traffic.add("Barrier", ranks, 0)
    traffic.add("Comm_dup", ranks, 0)
    for together in sets(ranks):
        traffic.allreduce(together, 4)
        traffic.allreduce(together, 24 * together)
        _plan(traffic, together, POINT_FIELDS)
        traffic.add("Comm_split", together, 0)
    traffic.allreduce(1, MEDIAN, exchange.iterations)
    traffic.allreduce(ranks, 8)
    traffic.allreduce(ranks, 8 + 8 * ranks)
    traffic.add("Allgather", ranks, 4 * ranks, 4 * ranks * ranks)
    traffic.add("Allgatherv", ranks, exchange.overlap_bytes, exchange.overlap_bytes * ranks)
    if exchange.returned:
        _plan(traffic, ranks, POINT_FIELDS)
    for size in (4, 8, 20):
        traffic.allreduce(ranks, size)
    _plan(traffic, ranks, LIST_FIELDS)
    traffic.add("Send", exchange.plan_messages, 4 * exchange.plan_messages)
    traffic.add("Rsend", exchange.field_messages, exchange.field_bytes)
    return traffic


# --- Zoltan2's multijagged ----------------------------------------------------------------------


def sections(ranks: int) -> list[int]:
    """Parts of each section along the first axis; one part each on up to two ranks."""
    number = isqrt(ranks - 1) + 1
    return [ranks // number + (section < ranks % number) for section in range(number)]


def step_bytes(parts: int) -> int:
    """Of a step of the search for the cuts between `parts`."""
    return 8 * (4 * (parts - 1) + 1)


def multijagged(ranks: int, iterations: dict[int, int]) -> Traffic:
    """`iterations`: steps by the number of parts that are cut apart."""
    traffic = Traffic()
    for size in (8, 8, 32, 8, 24, 4, 4):
        traffic.allreduce(ranks, size)
    traffic.add("Comm_dup", ranks, 0)
    if ranks > 2:
        traffic.allreduce(ranks, 8 * (ranks + 1) * len(sections(ranks)))
        traffic.allreduce(ranks, 24, sum(parts > 1 for parts in sections(ranks)))
    for parts, times in iterations.items():
        traffic.allreduce(ranks, step_bytes(parts), times)
    return traffic


def expected_iterations(ranks: int, steps: float) -> dict[int, int]:
    number = len(sections(ranks))
    found = {number: ceil(steps)}
    for parts in sections(ranks) if ranks > 2 else []:
        if parts > 1:
            found[parts] = found.get(parts, 0) + ceil(steps)
    return found
