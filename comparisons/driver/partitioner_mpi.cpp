#include "partitioner_mpi.hpp"

#include "failure_mpi.hpp"
#include "hilbert_counts_mpi.hpp"
#include "text.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#ifdef RRCB_HAS_ZOLTAN2
#include "multijagged_mpi.hpp"
#endif

namespace comparisons {

namespace {

int num_objects(void* data, int* code) {
    *code = ZOLTAN_OK;
    return static_cast<int>(static_cast<const NumberedPoints*>(data)->points.count);
}

void object_list(void* data, int, int, ZOLTAN_ID_PTR global_ids, ZOLTAN_ID_PTR local_ids,
                 int weight_dimension, float* weights, int* code) {
    const auto& [points, first_id] = *static_cast<const NumberedPoints*>(data);
    std::iota(global_ids, global_ids + points.count, first_id);
    std::iota(local_ids, local_ids + points.count, ZOLTAN_ID_TYPE{0});
    if (weight_dimension > 0) {
        std::ranges::transform(points.weights, weights,
                               [](double weight) { return static_cast<float>(weight); });
    }
    *code = ZOLTAN_OK;
}

int dimension(void* data, int* code) {
    *code = ZOLTAN_OK;
    return static_cast<const NumberedPoints*>(data)->points.dimension;
}

void coordinates(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local_ids,
                 int num_axes, double* result, int* code) {
    const rrcb::Points& points = static_cast<const NumberedPoints*>(data)->points;
    const auto axes = static_cast<std::size_t>(num_axes);
    for (std::size_t a = 0; a < axes; ++a) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            result[i * axes + a] = points.coordinate(local_ids[i], static_cast<int>(a));
    }
    *code = ZOLTAN_OK;
}

/// Calls rrcb::balance like a program that has its points in arrays.
class ArraysPartitioner : public Partitioner {
  public:
    ArraysPartitioner(const Method& method, const Workload& workload, MPI_Comm comm)
        : options_(std::get<rrcb::Options>(*method.options)),
          reuses_(method.reuses),
          workload_(workload),
          comm_(comm) {}

    int partition() override {
        try {
            balance_ = rrcb::balance(workload_.points(), comm_, options_, cuts_);
            if (reuses_) cuts_ = balance_->cuts;
        } catch (const rrcb::Error&) {
            return ZOLTAN_FATAL;
        }
        return ZOLTAN_OK;
    }

    std::vector<int> parts() const override { return balance_->parts; }
    std::string function() const override { return on_arrays; }

    void free_lists() override { balance_.reset(); }

  private:
    rrcb::Options options_;
    bool reuses_;
    const Workload& workload_;
    MPI_Comm comm_;
    std::optional<rrcb::Balance> balance_;
    rrcb::Cuts cuts_;  ///< cuts of the previous call, if they are reused
};

}  // namespace

ZoltanPartitioner::ZoltanPartitioner(const ZoltanParameters& parameters, const Workload& workload,
                                     MPI_Comm comm)
    : comm_(comm), zoltan_(Zoltan_Create(comm)) {
    if (zoltan_ == nullptr) throw Failure("Zoltan_Create failed: not enough memory");
    for (const auto& [name, value] : parameters) {
        if (Zoltan_Set_Param(zoltan_, name.c_str(), value.c_str()) == ZOLTAN_OK) continue;
        Zoltan_Destroy(&zoltan_);
        throw Failure("Zoltan refuses the parameter " + name + "=" + value);
    }
    if (workload.weighted) Zoltan_Set_Param(zoltan_, "OBJ_WEIGHT_DIM", "1");
    Zoltan_Set_Num_Obj_Fn(zoltan_, num_objects, &points_);
    Zoltan_Set_Obj_List_Fn(zoltan_, object_list, &points_);
    Zoltan_Set_Num_Geom_Fn(zoltan_, dimension, &points_);
    Zoltan_Set_Geom_Multi_Fn(zoltan_, coordinates, &points_);
    use_points(workload.points());
}

ZoltanPartitioner::~ZoltanPartitioner() {
    ZoltanPartitioner::free_lists();
    Zoltan_Destroy(&zoltan_);
}

int ZoltanPartitioner::partition() {
    int changes = 0;
    int gid_entries = 0;
    int lid_entries = 0;
    return Zoltan_LB_Partition(zoltan_, &changes, &gid_entries, &lid_entries, &imports_.count,
                               &imports_.global_ids, &imports_.local_ids, &imports_.ranks,
                               &imports_.parts, &exports_.count, &exports_.global_ids,
                               &exports_.local_ids, &exports_.ranks, &exports_.parts);
}

std::vector<int> ZoltanPartitioner::parts() const {
    const int rank = rank_of(comm_);
    std::vector<rrcb::Part> parts(points_.points.count, rank);
    for (int i = 0; i < exports_.count; ++i) parts[exports_.local_ids[i]] = exports_.parts[i];
    return parts;
}

void ZoltanPartitioner::free_lists() {
    for (ObjectLists* lists : {&imports_, &exports_}) {
        Zoltan_LB_Free_Part(&lists->global_ids, &lists->local_ids, &lists->ranks, &lists->parts);
        lists->count = -1;
    }
}

