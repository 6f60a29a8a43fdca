// The lists of one rank, on one process.
#include "zoltan/call/lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace rrcb::zoltan {
namespace {

template <typename T>
ZoltanArray<T> array_of(const std::vector<T>& values) {
    ZoltanArray<T> array(values.size());
    std::ranges::copy(values, array.get());
    return array;
}

template <typename T>
std::vector<T> values_of(const ZoltanArray<T>& array) {
    return {array.get(), array.get() + array.size()};
}

/// Objects 10, 11, ... with local ids 0, 1, ...; no initial parts: no callback names them.
Objects make_objects(std::size_t count, const std::vector<int>& initial_parts = {}) {
    Objects objects;
    objects.count = static_cast<int>(count);
    objects.global_ids = ZoltanArray<IdWord>(count);
    objects.local_ids = ZoltanArray<IdWord>(count);
    for (std::size_t i = 0; i < count; ++i) {
        objects.global_ids[i] = static_cast<IdWord>(10 + i);
        objects.local_ids[i] = static_cast<IdWord>(i);
    }
    objects.initial_parts = array_of(initial_parts);
    objects.new_ranks = ZoltanArray<int>(count);
    objects.new_parts = ZoltanArray<int>(count);
    return objects;
}

TEST(ExportLists, hold_what_goes_to_other_ranks_in_its_order) {
    const std::vector<Part> parts{2, 1, 0, 1};
    const Exports exports = make_exports(make_objects(4), {}, parts, even_part_map(3, 3), 1);
    EXPECT_TRUE(exports.moves);
    EXPECT_EQ(exports.list.count, 2);
    EXPECT_EQ(values_of(exports.list.global_ids), (std::vector<IdWord>{10, 12}));
    EXPECT_EQ(values_of(exports.list.local_ids), (std::vector<IdWord>{0, 2}));
    EXPECT_EQ(values_of(exports.list.ranks), (std::vector<int>{2, 0}));
    EXPECT_EQ(values_of(exports.list.parts), (std::vector<int>{2, 0}));
}

TEST(ExportLists, hold_what_changes_its_part_on_the_same_rank) {
    // Parts 2 and 3 are on rank 1.
    const std::vector<Part> parts{2, 2, 3, 3};
    const Exports exports =
        make_exports(make_objects(4, {2, 3, 2, 3}), {}, parts, even_part_map(4, 2), 1);
    EXPECT_TRUE(exports.moves);
    EXPECT_EQ(values_of(exports.list.global_ids), (std::vector<IdWord>{11, 12}));
    EXPECT_EQ(values_of(exports.list.ranks), (std::vector<int>{1, 1}));
    EXPECT_EQ(values_of(exports.list.parts), (std::vector<int>{2, 3}));
}

TEST(ExportLists, take_objects_without_a_named_part_to_be_in_that_of_their_rank) {
    // Both parts are on rank 1; Zoltan believes the objects in part 1.
    const std::vector<Part> parts{0, 1};
    const PartMap map = local_part_map(std::vector{0, 2}, 2);
    const Exports exports = make_exports(make_objects(2), {}, parts, map, 1);
    EXPECT_EQ(values_of(exports.list.global_ids), (std::vector<IdWord>{10}));
}

TEST(ExportLists, have_no_arrays_where_nothing_moves) {
    const std::vector<Part> parts{1, 1};
    const Exports exports = make_exports(make_objects(2), {}, parts, even_part_map(3, 3), 1);
    EXPECT_FALSE(exports.moves);
    EXPECT_EQ(exports.list.count, 0);
    EXPECT_EQ(exports.list.global_ids.get(), nullptr);
    EXPECT_EQ(exports.list.local_ids.get(), nullptr);
    EXPECT_EQ(exports.list.ranks.get(), nullptr);
    EXPECT_EQ(exports.list.parts.get(), nullptr);
}

TEST(ExportLists, hold_all_objects_where_parts_are_asked_for) {
    Parameters parameters;
    parameters.return_lists = ReturnLists::parts;
    for (const Part last : {1, 2}) {
        const std::vector<Part> parts{1, last};
        const Exports exports =
            make_exports(make_objects(2), parameters, parts, even_part_map(3, 3), 1);
        EXPECT_EQ(exports.moves, last != 1);
        EXPECT_EQ(exports.list.count, 2);
        EXPECT_EQ(values_of(exports.list.ranks), (std::vector<int>{1, last}));
        EXPECT_EQ(values_of(exports.list.parts), (std::vector<int>{1, last}));
    }
}

TEST(ExportLists, keep_the_words_of_an_id_together) {
    Parameters parameters;
    parameters.num_gid_entries = 2;
    parameters.num_lid_entries = 0;
    const IdWidths widths(parameters);
    Objects objects = make_objects(3);
    objects.local_ids = {};
    objects.global_ids = ZoltanArray<IdWord>(3 * widths.global);
    std::vector<IdWord> last;
    for (std::size_t word = 0; word < 3 * widths.global; ++word) {
        objects.global_ids[word] = static_cast<IdWord>(word);
        if (word >= 2 * widths.global) last.push_back(static_cast<IdWord>(word));
    }
    const std::vector<Part> parts{0, 0, 1};
    const Exports exports =
        make_exports(std::move(objects), parameters, parts, even_part_map(2, 2), 0);
    EXPECT_EQ(values_of(exports.list.global_ids), last);
    EXPECT_EQ(exports.list.local_ids.get(), nullptr);
}

TEST(ExportLists, name_the_parts_that_objects_are_in) {
    const List named = list_in_place(make_objects(2, {3, 2}), 1);
    EXPECT_EQ(values_of(named.ranks), (std::vector<int>{1, 1}));
    EXPECT_EQ(values_of(named.parts), (std::vector<int>{3, 2}));
    const List unnamed = list_in_place(make_objects(2), 1);
    EXPECT_EQ(values_of(unnamed.parts), (std::vector<int>{1, 1}));
    EXPECT_EQ(unnamed.count, 2);
}

}  // namespace
}  // namespace rrcb::zoltan
