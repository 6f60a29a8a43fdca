#include "c/columns.hpp"
#include "c/domain.hpp"
#include "c/handle_mpi.hpp"
#include "lists/neighbours_state_mpi.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>

struct rrcb_neighbours {
    static constexpr const char* name = "neighbours";
    MPI_Comm comm = MPI_COMM_NULL;
    std::optional<rrcb::Neighbours> all{};
};

namespace rrcb::c {

namespace {

using Access = detail::NeighbourAccess;

/// Options of a call, and the memory that they borrow.
struct KeptNeighbourOptions {
    NeighbourOptions options{};
    std::vector<RankRange> ranks{};

    void read(const rrcb_neighbour_options* from, const rrcb_balancer& own) {
        const rrcb_neighbour_options given = copy_in(from, "options");
        if (given.cutoff == 0 && given.travel == 0)
            reject("cutoff and travel are both 0; give one of them");
        options.cutoff = given.cutoff;
        options.travel = given.travel;
        options.needs = static_cast<Needs>(given.needs);
        read_domain(given, options, ranks, own);
    }
};

std::unique_ptr<rrcb_neighbours> make(const rrcb_balancer& own, const rrcb_neighbour_options* given,
                                      rrcb_neighbours** neighbours) {
    KeptNeighbourOptions kept;
    const auto check = [&] {
        require_cuts(own);
        kept.read(given, own);
    };
    std::unique_ptr<rrcb_neighbours> made;
    {
        Participant self = mpi::enter(own.comm, CallName::neighbours);
        made = make_handle(self, neighbours, {}, check);
        self.throw_failed_message();
    }
    made->comm = own.comm;
    made->all.emplace(own.cuts, own.comm, kept.options);
    return made;
}

/// Runs a call with neighbours. If its arguments cannot be read, the call fails on the neighbours
/// too.
template <class Read, class Body>
int with_neighbours(CallName call, rrcb_neighbours* handle, Read&& read, Body&& body) noexcept {
    return guarded(handle, [&](rrcb_neighbours& own) {
        const Failure failure = attempt([&] { read(own); });
        if (failure.failed) Access::fail(*own.all, call, failure);
        body(*own.all);
    });
}

/// An array of the caller, and a copy of it.
struct HeldArray {
    rrcb_array now;
    rrcb_array* place;
};

/// Returns the arrays passed to a call.
std::vector<HeldArray> held_arrays(rrcb_array* arrays, std::size_t count, const char* name) {
    std::vector<HeldArray> held;
    auto* place = reinterpret_cast<std::byte*>(arrays);
    for (const rrcb_array& array : copy_all_in(arrays, count, name)) {
        held.push_back({array, reinterpret_cast<rrcb_array*>(place)});
        place += array.size;
    }
    return held;
}

std::size_t bytes_of_point(const rrcb_array& array) {
    std::size_t bytes = 0;
    visit_type(array.type, [&]<class T>(T) { bytes = array.components * sizeof(T); });
    return bytes;
}

/// Resizes an array of the caller for another number of values, and returns its memory.
std::byte* resize(void* given, std::size_t num_values) {
    auto& [array, place] = *static_cast<HeldArray*>(given);
    const std::size_t count = num_values / array.components;
    void* moved = array.values;
    if (array.resize != nullptr) {
        if (count != array.count) moved = array.resize(array.owner, count);
    } else if (count > array.capacity) {
        const std::size_t capacity = std::max(count, array.capacity + array.capacity / 2);
        moved = std::realloc(array.values, capacity * bytes_of_point(array));
        if (moved != nullptr) array.capacity = capacity;
    }
    if (moved == nullptr && count > 0) throw std::bad_alloc();
    array.values = moved;
    array.count = count;
    copy_out(array, place);
    return static_cast<std::byte*>(moved);
}

void require_array(const rrcb_array& array, std::size_t k) {
    const std::string which = "array " + std::to_string(k) + " (the first is 0)";
    if (array.components == 0)
        reject("components of " + which +
               " is 0; leave it out (in Fortran: let it take an array before)");
    if (array.count > 0 && array.values == nullptr) reject("values of " + which + " is null");
    if (array.resize == nullptr && array.capacity < array.count)
        reject("capacity of " + which +
               " is below its count; set it to the points that values has "
               "room for");
}

/// Returns columns of `num_points` points at the addresses `from`, or at the arrays' own addresses.
/// The arrays are also their results.
std::vector<detail::ByteColumn> arrays_in(std::span<HeldArray> arrays, const void* const* from,
                                          LocalIndex num_points) {
    std::vector<detail::ByteColumn> columns;
    for (HeldArray& held : arrays) {
        const rrcb_array& array = held.now;
        require_array(array, columns.size());
        const auto is_same = [&](const HeldArray& other) {
            return other.now.values == array.values;
        };
        if (array.values != nullptr && array.count + array.capacity > 0 &&
            std::ranges::any_of(arrays.first(columns.size()), is_same))
            reject("array " + std::to_string(columns.size()) +
                   " (the first is 0) has the values of one before it; name each array once");
        const void* const values = from == nullptr ? array.values : from[columns.size()];
        c::require_array(num_points, values, "a column of the type of its array of ghosts");
        visit_type(array.type, [&]<class T>(T) {
            columns.push_back({static_cast<const std::byte*>(values),
                               (from == nullptr ? array.count : num_points) * array.components,
                               detail::kind_of<T>, sizeof(T), array.components, &held, resize});
        });
    }
    return columns;
}

/// Returns columns of ghosts, with the columns of points to which they are to be added.
std::vector<detail::SumColumn> sums_of(const rrcb_column* given, std::size_t num_columns,
                                       LocalIndex num_ghosts, LocalIndex num_points) {
    const std::vector<rrcb_column> columns = given_columns(given, num_columns);
    std::vector<detail::SumColumn> sums;
    for (const detail::ByteColumn& ghosts : columns_of(columns, num_ghosts, num_points)) {
        detail::SumColumn& sum = sums.emplace_back(detail::SumColumn{ghosts, ghosts, nullptr});
        sum.points.from = static_cast<const std::byte*>(ghosts.result);
        sum.points.num_values = num_points * ghosts.components;
        visit_type(columns[sums.size() - 1].type, [&]<class T>(T) {
            if constexpr (std::is_same_v<T, std::byte>)
                reject("columns of RRCB_BYTE cannot be added; give a type of numbers");
            else
                sum.add = detail::add_values<T>;
        });
    }
    return sums;
}

SharedEntries entries_of(const rrcb_shared_entries* from) {
    const rrcb_shared_entries given = copy_in(from, "shared");
    c::require_array(given.num_ranks, given.ranks, "ranks");
    c::require_array(given.num_indices, given.indices, "indices");
    SharedEntries shared;
    for (const rrcb_rank_count& one : view(given.ranks, given.num_ranks))
        shared.ranks.push_back({one.rank, one.count});
    const std::span<const LocalIndex> indices = view(given.indices, given.num_indices);
    shared.indices.assign(indices.begin(), indices.end());
    return shared;
}

}  // namespace

}  // namespace rrcb::c

