#pragma once

#include "program.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rrcb::zoltan_test {

/// A program that sends its objects where the lists say; it tells their parts where there are more
/// or fewer of them than ranks.
struct Moving : Program {
    explicit Moving(int dimension_) : Program(dimension_) {
        set({{"OBJ_WEIGHT_DIM", "1"}, {"RETURN_LISTS", "EXPORT"}});
    }

    void tell_parts() {
        ZOLTAN_PART_FN* part = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR lid,
                                  int* code) {
            *code = ZOLTAN_OK;
            return static_cast<Moving*>(data)->parts[*lid];
        };
        parts.assign(weights.size(), rank);
        Zoltan_Set_Part_Fn(zz, part, this);
    }

    /// Objects as records of position, weight and part, by destination.
    void send(const Outcome& outcome) {
        const auto ranks = static_cast<std::size_t>(num_ranks);
        const auto stride = static_cast<std::size_t>(dimension);
        std::vector<int> targets(weights.size(), rank);
        parts.resize(weights.size(), rank);
        for (std::size_t k = 0; k < outcome.exports.ranks.size(); ++k) {
            const auto object = outcome.exports.local_ids[k][0];
            targets[object] = outcome.exports.ranks[k];
            parts[object] = outcome.exports.parts[k];
        }
        std::vector<std::vector<double>> boxes(ranks);
        for (std::size_t i = 0; i < targets.size(); ++i) {
            auto& box = boxes[static_cast<std::size_t>(targets[i])];
            for (std::size_t a = 0; a < stride; ++a) box.push_back(coordinates[i * stride + a]);
            box.push_back(static_cast<double>(weights[i]));
            box.push_back(parts[i]);
        }
        receive(boxes);
    }

    std::vector<int> parts;

  private:
    void receive(const std::vector<std::vector<double>>& boxes) {
        const auto ranks = static_cast<std::size_t>(num_ranks);
        std::vector<int> sent(ranks), sent_at(ranks + 1), got(ranks), got_at(ranks + 1);
        std::vector<double> outbox;
        for (std::size_t r = 0; r < ranks; ++r) {
            sent[r] = static_cast<int>(boxes[r].size());
            sent_at[r + 1] = sent_at[r] + sent[r];
            outbox.insert(outbox.end(), boxes[r].begin(), boxes[r].end());
        }
        MPI_Alltoall(sent.data(), 1, MPI_INT, got.data(), 1, MPI_INT, MPI_COMM_WORLD);
        for (std::size_t r = 0; r < ranks; ++r) got_at[r + 1] = got_at[r] + got[r];
        std::vector<double> inbox(static_cast<std::size_t>(got_at[ranks]));
        MPI_Alltoallv(outbox.data(), sent.data(), sent_at.data(), MPI_DOUBLE, inbox.data(),
                      got.data(), got_at.data(), MPI_DOUBLE, MPI_COMM_WORLD);
        coordinates.clear();
        weights.clear();
        parts.clear();
        const auto stride = static_cast<std::ptrdiff_t>(dimension);
        for (auto at = inbox.begin(); at != inbox.end(); at += stride + 2) {
            coordinates.insert(coordinates.end(), at, at + stride);
            weights.push_back(static_cast<float>(at[stride]));
            parts.push_back(static_cast<int>(at[stride + 1]));
        }
    }
};

/// As a program does that balances until nothing changes; calls it took, `most` where it did not
/// end.
inline int calls_until_rest(Moving& program, int most) {
    for (int calls = 1; calls <= most; ++calls) {
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        if (outcome.changes == 0) return calls;
        program.send(outcome);
    }
    return most + 1;
}

}  // namespace rrcb::zoltan_test
