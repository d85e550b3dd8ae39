#include "sim/experiment/study/study_schema.hpp"

#include <nlohmann/json.hpp>

#include "sim/settings/schema.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::experiment {
namespace {

using Json = nlohmann::ordered_json;

const Json text = {{"type", "string"}};
const Json fit_name = {{"type", "string"}, {"pattern", "^[A-Za-z0-9-]{1,100}$"}};

Json list_of(const Json& item) {
    return {{"type", "array"}, {"items", item}, {"minItems", 1}};
}

Json one_or_list(const Json& item) {
    return {{"anyOf", {item, list_of(item)}}};
}

/// Every key of the settings with a list of values.
Json lists_of_settings(bool with_selection) {
    Json properties = Json::object();
    for (const Setting& setting : settings_table()) {
        const std::string table(setting.table());
        const std::string name(setting.name());
        const Json list = list_of(setting_schema(setting));
        if (table.empty()) {
            if (with_selection) properties[name] = list;
            continue;
        }
        Json& entry = properties[table];
        entry["type"] = "object";
        entry["additionalProperties"] = false;
        entry["properties"][name] = list;
    }
    if (with_selection) {
        properties["name"] = list_of(fit_name);
        properties["profile"] = list_of(text);
        properties["parameters"] = list_of(text);
    }
    return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

Json settings_object() {
    Json settings = settings_schema();
    for (const char* key : {"$schema", "title"}) settings.erase(key);
    return settings;
}

Json arm() {
    const Json task = setting_schema(*find_setting("task"));
    const Json source = setting_schema(*find_setting("source"));
    return {{"type", "object"},
            {"properties",
             {{"name", fit_name},
              {"task", one_or_list(task)},
              {"source", one_or_list(source)},
              {"profile", one_or_list(text)},
              {"parameters", one_or_list(text)},
              {"settings", settings_object()},
              {"grid", lists_of_settings(false)},
              {"linked", list_of(lists_of_settings(true))}}},
            {"additionalProperties", false}};
}

/// The keys of [contrast] and of [contrast.paired].
Json baselines() {
    return {{"baseline", list_of(text)}, {"against", list_of(text)}, {"over", list_of(text)}};
}

Json contrast() {
    Json properties = baselines();
    properties["paired"] = {
        {"type", "object"}, {"properties", baselines()}, {"additionalProperties", false}};
    return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

}  // namespace

Json study_schema() {
    const Json seeds = {{"type", "integer"}, {"minimum", 1}, {"maximum", 1000000}};
    Json schema = schema_head("Study of Gene Clocks");
    schema.update({{"type", "object"},
                   {"properties",
                    {{"name", fit_name},
                     {"title", text},
                     {"description", text},
                     {"first_seed", {{"type", "integer"}, {"minimum", 0}, {"default", 1}}},
                     {"seeds", seeds},
                     {"profile", text},
                     {"settings", settings_object()},
                     {"quick",
                      {{"type", "object"},
                       {"properties", {{"seeds", seeds}, {"settings", settings_object()}}},
                       {"additionalProperties", false}}},
                     {"contrast", contrast()},
                     {"arm", list_of(arm())}}},
                   {"required", {"name", "title", "arm"}},
                   {"additionalProperties", false}});
    return schema;
}

}  // namespace gene_clocks::experiment
