#include "zoltan/call/objects.hpp"

#include "zoltan/real/message.hpp"

#include <algorithm>
#include <string>

namespace rrcb::zoltan {

namespace {

/// A registered callback and its data pointer. Converts to false if none is registered.
template <typename Function>
struct Callback {
    Function* function = nullptr;
    void* data = nullptr;

    explicit operator bool() const { return function != nullptr; }

    template <typename... Arguments>
    auto operator()(Arguments... arguments) const {
        return function(data, arguments...);
    }
};

template <typename Function>
Callback<Function> callback(Zoltan_Struct* zz, ZOLTAN_FN_TYPE type) {
    ZOLTAN_VOID_FN* function = nullptr;
    void* data = nullptr;
    if (Zoltan_Get_Fn(zz, type, &function, &data) != ZOLTAN_OK) return {};
    return {reinterpret_cast<Function*>(function), data};
}

/// Calls the callbacks of one handle, and turns their error codes into failures.
class Collector {
  public:
    Collector(Zoltan_Struct* zz, const Parameters& parameters, Workspace& workspace)
        : zz_(zz),
          parameters_(parameters),
          gid_(parameters.num_gid_entries),
          lid_(parameters.num_lid_entries),
          widths_(parameters),
          workspace_(workspace) {}

    Objects collect() {
        read_count();
        read_dimension();
        const auto count = static_cast<std::size_t>(objects_.count);
        if (count > 0) {
            allocate(count);
            read_ids_and_weights(count);
            read_coordinates(count);
        }
        read_initial_parts(count);
        return std::move(objects_);
    }

  private:
    ZOLTAN_ID_PTR global_id(std::size_t i) const {
        return as_zoltan_ids(objects_.global_ids + i * widths_.global);
    }
    ZOLTAN_ID_PTR local_id(std::size_t i) const {
        if (widths_.local == 0) return nullptr;
        return as_zoltan_ids(objects_.local_ids + i * widths_.local);
    }

    void check(int code, const char* name) {
        if (code == ZOLTAN_WARN) objects_.warned = true;
        if (code == ZOLTAN_OK || code == ZOLTAN_WARN) return;
        throw ZoltanError(code == ZOLTAN_MEMERR ? ZOLTAN_MEMERR : ZOLTAN_FATAL,
                          std::string(name) + " returned error code " + std::to_string(code));
    }

    void read_count() {
        const auto num_objects = callback<ZOLTAN_NUM_OBJ_FN>(zz_, ZOLTAN_NUM_OBJ_FN_TYPE);
        if (!num_objects) throw_fatal("Must register ZOLTAN_NUM_OBJ_FN.");
        int code = ZOLTAN_OK;
        objects_.count = num_objects(&code);
        check(code, "ZOLTAN_NUM_OBJ_FN");
        if (objects_.count >= 0) return;
        throw_fatal("ZOLTAN_NUM_OBJ_FN returned a negative number of objects: " +
                    std::to_string(objects_.count));
    }

    void read_dimension() {
        const auto dimension = callback<ZOLTAN_NUM_GEOM_FN>(zz_, ZOLTAN_NUM_GEOM_FN_TYPE);
        if (!dimension) throw_fatal("Must register ZOLTAN_NUM_GEOM_FN.");
        int code = ZOLTAN_OK;
        objects_.points.dimension = dimension(&code);
        check(code, "ZOLTAN_NUM_GEOM_FN");
        if (objects_.points.dimension >= 1 && objects_.points.dimension <= max_dimension) return;
        throw_fatal("ZOLTAN_NUM_GEOM_FN returned dimension " +
                    std::to_string(objects_.points.dimension) + "; it must be 1, 2 or 3");
    }

    void read_ids_and_weights(std::size_t count) {
        const int weight_dimension = parameters_.weight_dimension;
        weights_ = weight_dimension == 0 ? nullptr : room_in(workspace_.callback_weights, count);
        const auto list = callback<ZOLTAN_OBJ_LIST_FN>(zz_, ZOLTAN_OBJ_LIST_FN_TYPE);
        if (list) {
            int code = ZOLTAN_OK;
            list(gid_, lid_, global_id(0), local_id(0), weight_dimension, weights_, &code);
            check(code, "ZOLTAN_OBJ_LIST_FN");
        } else {
            iterate_objects(count);
        }
    }