using rrcb::CallName;
using rrcb::Neighbours;
using rrcb::c::Access;
using rrcb::c::guarded;
using rrcb::c::with_neighbours;

int rrcb_neighbours_create(const rrcb_balancer* balancer, const rrcb_neighbour_options* options,
                           rrcb_neighbours** neighbours) {
    const auto body = [&] {
        rrcb::c::require_handle(balancer, rrcb_balancer::name);
        *neighbours = rrcb::c::make(*balancer, options, neighbours).release();
    };
    return guarded(body, {rrcb::c::origin_in(balancer).comm, rrcb::c::patience_together});
}

void rrcb_neighbours_destroy(rrcb_neighbours** neighbours) {
    rrcb::c::destroy(neighbours);
}

int rrcb_neighbours_migrate(rrcb_neighbours* neighbours, const rrcb_points* positions,
                            size_t num_columns, rrcb_array* columns) {
    rrcb::Points points;
    std::vector<rrcb::c::HeldArray> held;
    std::vector<rrcb::detail::ByteColumn> moved;
    const auto read = [&](const rrcb_neighbours&) {
        points = rrcb::c::points_of(positions);
        held = rrcb::c::held_arrays(columns, num_columns, "columns");
        moved = rrcb::c::arrays_in(held, nullptr, 0);
    };
    return with_neighbours(CallName::migrate, neighbours, read,
                           [&](Neighbours& all) { Access::migrate(all, points, moved); });
}

