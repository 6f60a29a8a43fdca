#include "arms_mpi.hpp"
#include "failure.hpp"

#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace comparisons {

namespace {

enum Tag : int { leavers, ghosts, forces };

/// A rank whose box is near this rank's box, and the buffers of its messages.
struct Neighbour {
    int rank;
    rrcb::Box box;
    std::vector<double> rows{};         ///< rows to send
    std::vector<std::uint32_t> sent{};  ///< local points that are ghosts there
    std::size_t num_ghosts = 0;         ///< number of ghosts from there
};

template <std::size_t dimension>
class ByHand {
  public:
    explicit ByHand(const Flow& flow) : comm_(flow.comm()), radius_(flow.radius()) {
        home_ = quiet_ = rrcb::box_of(flow.cuts(), flow.rank());
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            quiet_.lower[axis] += radius_;
            quiet_.upper[axis] -= radius_;
        }
        const double reach = std::max(flow.radius(), flow.travel());
        for (int other = 0; other < flow.num_ranks(); ++other) {
            const rrcb::Box box = rrcb::box_of(flow.cuts(), other);
            if (other != flow.rank() && are_near(home_, box, reach))
                neighbours_.push_back({other, box});
        }
        requests_.resize(neighbours_.size());
    }

    /// Sends each point that has left the box to the rank whose box contains it. The last points
    /// fill the gaps.
    void migrate(Particles& p) {
        for (Neighbour& neighbour : neighbours_) neighbour.rows.clear();
        std::size_t count = p.size();
        for (std::size_t i = 0; i < count;) {
            if (has(home_, &p.x[i * dimension])) {
                ++i;
                continue;
            }
            pack(p, i, owner_of(&p.x[i * dimension]).rows);
            --count;
            for (std::size_t a = 0; a < dimension; ++a) {
                p.x[i * dimension + a] = p.x[count * dimension + a];
                p.v[i * dimension + a] = p.v[count * dimension + a];
            }
            p.ids[i] = p.ids[count];
        }
        resize(count, p.x, p.v, p.ids);
        send_rows(leavers);
        for (const Neighbour& neighbour : neighbours_) {
            const std::size_t arriving = receive(neighbour, leavers) / row;
            resize(count + arriving, p.x, p.v, p.ids);
            unpack(arriving, count, p.x, p.v, p.ids);
            count += arriving;
        }
        wait();
    }

    /// Finds the points within the radius of each neighbour's box.
    void find_ghosts(const Particles& p) {
        for (Neighbour& neighbour : neighbours_) neighbour.sent.clear();
        const std::size_t count = p.size();
        for (std::size_t i = 0; i < count; ++i) {
            const double* x = &p.x[i * dimension];
            if (has(quiet_, x)) continue;
            for (Neighbour& neighbour : neighbours_)
                if (is_within(radius_, neighbour.box, x))
                    neighbour.sent.push_back(static_cast<std::uint32_t>(i));
        }
    }

    void fetch(Particles& p) {
        for (Neighbour& neighbour : neighbours_) {
            neighbour.rows.clear();
            for (const std::uint32_t i : neighbour.sent) pack(p, i, neighbour.rows);
        }
        send_rows(ghosts);
        std::size_t count = 0;
        for (Neighbour& neighbour : neighbours_) {
            neighbour.num_ghosts = receive(neighbour, ghosts) / row;
            resize(count + neighbour.num_ghosts, p.ghost_x, p.ghost_v, p.ghost_ids);
            unpack(neighbour.num_ghosts, count, p.ghost_x, p.ghost_v, p.ghost_ids);
            count += neighbour.num_ghosts;
        }
        resize(count, p.ghost_x, p.ghost_v, p.ghost_ids);
        wait();
    }

    /// Adds the forces on ghosts to those on their points, by ascending rank.
    void accumulate(Particles& p) {
        const double* next = p.ghost_forces.data();
        for (std::size_t k = 0; k < neighbours_.size(); ++k) {
            const std::size_t length = neighbours_[k].num_ghosts * dimension;
            MPI_Isend(next, static_cast<int>(length), MPI_DOUBLE, neighbours_[k].rank, forces,
                      comm_, &requests_[k]);
            next += length;
        }
        for (const Neighbour& neighbour : neighbours_) {
            receive(neighbour, forces);
            const double* force = received_.data();
            for (const std::uint32_t i : neighbour.sent)
                for (std::size_t a = 0; a < dimension; ++a) p.forces[i * dimension + a] += *force++;
        }
        wait();
    }

