#include "parallel/communicator_mpi.hpp"
#include "step/stepper.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

namespace mpm {

namespace {

/// Owners by the closed boxes; a position on a face is with the first of them.
Decomposition within(const std::vector<Box>& boxes) {
    const auto look_up = [boxes](Positions at, std::span<int> owners) {
        for (std::size_t p = 0; p < owners.size(); ++p)
            owners[p] = static_cast<int>(
                std::ranges::find_if(boxes, [&](const Box& box) { return contains(box, at[p]); }) -
                boxes.begin());
    };
    return {boxes, look_up, {}};
}

template <typename Numbers>
void append(const Numbers& numbers, std::vector<double>& list) {
    for (const auto number : numbers) list.push_back(static_cast<double>(number));
}

/// States of the effects that add up over the ranks, or that are the same on all.
std::vector<double> saved(const std::vector<EffectState>& states, bool is_sum) {
    std::vector<double> all;
    for (const EffectState& state : states)
        if (state.is_sum == is_sum) append(state.save(), all);
    return all;
}

void load(const std::vector<EffectState>& states, bool is_sum, std::span<const double> numbers) {
    StateSection source(numbers);
    for (const EffectState& state : states)
        if (state.is_sum == is_sum) state.load(source.take(state.save().size()));
}

}  // namespace

template <int D>
StateHead Stepper<D>::state_head() const {
    StateHead head{.columns = particles.column_names(),
                   .scene = {D, scene_.grid.spacing, static_cast<double>(num_points)},
                   .numbers = {time, time_step, max_speed, static_cast<double>(num_steps)},
                   .effects = saved(stages_.states, false),
                   .boxes = decomposition.boxes};
    append(scene_.grid.lower, head.scene);
    append(scene_.grid.num_cells, head.scene);
    head.scene.push_back(start_places.fingerprint());
    for (const Probe& probe : scene_.probes) append(probe.position, head.scene);
    return head;
}

/// What this rank alone knows: its sums, its place between two sorts, its nodes, its points.
template <int D>
std::vector<double> Stepper<D>::state_section() const {
    std::vector<double> section = saved(stages_.states, true);
    append(
        std::array{static_cast<double>(num_out_of_order_), static_cast<double>(steps_since_sort_)},
        section);
    if (stages_.carries_motion) {
        append(patch_.nodes.begin, section);
        append(patch_.nodes.count, section);
        for (std::size_t n = 0; n < patch_.motion.size(); ++n) {
            const NodeMotion<D>& node = patch_.motion[n];
            for (const auto& part : {node.velocity, node.velocity_change, node.strain_velocity})
                append(part, section);
        }
    }
    const std::size_t begin = section.size(), width = particles.column_names().size();
    section.resize(begin + particles.size() * width);
    for (std::size_t p = 0; p < particles.size(); ++p)
        particles.copy_row(p, std::span(section).subspan(begin + p * width, width));
    return section;
}

template <int D>
void Stepper<D>::write_state(const std::string& path) const {
    write_state_file(path, state_head(), state_section(), comm_);
}

/// Takes the motion of the nodes of a section that this rank has, too.
template <int D>
void Stepper<D>::read_motion(StateSection& section) {
    NodeRange<D> nodes;
    for (int& begin : nodes.begin) begin = static_cast<int>(section.next());
    for (int& count : nodes.count) count = static_cast<int>(section.next());
    visit_nodes<D>(nodes, [&](const std::array<int, D>& node) {
        const std::span<const double> motion = section.take(3 * D);
        bool is_here = !patch_.nodes.empty();
        for (std::size_t a = 0; a < D; ++a)
            is_here &= node[a] >= patch_.nodes.begin[a] &&
                       node[a] < patch_.nodes.begin[a] + patch_.nodes.count[a];
        if (!is_here) return;
        const std::size_t n = patch_.index(node);
        NodeMotion<D>& mine = patch_.motion[n];
        std::ranges::copy(motion.first(D), mine.velocity.begin());
        std::ranges::copy(motion.subspan(D, D), mine.velocity_change.begin());
        std::ranges::copy(motion.last(D), mine.strain_velocity.begin());
    });
}

/// Takes those of the points that are this rank's in a division that did not write them.
template <int D>
void Stepper<D>::take_points(std::span<const double> rows) {
    const std::size_t width = particles.column_names().size();
    for (std::size_t at = 0; at + width <= rows.size(); at += width) {
        const std::span<const double> row = rows.subspan(at, width);
        const double* const z = D == 3 ? &row[motion_.position[2]] : nullptr;
        int owner = 0;
        decomposition.owners({{&row[motion_.position[0]], 1},
                              {&row[motion_.position[1]], 1},
                              {z, D == 3 ? std::size_t{1} : 0}},
                             {&owner, 1});
        if (owner == rank_of(comm_)) particles.append(row);
    }
}

/// Takes this rank's share of the section that one rank has written.
template <int D>
void Stepper<D>::take_section(StateSection section, bool is_mine, bool is_divided_anew) {
    std::vector<double> sums = saved(stages_.states, true);
    const std::span<const double> more = section.take(sums.size());
    // Divided anew, the first rank has the sums of all.
    for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] = is_divided_anew ? sums[k] + (rank_of(comm_) == 0 ? more[k] : 0)
                                  : (is_mine ? more[k] : sums[k]);
    load(stages_.states, true, sums);
    const auto num_out_of_order = static_cast<std::size_t>(section.next());
    const int steps_since_sort = static_cast<int>(section.next());
    if (stages_.carries_motion) read_motion(section);
    if (is_divided_anew) return take_points(section.rest());
    if (!is_mine) return;
    num_out_of_order_ = num_out_of_order;
    steps_since_sort_ = steps_since_sort;
    particles.append(section.rest());
}

