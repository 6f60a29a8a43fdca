#include "hilbert_counts_mpi.hpp"

#include "failure_mpi.hpp"
#include "method.hpp"

#include <rrcb/points.hpp>

#include <zoltan.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace comparisons {

namespace {

using Key = std::uint64_t;

/// Cells that hold more than this share of the mean part are divided.
constexpr double most_of_a_part = 0.01;

/// Returns the number of bits per axis in a key.
constexpr int key_bits(int dimension) {
    return dimension == 2 ? 31 : 21;
}

/// A section of the curve: the keys first ... first + size - 1.
struct Cell {
    Key first = 0;
    Key size = 0;
    double weight = 0;
};

/// The keys of this rank in ascending order, and the weight of all keys before each.
struct SortedKeys {
    std::vector<Key> keys;
    std::vector<double> before;

    double weight_of(const Cell& cell) const {
        const auto place = [&](Key key) {
            return before[static_cast<std::size_t>(std::ranges::lower_bound(keys, key) -
                                                   keys.begin())];
        };
        return place(cell.first + cell.size) - place(cell.first);
    }
};

SortedKeys sorted(const std::vector<Key>& keys, const rrcb::Points& points) {
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return keys[i]; });
    SortedKeys result{{}, {0}};
    for (const std::size_t i : order) {
        result.keys.push_back(keys[i]);
        result.before.push_back(result.before.back() + points.weight(i));
    }
    return result;
}

/// Computes the weight of each cell on all ranks.
void count(std::vector<Cell>& cells, const SortedKeys& keys, MPI_Comm comm) {
    std::vector<double> weights(cells.size());
    std::ranges::transform(cells, weights.begin(),
                           [&](const Cell& c) { return keys.weight_of(c); });
    MPI_Allreduce(MPI_IN_PLACE, weights.data(), static_cast<int>(weights.size()), MPI_DOUBLE,
                  MPI_SUM, comm);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i].weight = weights[i];
}

/// Returns the cells of the curve in its order. Heavy cells have been divided as far as possible.
std::vector<Cell> counted_cells(const SortedKeys& keys, int dimension, MPI_Comm comm) {
    std::vector<Cell> fresh = {{0, Key{1} << (key_bits(dimension) * dimension), 0}};
    std::vector<Cell> done;
    double most = 0;
    while (!fresh.empty()) {
        count(fresh, keys, comm);
        if (done.empty() && fresh.size() == 1)
            most = fresh[0].weight / size_of(comm) * most_of_a_part;
        std::vector<Cell> next;
        for (const Cell& cell : fresh) {
            if (cell.weight <= most || cell.size == 1) {
                done.push_back(cell);
                continue;
            }
            const Key size = cell.size >> dimension;
            for (Key first = cell.first; first < cell.first + cell.size; first += size)
                next.push_back({first, size, 0});
        }
        fresh = std::move(next);
    }
    std::ranges::sort(done, {}, &Cell::first);
    return done;
}

/// Returns the first key of each part except the first part. Each is the cell nearest to the even
/// share.
std::vector<Key> cut_keys(const std::vector<Cell>& cells, int num_parts) {
    double total = 0;
    for (const Cell& cell : cells) total += cell.weight;
    std::vector<Key> cuts;
    double below = 0;
    auto cell = cells.begin();
    for (int part = 1; part < num_parts; ++part) {
        const double wanted = total * part / num_parts;
        while (cell != cells.end() && below + cell->weight / 2 < wanted) below += (cell++)->weight;
        cuts.push_back(cell == cells.end() ? ~Key{0} : cell->first);
    }
    return cuts;
}

class HilbertCounts : public Partitioner {
  public:
    HilbertCounts(const Workload& workload, MPI_Comm comm) : workload_(workload), comm_(comm) {}

    int partition() override {
        const rrcb::Points points = workload_.points();
        const int dimension = workload_.dimension;
        const rrcb::Box box = joined_box(rrcb::bounding_box(points), comm_);
        std::vector<Key> keys(points.count);
        for (std::size_t i = 0; i < points.count; ++i)
            keys[i] = hilbert_cell(box, points.position(i), dimension, key_bits(dimension));
        const std::vector<Cell> cells = counted_cells(sorted(keys, points), dimension, comm_);
        const std::vector<Key> cuts = cut_keys(cells, size_of(comm_));
        parts_.resize(keys.size());
        std::ranges::transform(keys, parts_.begin(), [&](Key key) {
            return static_cast<int>(std::ranges::upper_bound(cuts, key) - cuts.begin());
        });
        return ZOLTAN_OK;
    }

    std::vector<int> parts() const override { return parts_; }
    std::string function() const override { return hilbert_counts; }

  private:
    const Workload& workload_;
    MPI_Comm comm_;
    std::vector<int> parts_;
};

}  // namespace

std::unique_ptr<Partitioner> make_hilbert_counts(const Workload& workload, MPI_Comm comm) {
    return std::make_unique<HilbertCounts>(workload, comm);
}

}  // namespace comparisons
