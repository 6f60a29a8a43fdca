"""The formulas of scaling_model.py beside what was counted, function by function."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from results import read_rows
from scaling_model import (
    LOOKS,
    Exchange,
    Rounds,
    Sizes,
    Traffic,
    answer_bytes,
    beyond_head,
    checksum_bytes,
    hand_up_bytes,
    look_bytes,
    multijagged,
    rrcb,
    rrcb_root_bytes,
    sections,
    sets,
    step_bytes,
    zoltan_rcb,
)

NONE = "rrcb[mesh=4,refine=none]"
REFINED = "rrcb[mesh=4]"
ACCEPTED = "rrcb[mesh=4,tol=2]"
EXACT = "rrcb-exact[mesh=4]"
ZOLTAN = "zoltan-rcb"
JAGGED = "zoltan2-mj"


@dataclass(frozen=True)
class Counted:
    """A method at a number of ranks: a row of table.csv and its rows of calls.csv."""

    method: str
    ranks: int
    messages: int
    bytes: int
    root_bytes_in: int
    imbalance: float
    traffic: Traffic


@dataclass(frozen=True)
class Comparison:
    """Predicted beside counted; `inputs` is what the prediction took from the run itself."""

    counted: Counted
    predicted: Traffic
    predicted_root_bytes: int | None
    inputs: str

    @property
    def agrees(self) -> bool:
        counted = self.counted
        return (
            self.predicted.messages == counted.messages
            and self.predicted.bytes == counted.bytes
            and _without_zeros(self.predicted) == _without_zeros(counted.traffic)
            and self.predicted_root_bytes in (None, counted.root_bytes_in)
        )


def _without_zeros(traffic: Traffic) -> dict[str, tuple[int, int, int]]:
    found = {
        name: (count, traffic.bytes_in[name], traffic.bytes_out[name])
        for name, count in traffic.calls.items()
    }
    return {name: values for name, values in found.items() if any(values)}


def read_counted(directory: Path) -> dict[tuple[str, int], Counted]:
    found = {}
    for folder in sorted([*directory.glob("ranks-*"), *directory.glob("refined-*")]):
        calls = read_rows(folder / "calls.csv")
        for row in read_rows(folder / "table.csv"):
            if row["error"]:
                continue
            traffic = Traffic()
            for call in calls:
                if call["method"] == row["method"]:
                    traffic.add(
                        call["function"].removeprefix("MPI_"),
                        *(int(call[name]) for name in ("calls", "bytes_in", "bytes_out")),
                    )
            counted = Counted(
                row["method"],
                int(row["ranks"]),
                int(row["messages"]),
                int(row["bytes"]),
                int(row["root_bytes_in"]),
                float(row["imbalance"]),
                traffic,
            )
            found[counted.method, counted.ranks] = counted
    return found


def compare_all(counted: dict[tuple[str, int], Counted]) -> list[Comparison]:
    sizes = read_sizes(counted)
    found = []
    for (method, ranks), row in sorted(counted.items()):
        if sizes and ranks > 1 and method in (NONE, ACCEPTED, REFINED, EXACT):
            found.append(_compare_rrcb(row, sizes))
        if method == ZOLTAN and ranks > 1:
            traffic = zoltan_rcb(ranks, read_exchange(row))
            inputs = "iterations, partners and points moved"
            found.append(Comparison(row, traffic, None, inputs))
        if method == JAGGED and ranks > 1:
            found.append(_compare_multijagged(row))
    return found


def read_sizes(counted: dict[tuple[str, int], Counted]) -> Sizes | None:
    """From two ranks, whose refinement takes a histogram a round."""
    if not all((method, 2) in counted for method in (NONE, EXACT)):
        return None
    none, exact = counted[NONE, 2].traffic, counted[EXACT, 2].traffic
    rounds = (exact.calls["Bcast"] - none.calls["Bcast"]) // 2 - 1
    searches = exact.bytes_in["Bcast"] - none.bytes_in["Bcast"] - answer_bytes(2)
    return Sizes(
        none.bytes_in["Allreduce"] // 2 - checksum_bytes(2),
        none.calls["Allreduce"] // 2,
        none.bytes_in["Gather"] // 2,
        none.bytes_in["Bcast"] - 8 * 2,
        none.calls["Bcast"] // 2,
        none.bytes_in["Send"] - hand_up_bytes(2, "none"),
        exact.bytes_in["Reduce"] // 2 - look_bytes(2),
        searches // rounds,
    )


def read_rounds(row: Counted, sizes: Sizes) -> Rounds:
    """What the refinement did; fractions would mean that the formula does not hold."""
    calls, bytes_in, ranks = row.traffic.calls, row.traffic.bytes_in, row.ranks
    looks = LOOKS["refined" if row.method == REFINED else "exact"]
    rest = beyond_head(ranks, "exact")
    once = sizes.broadcasts + 8 * ranks + rest + looks * answer_bytes(ranks)
    reduced = bytes_in.get("Reduce", 0) - looks * ranks * look_bytes(ranks)
    return Rounds(
        _whole(calls["Bcast"], ranks) - sizes.num_broadcasts - (rest > 0) - looks,
        _whole(bytes_in["Bcast"] - once, sizes.search),
        _whole(calls.get("Reduce", 0), ranks) - looks,
        _whole(reduced, ranks * sizes.histogram),
        _whole(calls["Gather"], ranks) - 1,
        bytes_in.get("Gatherv", 0),
    )


def _compare_rrcb(row: Counted, sizes: Sizes) -> Comparison:
    was_accepted = row.traffic.calls.get("Reduce", 0) == row.ranks
    if row.method == EXACT or row.method == REFINED and not was_accepted:
        refine = "refined" if row.method == REFINED else "exact"
        rounds = read_rounds(row, sizes)
        traffic = rrcb(row.ranks, sizes, refine, rounds)
        into = rrcb_root_bytes(row.ranks, sizes, refine, rounds)
        return Comparison(row, traffic, into, "rounds, histograms and candidates")
    refine = "none" if row.method == NONE else "accepted"
    traffic = rrcb(row.ranks, sizes, refine)
    return Comparison(row, traffic, rrcb_root_bytes(row.ranks, sizes, refine), "none")


def read_exchange(row: Counted) -> Exchange:
    calls, bytes_in = row.traffic.calls, row.traffic.bytes_in
    together = sets(row.ranks)
    returned = _whole(calls["Reduce"] - sum(together), row.ranks) > 1
    without = zoltan_rcb(row.ranks, Exchange(0, returned, 0, 0, 0, 0))
    return Exchange(
        calls["Allreduce"] - without.calls["Allreduce"],
        returned,
        calls["Send"],
        calls["Rsend"],
        bytes_in["Rsend"],
        bytes_in["Allgatherv"],
    )


def _compare_multijagged(row: Counted) -> Comparison:
    """Steps of two sizes at most: those of the larger from the bytes, all from the calls."""
    ranks = row.ranks
    without = multijagged(ranks, {})
    steps = _whole(row.traffic.calls["Allreduce"] - without.calls["Allreduce"], ranks)
    size = _whole(row.traffic.bytes_in["Allreduce"] - without.bytes_in["Allreduce"], ranks)
    widths = sorted({len(sections(ranks)), *(p for p in sections(ranks) if ranks > 2)} - {1})
    iterations = {widths[-1]: steps}
    if len(widths) == 2:
        few, many = map(step_bytes, widths)
        larger = _whole(size - steps * few, many - few)
        iterations = {widths[1]: larger, widths[0]: steps - larger}
    traffic = multijagged(ranks, iterations)
    root_bytes = traffic.bytes_out["Allreduce"] // ranks
    return Comparison(row, traffic, root_bytes, "steps of the search")


def _whole(amount: int, unit: int) -> int:
    """The quotient; -1, which no count is, where something is left over."""
    return amount // unit if amount % unit == 0 else -1
