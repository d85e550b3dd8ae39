#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/settings/document.hpp"

namespace gene_clocks::experiment {

/// What arms are compared with. Not both of `baseline` and `against` have elements.
struct Baselines {
    /// "key=value": the baseline of an arm is the one whose settings are its own but for these.
    std::vector<std::string> baseline = {};
    /// Names of arms: the baseline of an arm is the one of these with its task and profile.
    std::vector<std::string> against = {};
    /// Keys of settings that are conditions, in which arms may differ from their baselines.
    std::vector<std::string> over = {};

    friend bool operator==(const Baselines&, const Baselines&) = default;
};

/// The table [contrast] of a study's file: what `gene-clocks contrast` compares its arms with where
/// the command line does not say.
struct ContrastTable {
    Baselines arms;                   ///< arm by arm
    std::optional<Baselines> paired;  ///< seed by seed, where that is not the same question

    friend bool operator==(const ContrastTable&, const ContrastTable&) = default;
};

/// Reads a table [contrast], with the keys `baseline`, `against` and `over`, and a table `paired`
/// with the same keys. Throws InputError, with file, line and key, for what is unfit in itself;
/// whether there are arms of the names in `against` is the caller's to check.
ContrastTable read_contrast_table(const Document& document, const toml::table& table);

/// As the store keeps it, and back. Throws InputError where the text is no such table.
std::string to_text(const ContrastTable& table);
ContrastTable contrast_table_from(const std::string& text, const std::string& origin);

}  // namespace gene_clocks::experiment