    void iterate_objects(std::size_t count) {
        const auto first = callback<ZOLTAN_FIRST_OBJ_FN>(zz_, ZOLTAN_FIRST_OBJ_FN_TYPE);
        const auto next = callback<ZOLTAN_NEXT_OBJ_FN>(zz_, ZOLTAN_NEXT_OBJ_FN_TYPE);
        if (!first || !next)
            throw_fatal(
                "Must register ZOLTAN_OBJ_LIST_FN or ZOLTAN_FIRST_OBJ_FN/ZOLTAN_NEXT_OBJ_FN.");
        int code = ZOLTAN_OK;
        const int wdim = parameters_.weight_dimension;
        int found = first(gid_, lid_, global_id(0), local_id(0), wdim, weights_, &code);
        check(code, "ZOLTAN_FIRST_OBJ_FN");
        for (std::size_t i = 1; i < count && found != 0; ++i) {
            float* weight = weights_ == nullptr ? nullptr : weights_ + i;
            found = next(gid_, lid_, global_id(i - 1), local_id(i - 1), global_id(i), local_id(i),
                         wdim, weight, &code);
            check(code, "ZOLTAN_NEXT_OBJ_FN");
        }
        if (found == 0)
            throw_fatal(
                "ZOLTAN_FIRST_OBJ_FN/ZOLTAN_NEXT_OBJ_FN ended before the number of objects that "
                "ZOLTAN_NUM_OBJ_FN returned");
    }

    void read_coordinates(std::size_t count) {
        const auto dimension = static_cast<std::size_t>(objects_.points.dimension);
        double* coordinates = room_in(workspace_.coordinates, count * dimension);
        read_geometry(count, coordinates);
        std::span<const double> weights;
        if (weights_ != nullptr) {
            double* converted = room_in(workspace_.weights, count);
            std::copy_n(weights_, count, converted);
            weights = {converted, count};
        }
        objects_.points =
            Points({coordinates, count * dimension}, objects_.points.dimension, weights);
    }

    void read_geometry(std::size_t count, double* coordinates) {
        const auto multi = callback<ZOLTAN_GEOM_MULTI_FN>(zz_, ZOLTAN_GEOM_MULTI_FN_TYPE);
        const auto single = callback<ZOLTAN_GEOM_FN>(zz_, ZOLTAN_GEOM_FN_TYPE);
        const auto dimension = static_cast<std::size_t>(objects_.points.dimension);
        int code = ZOLTAN_OK;
        if (multi) {
            multi(gid_, lid_, objects_.count, global_id(0), local_id(0), objects_.points.dimension,
                  coordinates, &code);
            check(code, "ZOLTAN_GEOM_MULTI_FN");
            return;
        }
        if (!single) throw_fatal("Must register ZOLTAN_GEOM_MULTI_FN or ZOLTAN_GEOM_FN.");
        for (std::size_t i = 0; i < count; ++i) {
            single(gid_, lid_, global_id(i), local_id(i), coordinates + i * dimension, &code);
            check(code, "ZOLTAN_GEOM_FN");
        }
    }

    void read_initial_parts(std::size_t count) {
        const auto multi = callback<ZOLTAN_PART_MULTI_FN>(zz_, ZOLTAN_PART_MULTI_FN_TYPE);
        const auto single = callback<ZOLTAN_PART_FN>(zz_, ZOLTAN_PART_FN_TYPE);
        objects_.names_parts = multi || single;
        if (!objects_.names_parts || count == 0) return;
        objects_.initial_parts = room_in(workspace_.initial_parts, count);
        int code = ZOLTAN_OK;
        if (multi) {
            multi(gid_, lid_, objects_.count, global_id(0), local_id(0), objects_.initial_parts,
                  &code);
            check(code, "ZOLTAN_PART_MULTI_FN");
            return;
        }
        for (std::size_t i = 0; i < count; ++i) {
            objects_.initial_parts[i] = single(gid_, lid_, global_id(i), local_id(i), &code);
            check(code, "ZOLTAN_PART_FN");
        }
    }

    /// Allocates the memory of later steps, because those run between messages, where no rank may
    /// fail alone.
    void allocate(std::size_t count) {
        const ReturnLists asked = parameters_.return_lists;
        if (asked != ReturnLists::none) objects_.moving = room_in(workspace_.moving, count);
        if (asked == ReturnLists::exports || asked == ReturnLists::parts) {
            objects_.room = make_list(objects_.count, widths_);
            objects_.global_ids = objects_.room.global_ids.get();
            objects_.local_ids = objects_.room.local_ids.get();
            return;
        }
        objects_.global_ids = room_in(workspace_.global_ids, count * widths_.global);
        if (widths_.local > 0)
            objects_.local_ids = room_in(workspace_.local_ids, count * widths_.local);
    }

    Zoltan_Struct* zz_;
    const Parameters& parameters_;
    int gid_;  ///< number of entries of a global id
    int lid_;
    IdWidths widths_;
    Workspace& workspace_;
    Objects objects_;
    float* weights_ = nullptr;  ///< weights from the callbacks; null if there are none
};

}  // namespace

List make_list(int count, const IdWidths& widths) {
    const auto size = static_cast<std::size_t>(count);
    return {count, make_array<IdWord>(size * widths.global),
            make_array<IdWord>(size * widths.local), make_array<int>(size), make_array<int>(size)};
}

Objects collect_objects(Zoltan_Struct* zz, const Parameters& parameters, Workspace& workspace) {
    return Collector(zz, parameters, workspace).collect();
}

}  // namespace rrcb::zoltan
