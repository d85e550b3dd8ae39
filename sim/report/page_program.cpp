#include "sim/report/page_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "sim/settings/embedded_files.hpp"
#include "sim/settings/input_error.hpp"

namespace gene_clocks::report {
namespace {

constexpr std::string_view page_folder = "report/page/";

/// Exits with 0 if Python has what the page needs; looks without importing it, which takes long.
constexpr const char* probe =
    "import importlib.util, sys\n"
    "sys.exit(sys.version_info < (3, 9) or"
    " not all(map(importlib.util.find_spec, ('matplotlib', 'jinja2'))))";

enum class Messages { shown, hidden };

/// Runs a program, found by PATH, to its end. Returns its exit status, or 127 where it cannot be
/// started or does not end by itself.
int run_program(std::vector<std::string> words, Messages messages) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (messages == Messages::hidden)
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child{};
    const int error =
        posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    constexpr int not_run = 127;
    if (error != 0) return not_run;
    int status = 0;
    while (waitpid(child, &status, 0) == -1) {
        if (errno != EINTR) return not_run;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : not_run;
}

/// A folder of its own in the system's place for temporary files; gone with the object.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "gene-clocks-report-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
            throw std::system_error(errno, std::generic_category(), pattern);
        path_ = pattern;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

void write_file(const std::filesystem::path& file, std::string_view text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

void unpack_page_program(const std::filesystem::path& folder) {
    for (const experiment::EmbeddedFile& file : experiment::embedded_files()) {
        if (file.path.starts_with(page_folder))
            write_file(folder / file.path.substr(page_folder.size()), file.text);
    }
}

}  // namespace

std::string find_python() {
    std::vector<std::string> candidates{"python3", "/usr/bin/python3"};
    if (const char* chosen = std::getenv("GENE_CLOCKS_PYTHON");
        chosen != nullptr && *chosen != '\0')
        candidates = {chosen};
    const auto found = std::ranges::find_if(candidates, [](const std::string& python) {
        return run_program({python, "-c", probe}, Messages::hidden) == 0;
    });
    if (found != candidates.end()) return *found;
    throw experiment::InputError(
        fmt::format("a report needs Python 3.9 or newer with matplotlib and Jinja2, and {}.\n"
                    "Debian: apt-get install python3-matplotlib python3-jinja2. Another Python is "
                    "taken from the "
                    "environment variable GENE_CLOCKS_PYTHON.",
                    candidates.size() == 1 ? candidates[0] + " is none"
                                           : "neither python3 nor /usr/bin/python3 is one"));
}

void draw_page(const std::string& python, const std::string& data,
               const std::filesystem::path& folder) {
    const TemporaryFolder temporary;
    unpack_page_program(temporary.path());
    const std::filesystem::path data_file = temporary.path() / "report.json";
    write_file(data_file, data);
    const std::filesystem::path program = temporary.path() / "write_page.py";
    const int status = run_program(
        {python, "-B", program.string(), data_file.string(), folder.string()}, Messages::shown);
    constexpr int bad_input = 2;
    if (status == bad_input)
        throw experiment::InputError(folder.string() + ": the report could not be written there");
    if (status != 0)
        throw std::runtime_error(fmt::format("drawing the report failed with status {}", status));
}

}  // namespace gene_clocks::report
