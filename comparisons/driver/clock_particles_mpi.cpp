#include "clock_particles_mpi.hpp"

#include "counter_random.hpp"
#include "failure.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/transfer.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace comparisons {

namespace {

constexpr double time_step = 2e-5;
constexpr double gravity = 1;
constexpr double sound = 15;       // speed in the fluid
constexpr double stiffness = 2e6;  // of grains, divided by their mass
constexpr double depth = 0.1;      // of the water
constexpr double height = 0.25;    // initial height of the pile
constexpr double top = 1.5;        // highest position of drops and loose grains

double skin(const Scene& scene) {
    return scene.spacing;
}

}  // namespace

Scene scene_of(const std::string& name, std::int64_t num_points) {
    if (name != "splash" && name != "pile") throw Failure("no scene " + name);
    const bool is_fluid = name == "splash";
    const double area = is_fluid ? depth : height / 2;
    const double spacing = std::sqrt(area / static_cast<double>(num_points));
    return {is_fluid, num_points, spacing, is_fluid ? 3 * spacing : spacing};
}

Particles::Particles(const Scene& scene, MPI_Comm comm) : scene_(scene), comm_(comm) {
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    const std::int64_t loose_every = scene.is_fluid ? 200 : 100;
    const double h = scene.spacing;
    std::int64_t k = 0;
    for (double x = h / 2; x < 1; x += h) {
        const double high = scene.is_fluid ? depth : height * (1 - std::abs(2 * x - 1));
        for (double y = h / 2; y < high; y += h, ++k) {
            if (static_cast<int>(x * num_ranks) != rank) continue;
            CounterRandom random(1, static_cast<std::uint64_t>(k));
            const bool is_loose = k % loose_every == 0;
            const double up = is_loose ? random.uniform(0.3, top) : y;
            at_.insert(at_.end(), {x + 0.05 * h * random.uniform(), up});
            const double flow = scene.is_fluid ? 0.5 * std::sin(2 * std::numbers::pi * x) : 0;
            velocities_.insert(velocities_.end(), {is_loose ? 0 : flow, is_loose ? 0.5 : 0});
        }
    }
}

double Particles::num_pairs() const {
    double sum = 0;
    for (const auto& [i, j] : pairs_) sum += j < size() ? 2 : 1;
    return sum / 2;
}

std::vector<double> Particles::rows(std::size_t width) const {
    std::vector<double> rows(size() * width);
    for (std::size_t i = 0; i < size(); ++i) rows[i * width] = 1;
    for (const auto& [i, j] : pairs_) {
        rows[i * width + 1] += 0.5;
        if (j < size()) rows[j * width + 1] += 0.5;
    }
    return rows;
}

std::size_t Particles::move(const std::vector<int>& ranks) {
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm_, &rank);
    MPI_Comm_size(comm_, &num_ranks);
    const rrcb::Plan plan = rrcb::plan(ranks, num_ranks, comm_);
    std::tie(at_, velocities_) = rrcb::transfer(
        plan, rrcb::columns(rrcb::column(at_, 2), rrcb::column(velocities_, 2)), comm_);
    pairs_.clear();
    return ranks.size() - static_cast<std::size_t>(std::ranges::count(ranks, rank));
}

void Particles::make_lists(int num_steps) {
    const double fastest = std::accumulate(
        velocities_.begin(), velocities_.end(), 0.0,
        [](double most, double velocity) { return std::max(most, std::abs(velocity)); });
    if (2 * std::sqrt(2) * fastest * time_step * num_steps > skin(scene_))
        throw Failure("particles are too fast");
    find_ghosts();
    find_pairs();
}

void Particles::find_ghosts() {
    constexpr double far = 1e300;
    std::array<double, 4> box{far, far, -far, -far};
    for (std::size_t k = 0; k < at_.size(); ++k) {
        box[k % 2] = std::min(box[k % 2], at_[k]);
        box[k % 2 + 2] = std::max(box[k % 2 + 2], at_[k]);
    }
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm_, &rank);
    MPI_Comm_size(comm_, &num_ranks);
    std::vector<double> boxes(4 * static_cast<std::size_t>(num_ranks));
    MPI_Allgather(box.data(), 4, MPI_DOUBLE, boxes.data(), 4, MPI_DOUBLE, comm_);
    const double near = scene_.reach + skin(scene_);
    sent_.clear();
    send_.assign(static_cast<std::size_t>(num_ranks), 0);
    receive_ = send_;
    for (int other = 0; other < num_ranks; ++other) {
        const double* of = boxes.data() + 4 * other;
        const std::size_t before = sent_.size();
        for (std::size_t i = 0; i < size() && other != rank; ++i)
            if (at_[2 * i] > of[0] - near && at_[2 * i] < of[2] + near &&
                at_[2 * i + 1] > of[1] - near && at_[2 * i + 1] < of[3] + near)
                sent_.push_back(i);
        send_[static_cast<std::size_t>(other)] = static_cast<int>(sent_.size() - before);
    }
    MPI_Alltoall(send_.data(), 1, MPI_INT, receive_.data(), 1, MPI_INT, comm_);
}

