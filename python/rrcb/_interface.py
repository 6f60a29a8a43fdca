"""Structures and functions of the library's interface in C."""

from __future__ import annotations

from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    c_char_p,
    c_double,
    c_int,
    c_int32,
    c_int64,
    c_size_t,
    c_void_p,
    sizeof,
)
from typing import Any


def members(**types: Any) -> list[tuple[str, Any]]:
    """Returns the members of a structure, in their order."""
    return list(types.items())


class Sized(Structure):
    """A structure that begins with its size, beyond which the library reads and writes nothing."""

    _fields_ = members(size=c_size_t)

    def __init__(self, *values: Any, **named: Any) -> None:
        super().__init__(sizeof(self), *values, **named)


class Points(Sized):
    """rrcb_points."""

    _fields_ = members(
        dimension=c_int, type=c_int, count=c_size_t, stride=c_size_t, axes=c_void_p * 3,
        weights=c_void_p
    )


class Cuts(Sized):
    """rrcb_cuts."""

    _fields_ = members(
        dimension=c_int, num_parts=c_int, tree=c_void_p, group_size=c_int, larger_below=c_int,
        round_robin_block=c_int, numbers=c_void_p, debt=c_double
    )


class Report(Sized):
    """rrcb_report."""

    _fields_ = members(
        imbalance=c_double, within_tolerance=c_int, kept=c_int, num_points=c_int64,
        total_weight=c_double, least_imbalance=c_double, estimated_imbalance=c_double,
        num_cells=c_int64, rounds=c_int, coincident_cuts=c_int, all_weights_zero=c_int,
        num_empty_parts=c_int
    )


class Column(Sized):
    """rrcb_column."""

    _fields_ = members(type=c_int, components=c_size_t, from_=c_void_p, to=c_void_p)


class Plan(Sized):
    """rrcb_plan_lists."""

    _fields_ = members(
        num_points=c_size_t, num_points_after=c_size_t, num_exports=c_size_t,
        export_indices=c_void_p, export_ranks=c_void_p, export_parts=c_void_p, num_imports=c_size_t,
        import_ranks=c_void_p, import_indices=c_void_p, import_parts=c_void_p
    )


class GhostOptions(Sized):
    """rrcb_ghost_options."""

    _fields_ = members(
        cutoff=c_double, cutoffs=c_void_p, lower=c_void_p, upper=c_void_p, ranks_of_parts=c_void_p,
        num_parts=c_size_t, needs=c_int64
    )


class NeighbourOptions(Sized):
    """rrcb_neighbour_options."""

    _fields_ = members(
        cutoff=c_double, travel=c_double, lower=c_void_p, upper=c_void_p, ranks_of_parts=c_void_p,
        num_parts=c_size_t, needs=c_int64
    )


Resize = CFUNCTYPE(c_void_p, c_void_p, c_size_t)


class Array(Sized):
    """rrcb_array."""

    _fields_ = members(
        type=c_int, components=c_size_t, values=c_void_p, count=c_size_t, capacity=c_size_t,
        resize=Resize, owner=c_void_p
    )


class SharedEntries(Sized):
    """rrcb_shared_entries."""

    _fields_ = members(
        num_ranks=c_size_t, ranks=c_void_p, num_indices=c_size_t, indices=c_void_p
    )


class RankCount(Structure):
    """rrcb_rank_count."""

    _fields_ = members(rank=c_int, count=c_size_t)


class RankRange(Structure):
    """rrcb_rank_range."""

    _fields_ = members(first_rank=c_int, count=c_int)


class GhostPlan(Sized):
    """rrcb_ghost_plan."""

    _fields_ = members(
        num_points=c_size_t, num_ghosts=c_size_t, num_send_ranks=c_size_t, send=POINTER(RankCount),
        num_sent=c_size_t, send_indices=c_void_p, num_receive_ranks=c_size_t,
        receive=POINTER(RankCount), shifts=c_void_p
    )


class VerifyOptions(Structure):
    """rrcb_verify_options."""

    _fields_ = members(
        sample=c_size_t, cutoff=c_double, cutoffs=c_void_p, num_ids=c_size_t, ids=c_void_p,
        num_ids_before=c_size_t, ids_before=c_void_p
    )


class Verification(Structure):
    """rrcb_verification."""

    _fields_ = members(
        num_pairs=c_int64, num_faults=c_int64, num_missing=c_size_t, missing=c_void_p,
        num_duplicates=c_size_t, duplicates=c_void_p, num_not_mine=c_size_t, not_mine=c_void_p
    )


class Address:
    """Argument type of arrays: their address, null if they are empty or None."""

    @staticmethod
    def from_param(values: Any) -> c_void_p | None:
        return c_void_p(values.ctypes.data) if values is not None and values.size else None


