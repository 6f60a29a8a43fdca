#pragma once

#include "c/sized.hpp"
#include "collective/participant.hpp"
#include "options/rejection.hpp"

#include <rrcb/transfer.hpp>

#include <cstddef>
#include <vector>

namespace rrcb::c {

/// Calls visit(value) with a value of the C++ type that `type` stands for; RRCB_BYTE stands for
/// std::byte. Throws Error if `type` is not an rrcb_type.
template <class Visit>
void visit_type(int32_t type, Visit&& visit) {
    switch (type) {
        case RRCB_BYTE:
            return visit(std::byte());
        case RRCB_INT32:
            return visit(int32_t());
        case RRCB_INT64:
            return visit(int64_t());
        case RRCB_FLOAT:
            return visit(float());
        case RRCB_DOUBLE:
            return visit(double());
    }
    reject("the type of a column must be an rrcb_type, such as RRCB_DOUBLE");
}

/// Converts columns of C to those of the library. Each column has an array of `num_from` points to
/// read, and one of `num_to` points to write. Throws Error for unknown types, and if `from` or `to`
/// of a column is null.
std::vector<detail::ByteColumn> columns_of(std::span<const rrcb_column> columns,
                                           LocalIndex num_from, LocalIndex num_to);

/// Returns the columns passed to a call. Throws Error if they are null.
inline std::vector<rrcb_column> given_columns(const rrcb_column* columns, std::size_t count) {
    return copy_all_in(columns, count, "columns");
}

/// Options passed to a call that moves columns, or the default if they are null. Throws Error if
/// the size of the options or of their report is not set.
struct GivenTransferOptions {
    GivenTransferOptions() = default;
    explicit GivenTransferOptions(const rrcb_transfer_options* options);

    std::size_t max_bytes = TransferOptions{}.max_bytes;
    rrcb_transfer_report* report = nullptr;

    /// Writes the report, if it is wanted.
    void store(const TransferReport& from) const;
};

/// Arguments of a function that moves columns.
struct ColumnCall {
    std::size_t num_columns;
    const rrcb_column* columns;
    const rrcb_transfer_options* options;

    /// Moves columns of `num_from` points to `num_to` points, along a plan or from groups.
    /// Collective.
    template <class AnyPlan>
    void move_by(const AnyPlan& plan, LocalIndex num_from, LocalIndex num_to,
                 Participant& self) const {
        std::vector<detail::ByteColumn> moved;
        GivenTransferOptions given;
        self.attempt([&] {
            moved = columns_of(given_columns(columns, num_columns), num_from, num_to);
            given = GivenTransferOptions(options);
        });
        TransferReport made;
        move(plan, moved, {given.max_bytes, &made}, self);
        given.store(made);
    }
};

}  // namespace rrcb::c
