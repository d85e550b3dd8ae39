// Property: a settings text is either refused with an InputError, or gives settings that survive
// being written and read again. The same text is tried as a study and as an arena.

#include <nlohmann/json.hpp>
#include <string>

#include "fuzz/require.hpp"
#include "sim/experiment/study/study.hpp"
#include "sim/settings/arena_file.hpp"
#include "sim/settings/document.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/settings_io.hpp"

using namespace gene_clocks;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        const auto document = experiment::parse_document(text, "input.toml");
        sim::Settings settings;
        experiment::read_settings(document, document.table, settings);
        const auto written =
            experiment::parse_document(experiment::to_toml(settings), "written.toml");
        sim::Settings again;
        experiment::read_settings(written, written.table, again);
        GENE_CLOCKS_REQUIRE(experiment::to_json(settings) == experiment::to_json(again));
    } catch (const experiment::InputError&) {
    }
    try {
        experiment::read_arena(experiment::parse_document(text, "input.toml"));
    } catch (const experiment::InputError&) {
    }
    sim::Settings assigned;
    const std::string before = experiment::to_toml(assigned);
    try {
        experiment::assign(assigned, text.substr(0, text.find('\n')));
    } catch (const experiment::InputError&) {
        GENE_CLOCKS_REQUIRE(experiment::to_toml(assigned) == before);
    }
    return 0;
}
