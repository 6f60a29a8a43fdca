#include "zoltan/call/rest_mpi.hpp"

#include "collective/communicator.hpp"
#include "refinement/mix.hpp"
#include "zoltan/call/rcb_options.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace rrcb::zoltan {

namespace {

std::uint64_t join(std::uint64_t sum, std::uint64_t bits) {
    return mix(sum + 0x9e3779b97f4a7c15U + bits);
}

bool is_finite(const Vector& position) {
    return std::ranges::all_of(position, [](double x) { return std::isfinite(x); });
}

}  // namespace

void add_checksums(const Parameters& parameters, const Workspace& workspace, const Points& points,
                   bool with_positions, std::span<const Part> parts,
                   std::span<std::uint64_t> checksums) {
    const auto stride = static_cast<std::size_t>(parameters.weight_dimension);
    const float* weights = workspace.callback_weights.data();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::uint64_t sum = 1;
        for (std::size_t k = 0; k < stride; ++k)
            sum = join(sum, std::bit_cast<std::uint32_t>(weights[i * stride + k]));
        for (int axis = 0; with_positions && axis < points.dimension; ++axis)
            sum = join(sum, std::bit_cast<std::uint64_t>(points.coordinate(i, axis)));
        checksums[static_cast<std::size_t>(parts[i])] += sum;
    }
}

namespace {

bool is_alone_on(int rank, const PartMap& map, Part part) {
    const RankRange& range = map.ranks[static_cast<std::size_t>(part)];
    return range.first_rank == rank && range.count == 1;
}

/// Whether every object of this rank is in a part that is on this rank alone and, on request, that
/// the cuts tell of its position; and the part of each. Never where the parts are not known.
bool are_where_sent(const Rest& rest, const KeptPartition& kept, const Objects& objects, int rank,
                    bool by_cuts, std::vector<Part>& parts) {
    const PartMap& map = kept.map();
    if (!map.one_each && !objects.names_parts) return false;
    if (rest.dimension != objects.points.dimension) return false;
    const int* named = objects.initial_parts.get();
    parts.assign(static_cast<std::size_t>(objects.count), rank);
    if (named != nullptr) std::copy_n(named, parts.size(), parts.begin());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] < 0 || parts[i] >= map.num_parts() || !is_alone_on(rank, map, parts[i]))
            return false;
        const Vector position = objects.points.position(i);
        if (!is_finite(position)) return false;
        if (by_cuts && kept.part_of(position.data()) != parts[i]) return false;
    }
    return true;
}

}  // namespace

bool are_in_own_part(const Objects& objects, const PartMap& map, int rank) {
    if (!map.one_each) return false;
    const int* named = objects.initial_parts.get();
    if (named == nullptr) return true;
    return std::all_of(named, named + objects.count, [&](int part) { return part == rank; });
}

bool is_at_rest(const Rest& rest, const KeptPartition& kept, const Parameters& parameters,
                const Workspace& workspace, const Objects& objects, int rank) {
    const bool with_positions = rest.by_position;
    std::vector<Part> parts;
    if (!are_where_sent(rest, kept, objects, rank, !with_positions, parts)) return false;
    std::vector<std::uint64_t> checksums(rest.checksums.size(), 0);
    add_checksums(parameters, workspace, objects.points, with_positions, parts, checksums);
    for (Part part = 0; part < kept.map().num_parts(); ++part) {
        const auto index = static_cast<std::size_t>(part);
        if (is_alone_on(rank, kept.map(), part) && checksums[index] != rest.checksums[index])
            return false;
    }
    return true;
}

bool are_as_cut(State& state, const Objects& objects) {
    const Parameters& parameters = state.parameters;
    // Parts may have become too thin where the box of the points did.
    const bool counts = parameters.return_lists != ReturnLists::none &&
                        !has_several_weights(parameters) && parameters.skip_within > 0 &&
                        parameters.options.min_width.empty();
    if (!counts || !state.rest || !state.kept) return false;
    Rest& rest = *state.rest;
    std::vector<Part> parts;
    if (!are_where_sent(rest, *state.kept, objects, state.communicator->rank(), true, parts))
        return false;
    std::ranges::fill(rest.part_weights, 0.0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double weight = objects.points.weight(i);
        if (!(weight >= 0 && std::isfinite(weight))) return false;
        rest.part_weights[static_cast<std::size_t>(parts[i])] += weight;
    }
    return true;
}

bool are_even(Rest& rest, double within, MPI_Comm comm) {
    // Each part is on one rank, so that all sums are exact, and the same on every rank.
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, rest.part_weights.data(),
                             mpi::to_int(std::ssize(rest.part_weights)), MPI_DOUBLE, MPI_SUM, comm),
               "MPI_Allreduce");
    const bool has_weight =
        std::ranges::any_of(rest.part_weights, [](double weight) { return weight > 0; });
    const double counted = imbalance(rest.part_weights, rest.part_sizes);
    if (!has_weight || !(counted <= within)) return false;
    rest.report.measured_imbalance = counted;
    return true;
}

}  // namespace rrcb::zoltan
