#include <cmath>
#include <gene_clocks/neat/random.hpp>
#include <numbers>

namespace gene_clocks::neat {
namespace {

std::uint64_t split_mix_64(std::uint64_t& state) {
    std::uint64_t mixed = (state += 0x9E3779B97F4A7C15u);
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return mixed ^ (mixed >> 31);
}

/// ln x for finite x > 0, within three units in the last place: ln m = 2 artanh((m − 1)/(m + 1)).
///
/// Not std::log: the C library has a variant for processors with fused multiply-add, whose last
/// bit differs, so that a trajectory would depend on the processor.
double natural_logarithm(double x) {
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent);
    if (mantissa < std::numbers::sqrt2 / 2.0) {
        mantissa *= 2.0;
        --exponent;
    }
    const double s = (mantissa - 1.0) / (mantissa + 1.0);  // |s| < 0.172: 11 terms are enough
    double series = 0.0;
    for (int k = 21; k >= 1; k -= 2) series = series * (s * s) + 1.0 / k;
    return 2.0 * s * series + exponent * std::numbers::ln2;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t stream) {
    std::uint64_t mixer = seed;
    mixer = split_mix_64(mixer) ^ stream;
    for (auto& word : state_) word = split_mix_64(mixer);
}

double RandomStream::normal() {
    for (;;) {
        const double x = uniform(-1.0, 1.0);
        const double y = uniform(-1.0, 1.0);
        const double square = x * x + y * y;
        if (square < 1.0 && square > 0.0) {
            return x * std::sqrt(-2.0 * natural_logarithm(square) / square);
        }
    }
}

}  // namespace gene_clocks::neat
