#include "parallel/strays.hpp"

#include "particles/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace mpm {

namespace {

constexpr std::size_t block = 256;

template <int D>
using Coordinates = std::array<const double*, D>;

template <int D>
Coordinates<D> coordinates_of(const Particles& particles, const MotionColumns& motion) {
    Coordinates<D> at;
    for (std::size_t a = 0; a < D; ++a) at[a] = particles[motion.position[a]].data();
    return at;
}

/// Returns whether a point is in the box.
template <int D>
bool is_inside(const Box& box, const Coordinates<D>& at, std::size_t p) {
    for (std::size_t a = 0; a < D; ++a)
        if (!(at[a][p] >= box.lower[a] && at[a][p] <= box.upper[a])) return false;
    return true;
}

/// Returns whether all points of a block are in the box. Compares two at a time.
template <int D>
bool are_inside(const Box& box, const Coordinates<D>& at, std::size_t begin, std::size_t end) {
    PairMask inside = {-1, -1};
    std::array<Pair, D> lower, upper;
    for (std::size_t a = 0; a < D; ++a) {
        lower[a] = Pair{box.lower[a], box.lower[a]};
        upper[a] = Pair{box.upper[a], box.upper[a]};
    }
    std::size_t p = begin;
    for (; p + 2 <= end; p += 2)
        for (std::size_t a = 0; a < D; ++a) {
            const Pair here = load_pair(at[a] + p);
            inside &= (here >= lower[a]) & (here <= upper[a]);
        }
    return inside[0] && inside[1] && (p == end || is_inside<D>(box, at, p));
}

/// Throws the error about a point whose position is not finite.
[[noreturn]] void refuse(double id, const Vector& at, int dimension, double now) {
    std::ostringstream text;
    text << "point " << std::setprecision(15) << id << std::setprecision(6)
         << " has no finite position: x = " << at[0] << " m, y = " << at[1] << " m";
    if (dimension == 3) text << ", z = " << at[2] << " m";
    text << ", time = " << now << " s: lower the Courant number";
    throw std::runtime_error(text.str());
}

bool is_open(const Wall& wall) {
    return wall.kind == Wall::open;
}

}  // namespace

Strays::Strays(const GridShape& grid, const Walls& walls)
    : grid_{grid.lower, grid.upper()},
      is_open_{{{is_open(walls.left), is_open(walls.right)},
                {is_open(walls.bottom), is_open(walls.top)},
                {is_open(walls.back), is_open(walls.front)}}} {}

/// Turns a point back that is beyond the grid. Returns whether a wall has stopped it.
template <int D>
bool Strays::stays(const MotionColumns& motion, std::size_t point, Particles& particles) const {
    bool stays = true;
    for (std::size_t a = 0; a < D; ++a) {
        double& at = particles.data(motion.position[a])[point];
        const std::array side{grid_.lower[a], grid_.upper[a]};
        const std::size_t end = at > side[1] ? 1 : 0;
        if (at >= side[0] && at <= side[1]) continue;
        stays = stays && !is_open_[a][end];
        particles.data(motion.velocity[a])[point] *= -1;
        at = std::clamp(2 * side[end] - at, side[0], side[1]);
    }
    return stays;
}

template <int D>
bool Strays::remove(const Box& home, const MotionColumns& motion, double now,
                    Particles& particles) {
    lost_.clear();
    bool is_any_outside = false;
    const Coordinates<D> at = coordinates_of<D>(particles, motion);
    for (std::size_t begin = 0; begin < particles.size(); begin += block) {
        const std::size_t end = std::min(begin + block, particles.size());
        if (are_inside<D>(home, at, begin, end)) continue;
        for (std::size_t p = begin; p < end; ++p) {
            if (is_inside<D>(home, at, p)) continue;
            const Vector place = positions_of(particles, motion, D)[p];
            if (!std::isfinite(place[0] + place[1] + place[2]))
                refuse(particles[motion.id][p], place, D, now);
            if (is_inside<D>(grid_, at, p) || stays<D>(motion, p, particles))
                is_any_outside = is_any_outside || !is_inside<D>(home, at, p);
            else
                lost_.push_back(p);
        }
    }
    if (!lost_.empty()) particles.remove(lost_);
    return is_any_outside;
}

template <int D>
bool are_inside(const Box& box, const Particles& particles, const MotionColumns& motion) {
    const Coordinates<D> at = coordinates_of<D>(particles, motion);
    for (std::size_t begin = 0; begin < particles.size(); begin += block)
        if (!are_inside<D>(box, at, begin, std::min(begin + block, particles.size()))) return false;
    return true;
}

template bool Strays::remove<2>(const Box&, const MotionColumns&, double, Particles&);
template bool Strays::remove<3>(const Box&, const MotionColumns&, double, Particles&);
template bool are_inside<2>(const Box&, const Particles&, const MotionColumns&);
template bool are_inside<3>(const Box&, const Particles&, const MotionColumns&);

}  // namespace mpm
