// The lists of one rank, on one process.
#include "../support/common.hpp"
#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {
namespace {

template <typename T>
std::vector<T> values_of(const ZoltanArray<T>& array, std::size_t size) {
    return {array.get(), array.get() + size};
}

/// Objects 10, 11, ... with local ids 0, 1, ...; no initial parts: no callback names
/// them.
struct RankObjects {
    explicit RankObjects(std::size_t count, const std::vector<int>& initial_parts = {})
        : global_ids(count), local_ids(count), named(initial_parts), moving(count) {
        std::iota(global_ids.begin(), global_ids.end(), 10U);
        std::iota(local_ids.begin(), local_ids.end(), 0U);
        objects.count = static_cast<int>(count);
        objects.initial_parts = named.empty() ? nullptr : named.data();
        objects.moving = moving.data();
    }

    /// Keeps the ids in the room of a list, as if it was asked for without another agreement.
    void make_room() {
        objects.room = make_list(objects.count, IdWidths({}));
        std::ranges::copy(global_ids, objects.room.global_ids.get());
        std::ranges::copy(local_ids, objects.room.local_ids.get());
        objects.global_ids = objects.room.global_ids.get();
        objects.local_ids = objects.room.local_ids.get();
    }

    List exports(const std::vector<Part>& parts, const PartMap& map, int rank,
                 const Parameters& parameters = {}) {
        const Moves moves(objects, parts, map, rank);
        const IdWidths widths(parameters);
        List list =
            objects.global_ids == nullptr ? make_list(moves.count(), widths) : moves.take_room();
        if (objects.global_ids == nullptr) {
            objects.global_ids = global_ids.data();
            objects.local_ids = local_ids.data();
        }
        moves.write(widths, list);
        EXPECT_EQ(list.count, moves.count());
        return list;
    }

    std::vector<IdWord> global_ids, local_ids;
    std::vector<int> named, moving;
    Objects objects;
};

TEST(ExportLists, hold_what_goes_to_other_ranks_in_its_order) {
    for (const bool is_in_place : {false, true}) {
        RankObjects here(4);
        if (is_in_place) here.make_room();
        const List list = here.exports({2, 1, 0, 1}, even_part_map(3, 3), 1);
        EXPECT_EQ(list.count, 2);
        EXPECT_EQ(values_of(list.global_ids, list.count), (std::vector<IdWord>{10, 12}));
        EXPECT_EQ(values_of(list.local_ids, list.count), (std::vector<IdWord>{0, 2}));
        EXPECT_EQ(values_of(list.ranks, list.count), (std::vector<int>{2, 0}));
        EXPECT_EQ(values_of(list.parts, list.count), (std::vector<int>{2, 0}));
    }
}

TEST(ExportLists, hold_what_changes_its_part_on_the_same_rank) {
    // Parts 2 and 3 are on rank 1.
    const List list = RankObjects(4, {2, 3, 2, 3}).exports({2, 2, 3, 3}, even_part_map(4, 2), 1);
    EXPECT_EQ(values_of(list.global_ids, list.count), (std::vector<IdWord>{11, 12}));
    EXPECT_EQ(values_of(list.ranks, list.count), (std::vector<int>{1, 1}));
    EXPECT_EQ(values_of(list.parts, list.count), (std::vector<int>{2, 3}));
}

TEST(ExportLists, hold_what_is_not_in_the_part_that_is_named) {
    const List list = RankObjects(3, {1, 0, 1}).exports({1, 1, 0}, even_part_map(2, 2), 1);
    EXPECT_EQ(values_of(list.global_ids, list.count), (std::vector<IdWord>{11, 12}));
    EXPECT_EQ(values_of(list.ranks, list.count), (std::vector<int>{1, 0}));
}

TEST(ExportLists, take_objects_without_a_named_part_to_be_in_that_of_their_rank) {
    // Both parts are on rank 1; Zoltan believes the objects in part 1.
    const PartMap map = local_part_map(std::vector{0, 2}, 2);
    const List list = RankObjects(2).exports({0, 1}, map, 1);
    EXPECT_EQ(values_of(list.global_ids, list.count), (std::vector<IdWord>{10}));
}

TEST(ExportLists, have_no_arrays_where_nothing_moves) {
    const List list = RankObjects(2).exports({1, 1}, even_part_map(3, 3), 1);
    EXPECT_EQ(list.count, 0);
    EXPECT_EQ(list.global_ids.get(), nullptr);
    EXPECT_EQ(list.local_ids.get(), nullptr);
    EXPECT_EQ(list.ranks.get(), nullptr);
    EXPECT_EQ(list.parts.get(), nullptr);
}

TEST(ExportLists, hold_all_objects_where_parts_are_asked_for) {
    for (const Part last : {1, 2}) {
        RankObjects here(2);
        here.make_room();
        const std::vector<Part> parts{1, last};
        const PartMap map = even_part_map(3, 3);
        const Moves moves(here.objects, parts, map, 1);
        EXPECT_EQ(moves.count(), last == 1 ? 0 : 1);
        const List list = moves.list_all();
        EXPECT_EQ(list.count, 2);
        EXPECT_EQ(values_of(list.global_ids, list.count), (std::vector<IdWord>{10, 11}));
        EXPECT_EQ(values_of(list.ranks, list.count), (std::vector<int>{1, last}));
        EXPECT_EQ(values_of(list.parts, list.count), (std::vector<int>{1, last}));
    }
}

TEST(ExportLists, keep_the_words_of_an_id_together) {
    Parameters parameters;
    parameters.num_gid_entries = 2;
    parameters.num_lid_entries = 0;
    const std::size_t width = IdWidths(parameters).global;
    RankObjects here(3);
    here.global_ids.resize(3 * width);
    std::iota(here.global_ids.begin(), here.global_ids.end(), 0U);
    const std::vector<IdWord> last(here.global_ids.end() - width, here.global_ids.end());
    const List list = here.exports({0, 0, 1}, even_part_map(2, 2), 0, parameters);
    EXPECT_EQ(values_of(list.global_ids, list.count * width), last);
    EXPECT_EQ(list.local_ids.get(), nullptr);
}

TEST(ExportLists, name_the_parts_that_objects_are_in) {
    RankObjects with_parts(2, {3, 2}), without_parts(2);
    with_parts.make_room();
    without_parts.make_room();
    const List named = list_in_place(std::move(with_parts.objects), 1);
    EXPECT_EQ(values_of(named.ranks, named.count), (std::vector<int>{1, 1}));
    EXPECT_EQ(values_of(named.parts, named.count), (std::vector<int>{3, 2}));
    const List unnamed = list_in_place(std::move(without_parts.objects), 1);
    EXPECT_EQ(values_of(unnamed.parts, unnamed.count), (std::vector<int>{1, 1}));
    EXPECT_EQ(unnamed.count, 2);
}

}  // namespace
}  // namespace rrcb::zoltan
