#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

namespace gene_clocks::authentication {

/// Why a frame that was sealed or signed is not opened.
enum class Refusal : std::uint8_t {
    forged,            ///< altered, or made without the key
    malformed,         ///< made with the key, but not a frame: see docs/wire-format.md
    replayed,          ///< a number that was opened before
    too_old,           ///< a number so far behind that nobody knows whether it was opened
    too_many_senders,  ///< sealed by one robot more than there is room for
    unknown_sender,    ///< signed in the name of a robot that is not in the list
};
inline constexpr std::size_t refusal_kinds = 6;

/// Which of one sender's numbers were opened.
///
/// Invariants: bit i of `opened` says that highest − i was, or that it does not exist; bit 0 is set
/// unless nothing was opened yet.
struct ReplayWindow {
    std::uint64_t highest = 0;  ///< the largest number opened
    std::uint64_t opened = 0;

    static constexpr std::uint64_t size = 64;
};

/// What was opened and what was refused, since the start.
struct OpenerCounts {
    std::uint64_t opened = 0;
    std::array<std::uint64_t, refusal_kinds> refused{};  ///< by Refusal
};

/// By sender. What a restart needs: an opener that starts without it takes frames once more that it
/// had opened before. No harm to a clock, but genomes of old come back. Who stores it now and then
/// loses only what was opened since.
using ReplayWindows = std::unordered_map<std::uint32_t, ReplayWindow>;

}  // namespace gene_clocks::authentication