template <int D>
void Stepper<D>::read_state(const std::string& path) {
    StateReader reader(path, comm_);
    const StateHead mine = state_head();
    if (reader.head().columns != mine.columns || reader.head().scene != mine.scene ||
        reader.head().effects.size() != mine.effects.size() ||
        reader.head().numbers.size() != mine.numbers.size())
        throw std::runtime_error(path +
                                 ": is the state of another scene, of another grid, or of "
                                 "other bodies, materials, effects, probes or method");
    std::vector<std::size_t> all(particles.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    particles.remove(all);
    const std::size_t num_sections = reader.head().boxes.size();
    const bool is_divided_anew = num_sections != mine.boxes.size();
    if (!is_divided_anew) divide_by(within(reader.head().boxes));
    std::ranges::fill(patch_.motion, NodeMotion<D>{});
    load(stages_.states, false, reader.head().effects);
    load(stages_.states, true, std::vector<double>(saved(stages_.states, true).size(), 0.0));
    for (std::size_t k = 0; k < num_sections; ++k) {
        const std::vector<double> section = reader.next_section();
        take_section(StateSection(section), k == static_cast<std::size_t>(rank_of(comm_)),
                     is_divided_anew);
    }
    if (is_divided_anew) transfers_->sort(particles, patch_);
    time = reader.head().numbers[0];
    time_step = reader.head().numbers[1];
    max_speed = reader.head().numbers[2];
    num_steps = static_cast<std::int64_t>(reader.head().numbers[3]);
}

template StateHead Stepper<2>::state_head() const;
template StateHead Stepper<3>::state_head() const;
template std::vector<double> Stepper<2>::state_section() const;
template std::vector<double> Stepper<3>::state_section() const;
template void Stepper<2>::write_state(const std::string&) const;
template void Stepper<3>::write_state(const std::string&) const;
template void Stepper<2>::read_motion(StateSection&);
template void Stepper<3>::read_motion(StateSection&);
template void Stepper<2>::take_points(std::span<const double>);
template void Stepper<3>::take_points(std::span<const double>);
template void Stepper<2>::take_section(StateSection, bool, bool);
template void Stepper<3>::take_section(StateSection, bool, bool);
template void Stepper<2>::read_state(const std::string&);
template void Stepper<3>::read_state(const std::string&);

}  // namespace mpm
