#pragma once

#include <cstddef>

// Counts what the program takes from the heap. A program that uses this links
// support/allocations.cpp, which replaces the global operator new.

namespace gene_clocks::test {

struct AllocationCount {
    std::size_t count = 0;
    std::size_t bytes = 0;  ///< requested in total, freed or not
};

/// Since the program's start.
AllocationCount allocations();

}  // namespace gene_clocks::test
