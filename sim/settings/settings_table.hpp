#pragma once

#include <cstdint>
#include <gene_clocks/sim/settings.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gene_clocks::experiment {

/// The value of one setting. Choices are text: the choice's name.
using Value = std::variant<bool, std::int64_t, double, std::string>;

/// As the command line takes it, for example "0.25", "true" or "gene-clock".
std::string to_text(const Value& value);

/// The values that a number may take.
struct Range {
    double minimum = 0.0;
    double maximum = 0.0;
    bool minimum_excluded = false;

    /// False for NaN.
    [[nodiscard]] bool contains(double value) const {
        return (minimum_excluded ? value > minimum : value >= minimum) && value <= maximum;
    }
    /// For example "[0, 1]" or "(0, 100]".
    [[nodiscard]] std::string text() const;
};

/// One key of `sim::Settings`: all that is known about it stands here and nowhere else.
struct Setting {
    std::string key;  ///< with its table, as in "odneat.p_mate"
    Range range;      ///< of a number
    std::string unit;
    std::string paper;  ///< where the paper speaks of it; empty where it does not
    std::string description;
    std::vector<std::string> choices;  ///< of a choice
    Value (*get)(const sim::Settings&);
    /// Throws std::bad_variant_access for a value of another type; does not look at the range.
    void (*set)(sim::Settings&, const Value&);

    [[nodiscard]] Value default_value() const { return get(sim::Settings{}); }
    /// The part before the dot; empty for a key outside all tables.
    [[nodiscard]] std::string_view table() const;
    /// The part after the dot.
    [[nodiscard]] std::string_view name() const;
    /// The measures are taken from a run's samples: they change neither its course nor its record.
    [[nodiscard]] bool shapes_run() const { return table() != "measures"; }
};

/// Every key, table by table.
const std::vector<Setting>& settings_table();

/// The setting of that key; null where there is none.
const Setting* find_setting(std::string_view key);

/// The keys in which two settings differ, in the table's order.
std::vector<std::string> differing_keys(const sim::Settings& one, const sim::Settings& other);

/// "; did you mean odneat.p_mate?", also for a key that lacks its table; or nothing.
std::string suggest_setting(std::string_view key);

}  // namespace gene_clocks::experiment
