// Butterflies of many ranks in one process.
#pragma once

#include "collective/butterfly.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rrcb::test {

/// What one pass of all ranks amounted to.
struct PassCounts {
    int num_steps = 0;
    std::size_t num_messages = 0;
    std::size_t most_messages = 0;  ///< from one rank
    std::size_t longest = 0;        ///< message, in bytes
    std::size_t most_bytes_in = 0;  ///< into one rank, in all steps
};

/// Runs a pass of all butterflies, rank k with flags[k], step by step. A rank k for which
/// fails(k, step) holds sends messages without records.
template <class Fails>
PassCounts run_pass(std::vector<Butterfly>& all, Butterfly::Direction direction,
                    const std::vector<Flags>& flags, Fails&& fails) {
    struct Mail {
        std::size_t to;
        Butterfly::Link link;  ///< of the rank that it goes to
        std::vector<double> message;
    };
    PassCounts counts;
    std::vector<std::size_t> sent(all.size());
    std::vector<std::size_t> bytes_in(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].start(flags[k]);
        counts.num_steps = std::max(counts.num_steps, all[k].num_steps());
    }
    for (int k = 0; k < counts.num_steps; ++k) {
        const int step = direction == Butterfly::to_owners ? k : counts.num_steps - 1 - k;
        std::vector<Mail> mail;
        for (std::size_t rank = 0; rank < all.size(); ++rank) {
            if (step >= all[rank].num_steps()) continue;
            for (const Butterfly::Link& link : all[rank].links(step, direction)) {
                if (!link.sends) continue;
                all[rank].pack_nothing();
                if (!fails(static_cast<int>(rank), step)) all[rank].pack(step, direction, link);
                const auto message = all[rank].message();
                mail.push_back({static_cast<std::size_t>(link.rank),
                                {static_cast<int>(rank), false, true},
                                {message.begin(), message.end()}});
                ++sent[rank];
                ++counts.num_messages;
                counts.longest = std::max(counts.longest, message.size_bytes());
                bytes_in[mail.back().to] += message.size_bytes();
            }
        }
        for (const Mail& letter : mail) {
            all[letter.to].hear(letter.message);
            all[letter.to].take(step, direction, letter.link, letter.message);
        }
    }
    counts.most_messages = *std::ranges::max_element(sent);
    counts.most_bytes_in = *std::ranges::max_element(bytes_in);
    return counts;
}

}  // namespace rrcb::test
