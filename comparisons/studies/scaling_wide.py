"""What a call moves where many ranks make the parts (Tuning::central_parts), by formula; each rank
gets its own cuts (HeldCuts::own).

Records travel to the owners of cuts, and answers back, along a butterfly of ranks: in each step a
rank sends one message, of a head and of the records whose owners lie in the other half. Where every
rank has points in every node, each rank but the owner sends the record of a node once.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import scaling_model as model
from scaling_model import HEAD, HISTOGRAM, RECORD_HEAD, Parts, Traffic

REGIONS = 64  # at most
MOST_CELLS = 224  # that are handed on up the tree; coarsened to 112 beyond
ANSWER = model.ANSWER + 48  # the box of the node as well
PLACES = RECORD_HEAD + 8 * 2 * (model.DIMENSION + model.DIMENSION**2)  # below a cut and above it
CUT = RECORD_HEAD + 32
BOX, COUNT = 48, 4  # reduced to everybody
COUNTS_LEFT = 16  # of parts and numbers that no offer brought together, summed over lower ranks
KEPT = 24  # points that stay under old and new numbers, and all
CHECKSUM = 16  # of the objects and their parts, in this call and after it


class Node(NamedTuple):
    level: int
    first_part: int
    parts: int

    def below(self) -> tuple[Node, Node]:
        lower = self.parts // 2
        return (
            Node(self.level + 1, self.first_part, lower),
            Node(self.level + 1, self.first_part + lower, self.parts - lower),
        )


def nodes_below(regions: int, node: Node) -> Iterator[Node]:
    """Nodes with a cut below the regions, a power of two; part p belongs to rank p."""
    if node.parts == 1:
        return
    if 1 << node.level >= regions:
        yield node
    for child in node.below():
        yield from nodes_below(regions, child)


def levels_below(regions: int, ranks: int) -> int:
    """Levels of cuts below the regions, of a part for each rank."""
    return (ranks - 1).bit_length() - (regions - 1).bit_length()


def pass_messages(ranks: int) -> int:
    """One from each rank of every set that is halved."""
    return sum(model.sets(ranks))


def _into_first(ranks: int, owners: list[int]) -> int:
    """Bytes of records that rank 0 gets in a round of a record to each of `owners` from all."""
    bytes_in, end = 0, ranks
    while end > 1:
        middle = end - end // 2
        bytes_in += HISTOGRAM * sum(owner < middle for owner in owners)
        bytes_in += ANSWER * sum(middle <= owner < end for owner in owners)
        end = middle
    return bytes_in


def _nodes_above(part: int, node: Node) -> Iterator[Node]:
    while node.parts > 1:
        yield node
        lower, upper = node.below()
        node = upper if part >= upper.first_part else lower


def _places(ranks: int) -> tuple[int, int]:
    """Records of places that go to the owners of all cuts, and those of them into rank 0."""
    held = [set(_nodes_above(rank, Node(0, 0, ranks))) for rank in range(ranks)]
    count = into = 0
    halves = [(0, ranks)]
    while halves:
        begin, end = halves.pop()
        if end - begin == 1:
            continue
        middle = end - (end - begin) // 2
        gone = [
            {node for node in held[rank] if (node.first_part < middle) != (rank < middle)}
            for rank in range(begin, end)
        ]
        for rank, nodes in zip(range(begin, end), gone):
            mirror = begin + end - 1 - rank
            target = middle if mirror == rank else mirror
            held[rank] -= nodes
            held[target] |= nodes
            count += len(nodes)
            into += len(nodes) if target == 0 else 0
        halves += [(begin, middle), (middle, end)]
    return count, into


def top(ranks: int, regions: int, parts: Parts) -> tuple[Traffic, int]:
    """Before the search below the regions, and bytes into rank 0; accepted, or one region."""
    traffic, agreements = Traffic(), [BOX, COUNT, parts.agreement]
    traffic.broadcast(ranks, parts.head)
    into = 0
    if regions > 1:
        into = model.look_bytes(regions, parts)
        traffic.reduce(ranks, into)
        traffic.broadcast(ranks, model.answer_bytes(regions, parts))
    else:
        agreements.append(parts.agreement)
    for size in agreements:
        traffic.allreduce(ranks, size)
    mine = parts.mesh + model.MESH**model.DIMENSION * parts.cell
    for rank in range(1, ranks):
        traffic.add("Send", 2, parts.summary + model.subtree(rank, ranks) * mine)
    for child in model.children(0, ranks):
        into += parts.summary + model.subtree(child, ranks) * mine
    return traffic, into + sum(agreements)


def accepted(ranks: int, regions: int, parts: Parts) -> tuple[Traffic, int]:
    """Every cut found by one count, a level in a round; and bytes into rank 0.

    Before, the places of the ranks, between which scattered points leave no cuts.
    """
    traffic, into = top(ranks, regions, parts)
    nodes = list(nodes_below(regions, Node(0, 0, ranks)))
    levels = sorted({node.level for node in nodes})
    passes = 2 + 2 * len(levels) + 1
    places, places_into = _places(ranks)
    size = HEAD * passes * pass_messages(ranks)
    size += len(nodes) * (ranks - 1) * (HISTOGRAM + ANSWER) + places * PLACES
    traffic.add("Isend", passes * pass_messages(ranks), size)
    into += HEAD * passes * (ranks - 1).bit_length() + places_into * PLACES
    for level in levels:
        into += _into_first(ranks, [node.first_part for node in nodes if node.level == level])
    return traffic, into


class PlugIn(NamedTuple):
    """What the plug-in for Zoltan adds to a call of rrcb::balance, lists of imports left out."""

    vote: int  # bytes of the reduction that begins a call
    passes: int = 1  # to search for part numbers
    record_bytes: int = 0
    renumbers: bool = False  # parts change their numbers, or nearly


def add_plug_in(traffic: Traffic, ranks: int, added: PlugIn, parts: Parts) -> None:
    traffic.allreduce(ranks, added.vote)
    traffic.allreduce(ranks, parts.agreement)
    traffic.allreduce(ranks, KEPT)
    for _ in range(2):
        traffic.allreduce(ranks, CHECKSUM)
    if added.renumbers:
        traffic.add("Exscan", ranks, COUNTS_LEFT * ranks, COUNTS_LEFT * (ranks - 1))
    messages = added.passes * pass_messages(ranks)
    traffic.add("Isend", messages, HEAD * messages + added.record_bytes)


def exact(ranks: int, rounds: int, record_bytes: int, parts: Parts) -> Traffic:
    """All cuts found by their owners; rounds and bytes of records depend on the points."""
    traffic, _ = top(ranks, 1, parts)
    messages = (2 * rounds + 1) * pass_messages(ranks)
    traffic.add("Isend", messages, HEAD * messages + record_bytes)
    return traffic
