#include "zoltan/entry/entry_point.hpp"
#include "zoltan/handle/lookups.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <cfloat>

using namespace rrcb::zoltan;

namespace {

void write_place(const Place& place, int* proc, int* part) {
    if (proc != nullptr) *proc = place.rank;
    if (part != nullptr) *part = place.part;
}

void hand_out_failure(int* values, int* count) {
    if (values != nullptr) *values = -1;
    *count = 0;
}

}  // namespace

RRCB_EXPORT int Zoltan_LB_Point_PP_Assign(Zoltan_Struct* zz, double* coordinates, int* proc,
                                          int* part) {
    const State* state = look_up_state(zz);
    if (state == nullptr) {
        return forward<&RealZoltan::lb_point_pp_assign>(zz, coordinates, proc, part);
    }
    write_place({}, proc, part);
    return guarded("Zoltan_LB_Point_PP_Assign", state, [&] {
        write_place(place_of(*state, coordinates), proc, part);
        return ZOLTAN_OK;
    });
}

RRCB_EXPORT int Zoltan_LB_Point_Assign(Zoltan_Struct* zz, double* coordinates, int* proc) {
    const State* state = look_up_state(zz);
    if (state == nullptr) return forward<&RealZoltan::lb_point_assign>(zz, coordinates, proc);
    write_place({}, proc, nullptr);
    return guarded("Zoltan_LB_Point_Assign", state, [&] {
        require_one_part_per_rank(*state, "Zoltan_LB_Point_PP_Assign");
        write_place(place_of(*state, coordinates), proc, nullptr);
        return ZOLTAN_OK;
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
    return guarded("Zoltan_LB_Box_PP_Assign", state, [&] {
        find_touched(*state, {{xmin, ymin, zmin}, {xmax, ymax, zmax}},
                     {procs, num_procs, parts, num_parts});
        return ZOLTAN_OK;
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
    return guarded("Zoltan_LB_Box_Assign", state, [&] {
        require_one_part_per_rank(*state, "Zoltan_LB_Box_PP_Assign");
        find_touched(*state, {{xmin, ymin, zmin}, {xmax, ymax, zmax}},
                     {procs, num_procs, nullptr, nullptr});
        return ZOLTAN_OK;
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
    return guarded("Zoltan_RCB_Box", state, [&] {
        const rrcb::Box region = region_of(*state, part);
        *dimension = last_of(*state).cuts().dimension;
        *xmin = region.lower[0], *ymin = region.lower[1], *zmin = region.lower[2];
        *xmax = region.upper[0], *ymax = region.upper[1], *zmax = region.upper[2];
        return ZOLTAN_OK;
    });
}
