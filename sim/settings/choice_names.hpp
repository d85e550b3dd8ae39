#pragma once

#include <array>
#include <cstddef>
#include <gene_clocks/sim/settings.hpp>
#include <optional>
#include <string_view>

namespace gene_clocks::experiment {

/// The names of an enumeration's values, in its order, as files and the command line write them.
template <typename Choice>
inline constexpr std::array<std::string_view, 0> choice_names;

template <>
inline constexpr std::array<std::string_view, 2> choice_names<sim::Task> = {"navigation",
                                                                            "collection"};
template <>
inline constexpr auto choice_names<sim::Source> = [] {
    std::array<std::string_view, sim::sources.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = sim::sources[i].name;
    return names;
}();
template <>
inline constexpr std::array<std::string_view, 2> choice_names<sim::Actuation> = {
    "translation-rotation", "wheels"};
template <>
inline constexpr std::array<std::string_view, 2> choice_names<sim::NavigationEnergy> = {
    "reference", "equation-2"};
template <>
inline constexpr std::array<std::string_view, 2> choice_names<neat::WeightDifference> = {"sum",
                                                                                         "mean"};
template <>
inline constexpr std::array<std::string_view, 2> choice_names<neat::HeldEnergy> = {"overwrite",
                                                                                   "running-mean"};
template <>
inline constexpr std::array<std::string_view, 2> choice_names<neat::HeldReports> = {"all",
                                                                                    "acceptable"};
template <>
inline constexpr std::array<std::string_view, 2> choice_names<sim::RebootClock> = {"kept", "lost"};
template <>
inline constexpr std::array<std::string_view, 2> choice_names<neat::CrossoverKind> = {"uniform",
                                                                                      "one-point"};
template <>
inline constexpr std::array<std::string_view, 3> choice_names<neat::Mismatch> = {
    "excess-disjoint", "age", "since-common"};
template <>
inline constexpr std::array<std::string_view, 3> choice_names<neat::SecondParent> = {
    "tournament", "other", "population"};

/// The name of a choice. Throws std::out_of_range for a value that has none.
template <typename Choice>
constexpr std::string_view name_of(Choice choice) {
    return choice_names<Choice>.at(static_cast<std::size_t>(choice));
}

/// The choice of that name, if there is one.
template <typename Choice>
constexpr std::optional<Choice> choice_of(std::string_view name) {
    const auto& names = choice_names<Choice>;
    for (std::size_t index = 0; index < names.size(); ++index) {
        if (names[index] == name) return static_cast<Choice>(index);
    }
    return std::nullopt;
}

}  // namespace gene_clocks::experiment
