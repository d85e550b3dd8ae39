#include <sodium.h>

#include <algorithm>
#include <gene_clocks/authentication/sealed_frames.hpp>
#include <utility>

#include "protocol/authentication/src/frame_numbers.hpp"

namespace gene_clocks::authentication {
namespace {

constexpr std::uint8_t seal_version = 129;  // no frame begins with it
constexpr std::size_t tag_bytes = 16;
static_assert(sizeof(Key) == crypto_generichash_KEYBYTES &&
              tag_bytes == crypto_generichash_BYTES_MIN);

using Tag = std::array<std::uint8_t, tag_bytes>;

/// BLAKE2b with a key, cut to 16 bytes (RFC 7693).
Tag tag_of(std::span<const std::uint8_t> bytes, const Key& key) {
    Tag tag;
    crypto_generichash(tag.data(), tag.size(), bytes.data(), bytes.size(), key.data(), key.size());
    return tag;
}

}  // namespace

Sealer::~Sealer() {
    sodium_memzero(key_.data(), key_.size());
}

std::optional<std::span<const std::uint8_t>> Sealer::seal(std::span<const std::uint8_t> frame) {
    const auto number = numbers_.mint();
    if (!number) return std::nullopt;
    sealed_.resize(seal_bytes_max + frame.size());
    kernel::gene_clocks_writer writer{sealed_.data(), sealed_.size(), 0};
    kernel::gene_clocks_put_byte(&writer, seal_version);
    kernel::gene_clocks_put_varint(&writer, number->counter);
    const auto behind = [&](std::size_t bytes) {
        return sealed_.begin() + static_cast<std::ptrdiff_t>(bytes);
    };
    std::copy(frame.begin(), frame.end(), behind(writer.size));
    const std::size_t tagged = writer.size + frame.size();
    const Tag tag = tag_of(std::span(sealed_).first(tagged), key_);
    std::copy(tag.begin(), tag.end(), behind(tagged));
    return std::span<const std::uint8_t>(sealed_).first(tagged + tag_bytes);
}

Opener::Opener(const Key& key, const WireLimits& limits, std::size_t senders_max, Windows windows)
    : key_(key), limits_(limits), senders_max_(senders_max), windows_(std::move(windows)) {}

Opener::~Opener() {
    sodium_memzero(key_.data(), key_.size());
}

std::variant<Frame, Refusal> Opener::examine(std::span<const std::uint8_t> sealed) {
    if (sealed.size() < tag_bytes || !may_be_numbered(sealed.size() - tag_bytes, limits_)) {
        return Refusal::forged;
    }
    const auto tagged = sealed.first(sealed.size() - tag_bytes);
    const Tag tag = tag_of(tagged, key_);
    if (sodium_memcmp(tag.data(), sealed.last(tag_bytes).data(), tag_bytes) != 0) {
        return Refusal::forged;
    }
    const auto numbered = read_numbered(tagged, seal_version, limits_);
    if (!numbered) return Refusal::malformed;
    const auto sender = static_cast<std::uint32_t>(numbered->frame.sender);
    const auto known = windows_.find(sender);
    if (known == windows_.end() && windows_.size() >= senders_max_) {
        return Refusal::too_many_senders;
    }
    ReplayWindow& window = known == windows_.end() ? windows_[sender] : known->second;
    if (const auto refusal = find_seen(window, numbered->number)) return *refusal;
    enter(window, numbered->number);
    return numbered->frame;
}

std::variant<Frame, Refusal> Opener::open(std::span<const std::uint8_t> sealed) {
    const auto result = examine(sealed);
    if (const auto* refusal = std::get_if<Refusal>(&result)) {
        ++counts_.refused[static_cast<std::size_t>(*refusal)];
    } else {
        ++counts_.opened;
    }
    return result;
}

}  // namespace gene_clocks::authentication