HANDLE = POINTER(c_void_p)
FUNCTIONS: dict[str, tuple[Any, ...]] = {
    "balancer_create_fortran": (c_int, HANDLE),
    "balancer_set": (c_void_p, c_char_p, c_char_p),
    "balancer_set_part_sizes": (c_void_p, c_size_t, Address),
    "balance": (c_void_p, POINTER(Points), Address),
    "get_report": (c_void_p, POINTER(Report)),
    "get_cuts": (c_void_p, POINTER(Cuts)),
    "set_cuts": (c_void_p, POINTER(Cuts)),
    "save_cuts": (c_void_p, POINTER(c_void_p), POINTER(c_size_t)),
    "load_cuts": (c_void_p, c_char_p, c_size_t),
    "assign": (c_void_p, POINTER(Points), Address),
    "assign_all": (c_void_p, POINTER(Points), Address),
    "box_of": (c_void_p, c_int32, Address, Address),
    "part_weights": (c_void_p, POINTER(Points), Address, c_size_t, Address),
    "moved_fraction": (c_void_p, POINTER(Points), Address, POINTER(c_double)),
    "balanced_sizes": (c_size_t, Address, Address, Address),
    "remap": (c_void_p, c_size_t, Address, Address, c_void_p, c_size_t, Address, c_void_p),
    "ranks_of_part": (c_int32, c_int, c_int, POINTER(RankRange)),
    "plan": (c_void_p, c_size_t, Address),
    "get_plan": (c_void_p, POINTER(Plan)),
    "transfer": (c_void_p, c_size_t, c_void_p, c_void_p),
    "ghosts_create": (c_void_p, POINTER(Points), POINTER(GhostOptions), HANDLE),
    "ghosts_get_plan": (c_void_p, POINTER(GhostPlan)),
    "ghosts_fetch": (c_void_p, c_size_t, c_void_p, c_void_p),
    "ghosts_reply": (c_void_p, c_size_t, c_void_p, c_void_p),
    "ghosts_accumulate": (c_void_p, c_size_t, c_void_p, c_void_p),
    "ghosts_verify": (c_void_p, POINTER(Points), POINTER(VerifyOptions), POINTER(Verification)),
    "groups_create": (c_void_p, POINTER(Points), Address, c_int, HANDLE),
    "groups_points": (c_void_p, POINTER(Points)),
    "groups_to_points": (c_void_p, c_size_t, c_void_p, c_void_p),
    "groups_sums": (c_void_p, c_size_t, Address, Address),
    "join_keys": (c_void_p, c_size_t, c_size_t, Address, Address),
    "ghosts_apply_shifts": (c_void_p, POINTER(Points)),
    "neighbours_create": (c_void_p, POINTER(NeighbourOptions), HANDLE),
    "neighbours_migrate": (c_void_p, POINTER(Points), c_size_t, c_void_p),
    "neighbours_find_ghosts": (c_void_p, POINTER(Points), Address),
    "neighbours_fetch": (c_void_p, c_size_t, c_void_p, c_void_p),
    "neighbours_accumulate": (c_void_p, c_size_t, c_void_p),
    "neighbours_sum": (c_void_p, POINTER(SharedEntries), c_size_t, c_size_t, c_void_p),
    "neighbours_ghost_plan": (c_void_p, POINTER(GhostPlan)),
    "neighbours_apply_shifts": (c_void_p, POINTER(Points)),
    "neighbours_ranks": (c_void_p, POINTER(c_size_t), POINTER(c_void_p)),
    "controller_create_fortran": (c_int, HANDLE),
    "controller_step": (c_void_p, c_double, POINTER(c_double), POINTER(c_int)),
    "controller_due": (c_void_p, POINTER(c_int)),
    "controller_rebalanced": (c_void_p, POINTER(Report), c_double),
    "controller_save": (c_void_p, POINTER(c_void_p), POINTER(c_size_t)),
    "controller_load_fortran": (c_int, c_char_p, c_size_t, HANDLE),
    "cost_model_save": (c_void_p, POINTER(c_void_p), POINTER(c_size_t)),
    "cost_model_load_fortran": (c_int, HANDLE, c_char_p, c_size_t, HANDLE),
    "cost_model_create_fortran": (c_int, HANDLE, c_int, HANDLE),
    "cost_model_num_columns": (c_void_p, POINTER(c_int)),
    "cost_model_step": (c_void_p, c_double, c_size_t, Address),
    "cost_model_weights": (c_void_p, c_size_t, c_size_t, Address, Address),
    "cost_model_costs": (c_void_p, c_size_t, Address),
    "cost_model_uses_costs": (c_void_p, POINTER(c_int)),
}
DESTROYED = ("balancer_destroy", "ghosts_destroy", "groups_destroy", "neighbours_destroy", "controller_destroy", "cost_model_destroy")
