#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/authentication/replay_window.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/wire.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

/// Frames that only the robot in whose name they are can make, each of which is taken once
/// (docs/wire-format.md, "Each robot's keys").
namespace gene_clocks::authentication {

/// A robot's secret: the seed of an Ed25519 key (RFC 8032). It leaves the robot never.
using SigningKey = std::array<std::uint8_t, 32>;
/// What everyone may know, and needs to know that a robot has signed.
using VerifyingKey = std::array<std::uint8_t, 32>;

/// A new secret, from the system's source of randomness.
SigningKey make_signing_key();
VerifyingKey verifying_key(const SigningKey& key);

/// Signs a robot's frames, and gives each a number.
///
/// Numbers come from a `GeneClock` of their own, as those of a Sealer do.
class Signer {
public:
    /// `numbers`: fresh, or restarted from what was stored.
    Signer(const SigningKey& key, GeneClock numbers);
    ~Signer();
    Signer(const Signer&) = delete;
    Signer& operator=(const Signer&) = delete;

    /// The signed frame, valid until the next call; nullopt where no number is left.
    [[nodiscard]] std::optional<std::span<const std::uint8_t>> sign(
        std::span<const std::uint8_t> frame);

    /// Must be on stable storage before what `sign` returned last may leave the robot.
    [[nodiscard]] std::uint64_t durable_needed() const { return numbers_.durable_needed(); }

private:
    std::array<std::uint8_t, 64> key_;  // the seed, and the key that verifies
    GeneClock numbers_;
    std::vector<std::uint8_t> signed_;
};

/// Opens what the robots of a list have signed, each frame once, in any order within a window of 64
/// numbers of its sender.
///
/// A frame's sender is the robot whose key has signed it. Nobody else takes room or numbers from
/// it: there is one window for each robot of the list, and nothing but its own signature moves it.
class Verifier {
public:
    /// Who is who, as the deployment says. Leave out the robot itself, so that its own frames do
    /// not come back to it, and whoever is to be heard no more.
    using Directory = std::unordered_map<RobotId, VerifyingKey>;

    /// `limits` are those of the frames.
    Verifier(Directory directory, const WireLimits& limits, ReplayWindows windows = {});

    /// The frame, which lies within `bytes`, or why not. What is refused changes nothing but the
    /// counts. A replayed frame costs no verification, nor does one of nobody in the list.
    [[nodiscard]] std::variant<Frame, Refusal> open(std::span<const std::uint8_t> bytes);

    [[nodiscard]] const OpenerCounts& counts() const { return counts_; }
    [[nodiscard]] const ReplayWindows& windows() const { return windows_; }

private:
    std::variant<Frame, Refusal> examine(std::span<const std::uint8_t> bytes);

    Directory directory_;
    WireLimits limits_;
    ReplayWindows windows_;
    OpenerCounts counts_;
};

/// The most bytes that signing adds to a frame: version, number, signature.
inline constexpr std::size_t signature_bytes_max = 1 + 10 + 64;

}  // namespace gene_clocks::authentication