void Particles::fetch(std::vector<double>& values, std::size_t width) const {
    std::vector<double> buffer;
    for (const std::size_t i : sent_)
        buffer.insert(buffer.end(), &values[i * width], &values[i * width] + width);
    const auto times = [&](std::vector<int> counts) {
        for (int& count : counts) count *= static_cast<int>(width);
        return counts;
    };
    const std::vector<int> out = times(send_);
    const std::vector<int> in = times(receive_);
    std::vector<int> out_at(out.size());
    std::vector<int> in_at(in.size());
    std::exclusive_scan(out.begin(), out.end(), out_at.begin(), 0);
    std::exclusive_scan(in.begin(), in.end(), in_at.begin(), 0);
    const std::size_t local = size() * width;
    values.resize(local + static_cast<std::size_t>(in_at.back() + in.back()));
    MPI_Alltoallv(buffer.data(), out.data(), out_at.data(), MPI_DOUBLE, values.data() + local,
                  in.data(), in_at.data(), MPI_DOUBLE, comm_);
}

void Particles::find_pairs() {
    std::vector<double> all = at_;
    fetch(all, 2);
    const double width = scene_.reach + skin(scene_);
    const auto index = [&](double x) {
        return static_cast<std::size_t>(std::clamp(x, 0.0, 2.0) / width) + 1;
    };
    const std::size_t wide = index(2) + 2;
    std::vector<std::size_t> first(wide * wide + 1);
    const auto cell = [&](std::size_t i) {
        return index(all[2 * i + 1]) + wide * index(all[2 * i]);
    };
    for (std::size_t i = 0; 2 * i < all.size(); ++i) ++first[cell(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::size_t> sorted(all.size() / 2);
    std::vector<std::size_t> next = first;
    for (std::size_t i = 0; 2 * i < all.size(); ++i) sorted[next[cell(i)]++] = i;
    pairs_.clear();
    for (std::size_t i = 0; i < size(); ++i)
        for (const std::size_t row : {cell(i) - wide, cell(i), cell(i) + wide})
            for (std::size_t k = first[row - 1]; k < first[row + 2]; ++k) {
                const std::size_t j = sorted[k];
                const double x = all[2 * i] - all[2 * j];
                const double y = all[2 * i + 1] - all[2 * j + 1];
                if (i < j && x * x + y * y < width * width) pairs_.push_back({i, j});
            }
    values_.resize(2 * all.size());
}

double Particles::step() {
    values_.resize(4 * size());
    for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t a = 0; a < 2; ++a) {
            values_[4 * i + a] = at_[2 * i + a];
            values_[4 * i + 2 + a] = velocities_[2 * i + a];
        }
    fetch(values_, 4);
    double start = MPI_Wtime();
    double work = 0;
    std::vector<double> densities;
    if (scene_.is_fluid) {
        // The kernel is scaled so that a regular lattice has the density 1.
        densities.assign(size(), 1);
        for (const auto& [i, j] : pairs_) {
            const double x = values_[4 * i] - values_[4 * j];
            const double y = values_[4 * i + 1] - values_[4 * j + 1];
            const double rest = 1 - (x * x + y * y) / (scene_.reach * scene_.reach);
            if (rest <= 0) continue;
            const double density = rest * rest * rest;
            densities[i] += density;
            if (j < size()) densities[j] += density;
        }
        const double factor = 4 / (std::numbers::pi * std::pow(scene_.reach / scene_.spacing, 2));
        for (double& density : densities) density *= factor;
        work += MPI_Wtime() - start;
        fetch(densities, 1);
        start = MPI_Wtime();
    }
    std::vector<double> forces(values_.size() / 2);
    push(forces, densities);
    go_on(forces);
    return work + MPI_Wtime() - start;
}

void Particles::push(std::vector<double>& forces, const std::vector<double>& densities) const {
    const double r = scene_.reach;
    const double slope = 24 * std::pow(scene_.spacing, 2) / (std::numbers::pi * std::pow(r, 4));
    // Negative pressures are cut off: the water does not pull.
    const auto pressure = [&](double rho) {
        return sound * sound * std::max(0.0, rho - 1) / (rho * rho);
    };
    for (const auto& [i, j] : pairs_) {
        const double* a = &values_[4 * i];
        const double* b = &values_[4 * j];
        const double x[] = {a[0] - b[0], a[1] - b[1]};
        const double distance = std::sqrt(x[0] * x[0] + x[1] * x[1]);
        if (distance >= r || distance == 0) continue;
        const double apart = ((a[2] - b[2]) * x[0] + (a[3] - b[3]) * x[1]) / distance;
        double force = 0;  // force divided by the distance
        if (scene_.is_fluid) {
            const double rest = 1 - distance * distance / (r * r);
            const double viscous = apart < 0 ? -0.2 * sound * apart : 0;
            force =
                slope * rest * rest * (pressure(densities[i]) + pressure(densities[j]) + viscous);
        } else {
            force = (stiffness * (r - distance) - 0.3 * std::sqrt(stiffness) * apart) / distance;
        }
        for (std::size_t axis = 0; axis < 2; ++axis) {
            forces[2 * i + axis] += force * x[axis];
            forces[2 * j + axis] -= force * x[axis];
        }
    }
}

void Particles::go_on(const std::vector<double>& forces) {
    for (std::size_t k = 0; k < at_.size(); ++k) {
        const bool is_up = k % 2 == 1;
        velocities_[k] += time_step * (forces[k] - (is_up ? gravity : 0));
        at_[k] += time_step * velocities_[k];
        const bool is_out = at_[k] < 0 || (!is_up && at_[k] > 1);
        if (!is_out) continue;
        at_[k] = at_[k] < 0 ? -at_[k] : 2 - at_[k];
        velocities_[k] *= -0.5;
    }
}

}  // namespace comparisons
