#include "sim/experiment/study/contrast_table.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/settings/settings_io.hpp"

namespace gene_clocks::experiment {
namespace {

/// The texts of a list, each checked by `check(text)`, which may throw InputError.
template <typename Check>
std::vector<std::string> read_list(const Document& document, TableReader& reader, const char* key,
                                   const std::string& path, Check check) {
    std::vector<std::string> texts;
    if (reader.find(key) == nullptr) return texts;
    const toml::array& list = reader.array(key);
    if (list.empty()) throw reader.error(key, "is an empty list; leave it out, or fill it");
    for (const toml::node& node : list) {
        const Place place = document.place_of(node);
        texts.push_back(read_text(node, place, path + "." + key));
        try {
            check(texts.back());
        } catch (const InputError& error) {
            throw key_error(place, path + "." + key, error.what());
        }
    }
    return texts;
}

Baselines read_baselines(const Document& document, TableReader& reader, const std::string& path) {
    Baselines baselines;
    baselines.baseline = read_list(document, reader, "baseline", path, [](const std::string& text) {
        sim::Settings unused;
        assign(unused, text, "");
    });
    baselines.against = read_list(document, reader, "against", path, [](const std::string&) {});
    baselines.over = read_list(document, reader, "over", path, [](const std::string& text) {
        if (find_setting(text) == nullptr) {
            throw InputError(
                fmt::format("there is no setting \"{}\"{}", text, suggest_setting(text)));
        }
    });
    if (!baselines.baseline.empty() && !baselines.against.empty()) {
        throw reader.error("against", "the table has a baseline as well; keep one of the two");
    }
    return baselines;
}

nlohmann::json to_json(const Baselines& baselines) {
    return {
        {"baseline", baselines.baseline}, {"against", baselines.against}, {"over", baselines.over}};
}

Baselines baselines_from(const nlohmann::json& json) {
    return {json.at("baseline").get<std::vector<std::string>>(),
            json.at("against").get<std::vector<std::string>>(),
            json.at("over").get<std::vector<std::string>>()};
}

}  // namespace

ContrastTable read_contrast_table(const Document& document, const toml::table& table) {
    TableReader reader(document, table, "contrast");
    ContrastTable contrast;
    contrast.arms = read_baselines(document, reader, "contrast");
    const toml::table* paired = reader.table("paired");
    reader.refuse_other_keys();
    if (paired != nullptr) {
        TableReader paired_reader(document, *paired, "contrast.paired");
        contrast.paired = read_baselines(document, paired_reader, "contrast.paired");
        paired_reader.refuse_other_keys();
    }
    return contrast;
}

std::string to_text(const ContrastTable& table) {
    nlohmann::json json = to_json(table.arms);
    if (table.paired) json["paired"] = to_json(*table.paired);
    return json.dump();
}

ContrastTable contrast_table_from(const std::string& text, const std::string& origin) {
    try {
        const auto json = nlohmann::json::parse(text);
        ContrastTable table{baselines_from(json), {}};
        if (json.contains("paired")) table.paired = baselines_from(json["paired"]);
        return table;
    } catch (const nlohmann::json::exception&) {
        throw InputError(origin + ": is damaged: unreadable table of contrasts");
    }
}

}  // namespace gene_clocks::experiment
