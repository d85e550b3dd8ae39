#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/wire.hpp>
#include <optional>
#include <span>
#include <unordered_map>
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

/// Why a sealed frame is not opened.
enum class Refusal : std::uint8_t {
    forged,            ///< altered, or sealed without the key
    malformed,         ///< sealed with the key, but not a frame: see docs/wire-format.md
    replayed,          ///< a number that was opened before
    too_old,           ///< a number so far behind that nobody knows whether it was opened
    too_many_senders,  ///< from one robot more than there is room for
};

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
    std::array<std::uint64_t, 5> refused{};  ///< by Refusal
};

/// Opens what `Sealer` sealed, each frame once, in any order within a window of 64 numbers.
///
/// State that a restart needs: `windows()`. An opener that starts without it takes frames once
/// more that it had opened before: no harm to a clock, but genomes of old come back. Who stores the
/// windows now and then loses only what was opened since.
class Opener {
public:
    using Windows = std::unordered_map<std::uint32_t, ReplayWindow>;  ///< by sender

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
