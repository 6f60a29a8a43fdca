"""The formulas of scaling_model.py beside what was counted, function by function."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from choice import yes
from results import read
import scaling_model as model
import scaling_wide as wide
from scaling_model import Count, Exchange, Rounds, Sizes, Traffic

NONE = "rrcb[mesh=4,refine=none]"
REFINED = "rrcb[mesh=4]"
ACCEPTED = "rrcb[mesh=4,tol=2]"
EXACT = "rrcb-exact[mesh=4]"
ZOLTAN = "zoltan-rcb"
JAGGED = "zoltan2-mj"
WIDE = "rrcb-arrays[mesh=4,tol=2,central=2]"
PLUGGED = "rrcb[mesh=4,tol=2,central=2]"
WIDE_EXACT = "rrcb-arrays[mesh=4,refine=exact,central=2]"


class Counted(NamedTuple):
    """A method at a number of ranks: a row of table.csv and its rows of calls.csv."""

    method: str
    ranks: int
    messages: int
    bytes: int
    root_bytes_in: int
    traffic: Traffic


class Comparison(NamedTuple):
    """Predicted beside counted; `inputs` is what the prediction took from the run itself."""

    counted: Counted
    predicted: Traffic
    root_bytes: int | str  # predicted; empty where no formula gives them
    inputs: str

    @property
    def agrees(self) -> bool:
        counted, predicted = self.counted, self.predicted
        return (
            (predicted.messages, predicted.bytes) == (counted.messages, counted.bytes)
            and all(predicted[name] == counted.traffic[name] for name in predicted | counted.traffic)
            and self.root_bytes in ("", counted.root_bytes_in)
        )

    @property
    def numbers(self) -> dict:
        """A row of scaling_check.csv."""
        counted, predicted = self.counted, self.predicted
        return {
            "method": counted.method, "ranks": counted.ranks,
            "messages": counted.messages, "predicted_messages": predicted.messages,
            "bytes": counted.bytes, "predicted_bytes": predicted.bytes,
            "root_bytes_in": counted.root_bytes_in, "predicted_root_bytes_in": self.root_bytes,
            "inputs": self.inputs, "agrees": yes(self.agrees),
        }  # fmt: skip

    @property
    def texts(self) -> dict[str, str]:
        numbers = self.numbers
        named = {
            "messages": "messages", "formula: messages": "predicted_messages",
            "bytes": "bytes", "formula: bytes": "predicted_bytes",
            "into rank 0": "root_bytes_in", "formula: into rank 0": "predicted_root_bytes_in",
        }  # fmt: skip
        texts = {"method": self.counted.method, "ranks": str(self.counted.ranks)}
        for name, column in named.items():
            texts[name] = "–" if numbers[column] == "" else f"{numbers[column]:,}"
        return texts | {"taken from the run": self.inputs, "equal": "yes" if self.agrees else "NO"}


def read_counted(directory: Path) -> dict[tuple[str, int], Counted]:
    found = {}
    for folder in sorted([*directory.glob("ranks-*"), *directory.glob("refined-*")]):
        calls = read(folder / "calls.csv")
        for row in read(folder / "table.csv").itertuples():
            traffic = Traffic()
            for call in calls[calls["method"] == row.method].itertuples():
                count = Count(call.calls, call.bytes_in, call.bytes_out)
                traffic.add(call.function.removeprefix("MPI_"), *count)
            numbers = (row.ranks, row.messages, row.bytes, row.root_bytes_in)
            found[row.method, row.ranks] = Counted(row.method, *numbers, traffic)
    return found


def compare_all(
    counted: dict[tuple[str, int], Counted], sizes: Sizes | None
) -> list[Comparison]:
    found = []
    for (method, ranks), row in sorted(counted.items(), key=lambda item: item[0]):
        if sizes and ranks > 1 and method in (NONE, ACCEPTED, REFINED, EXACT):
            found.append(_compare_rrcb(row, sizes))
        if method == ZOLTAN and ranks > 1:
            traffic = model.zoltan_rcb(ranks, read_exchange(row))
            found.append(Comparison(row, traffic, "", "iterations, partners and points moved"))
        if method == JAGGED and ranks > 1:
            found.append(_compare_multijagged(row))
        if sizes and method in (WIDE, WIDE_EXACT) and ranks > 2:
            found.append(_compare_wide(row, sizes.parts))
        if sizes and method == PLUGGED and ranks > 2:
            vote = _read_vote(counted, sizes.parts)
            found.append(_compare_plugged(row, vote, sizes.parts))
    return found


def read_sizes(directory: Path, counted: dict[tuple[str, int], Counted]) -> Sizes | None:
    """From two ranks."""
    file = read(directory / "ranks-2" / "message_sizes.csv")
    if file.empty or (NONE, 2) not in counted:
        return None
    parts = model.Parts(**file.set_index("name")["bytes"])
    none = counted[NONE, 2].traffic
    return Sizes(
        parts,
        agreements=none["Allreduce"].sent // 2,
        num_agreements=none["Allreduce"].calls // 2,
        broadcasts=none["Bcast"].sent - 8 * 2,
        num_broadcasts=none["Bcast"].calls // 2,
    )


def read_rounds(row: Counted, sizes: Sizes) -> Rounds:
    """What the refinement did; fractions would mean that the formula does not hold.

    Corrections have messages as long as the cuts near the points ask for, and passes to rank 0 and
    back those that the points ask for: their bytes are taken as they came.
    """
    traffic, ranks = row.traffic, row.ranks
    looks = model.LOOKS["refined" if row.method == REFINED else "exact"]
    rest = model.beyond_head(ranks, "exact", sizes.parts)
    once = sizes.broadcasts + 8 * ranks + rest + looks * model.answer_bytes(ranks, sizes.parts)
    reduced = traffic["Reduce"].sent - looks * ranks * model.look_bytes(ranks, sizes.parts)
    return read_records(row)._replace(
        corrections=_whole(traffic["Reduce"].calls, ranks) - looks,
        answer_bytes=traffic["Bcast"].sent - once,
        bin_bytes=_whole(reduced, ranks),
    )


def read_records(row: Counted) -> Rounds:
    """Passes of the search, behind that of the plug-in's overlaps."""
    records = row.traffic["Isend"]
    passes = _whole(records.calls, row.ranks - 1)
    return Rounds(_whole(passes - 1, 2), records.sent - model.HEAD * records.calls)


