#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace gene_clocks::experiment {

/// Input that the user can put right. The program reports it, exits with 2 and has written nothing.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Where input came from, for error messages.
struct Place {
    std::string source;      ///< a file's name, or what stands for it, such as "--set"
    std::uint32_t line = 0;  ///< from 1; 0 where lines mean nothing

    /// "file:line: " or "file: "; empty where there is no source.
    [[nodiscard]] std::string prefix() const {
        if (source.empty()) return {};
        return line == 0 ? source + ": " : source + ":" + std::to_string(line) + ": ";
    }
};

/// An error in the value of a key, or in the key itself.
inline InputError key_error(const Place& place, const std::string& key,
                            const std::string& message) {
    return InputError(place.prefix() + key + ": " + message);
}

}  // namespace gene_clocks::experiment
