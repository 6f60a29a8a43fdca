#include "refinement/level_search_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "refinement/sample.hpp"

#include <algorithm>
#include <numeric>

namespace rrcb {

namespace {

bool is_counting(const CutSearch& search) {
    return search.stage < CutSearch::gathering;
}

bool is_sampling(const CutSearch& search) {
    return search.stage == CutSearch::sampling;
}

bool is_gathering(const CutSearch& search) {
    return search.stage == CutSearch::gathering;
}

bool is_over(const CutSearch& search) {
    return search.stage > CutSearch::gathering;
}

}  // namespace

LevelSearch::LevelSearch(std::size_t most, const HistogramLayout& layout, int dimension,
                         bool is_root)
    : dimension_(dimension),
      is_root_(is_root),
      histograms_(layout, most, is_root),
      candidates_(dimension) {
    nodes_.reserve(most);
    places_.reserve(most);
    searches_.reserve(most);
    before_.reserve(most);
    targets_.reserve(most);
    local_.reserve(most);
    samples_.reserve(most);
}

void LevelSearch::clear() {
    nodes_.clear();
    places_.clear();
    searches_.clear();
    targets_.clear();
    local_.clear();
}

void LevelSearch::add(const Node& node, const CutSearch& start, const Places& places,
                      const SortedPoints& points) {
    nodes_.push_back(&node);
    places_.push_back(places);
    searches_.push_back(start);
    targets_.emplace_back();
    local_.emplace_back(node.fragments, points);
}

int LevelSearch::run(const TargetRule& rule, Participant& self) {
    int rounds = 0;
    // The searches are the same on all ranks, and so are their number and stages: these alone tell
    // which messages a round has. In each round every search narrows the range of its cut, or ends.
    for (; !std::ranges::all_of(searches_, is_over); ++rounds) {
        before_ = searches_;
        count_and_decide(rule, self);
        gather_and_decide(self);
        if (is_root_) conclude(self);
        mpi::broadcast(std::as_writable_bytes(std::span(searches_)), root, self.comm);
        if (searches_[0].stage == CutSearch::abandoned) fail_together(some_rank, self);
        follow(self);
    }
    return rounds;
}

void LevelSearch::count_and_decide(const TargetRule& rule, Participant& self) {
    histograms_.clear();
    samples_.clear();
    for (std::size_t k = 0; k < searches_.size(); ++k)
        if (is_counting(searches_[k])) count(k, self);
    if (histograms_.size() == 0) return;
    histograms_.join(root, self.comm);
    if (!is_root_) return;
    if (histograms_.any_failed()) self.hear_of(some_rank);
    std::size_t next = 0;
    self.attempt([&] {
        for (std::size_t k = 0; k < searches_.size(); ++k)
            if (is_counting(before_[k])) decide_counted(k, histograms_.joined(next++), rule);
    });
}

/// Makes this rank's histogram or sample for search number `k`.
void LevelSearch::count(std::size_t k, Participant& self) {
    const CutSearch& search = searches_[k];
    if (is_sampling(search)) samples_.push_back(histograms_.size());
    const std::span<double> histogram = histograms_.add();
    if (is_sampling(search)) {
        const std::span<double> sample = clear_to_sample(dimension_, histogram);
        local_[k].add_candidates(mpi::rank_of(self.comm), sample);
    } else {
        self.attempt([&] { local_[k].count(search, histograms_.layout(), histogram); });
    }
    if (self.failed()) mark_failed(histogram);
}

/// Decides at the root on search number `k`, by its joined histogram.
void LevelSearch::decide_counted(std::size_t k, std::span<const double> histogram,
                                 const TargetRule& rule) {
    CutSearch& search = searches_[k];
    const HistogramLayout& layout = histograms_.layout();
    if (is_sampling(search)) {
        search.stage = CutSearch::over_splitters;
    } else if (search.stage == CutSearch::over_splitters) {
        decide_by_splitters(search, targets_[k], layout, local_[k].splitters(), histogram);
    } else {
        const auto weights = histogram.subspan(layout.num_extents, layout.num_slots());
        // What the node weighs is known when all of it has been counted.
        if (search.stage == CutSearch::over_fragments) {
            targets_[k] =
                rule.target_of(nodes_[k]->at, std::accumulate(weights.begin(), weights.end(), 0.0),
                               nodes_[k]->below);
            targets_[k].places = places_[k];
        }
        decide_by_bins(search, targets_[k], layout, histogram);
    }
}

void LevelSearch::gather_and_decide(Participant& self) {
    if (std::ranges::none_of(before_, is_gathering)) return;
    candidates_.clear();
    self.attempt([&] {
        for (std::size_t k = 0; k < before_.size(); ++k)
            if (is_gathering(before_[k])) candidates_.add(k, local_[k]);
    });
    if (self.failed()) candidates_.mark_failed();
    candidates_.gather(root, self.comm);
    if (!is_root_) return;
    if (candidates_.any_failed()) self.hear_of(some_rank);
    self.attempt([&] {
        const auto lists = candidates_.lists(before_.size());
        for (std::size_t k = 0; k < before_.size(); ++k)
            if (is_gathering(before_[k]))
                decide_among(searches_[k], targets_[k], lists[k], dimension_);
    });
}

/// Ends the round at the root. It makes room for the candidates before others send them, and
/// abandons all searches where a rank can't go on.
void LevelSearch::conclude(Participant& self) {
    const GlobalCount num_points = limit_gathering(searches_, targets_);
    self.attempt([&] { candidates_.expect(num_points, mpi::size_of(self.comm)); });
    if (self.can_go_on()) return;
    for (CutSearch& search : searches_) search.stage = CutSearch::abandoned;
}

/// Follows the decisions of the root on this rank. Collective where it has found splitters.
void LevelSearch::follow(Participant& self) {
    histograms_.broadcast_samples(samples_, root, self.comm);
    self.attempt([&] {
        std::size_t next = 0;
        for (std::size_t k = 0; k < local_.size(); ++k) {
            if (is_sampling(before_[k]))
                local_[k].take_splitters(
                    splitters_of(positions_in(histograms_.sample(next++), dimension_),
                                 order_of(searches_[k]), histograms_.layout()));
            local_[k].keep_chosen(before_[k], searches_[k], histograms_.layout());
        }
    });
}

}  // namespace rrcb
