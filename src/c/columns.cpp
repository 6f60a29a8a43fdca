#include "c/columns.hpp"

#include <string>

namespace rrcb::c {

namespace {

/// Returns the caller's memory for the result of a column.
std::byte* room_at(void* to, std::size_t) {
    return static_cast<std::byte*>(to);
}

/// One of the two arrays of a column.
struct Side {
    const char* name;
    const void* values;
    LocalIndex num_points;

    void require_of(std::size_t k, std::size_t components) const {
        if (num_points == 0 || components == 0 || values != nullptr) return;
        reject(std::string(name) + " of column " + std::to_string(k) +
               " (the first is 0) is null (in Fortran: or too short); it must hold " +
               std::to_string(components) + " for each of " + std::to_string(num_points) +
               " points");
    }
};

}  // namespace

std::vector<detail::ByteColumn> columns_of(std::span<const rrcb_column> columns,
                                           LocalIndex num_from, LocalIndex num_to) {
    std::vector<detail::ByteColumn> result;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const rrcb_column& column = columns[k];
        visit_type(column.type, [&]<class T>(T) {
            for (const Side& side :
                 {Side{"from", column.from, num_from}, Side{"to", column.to, num_to}})
                side.require_of(k, column.components);
            result.push_back({static_cast<const std::byte*>(column.from),
                              num_from * column.components, detail::kind_of<T>, sizeof(T),
                              column.components, column.to, room_at});
        });
    }
    return result;
}

GivenTransferOptions::GivenTransferOptions(const rrcb_transfer_options* options) {
    static_assert(rrcb_transfer_options RRCB_TRANSFER_OPTIONS_INIT.max_bytes ==
                  TransferOptions{}.max_bytes);
    if (options == nullptr) return;
    const rrcb_transfer_options given = copy_in(options, "options");
    if (given.report != nullptr) require_sized(given.report, "report");
    max_bytes = given.max_bytes;
    report = given.report;
}

void GivenTransferOptions::store(const TransferReport& from) const {
    if (report != nullptr)
        copy_out({0, from.peak_bytes, from.bytes_sent, from.num_messages}, report);
}

}  // namespace rrcb::c
