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

/// Returns the limits passed to a call, or the default if they are null.
TransferLimits limits_of(const rrcb_transfer_limits* limits);

/// Writes a report, unless it is null.
void store(const TransferReport& from, rrcb_transfer_report* report);

/// Arguments of a function that moves columns.
struct ColumnCall {
    std::size_t num_columns;
    const rrcb_column* columns;
    const rrcb_transfer_limits* limits;
    rrcb_transfer_report* report;

    /// Returns the limits. Throws Error if the size of the limits or of the report is not set.
    TransferLimits checked_limits() const {
        if (report != nullptr) require_sized(report, "report");
        return limits_of(limits);
    }

    /// Moves columns of `num_from` points to `num_to` points, along a plan or from groups.
    /// Collective.
    template <class AnyPlan>
    void move_by(const AnyPlan& plan, LocalIndex num_from, LocalIndex num_to,
                 Participant& self) const {
        std::vector<detail::ByteColumn> moved;
        TransferLimits within;
        self.attempt([&] {
            moved = columns_of(given_columns(columns, num_columns), num_from, num_to);
            within = checked_limits();
        });
        TransferReport made;
        move(plan, moved, within, &made, self);
        store(made, report);
    }
};

}  // namespace rrcb::c
