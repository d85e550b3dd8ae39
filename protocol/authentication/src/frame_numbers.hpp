#pragma once

#include <cstdint>
#include <gene_clocks/authentication/replay_window.hpp>
#include <gene_clocks/wire.hpp>
#include <optional>
#include <span>

namespace gene_clocks::authentication {

/// What a frame that was sealed or signed begins with: version, number, the frame itself.
struct NumberedFrame {
    std::uint64_t number;
    Frame frame;
};

/// Nullopt where it is not so. The version tells what is sealed from what is signed, and both from
/// a frame, so that no one of them passes for another.
inline std::optional<NumberedFrame> read_numbered(std::span<const std::uint8_t> bytes,
                                                  std::uint8_t version, const WireLimits& limits) {
    if (bytes.empty() || bytes.front() != version) return std::nullopt;
    kernel::gene_clocks_reader reader{bytes.data(), bytes.size(), 1};
    std::uint64_t number = 0;
    if (kernel::gene_clocks_get_varint(&reader, 64, &number) || number == 0) return std::nullopt;
    const auto frame = decode_frame(bytes.subspan(reader.offset), limits);
    if (!frame) return std::nullopt;
    return NumberedFrame{number, *frame};
}

/// Whether so many bytes may be version, number and frame. Lengths come first: nobody makes us hash
/// more than a frame may have.
inline bool may_be_numbered(std::size_t bytes, const WireLimits& limits) {
    constexpr std::size_t before = 1 + 10;
    return bytes <= before || bytes - before <= limits.frame_bytes;  // no sum that could wrap
}

/// Why a number may not be opened; nullopt where it may.
inline std::optional<Refusal> find_seen(const ReplayWindow& window, std::uint64_t number) {
    if (number > window.highest) return std::nullopt;
    const std::uint64_t age = window.highest - number;
    if (age >= ReplayWindow::size) return Refusal::too_old;
    if ((window.opened >> age & 1) != 0) return Refusal::replayed;
    return std::nullopt;
}

/// Notes that it was opened.
inline void enter(ReplayWindow& window, std::uint64_t number) {
    if (number <= window.highest) {
        window.opened |= std::uint64_t{1} << (window.highest - number);
        return;
    }
    const std::uint64_t leap = number - window.highest;
    window.opened = leap < ReplayWindow::size ? window.opened << leap : 0;
    window.opened |= 1;
    window.highest = number;
}

}  // namespace gene_clocks::authentication
