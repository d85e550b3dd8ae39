#pragma once

#include <span>
#include <string_view>

namespace gene_clocks::experiment {

/// A file of the repository that is part of the program.
struct EmbeddedFile {
    std::string_view path;  ///< below sim/, as in "studies/gecco15.toml"
    std::string_view text;
};

/// All of them, sorted by path. Generated at build time by EmbedFiles.cmake.
std::span<const EmbeddedFile> embedded_files();

/// The text of an embedded file. Throws std::out_of_range where there is none at that path.
std::string_view embedded_text(std::string_view path);

}  // namespace gene_clocks::experiment
