#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gene_clocks::test {

/// A program, gene-clocks if it is not said otherwise, as a process of its own.
class Program {
public:
    using Arguments = std::vector<std::string>;

    /// Starts it in a folder.
    Program(const std::filesystem::path& folder, const Arguments& arguments,
            const char* program = PROGRAM);
    ~Program();  ///< kills it if it still runs
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    [[nodiscard]] pid_t process() const { return process_; }

    /// Sends it a signal.
    void signal(int number) const;

    /// Waits until something is so, or the program has ended; returns whether it was so.
    bool wait_until(const std::function<bool()>& seen) const;
    /// Waits likewise until its standard error contains a text.
    bool wait_for_message(const std::string& text) const;

    /// What a program that has ended leaves.
    struct Result {
        int status{};  ///< its exit status; minus the signal's number if one killed it
        std::string output;
        std::string messages;  ///< its standard error
    };
    /// Waits until it has ended.
    Result wait();

private:
    pid_t process_ = 0;  ///< 0 once it was waited for
    std::filesystem::path output_;
    std::filesystem::path messages_;
};

/// Runs it to its end.
Program::Result gene_clocks(const std::filesystem::path& folder,
                            const Program::Arguments& arguments);

}  // namespace gene_clocks::test
