#include "zoltan/entry/look_up.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <algorithm>
#include <cfloat>
#include <string>
#include <vector>

using namespace rrcb::zoltan;

namespace {

void write_place(int rank, int of_part, int* proc, int* part) {
    if (proc != nullptr) *proc = rank;
    if (part != nullptr) *part = of_part;
}

void look_up_point(const LastPartition& last, const double* coordinates, int* proc, int* part) {
    const rrcb::Part found = last.part_of(coordinates);
    write_place(last.map().ranks_of(found).first_rank, found, proc, part);
}

void hand_out_failure(int* values, int* count) {
    if (values != nullptr) *values = -1;
    *count = 0;
}

/// Writes the ranks of parts, which must ascend, in ascending order. Returns their number.
int write_ranks(const PartMap& map, const rrcb::Part* parts, int num_parts, int* ranks) {
    int count = 0;
    for (int i = 0; i < num_parts; ++i) {
        const rrcb::RankRange range = map.ranks_of(parts[i]);
        // The ranks of ascending parts ascend as well. Ranks up to the last one written are
        // therefore duplicates and are skipped.
        const int next = count == 0 ? 0 : ranks[count - 1] + 1;
        for (int r = std::max(range.first_rank, next); r < range.first_rank + range.count; ++r) {
            ranks[count++] = r;
        }
    }
    return count;
}

/// Writes the parts that a closed box touches and the ranks that hold them, both in ascending
/// order. An array may be null if it is not needed.
void look_up_box(const LastPartition& last, const rrcb::Box& box, int* ranks, int* num_ranks,
                 int* parts, int* num_parts) {
    // The memory is kept between calls, because programs make tens of thousands of them.
    thread_local std::vector<rrcb::Part> unasked;
    if (parts == nullptr) unasked.resize(last.map().num_parts);
    rrcb::Part* const touched = parts == nullptr ? unasked.data() : parts;
    const int count = last.parts_touching(box, touched);
    if (parts != nullptr) *num_parts = count;
    if (ranks != nullptr) *num_ranks = write_ranks(last.map(), touched, count, ranks);
}

/// Returns the state of a handle whose last partition RRCB has made; null if the real Zoltan has to
/// answer. Unlike other look-ups, the ranks of parts do not need KEEP_CUTS.
const State* divided_state(const Zoltan_Struct* zz) {
    const State* state = rrcb_state(zz);
    return state != nullptr && state->last ? state : nullptr;
}

/// Returns the lowest rank of a part. For an object, returns any rank of its part, preferably this
/// one.
int rank_of_part(const State& state, int part, ZOLTAN_ID_PTR object) {
    const PartMap& map = state.last->map();
    if (!map.one_each && (part < 0 || part >= map.num_parts))
        throw_fatal("Invalid part number: " + std::to_string(part));
    if (object == nullptr) return map.ranks_of(part).first_rank;
    return map.destination(part, *object, state.communicator->rank());
}

}  // namespace

RRCB_EXPORT int Zoltan_LB_Point_PP_Assign(Zoltan_Struct* zz, double* coordinates, int* proc,
                                          int* part) {
    const State* state = look_up_state(zz);
    if (state == nullptr) {
        return forward<&RealZoltan::lb_point_pp_assign>(zz, coordinates, proc, part);
    }
    write_place(-1, -1, proc, part);
    return look_up("Zoltan_LB_Point_PP_Assign", *state, [&](const LastPartition& last) {
        look_up_point(last, coordinates, proc, part);
    });
}

RRCB_EXPORT int Zoltan_LB_Point_Assign(Zoltan_Struct* zz, double* coordinates, int* proc) {
    const State* state = look_up_state(zz);
    if (state == nullptr) return forward<&RealZoltan::lb_point_assign>(zz, coordinates, proc);
    write_place(-1, -1, proc, nullptr);
    return look_up("Zoltan_LB_Point_Assign", *state, [&](const LastPartition& last) {
        require_one_part_per_rank(last.map(), "Zoltan_LB_Point_PP_Assign");
        look_up_point(last, coordinates, proc, nullptr);
    });
}

RRCB_EXPORT int Zoltan_LB_Box_PP_Assign(Zoltan_Struct* zz, double xmin, double ymin, double zmin,
                                        double xmax, double ymax, double zmax, int* procs,
                                        int* num_procs, int* parts, int* num_parts) {
    const State* state = look_up_state(zz);
    if (state == nullptr) {
        return forward<&RealZoltan::lb_box_pp_assign>(zz, xmin, ymin, zmin, xmax, ymax, zmax, procs,
                                                      num_procs, parts, num_parts);
    }
    hand_out_failure(procs, num_procs);
    hand_out_failure(parts, num_parts);
    return look_up("Zoltan_LB_Box_PP_Assign", *state, [&](const LastPartition& last) {
        look_up_box(last, {{xmin, ymin, zmin}, {xmax, ymax, zmax}}, procs, num_procs, parts,
                    num_parts);
    });
}

