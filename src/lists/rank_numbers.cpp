#include "lists/rank_numbers.hpp"

#include <algorithm>
#include <tuple>

namespace rrcb {

namespace {

constexpr int nowhere = -1;

/// Placement of parts on ranks, as far as it has come.
class Placement {
  public:
    explicit Placement(std::span<const RankRange> ranks_of_parts)
        : ranks_of_numbers_(ranks_of_parts),
          vacancies_(static_cast<std::size_t>(ranks_of_parts.back().first_rank) + 1, 0),
          ranks_(ranks_of_parts.size(), nowhere) {
        for (const RankRange& owner : ranks_of_numbers_)
            ++vacancies_[static_cast<std::size_t>(owner.first_rank)];
    }

    int owner_of(Part number) const {
        return ranks_of_numbers_[static_cast<std::size_t>(number)].first_rank;
    }
    int rank_of(Part part) const { return ranks_[static_cast<std::size_t>(part)]; }
    int num_parts() const { return static_cast<int>(ranks_of_numbers_.size()); }

    /// Places a part, unless it has a rank or the rank has no number left.
    void place(Part part, int rank) {
        if (rank_of(part) != nowhere || !has_vacancy(rank)) return;
        ranks_[static_cast<std::size_t>(part)] = rank;
        --vacancies_[static_cast<std::size_t>(rank)];
    }

    void place_the_rest() {
        for (Part part = 0; part < num_parts(); ++part) place(part, owner_of(part));
        int rank = 0;
        for (Part part = 0; part < num_parts(); ++part) {
            if (rank_of(part) != nowhere) continue;
            while (!has_vacancy(rank)) ++rank;
            place(part, rank);
        }
    }

  private:
    bool has_vacancy(int rank) const {
        const auto index = static_cast<std::size_t>(rank);
        return index < vacancies_.size() && vacancies_[index] > 0;
    }

    std::span<const RankRange> ranks_of_numbers_;
    std::vector<int> vacancies_;  ///< numbers left of each rank
    std::vector<int> ranks_;      ///< of each part
};

/// Parts in the order in which they take the numbers of their ranks.
std::vector<Part> numbers_of(const Placement& placement) {
    std::vector<Part> numbers(static_cast<std::size_t>(placement.num_parts()), nowhere);
    std::vector<Part> movers, left;
    for (Part part = 0; part < placement.num_parts(); ++part) {
        if (placement.rank_of(part) == placement.owner_of(part)) {
            numbers[static_cast<std::size_t>(part)] = part;
        } else {
            movers.push_back(part);
            left.push_back(part);
        }
    }
    // Numbers ascend with their ranks; so the movers, by rank, meet the numbers of their rank.
    std::ranges::stable_sort(movers, {}, [&](Part part) { return placement.rank_of(part); });
    for (std::size_t i = 0; i < movers.size(); ++i)
        numbers[static_cast<std::size_t>(movers[i])] = left[i];
    return numbers;
}

}  // namespace

std::vector<Part> numbers_by_rank(std::span<const Overlap> overlaps,
                                  std::span<const RankRange> ranks_of_parts) {
    Placement placement(ranks_of_parts);
    std::vector<Overlap> sorted;
    std::ranges::copy_if(overlaps, std::back_inserter(sorted),
                         [](const Overlap& overlap) { return overlap.count > 0; });
    std::ranges::sort(sorted, [&](const Overlap& a, const Overlap& b) {
        const bool a_moves = placement.owner_of(a.part) != a.origin;
        const bool b_moves = placement.owner_of(b.part) != b.origin;
        return std::tie(b.count, a_moves, a.part, a.origin) <
               std::tie(a.count, b_moves, b.part, b.origin);
    });
    for (const Overlap& overlap : sorted) placement.place(overlap.part, overlap.origin);
    placement.place_the_rest();
    return numbers_of(placement);
}

}  // namespace rrcb
