#pragma once

#include <cstdint>
#include <gene_clocks/neat/random.hpp>

namespace gene_clocks::neat {

/// A robot's own physical clock: local time = offset + (1 + drift) · time. Where it is
/// synchronised, the offset is set anew every period, to within an error, and drifts from there.
struct LocalTime {
    double offset_cycles = 0.0;
    double drift_rate = 0.0;                    ///< 1e-6 per part per million
    double synchronised_every_cycles = 0.0;     ///< 0: never
    double synchronisation_error_cycles = 0.0;  ///< each time uniform within plus and minus this
    std::uint64_t seed = 0;                     ///< of the errors

    /// What the clock shows at a time.
    double at(double now_cycles) const {
        double since_cycles = now_cycles;
        double offset = offset_cycles;
        if (synchronised_every_cycles > 0.0) {
            // The errors are drawn from the number of the period, so that the clock has no state.
            const double period = static_cast<double>(
                static_cast<std::int64_t>(now_cycles / synchronised_every_cycles));
            if (period >= 1.0) {
                since_cycles = now_cycles - period * synchronised_every_cycles;
                offset = synchronisation_error_cycles *
                         RandomStream(seed, static_cast<std::uint64_t>(period)).uniform(-1.0, 1.0);
            }
        }
        return offset + now_cycles + drift_rate * since_cycles;
    }
};

}  // namespace gene_clocks::neat
