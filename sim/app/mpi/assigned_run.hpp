#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/experiment/store/store.hpp"
#include "sim/experiment/study/study.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/settings_io.hpp"

namespace gene_clocks::app {

/// A run that a worker is to make, as it is sent.
struct AssignedRun {
    std::uint64_t arm{};  ///< its position in the study
    std::uint64_t seed{};

    [[nodiscard]] std::vector<std::uint8_t> bytes() const {
        std::vector<std::uint8_t> bytes(sizeof *this);
        std::memcpy(bytes.data(), this, sizeof *this);
        return bytes;
    }
    static AssignedRun of(std::span<const std::uint8_t> bytes) {
        AssignedRun run;
        if (bytes.size() != sizeof run) throw std::runtime_error("a message that assigns no run");
        std::memcpy(&run, bytes.data(), sizeof run);
        return run;
    }
};

/// Equal for processes that run the same version on the same study: all that a worker and the
/// coordinator must agree on.
inline std::string fingerprint(const experiment::Study& study) {
    std::string text = experiment::program_version();
    for (const experiment::Arm& arm : study.arms) text += ' ' + arm.settings_hash;
    return experiment::hash_of(text);
}

}  // namespace gene_clocks::app