void ZoltanPartitioner::use_seed(std::uint64_t seed) {
    Zoltan_Set_Param(zoltan_, "RRCB_SEED", write_number(seed).c_str());
}

void ZoltanPartitioner::use_points(const rrcb::Points& points) {
    const auto count = static_cast<ZOLTAN_ID_TYPE>(points.count);
    points_.points = points;
    MPI_Scan(&count, &points_.first_id, 1, ZOLTAN_ID_MPI_TYPE, MPI_SUM, comm_);
    points_.first_id -= count;
}

rrcb::Box ZoltanPartitioner::box_of(rrcb::Part part) const {
    constexpr double open = std::numeric_limits<double>::max();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    rrcb::Box box{{-open, -open, -open}, {open, open, open}};
    const int size = size_of(comm_);
    // Zoltan does not return the box of a single part: its bounds would be the origin.
    if (size > 1) {
        int num_axes = 0;
        const int code = Zoltan_RCB_Box(zoltan_, part, &num_axes, &box.lower[0], &box.lower[1],
                                        &box.lower[2], &box.upper[0], &box.upper[1], &box.upper[2]);
        if (code != ZOLTAN_OK) throw Failure("Zoltan_RCB_Box failed; it needs RCB and KEEP_CUTS=1");
    }
    std::ranges::replace(box.lower, -open, -infinity);
    std::ranges::replace(box.upper, open, infinity);
    return box;
}

std::unique_ptr<Partitioner> make_partitioner(const Method& method, const Workload& workload,
                                              Lists lists, MPI_Comm comm) {
    if (method.lb_method == on_arrays) {
        return std::make_unique<ArraysPartitioner>(method, workload, comm);
    }
    if (method.lb_method == hilbert_counts) return make_hilbert_counts(workload, comm);
#ifdef RRCB_HAS_ZOLTAN2
    if (method.lb_method == multijagged) {
        std::vector<const double*> axes;
        for (int axis = 0; axis < workload.dimension; ++axis)
            axes.push_back(workload.coordinates.data() + axis);
        return make_multijagged({workload.points().count, axes, workload.dimension,
                                 workload.weighted ? workload.weights.data() : nullptr},
                                multijagged_tolerance, comm);
    }
#endif
    return std::make_unique<ZoltanPartitioner>(zoltan_parameters(method, lists), workload, comm);
}

namespace {

/// Divides the points by Zoltan, which keeps the cuts for look-ups. Collective.
mpm::Decomposition decompose(const std::shared_ptr<ZoltanPartitioner>& zoltan, MPI_Comm comm) {
    zoltan->free_lists();
    int code = zoltan->partition();
    // Negative codes are errors. If any rank has one, all ranks throw it.
    MPI_Allreduce(MPI_IN_PLACE, &code, 1, MPI_INT, MPI_MIN, comm);
    if (code < 0) throw std::runtime_error("Zoltan_LB_Partition returned " + std::to_string(code));
    mpm::Decomposition decomposition;
    decomposition.local_owners = zoltan->parts();
    for (int part = 0; part < size_of(comm); ++part) {
        const rrcb::Box box = zoltan->box_of(part);
        decomposition.boxes.push_back({box.lower, box.upper});
    }
    decomposition.owners = [zoltan](mpm::Positions at, std::span<int> owners) {
        for (std::size_t i = 0; i < owners.size(); ++i) {
            mpm::Vector place = at[i];
            int rank = -1;
            Zoltan_LB_Point_PP_Assign(zoltan->handle(), place.data(), &rank, &owners[i]);
        }
    };
    return decomposition;
}

/// Returns a balancer that uses the same handle of Zoltan in every call.
mpm::Balancer zoltan_balancer(ZoltanParameters parameters) {
    // Boxes and look-ups need the cuts to be kept. The last value of a parameter counts.
    parameters.insert(parameters.begin(), {"REMAP", "0"});
    parameters.emplace_back("KEEP_CUTS", "1");
    auto zoltan = std::make_shared<std::shared_ptr<ZoltanPartitioner>>();
    return [zoltan, parameters](mpm::Positions positions, MPI_Comm comm) {
        if (!*zoltan) *zoltan = std::make_shared<ZoltanPartitioner>(parameters, Workload(), comm);
        const std::array<std::span<const double>, 3> columns{positions.x, positions.y, positions.z};
        (*zoltan)->use_points(
            rrcb::Points(std::span(columns).first(static_cast<std::size_t>(positions.dimension))));
        return decompose(*zoltan, comm);
    };
}

}  // namespace

std::optional<mpm::Balancer> make_balancer(const Method& method, const PointWeights& weights) {
    if (method.lb_method == on_arrays)
        return rrcb_balancer(std::get<rrcb::Options>(*method.options), weights, method.reuses);
    if (method.lb_method != "RCB" && method.lb_method != "RRCB") return std::nullopt;
    return zoltan_balancer(zoltan_parameters(method, Lists::parts));
}

}  // namespace comparisons
