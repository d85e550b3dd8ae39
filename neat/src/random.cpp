#include "gene_clocks/neat/random.hpp"

#include <cmath>

namespace gene_clocks::neat {
namespace {

std::uint64_t split_mix_64(std::uint64_t& state) {
    std::uint64_t mixed = (state += 0x9E3779B97F4A7C15u);
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return mixed ^ (mixed >> 31);
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
        if (square < 1.0 && square > 0.0) return x * std::sqrt(-2.0 * std::log(square) / square);
    }
}

}  // namespace gene_clocks::neat
