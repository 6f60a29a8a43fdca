#pragma once

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb::test {

/// A simulation of points that drift, the same on every rank.
struct NeighbourCase {
    unsigned seed = 1;
    int dimension = 2;
    std::size_t num_points = 600;  ///< of all ranks
    int num_parts = 0;             ///< 0: one for each rank
    double radius = 0.1;
    double travel = 0.02;
    bool has_radii = false;
    bool is_periodic = false;
    bool has_lattice = false;  ///< many coincident points
    bool has_boxes = false;    ///< the boxes of the parts are given, not the cuts
    bool turns_parts = false;  ///< parts on other ranks than ranks_of_part() says
    Needs needs = Needs::scatter;
    int num_steps = 4;
};

inline std::string text_of(const NeighbourCase& input) {
    return "seed " + std::to_string(input.seed) + ", dimension " + std::to_string(input.dimension) +
           ", points " + std::to_string(input.num_points) + ", parts " +
           std::to_string(input.num_parts) + ", radius " + std::to_string(input.radius) +
           ", travel " + std::to_string(input.travel) + ", radii " +
           std::to_string(input.has_radii) + ", periodic " + std::to_string(input.is_periodic) +
           ", lattice " + std::to_string(input.has_lattice) + ", boxes " +
           std::to_string(input.has_boxes) + ", turned " + std::to_string(input.turns_parts) +
           ", needs " + std::to_string(static_cast<int>(input.needs));
}

/// Points of a rank that drift in the unit cube.
template <class T>
class NeighbourRun {
  public:
    explicit NeighbourRun(const NeighbourCase& input) : input_(input), dim_(input.dimension) {
        const std::vector<double> all =
            uniform_cloud(input.num_points, input.dimension, input.seed);
        // Every rank knows the points and balances alone.
        std::vector<T> places(all.begin(), all.end());
        if (input.has_lattice)
            for (T& x : places) x = std::floor(x * 4) / 4;
        Options options;
        options.num_parts = input.num_parts == 0 ? num_ranks() : input.num_parts;
        if (input.has_lattice) options.expert.coincident = Coincident::divide;
        const Balance whole = balance(Points(places, input.dimension), MPI_COMM_SELF, options);
        cuts_ = whole.cuts;
        for (Part part = 0; part < cuts_.num_parts; ++part)
            ranks_.push_back(input.turns_parts ? RankRange{(part * 7 + 3) % num_ranks(), 1}
                                               : ranks_of_part(part, cuts_.num_parts, num_ranks()));
        for (std::size_t i = 0; i < input.num_points; ++i) {
            const RankRange ranks = ranks_[static_cast<std::size_t>(whole.parts[i])];
            if (ranks.first_rank + static_cast<int>(i) % ranks.count != rank()) continue;
            ids_.push_back(static_cast<std::int64_t>(i));
            for (std::size_t a = 0; a < dim_; ++a) x_.push_back(places[dim_ * i + a]);
        }
    }

    NeighbourOptions options() const {
        NeighbourOptions options{.cutoff = input_.radius, .travel = input_.travel};
        if (input_.is_periodic) options.periodic = box();
        if (input_.turns_parts) options.ranks_of_parts = ranks_;
        options.needs = input_.needs;
        return options;
    }

    Neighbours neighbours() const {
        if (!input_.has_boxes) return Neighbours(cuts_, MPI_COMM_WORLD, options());
        std::vector<Box> boxes;
        for (Part part = 0; part < cuts_.num_parts; ++part) boxes.push_back(box_of(cuts_, part));
        return Neighbours(boxes, input_.dimension, MPI_COMM_WORLD, options());
    }

    /// Steps, each compared with the collective functions. Returns the first difference.
    std::string run() {
        Neighbours neighbours = this->neighbours();
        std::string fault;
        for (int step = 0; step < input_.num_steps && fault.empty(); ++step) {
            if (step > 0) drift(step);
            neighbours.migrate(column(x_, dim_), ids_);
            fault = fault_of_owners();
            if (fault.empty()) fault = fault_of_ghosts(neighbours, step);
            if (largest(fault.empty() ? 0 : 1) != 0 && fault.empty()) fault = "other ranks failed";
        }
        return fault;
    }

    Box box() const { return {{0, 0, 0}, {1, 1, 1}}; }
    std::vector<T>& x() { return x_; }
    std::vector<std::int64_t>& ids() { return ids_; }
    const Cuts& cuts() const { return cuts_; }
    std::size_t dim() const { return dim_; }

    void drift(int step) {
        for (std::size_t i = 0; i < ids_.size(); ++i) {
            std::mt19937_64 engine(input_.seed * 7919 + static_cast<unsigned>(step) * 104729 +
                                   static_cast<unsigned>(ids_[i]));
            for (std::size_t a = 0; a < dim_; ++a) {
                T& x = x_[i * dim_ + a];
                x = static_cast<T>(x + uniform(engine, -0.57, 0.57) * input_.travel);
                if (input_.has_lattice) x = std::floor(x * 4) / 4;
                if (input_.is_periodic) x = static_cast<T>(x - std::floor(x));
                if (!input_.is_periodic) x = std::clamp(x, T(0), T(1));
            }
        }
    }

  private:
    Points points() const { return Points(x_, input_.dimension); }

    std::string fault_of_owners() const {
        for (std::size_t i = 0; i < ids_.size(); ++i) {
            const Part part = part_of(cuts_, points().position(i));
            const RankRange ranks = ranks_[static_cast<std::size_t>(part)];
            if (!ranks.contains(rank()) && !input_.has_lattice)
                return "point " + std::to_string(ids_[i]) + " is on a wrong rank";
        }
        std::int64_t sums[2]{static_cast<std::int64_t>(ids_.size()),
                             std::accumulate(ids_.begin(), ids_.end(), std::int64_t{0})};
        MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
        const auto n = static_cast<std::int64_t>(input_.num_points);
        return sums[0] == n && sums[1] == n * (n - 1) / 2 ? "" : "points are lost or doubled";
    }

    std::vector<double> radii() const {
        std::vector<double> radii;
        for (const std::int64_t id : ids_)
            radii.push_back(input_.radius * static_cast<double>(id % 7 == 0 ? 8 : id % 5) / 8);
        return radii;
    }

    std::string fault_of_ghosts(Neighbours& neighbours, int step) {
        const std::vector<double> radii = this->radii();
        GhostOptions same;
        if (input_.has_radii)
            same.cutoff = radii;
        else
            same.cutoff = input_.radius;
        if (input_.is_periodic) same.periodic = box();
        if (input_.turns_parts) same.ranks_of_parts = ranks_;
        same.needs = input_.needs;
        Cuts cuts = cuts_;
        cuts = unstamped(cuts);
        const GhostPlan plan = ghost_plan(cuts, points(), MPI_COMM_WORLD, same);
        if (input_.has_radii)
            neighbours.find_ghosts(column(x_, dim_), radii);
        else
            neighbours.find_ghosts(column(x_, dim_));
        for (int repeat = 0; repeat < 2; ++repeat) {
            neighbours.fetch(ghosts_of(ghost_x_, ghost_ids_), column(x_, dim_), ids_);
            const std::string fault = difference(plan, neighbours.ghost_plan());
            if (!fault.empty()) return fault + " in step " + std::to_string(step);
        }
        if (ghost_x_ != fetch(plan, column(x_, dim_), MPI_COMM_WORLD)) return "other positions";
        if (ghost_ids_ != fetch(plan, ids_, MPI_COMM_WORLD)) return "other ids";
        std::vector<float> of_ghosts;
        for (const std::int64_t id : ghost_ids_)
            of_ghosts.push_back(0.1F * static_cast<float>(id + rank()));
        std::vector<float> sums(ids_.size(), 0.5F);
        const std::vector<float> expected = accumulate(plan, of_ghosts, sums, MPI_COMM_WORLD);
        std::vector<std::int64_t> numbers(2 * ids_.size(), 1);
        std::vector<std::int64_t> of_ghosts_numbers(2 * ghost_ids_.size(), 3);
        neighbours.accumulate(ghosts_of(of_ghosts, of_ghosts_numbers), sums, column(numbers, 2));
        if (sums != expected) return "other sums";
        std::vector<std::int64_t> counts(ids_.size() * 2, 1);
        for (const LocalIndex i : plan.send_indices) counts[2 * i] += 3, counts[2 * i + 1] += 3;
        return numbers == counts ? "" : "other sums of numbers";
    }

    static std::string difference(const GhostPlan& a, const GhostPlan& b) {
        const auto are_equal = [](const std::vector<RankCount>& one,
                                  const std::vector<RankCount>& other) {
            return std::ranges::equal(one, other, [](const RankCount& x, const RankCount& y) {
                return x.rank == y.rank && x.count == y.count;
            });
        };
        if (a.num_points != b.num_points) return "another number of points";
        if (!are_equal(a.send, b.send)) return "other numbers to send";
        if (a.send_indices != b.send_indices) return "other points to send";
        if (!are_equal(a.receive, b.receive)) return "other numbers to receive";
        return a.shifts == b.shifts ? "" : "other shifts";
    }

    NeighbourCase input_;
    std::size_t dim_;
    Cuts cuts_;
    std::vector<RankRange> ranks_;
    std::vector<T> x_;
    std::vector<std::int64_t> ids_;
    std::vector<T> ghost_x_;
    std::vector<std::int64_t> ghost_ids_;
};

}  // namespace rrcb::test
