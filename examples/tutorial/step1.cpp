// Step 1: a serial particle code.
#include "particles.hpp"

#include <cstdio>

int main() {
    std::vector<double> positions = column_of_water();
    double pairs = 0;
    for (int step = 0; step < num_steps; ++step) {
        pairs += count_pairs(positions, positions);
        move(positions);
    }
    std::printf("%.0f pairs\n", pairs);
}

// Output of any run:
// 1605164 pairs
