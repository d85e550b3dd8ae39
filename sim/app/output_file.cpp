#include "sim/app/output_file.hpp"

#include <iostream>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sim/settings/input_error.hpp"

namespace gene_clocks::app {

namespace fs = std::filesystem;
using experiment::InputError;

OutputFile::OutputFile(fs::path name) : name_(std::move(name)) {
    if (name_.empty()) throw InputError("the name of an output file is empty; give it one");
    std::error_code unknown;  // then opening fails as well
    const fs::file_status present = fs::symlink_status(name_, unknown);
    // To rename over a device or a link would replace it.
    if (fs::exists(present) && !fs::is_regular_file(present)) {
        throw InputError(name_.string() + ": exists and is not a regular file; give another name");
    }
    const fs::path unfinished = name_.string() + ".part";
    fs::remove(unfinished, unknown);  // what was left there, were it a link to something of value
    stream_.open(unfinished, std::ios::binary | std::ios::trunc);
    if (!stream_) throw InputError(name_.string() + ": cannot be written there");
    unfinished_ = unfinished;
}

OutputFile::~OutputFile() {
    if (unfinished_.empty()) return;
    std::error_code ignored;
    fs::remove(unfinished_, ignored);
}

void OutputFile::finish() {
    stream_.close();
    if (!stream_) throw std::runtime_error(name_.string() + ": writing failed");
    fs::rename(unfinished_, name_);
    unfinished_.clear();
}

Output::Output(const std::string& name) {
    if (name != "-") file_.emplace(name);
}

std::ostream& Output::stream() {
    return file_ ? file_->stream() : std::cout;
}

void Output::finish() {
    if (file_) {
        file_->finish();
    } else if (!std::cout.flush()) {
        throw std::runtime_error("standard output cannot be written");
    }
}

void require_different(std::initializer_list<NamedOutput> outputs) {
    std::map<std::string, std::string_view> options;  // by the place that they name
    for (const auto& [option, name] : outputs) {
        if (name.empty()) continue;
        std::error_code unknown;  // then the path as it is has to do
        const fs::path path =
            name == "-" ? fs::path(name) : fs::weakly_canonical(fs::absolute(name), unknown);
        const std::string place = unknown ? name : path.string();
        const auto [other, is_new] = options.emplace(place, option);
        if (!is_new) {
            throw InputError(std::string(option) + ": " + std::string(other->second) + " goes to " +
                             name + " already");
        }
    }
}

}  // namespace gene_clocks::app
