#pragma once

#include <array>
#include <cstdint>
#include <gene_clocks/sim/settings.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/settings/document.hpp"

namespace gene_clocks::report {

/// The settings that the paper tuned, in the order of Table 1; a parameter set gives their values.
inline constexpr std::array<std::string_view, 9> tuned_keys = {
    "odneat.p_mate", "odneat.p_mutate",          "odneat.p_weight",
    "odneat.p_node", "odneat.p_connection",      "odneat.p_recurrent",
    "odneat.sigma",  "odneat.maturation_cycles", "odneat.population"};

/// Where other people's runs lay: their middle half, or the range that a text gives.
struct PublishedRange {
    double lower{};
    std::optional<double> median;
    double upper{};

    [[nodiscard]] bool contains(double value) const { return lower <= value && value <= upper; }
};

/// What one source of published numbers says of one kind of run.
struct PublishedRuns {
    sim::Task task{};
    sim::Source source{};
    std::string parameters;  ///< the parameter set; empty: holds for every one
    std::map<std::string, PublishedRange> ranges;  ///< by measure
};

/// What the paper says of one task.
struct PublishedTask {
    std::string printed_parameters;          ///< the set that Table 1 prints for the task
    std::string run_parameters;              ///< the set that the published runs used
    std::map<std::string, double> p_values;  ///< Table 2, by measure
    double controller_size_p_value_above{};  ///< Figure 11
    std::int64_t cycles{};
};

/// The numbers of published.toml, which says where they come from.
struct Published {
    std::vector<PublishedRuns> paper;
    std::vector<PublishedRuns> reference;
    std::map<sim::Task, PublishedTask> tasks;
    std::map<std::string, double> fixed;  ///< Table 1's fixed values, by settings key
    double significance_level{};
    std::int64_t runs{};
};

/// Throws experiment::InputError, with file, line and key.
Published read_published(const experiment::Document& document);

/// The published numbers that are part of the program.
const Published& published();

}  // namespace gene_clocks::report
