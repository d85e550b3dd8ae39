#include "sim/core/src/source_factory.hpp"

#include <stdexcept>

#include "sim/core/src/random_streams.hpp"

namespace gene_clocks::sim {
namespace {

/// What drifts when nobody says how: quartz that is off by up to 100 ppm, in robots that were
/// switched on within ten thousand cycles.
constexpr TimestampSettings typical_drift{.offset_cycles = 10'000.0, .drift_ppm = 100.0};

}  // namespace

SourceFactory::SourceFactory(const Settings& settings, std::uint64_t genesis_count,
                             std::uint64_t seed)
    : settings_(settings),
      genesis_count_(genesis_count),
      seed_(seed),
      local_times_(draw_local_times()),
      record_(std::make_shared<neat::InnovationRecord>(genesis_count)) {}

std::vector<neat::LocalTime> SourceFactory::draw_local_times() const {
    const bool is_typical =
        settings_.source == Source::timestamp_drift && settings_.timestamp == TimestampSettings{};
    const TimestampSettings& clock = is_typical ? typical_drift : settings_.timestamp;
    neat::RandomStream random = make_stream(seed_, Stream::clocks);
    std::vector<neat::LocalTime> times;
    for (std::int64_t robot = 1; robot <= settings_.world.robots; ++robot) {
        neat::LocalTime& time = times.emplace_back();
        time.offset_cycles = random.uniform(-1.0, 1.0) * clock.offset_cycles;
        time.drift_rate = random.uniform(-1.0, 1.0) * clock.drift_ppm * 1e-6;
        time.synchronised_every_cycles = clock.synchronised_every_cycles;
        time.synchronisation_error_cycles = clock.synchronisation_error_cycles;
        time.seed =
            make_stream(seed_, Stream::synchronisation, static_cast<std::uint64_t>(robot)).bits();
    }
    return times;
}

std::unique_ptr<neat::InnovationSource> SourceFactory::make(RobotId robot,
                                                            std::uint64_t life) const {
    const auto index = static_cast<std::uint64_t>(robot);
    const neat::SourceParts parts{
        .robot = robot,
        .robots = static_cast<std::uint64_t>(settings_.world.robots),
        .genesis_count = genesis_count_,
        .time = local_times_.at(index - 1),
        .random = make_stream(seed_, Stream::identifiers, index + (life << 20)),
        .record = record_};
    switch (settings_.source) {
#define GENE_CLOCKS_MAKE_SOURCE(enumerator, name, class_name, ...) \
    case Source::enumerator:                                       \
        return std::make_unique<neat::class_name>(parts);
        GENE_CLOCKS_SOURCES(GENE_CLOCKS_MAKE_SOURCE)
#undef GENE_CLOCKS_MAKE_SOURCE
    }
    throw std::invalid_argument("unknown innovation source");
}

}  // namespace gene_clocks::sim
