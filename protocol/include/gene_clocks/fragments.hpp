#pragma once

#include <gene_clocks/fragments.h>

#include <cstddef>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/wire.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace gene_clocks {

/// What became of a fragment.
enum class FragmentOutcome : std::uint8_t {
    kept = gene_clocks_fragment_kept,            ///< the message is not whole yet
    completes = gene_clocks_fragment_completes,  ///< the message is whole, and was not before
    repeated = gene_clocks_fragment_repeated,    ///< it is there already
    late = gene_clocks_fragment_late,            ///< the sender has gone on to another message
    malformed = gene_clocks_fragment_malformed,  ///< it is no fragment that anyone splits off
    too_long = gene_clocks_fragment_too_long,    ///< the message is longer than the memory for it
};

/// The outcome's name.
constexpr std::string_view name_of(FragmentOutcome outcome) {
    constexpr std::string_view names[] = {"kept", "completes", "repeated",
                                          "late", "malformed", "too_long"};
    return names[static_cast<std::size_t>(outcome)];
}

/// Splits a frame, sealed or not, into fragments of at most `fragment_bytes`; a single one, the
/// frame itself, where it fits. `number` is one more for each message of this sender, from any
/// number on. See gene_clocks_split_message for what is refused.
inline WireResult<std::vector<std::vector<std::uint8_t>>> split_message(
    std::span<const std::uint8_t> message, RobotId sender, std::uint8_t number,
    std::size_t fragment_bytes) {
    gene_clocks_split split{};
    const auto error =
        gene_clocks_split_message(&split, message.data(), message.size(),
                                  static_cast<std::uint32_t>(sender), number, fragment_bytes);
    if (error) return WireFault{static_cast<WireError>(error), 0};
    std::vector<std::vector<std::uint8_t>> fragments(split.last + std::size_t{1});
    for (std::size_t i = 0; i < fragments.size(); ++i) {
        fragments[i].resize(split.piece_bytes + gene_clocks_fragment_header_max);
        fragments[i].resize(
            gene_clocks_put_fragment(&split, static_cast<std::uint8_t>(i), fragments[i].data()));
    }
    return fragments;
}

/// Puts messages together from fragments, in memory that is fixed from the start:
/// messages × message_bytes.
class MessageAssembler {
public:
    /// `messages`: that are put together at a time, one for each sender; at least 1.
    explicit MessageAssembler(std::size_t messages = 16, std::size_t message_bytes = 65'507)
        : assemblies_(messages),
          memory_(messages * message_bytes),
          assembler_{nullptr, nullptr, message_bytes, messages, 0} {}

    struct Taken {
        FragmentOutcome outcome{};
        /// Where it completes: the message, valid until the next call (where it came whole, as long
        /// as the bytes given). Its checksum tells whether it was put together right.
        std::span<const std::uint8_t> message;
    };

    /// Takes what came off a link: a fragment, or a message that came whole.
    Taken take(std::span<const std::uint8_t> bytes) {
        assembler_.assemblies = assemblies_.data();
        assembler_.memory = memory_.data();
        const std::uint8_t* message = nullptr;
        std::size_t size = 0;
        const auto outcome =
            gene_clocks_take_fragment(&assembler_, bytes.data(), bytes.size(), &message, &size);
        return {static_cast<FragmentOutcome>(outcome), {message, size}};
    }

private:
    std::vector<gene_clocks_assembly> assemblies_;
    std::vector<std::uint8_t> memory_;
    gene_clocks_assembler assembler_;
};

}  // namespace gene_clocks
