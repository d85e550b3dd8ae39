#include "output_file.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>

#include "input_error.hpp"

namespace gene_clocks::app {

namespace fs = std::filesystem;
using experiment::InputError;

OutputFile::OutputFile(fs::path name) : name_(std::move(name)) {
    if (name_.empty()) throw InputError("a file to write needs a name");
    std::error_code unknown;  // then opening fails as well
    const fs::file_status present = fs::symlink_status(name_, unknown);
    // To rename over a device or a link would replace it.
    if (fs::exists(present) && !fs::is_regular_file(present)) {
        throw InputError(name_.string() + ": is there already, and is not a plain file");
    }
    const fs::path unfinished = name_.string() + ".part";
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

}  // namespace gene_clocks::app
