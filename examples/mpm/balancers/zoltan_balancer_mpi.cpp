#include "balancers/zoltan_balancer_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <zoltan.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

namespace {

/// Data of Zoltan's callbacks.
struct Objects {
    mpm::Positions positions;
    ZOLTAN_ID_TYPE first_id = 0;
};

mpm::Positions& positions_of(void* data) {
    return static_cast<Objects*>(data)->positions;
}

int num_objects(void* data, int* code) {
    *code = ZOLTAN_OK;
    return static_cast<int>(positions_of(data).size());
}

void object_list(void* data, int, int, ZOLTAN_ID_PTR global_ids, ZOLTAN_ID_PTR local_ids, int,
                 float*, int* code) {
    const std::size_t count = positions_of(data).size();
    std::iota(global_ids, global_ids + count, static_cast<Objects*>(data)->first_id);
    std::iota(local_ids, local_ids + count, ZOLTAN_ID_TYPE{0});
    *code = ZOLTAN_OK;
}

int dimension(void* data, int* code) {
    *code = ZOLTAN_OK;
    return positions_of(data).z.empty() ? 2 : 3;
}

void coordinates(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local_ids,
                 int num_axes, double* result, int* code) {
    const mpm::Positions& positions = positions_of(data);
    for (int i = 0; i < count; ++i) {
        const mpm::Vector at = positions[local_ids[i]];
        result = std::copy_n(at.begin(), num_axes, result);
    }
    *code = ZOLTAN_OK;
}

/// Zoltan's handle, kept from one balance to the next because look-ups need its cuts.
class ZoltanRcb {
  public:
    ZoltanRcb(const ZoltanParameters& parameters, MPI_Comm comm) : zoltan_(Zoltan_Create(comm)) {
        if (!zoltan_) throw std::runtime_error("Zoltan_Create failed: not enough memory");
        for (const auto& [name, value] : parameters)
            if (Zoltan_Set_Param(zoltan_.get(), name.c_str(), value.c_str()) != ZOLTAN_OK)
                throw std::runtime_error("Zoltan refuses the parameter " + name + "=" + value);
        Zoltan_Set_Num_Obj_Fn(zoltan_.get(), num_objects, &objects_);
        Zoltan_Set_Obj_List_Fn(zoltan_.get(), object_list, &objects_);
        Zoltan_Set_Num_Geom_Fn(zoltan_.get(), dimension, &objects_);
        Zoltan_Set_Geom_Multi_Fn(zoltan_.get(), coordinates, &objects_);
    }
    ZoltanRcb(const ZoltanRcb&) = delete;
    ZoltanRcb& operator=(const ZoltanRcb&) = delete;

    mpm::Decomposition decompose(mpm::Positions positions, MPI_Comm comm) {
        objects_.positions = positions;
        ZOLTAN_ID_TYPE end = static_cast<ZOLTAN_ID_TYPE>(positions.size());
        MPI_Scan(MPI_IN_PLACE, &end, 1, ZOLTAN_ID_MPI_TYPE, MPI_SUM, comm);
        objects_.first_id = end - static_cast<ZOLTAN_ID_TYPE>(positions.size());
        mpm::Decomposition decomposition;
        decomposition.local_owners = partition(comm);
        const int num_parts = mpm::size_of(comm);
        for (int part = 0; part < num_parts; ++part)
            decomposition.boxes.push_back(box_of(part, num_parts));
        return decomposition;
    }

    int owner_of(mpm::Vector at) const {
        int rank = -1, part = -1;
        Zoltan_LB_Point_PP_Assign(zoltan_.get(), at.data(), &rank, &part);
        return part;
    }

  private:
    std::vector<int> partition(MPI_Comm comm) {
        int changes = 0, gid_entries = 0, lid_entries = 0, num_imports = 0, num_exports = 0;
        ZOLTAN_ID_PTR import_gids = nullptr, import_lids = nullptr;
        ZOLTAN_ID_PTR export_gids = nullptr, export_lids = nullptr;
        int *import_ranks = nullptr, *import_parts = nullptr;
        int *export_ranks = nullptr, *export_parts = nullptr;
        int code = Zoltan_LB_Partition(zoltan_.get(), &changes, &gid_entries, &lid_entries,
                                       &num_imports, &import_gids, &import_lids, &import_ranks,
                                       &import_parts, &num_exports, &export_gids, &export_lids,
                                       &export_ranks, &export_parts);
        // An object that no list names stays where it is.
        std::vector<int> owners(objects_.positions.size(), mpm::rank_of(comm));
        for (int i = 0; code >= 0 && i < num_exports; ++i) owners[export_lids[i]] = export_parts[i];
        Zoltan_LB_Free_Part(&import_gids, &import_lids, &import_ranks, &import_parts);
        Zoltan_LB_Free_Part(&export_gids, &export_lids, &export_ranks, &export_parts);
        // Negative codes are errors. All ranks throw the one of any.
        MPI_Allreduce(MPI_IN_PLACE, &code, 1, MPI_INT, MPI_MIN, comm);
        if (code < 0)
            throw std::runtime_error("Zoltan_LB_Partition returned " + std::to_string(code));
        return owners;
    }

    mpm::Box box_of(int part, int num_parts) const {
        constexpr double open = std::numeric_limits<double>::max();
        constexpr double infinity = std::numeric_limits<double>::infinity();
        mpm::Box box{{-open, -open, -open}, {open, open, open}};
        int num_axes = 0;
        // Zoltan tells the origin as the box of a single part.
        const int code =
            num_parts == 1
                ? ZOLTAN_OK
                : Zoltan_RCB_Box(zoltan_.get(), part, &num_axes, &box.lower[0], &box.lower[1],
                                 &box.lower[2], &box.upper[0], &box.upper[1], &box.upper[2]);
        if (code != ZOLTAN_OK)
            throw std::runtime_error(
                "Zoltan_RCB_Box failed: only LB_METHOD=RCB and RRCB make boxes");
        std::ranges::replace(box.lower, -open, -infinity);
        std::ranges::replace(box.upper, open, infinity);
        return box;
    }

    struct Destroy {
        void operator()(Zoltan_Struct* zoltan) const { Zoltan_Destroy(&zoltan); }
    };

    std::unique_ptr<Zoltan_Struct, Destroy> zoltan_;
    Objects objects_;
};

}  // namespace

mpm::Balancer zoltan_balancer(ZoltanParameters parameters) {
    // Boxes and look-ups need kept cuts. The last setting counts.
    parameters.insert(parameters.begin(), {"REMAP", "0"});
    parameters.insert(parameters.end(), {{"KEEP_CUTS", "1"}, {"RETURN_LISTS", "PARTS"}});
    auto zoltan = std::make_shared<std::unique_ptr<ZoltanRcb>>();
    return [zoltan, parameters](mpm::Positions positions, MPI_Comm comm) {
        if (!*zoltan) *zoltan = std::make_unique<ZoltanRcb>(parameters, comm);
        mpm::Decomposition decomposition = (*zoltan)->decompose(positions, comm);
        decomposition.owners = [zoltan](mpm::Positions at, std::span<int> owners) {
            for (std::size_t i = 0; i < owners.size(); ++i) owners[i] = (*zoltan)->owner_of(at[i]);
        };
        return decomposition;
    };
}