int rrcb_neighbours_find_ghosts(rrcb_neighbours* neighbours, const rrcb_points* points,
                                const double* radii) {
    rrcb::Points found;
    std::optional<std::span<const double>> each;
    const auto read = [&](const rrcb_neighbours&) {
        found = rrcb::c::points_of(points);
        if (radii != nullptr) each = rrcb::c::view(radii, found.count);
    };
    return with_neighbours(CallName::find_ghosts, neighbours, read,
                           [&](Neighbours& all) { Access::find_ghosts(all, found, each); });
}

int rrcb_neighbours_fetch(rrcb_neighbours* neighbours, size_t num_columns,
                          const void* const* columns, rrcb_array* ghosts) {
    std::vector<rrcb::c::HeldArray> held;
    std::vector<rrcb::detail::ByteColumn> fetched;
    const auto read = [&](const rrcb_neighbours& own) {
        rrcb::c::require_array(num_columns, columns, "columns");
        held = rrcb::c::held_arrays(ghosts, num_columns, "ghosts");
        fetched = rrcb::c::arrays_in(held, columns, own.all->ghost_plan().num_points);
    };
    return with_neighbours(CallName::fetch_of_neighbours, neighbours, read,
                           [&](Neighbours& all) { Access::fetch(all, fetched); });
}

int rrcb_neighbours_accumulate(rrcb_neighbours* neighbours, size_t num_columns,
                               const rrcb_column* columns) {
    std::vector<rrcb::detail::SumColumn> sums;
    const auto read = [&](const rrcb_neighbours& own) {
        const rrcb::GhostPlan& ghosts = own.all->ghost_plan();
        sums =
            rrcb::c::sums_of(columns, num_columns, rrcb::total(ghosts.receive), ghosts.num_points);
    };
    return with_neighbours(CallName::accumulate_of_neighbours, neighbours, read,
                           [&](Neighbours& all) { Access::accumulate(all, sums); });
}

int rrcb_neighbours_sum(rrcb_neighbours* neighbours, const rrcb_shared_entries* shared,
                        size_t num_entries, size_t num_columns, const rrcb_column* columns) {
    rrcb::SharedEntries entries;
    std::vector<rrcb::detail::SumColumn> sums;
    const auto read = [&](const rrcb_neighbours&) {
        entries = rrcb::c::entries_of(shared);
        sums = rrcb::c::sums_of(columns, num_columns, 0, num_entries);
    };
    return with_neighbours(CallName::sum, neighbours, read,
                           [&](Neighbours& all) { Access::sum(all, entries, sums); });
}

int rrcb_neighbours_ghost_plan(const rrcb_neighbours* neighbours, rrcb_ghost_plan* plan) {
    return guarded(neighbours, [&](const auto& own) {
        rrcb::c::require_sized(plan, "plan");
        rrcb::c::copy_out(rrcb::c::view_of(own.all->ghost_plan()), plan);
    });
}

int rrcb_neighbours_apply_shifts(const rrcb_neighbours* neighbours, const rrcb_points* positions) {
    return guarded(neighbours, [&](const auto& own) {
        rrcb::detail::apply_shifts(own.all->ghost_plan(), rrcb::c::points_of(positions));
    });
}

int rrcb_neighbours_ranks(const rrcb_neighbours* neighbours, size_t* count, const int** ranks) {
    return guarded(neighbours, [&](const auto& own) {
        rrcb::c::require(count, "count");
        rrcb::c::require(ranks, "ranks");
        *count = own.all->ranks().size();
        *ranks = own.all->ranks().data();
    });
}
