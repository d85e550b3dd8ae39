#include "tests/sim/app/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::test {
namespace {

/// A new empty file outside the program's folder, which tests look into.
std::filesystem::path make_file() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "gene-clocks-out-XXXXXX").string();
    const int descriptor = mkstemp(pattern.data());
    if (descriptor < 0) throw std::runtime_error("no temporary file");
    close(descriptor);
    return pattern;
}

}  // namespace

Program::Program(const std::filesystem::path& folder, const Arguments& arguments,
                 const char* program)
    : output_(make_file()), messages_(make_file()) {
    std::vector<char*> words{const_cast<char*>(program)};
    for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ > 0) return;
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(open(output_.c_str(), O_WRONLY), STDOUT_FILENO);
    dup2(open(messages_.c_str(), O_WRONLY | O_APPEND), STDERR_FILENO);
    if (chdir(folder.c_str()) == 0) execv(program, words.data());
    _exit(127);
}

Program::~Program() {
    if (process_ != 0) {
        signal(SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    std::filesystem::remove(output_);
    std::filesystem::remove(messages_);
}

void Program::signal(int number) const {
    kill(process_, number);
}

bool Program::wait_until(const std::function<bool()>& seen) const {
    siginfo_t info{};
    while (!seen()) {
        // Ended, but not yet collected: one last look.
        waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT);
        if (info.si_pid != 0) return seen();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

bool Program::wait_for_message(const std::string& text) const {
    return wait_until([&] { return read_all(messages_).find(text) != std::string::npos; });
}

Program::Result Program::wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_all(output_),
            read_all(messages_)};
}

Program::Result gene_clocks(const std::filesystem::path& folder,
                            const Program::Arguments& arguments) {
    return Program(folder, arguments).wait();
}

}  // namespace gene_clocks::test
