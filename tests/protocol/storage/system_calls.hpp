#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// A layer between PosixFiles and the operating system, in which any call may go wrong. The linker
/// puts it there (--wrap, in CMakeLists.txt): what is tested is the library as it ships.
namespace gene_clocks::test {

enum class Call : std::uint8_t { openat, flock, read, write, fsync, renameat, unlinkat, close };
inline constexpr int call_kinds = 8;

/// What becomes of one call.
enum class Upset : std::uint8_t {
    none,
    fails_undone,  ///< it returns −1 and has done nothing
    fails_done,    ///< it returns −1 and has been done all the same
    half,          ///< a read or a write of half of the bytes
    nothing,       ///< a read or a write of no byte
    dies_before,   ///< the process ends instead of the call
    dies_after,    ///< … or right after it
};

/// An upset of the call number `at`, counted from 0, and of those after it up to `last`.
struct Plan {
    Upset upset = Upset::none;
    int system_error = 0;  ///< errno, where it fails
    int at = -1;
    int last = -1;  ///< −1: only the one
};

/// Watches the calls while it lives, and carries out plans. One at a time.
class SystemCalls {
public:
    explicit SystemCalls(std::vector<Plan> plans = {});
    ~SystemCalls();
    SystemCalls(const SystemCalls&) = delete;
    SystemCalls& operator=(const SystemCalls&) = delete;

    /// The calls so far.
    [[nodiscard]] const std::vector<Call>& made() const { return made_; }
    /// How many of them were upset.
    [[nodiscard]] int upset() const { return upset_; }
    /// Descriptors that were opened and not closed.
    [[nodiscard]] int open_descriptors() const { return open_descriptors_; }

    /// For the layer itself: what is to become of the next call.
    Plan next(Call call);
    void count_descriptor(int change) { open_descriptors_ += change; }

private:
    std::vector<Plan> plans_;
    std::vector<Call> made_;
    int upset_ = 0;
    int open_descriptors_ = 0;
};

}  // namespace gene_clocks::test
