// Must fail: shows that a broken property is noticed, under the fuzzer and in replay.

#include <cstdint>
#include <string_view>

#include "fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    GENE_CLOCKS_REQUIRE(!text.starts_with("clock"));
    return 0;
}
