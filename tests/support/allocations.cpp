#include "tests/support/allocations.hpp"

#include <cstdlib>
#include <new>

namespace {
gene_clocks::test::AllocationCount total;
}

namespace gene_clocks::test {
AllocationCount allocations() {
    return total;
}
}  // namespace gene_clocks::test

void* operator new(std::size_t size) {
    ++total.count;
    total.bytes += size;
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
