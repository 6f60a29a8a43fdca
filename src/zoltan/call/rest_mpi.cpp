#include "zoltan/call/rest_mpi.hpp"

#include "collective/communicator.hpp"
#include "refinement/mix.hpp"
#include "zoltan/call/rcb_options.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace rrcb::zoltan {

namespace {

std::uint64_t join(std::uint64_t sum, std::uint64_t bits) {
    return mix(sum + 0x9e3779b97f4a7c15U + bits);
}

bool is_finite(const Vector& position) {
    return std::ranges::all_of(position, [](double x) { return std::isfinite(x); });
}

/// Calls visit(part, hash) for each object.
template <class Visit>
void for_each_hash(const Hashed& objects, std::span<const Part> parts, Visit&& visit) {
    const auto stride = static_cast<std::size_t>(objects.parameters.weight_dimension);
    const float* weights = objects.workspace.callback_weights.data();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::uint64_t sum = 1;
        for (std::size_t k = 0; k < stride; ++k)
            sum = join(sum, std::bit_cast<std::uint32_t>(weights[i * stride + k]));
        for (int axis = 0; objects.with_positions && axis < objects.points.dimension; ++axis)
            sum = join(sum, std::bit_cast<std::uint64_t>(objects.points.coordinate(i, axis)));
        visit(parts[i], sum);
    }
}

/// Sums travel as the doubles of the same bits.
void add_bits(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    const auto sum = std::bit_cast<std::uint64_t>(a[0]) + std::bit_cast<std::uint64_t>(b[0]);
    joined.push_back(std::bit_cast<double>(sum));
}

}  // namespace

ChecksumSums::ChecksumSums(const PartMap& map, const Communicator& comm, bool is_spread) {
    if (is_spread) spread_.emplace(comm.rank(), comm.size(), add_bits);
    if (!is_spread) sums_.resize(static_cast<std::size_t>(map.num_parts) + 1);
}

bool ChecksumSums::run(const Hashed& objects, std::span<const Part> parts, bool moves,
                       const PartMap& map, Rest& rest, ButterflyMessages& messages,
                       Participant& self) {
    if (spread_) return run_spread(objects, parts, moves, map, rest, messages, self);
    for_each_hash(objects, parts, [&](Part part, std::uint64_t hash) {
        sums_[static_cast<std::size_t>(part)] += hash;
    });
    sums_.back() = moves ? 1 : 0;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums_.data(), static_cast<int>(sums_.size()),
                             MPI_UINT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    std::copy_n(sums_.begin() + rest.own.first, rest.checksums.size(), rest.checksums.begin());
    return sums_.back() != 0;
}

bool ChecksumSums::run_spread(const Hashed& objects, std::span<const Part> parts, bool moves,
                              const PartMap& map, Rest& rest, ButterflyMessages& messages,
                              Participant& self) {
    self.attempt([&] {
        std::map<Part, std::uint64_t> sums;
        auto last = sums.end();
        for_each_hash(objects, parts, [&](Part part, std::uint64_t hash) {
            if (last == sums.end() || last->first != part) last = sums.try_emplace(part, 0).first;
            last->second += hash;
        });
        for (const auto& [part, sum] : sums)
            spread_->add(static_cast<Key>(part), map.ranks_of(part).first_rank,
                         std::array{std::bit_cast<double>(sum)});
    });
    messages.run(*spread_, Butterfly::to_owners, {0, moves ? 1.0 : 0.0}, self);
    // A rank that failed on the way may still hold records of others.
    self.attempt([&] {
        spread_->owned().for_each([&](const Record& sum) {
            rest.checksums[static_cast<std::size_t>(sum.key) -
                           static_cast<std::size_t>(rest.own.first)] =
                std::bit_cast<std::uint64_t>(sum.payload[0]);
        });
    });
    return spread_->flags()[1] > 0;
}

namespace {

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
        if (parts[i] < 0 || parts[i] >= map.num_parts || !map.is_alone_on(rank, parts[i]))
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
    for_each_hash({parameters, workspace, objects.points, with_positions}, parts,
                  [&](Part part, std::uint64_t hash) {
                      checksums[static_cast<std::size_t>(part - rest.own.first)] += hash;
                  });
    // A part that this rank shares with others has sums of theirs, and none of its objects here.
    const bool is_shared =
        rest.own.first < rest.own.end && !kept.map().is_alone_on(rank, rest.own.first);
    return is_shared || checksums == rest.checksums;
}

bool are_as_cut(State& state, const Objects& objects) {
    const Parameters& parameters = state.parameters;
    // Parts may have become too thin where the box of the points did.
    const bool counts = parameters.return_lists != ReturnLists::none &&
                        parameters.skip_within > 0 && parameters.options.min_width.empty();
    if (!counts || !state.rest || !state.kept) return false;
    Rest& rest = *state.rest;
    std::vector<Part> parts;
    if (!are_where_sent(rest, *state.kept, objects, state.communicator->rank(), true, parts))
        return false;
    std::ranges::fill(rest.part_weights, 0.0);
    const Part first = rest.is_spread ? rest.own.first : 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double weight = objects.points.weight(i);
        if (!(weight >= 0 && std::isfinite(weight))) return false;
        rest.part_weights[static_cast<std::size_t>(parts[i] - first)] += weight;
    }
    return true;
}

namespace {

/// Imbalance of the parts, the same on every rank; 0 where no object has weight.
double imbalance_of_all(Rest& rest, MPI_Comm comm) {
    // Each part is on one rank, so that all sums are exact, and the same on every rank.
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, rest.part_weights.data(),
                             mpi::to_int(std::ssize(rest.part_weights)), MPI_DOUBLE, MPI_SUM, comm),
               "MPI_Allreduce");
    const bool has_weight =
        std::ranges::any_of(rest.part_weights, [](double weight) { return weight > 0; });
    return has_weight ? imbalance(rest.part_weights, rest.part_sizes) : 0;
}

/// The same of parts whose weights stay on their ranks. Collective: two reductions.
double imbalance_of_own(const Rest& rest, int num_parts, MPI_Comm comm) {
    double total = std::accumulate(rest.part_weights.begin(), rest.part_weights.end(), 0.0);
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, comm), "MPI_Allreduce");
    const double sizes = rest.part_sizes.empty()
                             ? num_parts
                             : std::accumulate(rest.part_sizes.begin(), rest.part_sizes.end(), 0.0);
    double worst = 0;
    for (std::size_t k = 0; k < rest.part_weights.size(); ++k) {
        if (!(rest.part_weights[k] > 0)) continue;
        const std::size_t part = static_cast<std::size_t>(rest.own.first) + k;
        const double ideal = (rest.part_sizes.empty() ? 1 : rest.part_sizes[part]) / sizes;
        worst = std::max(worst, ideal > 0 ? rest.part_weights[k] / total / ideal
                                          : std::numeric_limits<double>::infinity());
    }
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, comm), "MPI_Allreduce");
    return worst;
}

}  // namespace

bool are_even(Rest& rest, int num_parts, double within, MPI_Comm comm) {
    const double counted =
        rest.is_spread ? imbalance_of_own(rest, num_parts, comm) : imbalance_of_all(rest, comm);
    if (!(counted > 0 && counted <= within)) return false;
    rest.report.measured_imbalance = counted;
    return true;
}

}  // namespace rrcb::zoltan
