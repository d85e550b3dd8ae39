#pragma once

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace gene_clocks::app {

/// A file that is whole or not there: it is written beside its place, under its name with ".part",
/// and renamed at the end.
class OutputFile {
public:
    /// Throws InputError where nothing can be written, or where something that is no plain file (a
    /// folder, a device, a link) has that name.
    explicit OutputFile(std::filesystem::path name);
    ~OutputFile();  ///< removes what is unfinished
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    std::ostream& stream() { return stream_; }

    /// Puts the file in its place. Throws std::runtime_error where not all of it could be written.
    void finish();

private:
    std::filesystem::path name_;
    std::filesystem::path unfinished_;  ///< empty once renamed
    std::ofstream stream_;
};

/// An output file, or standard output for the name "-".
class Output {
public:
    /// Throws as OutputFile does.
    explicit Output(const std::string& name);

    std::ostream& stream();

    /// Throws std::runtime_error where not all of it could be written.
    void finish();

private:
    std::optional<OutputFile> file_;  ///< none: standard output
};

/// An option of the command line and the file it names; "-" is standard output, "" none.
using NamedOutput = std::pair<std::string_view, std::string>;

/// Throws InputError where two of them would go to one place, however that is written.
void require_different(std::initializer_list<NamedOutput> outputs);

}  // namespace gene_clocks::app