def _compare_rrcb(row: Counted, sizes: Sizes) -> Comparison:
    was_accepted = row.traffic["Reduce"].calls == row.ranks
    refine, rounds = "none" if row.method == NONE else "accepted", read_records(row)
    if row.method == EXACT or row.method == REFINED and not was_accepted:
        refine = "refined" if row.method == REFINED else "exact"
        rounds = read_rounds(row, sizes)
    predicted = model.rrcb(row.ranks, sizes, refine, rounds)
    return Comparison(row, predicted, "", "rounds and bytes of records")


def read_exchange(row: Counted) -> Exchange:
    traffic = row.traffic
    returned = _whole(traffic["Reduce"].calls - sum(model.sets(row.ranks)), row.ranks) > 1
    without = model.zoltan_rcb(row.ranks, Exchange(0, returned, 0, 0, 0, 0))
    return Exchange(
        iterations=traffic["Allreduce"].calls - without["Allreduce"].calls,
        returned=returned,
        plan_messages=traffic["Send"].calls,
        field_messages=traffic["Rsend"].calls,
        field_bytes=traffic["Rsend"].sent,
        overlap_bytes=traffic["Allgatherv"].sent,
    )


def _read_vote(counted: dict[tuple[str, int], Counted], parts: model.Parts) -> int:
    """Bytes of the vote, on the least ranks on which many make the parts."""
    ranks = min(ranks for method, ranks in counted if method == PLUGGED and ranks > 2)
    row = counted[PLUGGED, ranks]
    traffic, _ = wide.accepted(ranks, 2, parts)
    wide.add_plug_in(traffic, ranks, wide.PlugIn(0, renumbers="Exscan" in row.traffic), parts)
    return _whole(row.traffic["Allreduce"].sent - traffic["Allreduce"].sent, ranks)


def _compare_plugged(row: Counted, vote: int, parts: model.Parts) -> Comparison:
    """Passes and records come from the run where numbers change, and are none else."""
    traffic, _ = wide.accepted(row.ranks, 2, parts)
    sent, known = row.traffic["Isend"], traffic["Isend"]
    renumbers = "Exscan" in row.traffic
    passes = _whole(sent.calls - known.calls, wide.pass_messages(row.ranks)) if renumbers else 1
    messages = passes * wide.pass_messages(row.ranks)
    records = sent.sent - known.sent - wide.HEAD * messages
    wide.add_plug_in(traffic, row.ranks, wide.PlugIn(vote, passes, records, renumbers), parts)
    return Comparison(row, traffic, "", "passes of REMAP and bytes of records")


def _compare_wide(row: Counted, parts: model.Parts) -> Comparison:
    if row.method == WIDE:
        return Comparison(row, *wide.accepted(row.ranks, 2, parts), "none")
    sent = row.traffic["Isend"]
    passes = _whole(sent.calls, wide.pass_messages(row.ranks))
    rounds = _whole(passes - 1, 2)
    record_bytes = sent.sent - wide.HEAD * sent.calls
    traffic = wide.exact(row.ranks, rounds, record_bytes, parts)
    return Comparison(row, traffic, "", "rounds and bytes of records")


def _compare_multijagged(row: Counted) -> Comparison:
    """Steps of two sizes at most: those of the larger from the bytes, all from the calls."""
    ranks = row.ranks
    counted, without = row.traffic["Allreduce"], model.multijagged(ranks, {})["Allreduce"]
    steps = _whole(counted.calls - without.calls, ranks)
    size = _whole(counted.sent - without.sent, ranks)
    sections = model.sections(ranks)
    widths = sorted({len(sections), *(parts for parts in sections if ranks > 2)} - {1})
    iterations = {widths[-1]: steps}
    if len(widths) == 2:
        few, many = map(model.step_bytes, widths)
        larger = _whole(size - steps * few, many - few)
        iterations = {widths[1]: larger, widths[0]: steps - larger}
    traffic = model.multijagged(ranks, iterations)
    root_bytes = traffic["Allreduce"].got // ranks
    return Comparison(row, traffic, root_bytes, "steps of the search")


def _whole(amount: int, unit: int) -> int:
    """The quotient; -1, which no count is, where something is left over."""
    return amount // unit if amount % unit == 0 else -1
