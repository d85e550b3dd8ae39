// Property, differential: the shipped trace checker and the proved one, which runs in this process,
// give the same verdict on any bytes (docs/trace-format.md). The first byte says whether the rest
// is the text itself, or chooses entries that come close to keeping the rules.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <string_view>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"
#include "proofs/oracle/in_process.h"
#include "protocol/trace/trace_reader.hpp"

namespace {

using gene_clocks::fuzz::ByteReader;

/// A number near those that matter in a fleet with these few robots, counters and messages.
std::uint64_t number(ByteReader& bytes) {
    const std::uint8_t byte = bytes.byte();
    return byte == 255 ? bytes.word() : byte == 254 ? ~std::uint64_t{bytes.byte()} : byte % 64;
}

std::string trace_of(ByteReader bytes) {
    std::string text = "gene-clocks-trace 1\n";
    const std::uint64_t maximum = number(bytes);
    const std::uint64_t window = number(bytes);
    text += fmt::format("limits {} {} {}\n", maximum, window, bytes.below(4));
    std::uint64_t entries = 0;
    for (; !bytes.empty(); ++entries) {
        static constexpr std::string_view kinds = "msrwc";
        const char kind = kinds[bytes.below(kinds.size())];
        text += fmt::format("{} {} {}", kind, 1 + bytes.below(4), number(bytes));
        if (kind == 'm' || kind == 's' || kind == 'r') text += fmt::format(" {}", number(bytes));
        text += '\n';
    }
    return text + fmt::format("end {}\n", entries);
}

void compare(const std::string& text) {
    std::istringstream in(text);
    const std::string shipped = gene_clocks::trace::check_trace(in).text();
    const std::string proved = gene_clocks_oracle_verdict(text.data(), text.size());
    if (shipped != proved) {
        std::fprintf(stderr, "%s\n  proved:  %s\n  shipped: %s\n", text.c_str(), proved.c_str(),
                     shipped.c_str());
    }
    GENE_CLOCKS_REQUIRE(shipped == proved);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    [[maybe_unused]] static const bool started = (gene_clocks_oracle_start(), true);
    ByteReader bytes({data, size});
    if (bytes.byte() % 2 == 0) {
        compare(trace_of(bytes));
    } else {
        compare(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    }
    return 0;
}