  private:
    static constexpr std::size_t row = 2 * dimension + 1;

    static bool are_near(const rrcb::Box& a, const rrcb::Box& b, double reach) {
        for (std::size_t axis = 0; axis < dimension; ++axis)
            if (a.lower[axis] - b.upper[axis] > reach || b.lower[axis] - a.upper[axis] > reach)
                return false;
        return true;
    }

    static bool has(const rrcb::Box& box, const double* x) {
        for (std::size_t axis = 0; axis < dimension; ++axis)
            if (!(x[axis] >= box.lower[axis] && x[axis] < box.upper[axis])) return false;
        return true;
    }

    static bool is_within(double radius, const rrcb::Box& box, const double* x) {
        double square = 0;
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            const double apart =
                std::max({box.lower[axis] - x[axis], x[axis] - box.upper[axis], 0.0});
            square += apart * apart;
        }
        return square <= radius * radius;
    }

    Neighbour& owner_of(const double* x) {
        for (Neighbour& neighbour : neighbours_)
            if (has(neighbour.box, x)) return neighbour;
        throw Failure("a point passed all neighbours");
    }

    static void pack(const Particles& p, std::size_t i, std::vector<double>& rows) {
        const std::size_t at = rows.size();
        rows.resize(at + row);
        double* to = &rows[at];
        for (std::size_t a = 0; a < dimension; ++a) to[a] = p.x[i * dimension + a];
        for (std::size_t a = 0; a < dimension; ++a) to[dimension + a] = p.v[i * dimension + a];
        to[2 * dimension] = std::bit_cast<double>(p.ids[i]);
    }

    /// Writes the received rows behind the first `begin` points.
    void unpack(std::size_t count, std::size_t begin, std::vector<double>& x,
                std::vector<double>& v, std::vector<std::int64_t>& ids) const {
        const double* from = received_.data();
        for (std::size_t i = begin; i < begin + count; ++i, from += row) {
            for (std::size_t a = 0; a < dimension; ++a) x[i * dimension + a] = from[a];
            for (std::size_t a = 0; a < dimension; ++a) v[i * dimension + a] = from[dimension + a];
            ids[i] = std::bit_cast<std::int64_t>(from[2 * dimension]);
        }
    }

    static void resize(std::size_t count, std::vector<double>& x, std::vector<double>& v,
                       std::vector<std::int64_t>& ids) {
        x.resize(count * dimension);
        v.resize(count * dimension);
        ids.resize(count);
    }

    void send_rows(Tag tag) {
        for (std::size_t k = 0; k < neighbours_.size(); ++k) {
            const std::vector<double>& rows = neighbours_[k].rows;
            MPI_Isend(rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, neighbours_[k].rank,
                      tag, comm_, &requests_[k]);
        }
    }

    /// Receives a message into received_. Returns its length.
    std::size_t receive(const Neighbour& neighbour, Tag tag) {
        MPI_Status status;
        MPI_Probe(neighbour.rank, tag, comm_, &status);
        int length = 0;
        MPI_Get_count(&status, MPI_DOUBLE, &length);
        if (received_.size() < static_cast<std::size_t>(length))
            received_.resize(static_cast<std::size_t>(length));
        MPI_Recv(received_.data(), length, MPI_DOUBLE, neighbour.rank, tag, comm_,
                 MPI_STATUS_IGNORE);
        return static_cast<std::size_t>(length);
    }

    void wait() {
        MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    }

    MPI_Comm comm_;
    double radius_;
    rrcb::Box home_{};   ///< box of this rank
    rrcb::Box quiet_{};  ///< the part of the box whose points no neighbour needs
    std::vector<Neighbour> neighbours_{};
    std::vector<double> received_{};
    std::vector<MPI_Request> requests_{};
};

template <std::size_t dimension>
Arm arm_of(const Flow& flow) {
    const auto step = std::make_shared<ByHand<dimension>>(flow);
    return {{"migrate", [=](Particles& p) { step->migrate(p); }},
            {"find_ghosts", [=](const Particles& p) { step->find_ghosts(p); }},
            {"fetch", [=](Particles& p) { step->fetch(p); }},
            {"accumulate", [=](Particles& p) { step->accumulate(p); }}};
}

}  // namespace

Arm by_hand(const Flow& flow) {
    return flow.dimension() == 2 ? arm_of<2>(flow) : arm_of<3>(flow);
}

}  // namespace comparisons
