#include <gene_clocks/authentication/sealed_frames.hpp>

using namespace gene_clocks;

namespace {

bool store(std::uint64_t counter) {
    return counter == 1002;  // a block above the number that was used
}

bool robots_talk(const authentication::Key& key, std::span<const std::uint8_t> frame,
                 std::uint64_t stored) {
    // Numbers of frames come from a clock of their own, which is stored and restarted as that of
    // genes is, in a folder of its own.
    authentication::Sealer sealer{key, *GeneClock::restart(RobotId{1}, stored, 0, {.block = 1000})};
    const auto sealed = sealer.seal(frame);
    if (!sealed || !store(sealer.durable_needed())) return false;  // before it leaves

    authentication::Opener opener{key, {}};
    const auto opened = opener.open(*sealed);
    const auto* const received = std::get_if<Frame>(&opened);
    if (!received) return false;  // forged, replayed, …: drop it

    const auto again = opener.open(*sealed);
    authentication::Opener stranger{authentication::Key{}, {}};
    return received->sender == RobotId{1} &&
           std::get<authentication::Refusal>(again) == authentication::Refusal::replayed &&
           std::get<authentication::Refusal>(stranger.open(*sealed)) ==
               authentication::Refusal::forged;
}

}  // namespace

int main() {
    authentication::Key key{};
    key.fill(42);
    std::array<std::uint8_t, 64> buffer{};
    const auto frame = encode_frame({RobotId{1}, Stamp{1}, 0.0f, {}}, buffer);
    return frame && robots_talk(key, *frame, 1) ? 0 : 1;
}
