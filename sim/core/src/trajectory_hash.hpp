#pragma once

#include <xxhash.h>

#include <cstdint>
#include <memory>
#include <span>

namespace gene_clocks::sim {

/// XXH3 (64 bit) over a run's numbers, bit for bit: equal trajectories have equal hashes.
class TrajectoryHash {
public:
    TrajectoryHash() : state_(XXH3_createState(), &XXH3_freeState) {
        XXH3_64bits_reset(state_.get());
    }

    void add(std::span<const float> values) {
        XXH3_64bits_update(state_.get(), values.data(), values.size_bytes());
    }
    void add(float value) { add(std::span(&value, 1)); }

    std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

private:
    std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

}  // namespace gene_clocks::sim
