// Firmware's view: no exceptions, no run-time types, no heap, no library behind it.
#include <gene_clocks/flash_store.hpp>
#include <gene_clocks/gene_clock.hpp>

namespace {

struct MemoryMappedFlash {
    static constexpr std::size_t program_unit = 16;
    static constexpr std::size_t sector_size = 2048;
    bool read(std::size_t, std::size_t, std::span<std::byte>) { return false; }
    bool program(std::size_t, std::size_t, std::span<const std::byte>) { return false; }
    bool erase(std::size_t) { return false; }
};

}  // namespace

bool flash_freestanding(gene_clocks::GeneClock& clock);
bool flash_freestanding(gene_clocks::GeneClock& clock) {
    gene_clocks::FlashStore store{MemoryMappedFlash{}, clock.robot()};
    static_assert(decltype(store)::slot_size == 32);
    return store.open() && store.store(clock.durable_needed());
}
