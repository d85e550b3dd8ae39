#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/authentication/replay_window.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/wire.hpp>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

/// Frames that only holders of a key can make, each of which is taken once
/// (docs/wire-format.md, "Authentication").
namespace gene_clocks::authentication {

/// The fleet's secret, from a good source of randomness. Whoever has it can speak as any robot.
using Key = std::array<std::uint8_t, 32>;

/// Seals a robot's frames: gives each a number and a tag.
///
/// Numbers come from a `GeneClock` of their own, since what they need is what marks need: none is
/// ever used twice, also after a crash. It is stored and restarted in the same way.
class Sealer {
public:
    /// `numbers`: fresh, or restarted from what was stored.
    Sealer(const Key& key, GeneClock numbers) : key_(key), numbers_(std::move(numbers)) {}
    ~Sealer();
    Sealer(const Sealer&) = delete;
    Sealer& operator=(const Sealer&) = delete;

    /// The sealed frame, valid until the next call; nullopt where no number is left.
    [[nodiscard]] std::optional<std::span<const std::uint8_t>> seal(
        std::span<const std::uint8_t> frame);

    /// Must be on stable storage before what `seal` returned last may leave the robot.
    [[nodiscard]] std::uint64_t durable_needed() const { return numbers_.durable_needed(); }

private:
    Key key_;
    GeneClock numbers_;
    std::vector<std::uint8_t> sealed_;
};

/// Opens what `Sealer` sealed, each frame once, in any order within a window of 64 numbers.
///
/// State that a restart needs: `windows()`.
class Opener {
public:
    using Windows = ReplayWindows;

    /// `limits` are those of the frames; memory is kept for at most `senders_max` senders.
    Opener(const Key& key, const WireLimits& limits, std::size_t senders_max = 1024,
           Windows windows = {});
    ~Opener();
    Opener(const Opener&) = delete;
    Opener& operator=(const Opener&) = delete;

    /// The frame, which lies within `sealed`, or why not. What is refused changes nothing but the
    /// counts; nothing is read of it before its tag is found right.
    [[nodiscard]] std::variant<Frame, Refusal> open(std::span<const std::uint8_t> sealed);

    [[nodiscard]] const OpenerCounts& counts() const { return counts_; }
    [[nodiscard]] const Windows& windows() const { return windows_; }

private:
    std::variant<Frame, Refusal> examine(std::span<const std::uint8_t> sealed);

    Key key_;
    WireLimits limits_;
    std::size_t senders_max_;
    Windows windows_;
    OpenerCounts counts_;
};

/// The most bytes that sealing adds to a frame: version, number, tag.
inline constexpr std::size_t seal_bytes_max = 1 + 10 + 16;

}  // namespace gene_clocks::authentication
