#include <sodium.h>

#include <algorithm>
#include <cstdlib>
#include <gene_clocks/authentication/signed_frames.hpp>
#include <utility>

#include "protocol/authentication/src/frame_numbers.hpp"

namespace gene_clocks::authentication {
namespace {

constexpr std::uint8_t signed_version = 130;  // no frame begins with it, nor what is sealed
constexpr std::size_t signature_bytes = crypto_sign_BYTES;
static_assert(sizeof(SigningKey) == crypto_sign_SEEDBYTES &&
              sizeof(VerifyingKey) == crypto_sign_PUBLICKEYBYTES &&
              signature_bytes_max == 1 + 10 + signature_bytes);

/// Before its first use; it may be asked any number of times, by several threads.
void start_sodium() {
    if (sodium_init() < 0) std::abort();  // no source of randomness
}

}  // namespace

SigningKey make_signing_key() {
    start_sodium();
    SigningKey key;
    randombytes_buf(key.data(), key.size());
    return key;
}

VerifyingKey verifying_key(const SigningKey& key) {
    start_sodium();
    VerifyingKey verifying;
    std::array<std::uint8_t, crypto_sign_SECRETKEYBYTES> both;
    crypto_sign_seed_keypair(verifying.data(), both.data(), key.data());
    sodium_memzero(both.data(), both.size());
    return verifying;
}

Signer::Signer(const SigningKey& key, GeneClock numbers) : numbers_(std::move(numbers)) {
    start_sodium();
    static_assert(sizeof key_ == crypto_sign_SECRETKEYBYTES);
    VerifyingKey verifying;
    crypto_sign_seed_keypair(verifying.data(), key_.data(), key.data());
}

Signer::~Signer() {
    sodium_memzero(key_.data(), key_.size());
}

std::optional<std::span<const std::uint8_t>> Signer::sign(std::span<const std::uint8_t> frame) {
    const auto number = numbers_.mint();
    if (!number) return std::nullopt;
    signed_.resize(signature_bytes_max + frame.size());
    kernel::gene_clocks_writer writer{signed_.data(), signed_.size(), 0};
    kernel::gene_clocks_put_byte(&writer, signed_version);
    kernel::gene_clocks_put_varint(&writer, number->counter);
    std::ranges::copy(frame, signed_.begin() + static_cast<std::ptrdiff_t>(writer.size));
    const std::size_t size = writer.size + frame.size();
    crypto_sign_detached(signed_.data() + size, nullptr, signed_.data(), size, key_.data());
    return std::span<const std::uint8_t>(signed_).first(size + signature_bytes);
}

Verifier::Verifier(Directory directory, const WireLimits& limits, ReplayWindows windows)
    : directory_(std::move(directory)), limits_(limits), windows_(std::move(windows)) {
    start_sodium();
    // Of those who are no longer, or not yet, in the list nothing need be known.
    std::erase_if(windows_,
                  [&](const auto& entry) { return !directory_.contains(RobotId{entry.first}); });
}

std::variant<Frame, Refusal> Verifier::examine(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < signature_bytes ||
        !may_be_numbered(bytes.size() - signature_bytes, limits_)) {
        return Refusal::forged;
    }
    const auto message = bytes.first(bytes.size() - signature_bytes);
    // What it says of itself is read before it is verified, to know whose key is asked, and costs
    // little; nothing of it is believed yet.
    const auto numbered = read_numbered(message, signed_version, limits_);
    if (!numbered) return Refusal::malformed;
    const auto& [number, frame] = *numbered;
    const auto known = directory_.find(frame.sender);
    if (known == directory_.end()) return Refusal::unknown_sender;
    const auto sender = static_cast<std::uint32_t>(frame.sender);
    const auto window = windows_.find(sender);
    if (window != windows_.end()) {
        if (const auto refusal = find_seen(window->second, number)) return *refusal;
    }
    if (crypto_sign_verify_detached(bytes.last(signature_bytes).data(), message.data(),
                                    message.size(), known->second.data()) != 0) {
        return Refusal::forged;
    }
    enter(windows_[sender], number);
    return frame;
}

std::variant<Frame, Refusal> Verifier::open(std::span<const std::uint8_t> bytes) {
    const auto result = examine(bytes);
    if (const auto* refusal = std::get_if<Refusal>(&result)) {
        ++counts_.refused[static_cast<std::size_t>(*refusal)];
    } else {
        ++counts_.opened;
    }
    return result;
}

}  // namespace gene_clocks::authentication
