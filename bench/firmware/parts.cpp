// What firmware in C++ calls, by parts: PART_... chooses those that are measured.
#include <cstddef>
#include <cstdint>
#include <gene_clocks/align.hpp>
#include <gene_clocks/flash_store.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/wire.hpp>
#include <optional>
#include <span>

using namespace gene_clocks;

#ifdef PART_CLOCK
std::optional<GeneClock> clock_restart(RobotId robot, std::uint64_t stored,
                                       std::uint64_t genesis_count);
std::optional<GeneClock> clock_restart(RobotId robot, std::uint64_t stored,
                                       std::uint64_t genesis_count) {
    return GeneClock::restart(robot, stored, genesis_count, {.block = 1000});
}
std::optional<GeneClock::Marks> clock_mint(GeneClock& clock, std::uint64_t count);
std::optional<GeneClock::Marks> clock_mint(GeneClock& clock, std::uint64_t count) {
    return clock.mint(count);
}
bool clock_observe(GeneClock& clock, Stamp stamp, std::span<const InnovationNumber> marks);
bool clock_observe(GeneClock& clock, Stamp stamp, std::span<const InnovationNumber> marks) {
    return clock.observe(stamp, marks);
}
#endif

#ifdef PART_ALIGNMENT
using Marks = std::span<const InnovationNumber>;
void align_genomes(Marks first, Marks second, void (*visit)(GeneMatch, std::size_t, std::size_t));
void align_genomes(Marks first, Marks second, void (*visit)(GeneMatch, std::size_t, std::size_t)) {
    align(first, second, visit);
}
#endif

#ifdef PART_DECODER
WireResult<Frame> decode(std::span<const std::uint8_t> bytes, const WireLimits& limits,
                         kernel::gene_clocks_genome& genome, kernel::gene_clocks_gene* genes,
                         std::uint32_t* joined);
WireResult<Frame> decode(std::span<const std::uint8_t> bytes, const WireLimits& limits,
                         kernel::gene_clocks_genome& genome, kernel::gene_clocks_gene* genes,
                         std::uint32_t* joined) {
    const auto frame = decode_frame(bytes, limits);
    if (!frame) return frame;
    const auto kernel_limits = limits.kernel_limits();
    const auto fault = kernel::gene_clocks_decode_genome(frame->payload.data(),
                                                         frame->payload.size(), frame->stamp.value,
                                                         &kernel_limits, &genome, genes, joined);
    if (fault.error) return WireFault::from(fault);
    return frame;
}
#endif

#ifdef PART_FLASH
/// A driver's functions; the sectors' size is that of many microcontrollers.
struct Sectors {
    static constexpr std::size_t program_unit = 8;
    static constexpr std::size_t sector_size = 4096;

    bool (*read_bytes)(std::size_t sector, std::size_t offset, std::byte* bytes, std::size_t size);
    bool (*program_bytes)(std::size_t sector, std::size_t offset, const std::byte* bytes,
                          std::size_t size);
    bool (*erase_sector)(std::size_t sector);

    bool read(std::size_t sector, std::size_t offset, std::span<std::byte> bytes) const {
        return read_bytes(sector, offset, bytes.data(), bytes.size());
    }
    bool program(std::size_t sector, std::size_t offset, std::span<const std::byte> bytes) const {
        return program_bytes(sector, offset, bytes.data(), bytes.size());
    }
    bool erase(std::size_t sector) const { return erase_sector(sector); }
};
using Store = FlashStore<Sectors>;

StorageStatus flash_create(Store& store);
StorageStatus flash_create(Store& store) {
    return store.create(1);
}
StorageStatus flash_open(Store& store);
StorageStatus flash_open(Store& store) {
    return store.open();
}
StorageStatus flash_store(Store& store, std::uint64_t counter);
StorageStatus flash_store(Store& store, std::uint64_t counter) {
    return store.store(counter);
}
#endif

#ifdef PART_RAM
char ram_of_a_clock[sizeof(GeneClock)];  // its limits included
#endif
