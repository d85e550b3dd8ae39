# Writes a C++ source that holds files as text.
# cmake -DOUTPUT=embedded_files.cpp -DROOT=sim "-DFILES=studies/a.toml;arenas/b.toml" -P EmbedFiles.cmake
set(entries "")
list(SORT FILES)
foreach(file IN LISTS FILES)
    file(READ "${ROOT}/${file}" text)
    string(REGEX REPLACE "^settings/" "" name "${file}")
    string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from files under sim/ by EmbedFiles.cmake.
#include \"sim/settings/embedded_files.hpp\"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace gene_clocks::experiment {
namespace {

constexpr auto files = std::to_array<EmbeddedFile>({
${entries}});

}  // namespace

std::span<const EmbeddedFile> embedded_files() { return files; }

std::string_view embedded_text(std::string_view path) {
    const auto found = std::ranges::find(files, path, &EmbeddedFile::path);
    if (found == files.end()) throw std::out_of_range(\"no embedded file \" + std::string(path));
    return found->text;
}

}  // namespace gene_clocks::experiment
")
