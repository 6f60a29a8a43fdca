#include "c/columns.hpp"

#include "options/rejection.hpp"

namespace rrcb::c {

namespace {

using detail::ValueKind;

struct ValueType {
    ValueKind kind;
    std::size_t bytes;
};

ValueType type_of(const rrcb_column& column) {
    switch (column.type) {
        case RRCB_BYTE:
            return {ValueKind::other, 1};
        case RRCB_INT32:
            return {ValueKind::integer, sizeof(int32_t)};
        case RRCB_INT64:
            return {ValueKind::integer, sizeof(int64_t)};
        case RRCB_FLOAT:
            return {ValueKind::floating_point, sizeof(float)};
        case RRCB_DOUBLE:
            return {ValueKind::floating_point, sizeof(double)};
    }
    reject("the type of a column must be an rrcb_type");
}

/// Returns the caller's memory for a column.
std::byte* room_at(void* to, std::size_t num_values) {
    require_array(num_values, to, "to");
    return static_cast<std::byte*>(to);
}

}  // namespace

std::vector<detail::ByteColumn> columns_of(std::span<const rrcb_column> columns,
                                           LocalIndex num_points) {
    std::vector<detail::ByteColumn> result;
    for (const rrcb_column& column : columns) {
        const ValueType type = type_of(column);
        const std::size_t num_values = num_points * column.components;
        require_array(num_values, column.from, "from");
        result.push_back({static_cast<const std::byte*>(column.from), num_values, type.kind,
                          type.bytes, column.components, column.to, room_at});
    }
    return result;
}

std::span<const rrcb_column> given_columns(const rrcb_column* columns, std::size_t count) {
    require_array(count, columns, "columns");
    return {columns, count};
}

TransferLimits limits_of(const rrcb_transfer_limits* limits) {
    return limits == nullptr ? TransferLimits{} : TransferLimits{limits->bytes};
}

void store(const TransferReport& from, rrcb_transfer_report* report) {
    if (report != nullptr) *report = {from.peak_bytes, from.bytes_sent, from.num_messages};
}

}  // namespace rrcb::c
