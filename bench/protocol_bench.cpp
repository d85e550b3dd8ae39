// What a gene clock costs: marking and receiving, and the alignment of two genomes.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <gene_clocks/align.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <vector>

namespace {

using namespace gene_clocks;

void mint(benchmark::State& state) {
    GeneClock clock{RobotId{1}};
    for (auto _ : state) {
        auto mark = clock.mint();
        benchmark::DoNotOptimize(mark);
    }
}
BENCHMARK(mint);

void observe(benchmark::State& state) {
    GeneClock clock{RobotId{1}};
    Stamp stamp{1};
    for (auto _ : state) {
        stamp.value += 2;
        bool is_admitted = clock.observe(stamp);
        benchmark::DoNotOptimize(is_admitted);
    }
}
BENCHMARK(observe);

/// One message and one mutation: what a robot adds to a cycle at most.
void mint_and_observe(benchmark::State& state) {
    GeneClock ours{RobotId{1}};
    GeneClock theirs{RobotId{2}};
    for (auto _ : state) {
        auto mark = ours.mint();
        bool is_admitted = theirs.observe(ours.stamp());
        benchmark::DoNotOptimize(mark);
        benchmark::DoNotOptimize(is_admitted);
    }
}
BENCHMARK(mint_and_observe);

struct Gene {
    InnovationNumber mark;
    double weight;
};

struct GenomePair {
    std::vector<Gene> first;
    std::vector<Gene> second;
};

/// Two genomes of about `genes` genes each, nine tenths of which they share, as kin do.
GenomePair kin(std::int64_t genes) {
    GenomePair pair;
    std::uint64_t counter = 0;
    for (std::uint32_t random = 1; std::ssize(pair.first) < genes;) {
        random = random * 1664525u + 1013904223u;  // the shape matters, not the quality
        const InnovationNumber mark{++counter, RobotId{1 + (random >> 24) % 100}};
        const std::uint32_t kind = (random >> 8) % 20;
        if (kind != 0) pair.first.push_back({mark, std::sin(static_cast<double>(counter))});
        if (kind != 1) pair.second.push_back({mark, std::cos(static_cast<double>(counter))});
    }
    return pair;
}

/// The sum of |Δw| over matching genes and the numbers of disjoint and excess ones (Equation 1).
/// Items are genes of one genome.
void align_genomes(benchmark::State& state) {
    const auto [first, second] = kin(state.range(0));
    for (auto _ : state) {
        double weight_difference = 0.0;
        int disjoint = 0;
        int excess = 0;
        align(
            first, second,
            [&](GeneMatch match, std::size_t i, std::size_t j) {
                switch (match) {
                    case GeneMatch::matching:
                        weight_difference += std::abs(first[i].weight - second[j].weight);
                        break;
                    case GeneMatch::disjoint_first:
                    case GeneMatch::disjoint_second:
                        ++disjoint;
                        break;
                    case GeneMatch::excess_first:
                    case GeneMatch::excess_second:
                        ++excess;
                        break;
                }
            },
            &Gene::mark);
        benchmark::DoNotOptimize(weight_difference);
        benchmark::DoNotOptimize(disjoint);
        benchmark::DoNotOptimize(excess);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(align_genomes)->Arg(40)->Arg(200);

}  // namespace
