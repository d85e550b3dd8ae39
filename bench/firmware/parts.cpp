// What firmware in C++ calls, by parts: PART_... chooses those that are measured.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "gene_clocks/align.hpp"
#include "gene_clocks/gene_clock.hpp"
#include "gene_clocks/wire.hpp"

using namespace gene_clocks;

#ifdef PART_CLOCK
std::optional<GeneClock> clock_restart(RobotId robot, std::uint64_t stored);
std::optional<GeneClock> clock_restart(RobotId robot, std::uint64_t stored) {
    return GeneClock::restart(robot, stored, {.block = 1000});
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

#ifdef PART_RAM
char ram_of_a_clock[sizeof(GeneClock)];  // its limits included
#endif
