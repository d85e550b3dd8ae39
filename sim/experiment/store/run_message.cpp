#include "sim/experiment/store/run_message.hpp"

#include <xxhash.h>

#include <concepts>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

#include "sim/experiment/store/store.hpp"
#include "sim/settings/program_version.hpp"

namespace gene_clocks::experiment {
namespace {

using nlohmann::json;

constexpr std::uint64_t format_version = 1;

template <typename T, typename Record>
concept either = std::same_as<std::remove_const_t<T>, Record>;

// The fields of records without a visitor. A structured binding names all of them, so that a field
// that a record gains does not compile until it is sent.
auto fields(either<InnovationNumber> auto& record) {
    auto& [counter, robot] = record;
    return std::tie(counter, robot);
}
auto fields(either<sim::GeneCreation> auto& record) {
    auto& [mark, robot, cycle] = record;
    return std::tie(mark, robot, cycle);
}
auto fields(either<sim::RunResult> auto& record) {
    auto& [samples, counters, chronology, creations, trajectory_hash, robot_steps, cpu_seconds] =
        record;
    return std::tie(samples, counters, chronology, creations, trajectory_hash, robot_steps,
                    cpu_seconds);
}
auto fields(either<RunMessage> auto& record) {
    auto& [settings_hash, seed, result, wall_seconds] = record;
    return std::tie(settings_hash, seed, result, wall_seconds);
}

// Records that have a visitor of their own.
void for_each_field(either<sim::Sample> auto& record, auto visit) {
    sim::for_each_value(record, visit);
}
void for_each_field(either<sim::RunCounters> auto& record, auto visit) {
    sim::for_each_counter(record, visit);
}
void for_each_field(either<sim::ChronologyMeasures> auto& record, auto visit) {
    sim::for_each_measure(record, visit);
}
template <typename T>
concept visited =
    either<T, sim::Sample> || either<T, sim::RunCounters> || either<T, sim::ChronologyMeasures>;

/// Numbers and texts as they are, records and vectors as arrays.
template <typename T>
json to_value(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::same_as<T, std::string>) {
        return value;
    } else if constexpr (std::is_enum_v<T>) {
        return static_cast<std::underlying_type_t<T>>(value);
    } else if constexpr (visited<T>) {
        json array = json::array();
        for_each_field(value, [&](const char*, const auto& field) { array.push_back(field); });
        return array;
    } else if constexpr (requires { value.begin(); }) {
        json array = json::array();
        for (const auto& element : value) array.push_back(to_value(element));
        return array;
    } else {
        return std::apply([](const auto&... each) { return json::array({to_value(each)...}); },
                          fields(value));
    }
}

void require(bool condition) {
    if (!condition) throw std::runtime_error("a message that is no run");
}

/// Takes the elements of an array, in turn; all of them must be taken.
class Elements {
public:
    explicit Elements(const json& array) : array_(array) { require(array.is_array()); }
    const json& next() {
        require(taken_ < array_.size());
        return array_[taken_++];
    }
    void end() const { require(taken_ == array_.size()); }

private:
    const json& array_;
    std::size_t taken_ = 0;
};

template <typename T>
void from_value(const json& value, T& out) {
    if constexpr (std::floating_point<T>) {
        require(value.is_number_float());
        out = value.get<T>();
    } else if constexpr (std::unsigned_integral<T>) {
        require(value.is_number_unsigned() && std::in_range<T>(value.get<std::uint64_t>()));
        out = value.get<T>();
    } else if constexpr (std::signed_integral<T>) {
        require(value.is_number_integer());
        require(!value.is_number_unsigned() || std::in_range<T>(value.get<std::uint64_t>()));
        out = value.get<T>();
    } else if constexpr (std::is_enum_v<T>) {
        std::underlying_type_t<T> number{};
        from_value(value, number);
        out = static_cast<T>(number);
    } else if constexpr (std::same_as<T, std::string>) {
        require(value.is_string());
        out = value.get<std::string>();
    } else if constexpr (visited<T>) {
        Elements elements(value);
        for_each_field(out, [&](const char*, auto& field) { from_value(elements.next(), field); });
        elements.end();
    } else if constexpr (requires { out.push_back({}); }) {
        require(value.is_array());
        out.resize(value.size());
        for (std::size_t i = 0; i < out.size(); ++i) from_value(value[i], out[i]);
    } else {
        Elements elements(value);
        std::apply([&](auto&... each) { (from_value(elements.next(), each), ...); }, fields(out));
        elements.end();
    }
}

using Hash = std::uint64_t;

Hash hash_of_bytes(std::span<const std::uint8_t> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace

std::vector<std::uint8_t> encode(const RunMessage& message) {
    std::vector<std::uint8_t> bytes(sizeof(Hash));
    json::to_cbor(json::array({format_version, program_version(), to_value(message)}), bytes);
    const Hash hash = hash_of_bytes(std::span(bytes).subspan(sizeof(Hash)));
    std::memcpy(bytes.data(), &hash, sizeof hash);
    return bytes;
}

RunMessage decode(std::span<const std::uint8_t> bytes) {
    require(bytes.size() >= sizeof(Hash));
    Hash hash{};
    std::memcpy(&hash, bytes.data(), sizeof hash);
    bytes = bytes.subspan(sizeof hash);
    require(hash == hash_of_bytes(bytes));
    const json value = json::from_cbor(bytes.begin(), bytes.end(), true, false);
    require(!value.is_discarded());
    Elements elements(value);
    require(elements.next() == format_version);
    if (const json& version = elements.next(); version != program_version()) {
        throw std::runtime_error("a message of another version of gene-clocks: " + version.dump());
    }
    RunMessage message;
    from_value(elements.next(), message);
    elements.end();
    return message;
}

}  // namespace gene_clocks::experiment