RRCB_EXPORT int Zoltan_LB_Box_Assign(Zoltan_Struct* zz, double xmin, double ymin, double zmin,
                                     double xmax, double ymax, double zmax, int* procs,
                                     int* num_procs) {
    const State* state = look_up_state(zz);
    if (state == nullptr) {
        return forward<&RealZoltan::lb_box_assign>(zz, xmin, ymin, zmin, xmax, ymax, zmax, procs,
                                                   num_procs);
    }
    hand_out_failure(procs, num_procs);
    return look_up("Zoltan_LB_Box_Assign", *state, [&](const LastPartition& last) {
        require_one_part_per_rank(last.map(), "Zoltan_LB_Box_PP_Assign");
        look_up_box(last, {{xmin, ymin, zmin}, {xmax, ymax, zmax}}, procs, num_procs, nullptr,
                    nullptr);
    });
}

RRCB_EXPORT int Zoltan_RCB_Box(Zoltan_Struct* zz, int part, int* dimension, double* xmin,
                               double* ymin, double* zmin, double* xmax, double* ymax,
                               double* zmax) {
    const State* state = look_up_state(zz);
    if (state == nullptr) {
        return forward<&RealZoltan::rcb_box>(zz, part, dimension, xmin, ymin, zmin, xmax, ymax,
                                             zmax);
    }
    *dimension = -1;
    *xmin = *ymin = *zmin = -DBL_MAX;
    *xmax = *ymax = *zmax = DBL_MAX;
    return look_up("Zoltan_RCB_Box", *state, [&](const LastPartition& last) {
        if (part < 0 || part >= last.cuts().num_parts)
            throw_fatal("Invalid part number " + std::to_string(part));
        const rrcb::Box region = last.region_of(part);
        double* const lower[] = {xmin, ymin, zmin};
        double* const upper[] = {xmax, ymax, zmax};
        *dimension = last.cuts().dimension;
        for (int a = 0; a < *dimension; ++a) {
            *lower[a] = std::max(region.lower[a], -DBL_MAX);
            *upper[a] = std::min(region.upper[a], DBL_MAX);
        }
    });
}

RRCB_EXPORT int Zoltan_LB_Part_To_Proc(Zoltan_Struct* zz, int part, ZOLTAN_ID_PTR global_id) {
    const State* state = divided_state(zz);
    if (state == nullptr) return forward<&RealZoltan::lb_part_to_proc>(zz, part, global_id);
    int rank = -1;
    guarded("Zoltan_LB_Part_To_Proc", state, [&] {
        rank = rank_of_part(*state, part, global_id);
        return ZOLTAN_OK;
    });
    return rank;
}

RRCB_EXPORT int Zoltan_LB_Proc_To_Part(Zoltan_Struct* zz, int rank, int* num_parts,
                                       int* first_part) {
    const State* state = divided_state(zz);
    if (state == nullptr)
        return forward<&RealZoltan::lb_proc_to_part>(zz, rank, num_parts, first_part);
    *num_parts = 0;
    *first_part = -1;
    return guarded("Zoltan_LB_Proc_To_Part", state, [&] {
        const PartMap& map = state->last->map();
        if (rank < 0 || rank >= map.num_ranks) throw_fatal("Input proc is out of range.");
        const auto [first, end] = map.parts_on(rank);
        *num_parts = end - first;
        *first_part = first_part_of(map, rank);
        return ZOLTAN_OK;
    });
}

RRCB_EXPORT int Zoltan_Help_Migrate(Zoltan_Struct* zz, int num_import,
                                    ZOLTAN_ID_PTR import_global_ids, ZOLTAN_ID_PTR import_local_ids,
                                    int* import_procs, int num_export,
                                    ZOLTAN_ID_PTR export_global_ids, ZOLTAN_ID_PTR export_local_ids,
                                    int* export_procs) {
    if (const State* state = divided_state(zz)) {
        const int code = guarded("Zoltan_Help_Migrate", state, [&] {
            require_one_part_per_rank(state->last->map(), "Zoltan_Migrate");
            return ZOLTAN_OK;
        });
        if (code != ZOLTAN_OK) return code;
    }
    return forward<&RealZoltan::help_migrate>(zz, num_import, import_global_ids, import_local_ids,
                                              import_procs, num_export, export_global_ids,
                                              export_local_ids, export_procs);
}
