#include "sim/experiment/study/arm_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace gene_clocks::experiment {
namespace {

constexpr std::array<std::string_view, 4> selection_keys = {"task", "source", "profile",
                                                            "parameters"};

bool is_selection_key(std::string_view key) {
    return std::ranges::find(selection_keys, key) != selection_keys.end();
}

/// Keys that vary together, through the points of one or more lists of equal length.
struct Axis {
    struct Point {
        std::string label;  ///< its part of the arm's name; may be empty
        std::vector<KeyedNode> values;
    };
    KeyedNode origin;  ///< of the first list; for messages
    std::vector<Point> points;
};

bool is_fit_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
}

/// A real number in as few digits as it takes to tell it from any other, without an exponent.
std::string fixed_text(double value) {
    std::array<char, 1100> text{};  // the longest has 1076 characters
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
    return {text.data(), end};
}

/// A value as part of a name: "0p5" for 0.5, "m3" for -3, "rooms" for the file "my/rooms.toml".
std::string value_label(const KeyedNode& node) {
    std::string text;
    switch (node.value->type()) {
        case toml::node_type::string:
            text = node.value->value<std::string>().value();
            if (is_file_name(text)) text = std::filesystem::path(text).stem().string();
            std::ranges::replace_if(text, std::not_fn(is_fit_character), '-');
            return text;
        case toml::node_type::integer:
            text = fmt::format("{}", node.value->value<std::int64_t>().value());
            break;
        case toml::node_type::floating_point:
            text = fixed_text(node.value->value<double>().value());
            break;
        case toml::node_type::boolean:
            return node.value->value<bool>().value() ? "true" : "false";
        default:
            throw key_error(node.place, node.key, "expected a list of numbers, texts or flags");
    }
    std::ranges::replace(text, '.', 'p');
    std::ranges::replace(text, '-', 'm');
    return text;
}

/// "range-px" for "radio.range_px".
std::string key_label(const std::string& key) {
    std::string label = key.substr(key.find('.') + 1);
    std::ranges::replace(label, '_', '-');
    return label;
}

std::string label_of(const KeyedNode& node) {
    const std::string value = value_label(node);
    return is_selection_key(node.key) ? value : key_label(node.key) + "-" + value;
}

/// The values of a list, each under the list's key.
std::vector<KeyedNode> values_of(const Document& document, const KeyedNode& list) {
    const toml::array* array = list.value->as_array();
    if (array == nullptr) throw key_error(list.place, list.key, "expected a list of values");
    if (array->empty()) throw key_error(list.place, list.key, "the list is empty");
    std::vector<KeyedNode> values;
    for (const toml::node& value : *array) {
        values.push_back({list.key, document.place_of(value), &value});
    }
    return values;
}

void refuse_equal_labels(const Axis& axis) {
    std::set<std::string> labels;
    for (const Axis::Point& point : axis.points) {
        if (labels.insert(point.label).second) continue;
        throw key_error(point.values.front().place, axis.origin.key,
                        fmt::format("two values of the list would both be called {}", point.label));
    }
}

Axis axis_of(const Document& document, const KeyedNode& list) {
    Axis axis{list, {}};
    for (KeyedNode& value : values_of(document, list)) {
        std::string label = label_of(value);
        axis.points.push_back({std::move(label), {std::move(value)}});
    }
    refuse_equal_labels(axis);
    return axis;
}

/// The names that a [[arm.linked]] gives its points.
std::vector<std::string> given_labels(const Document& document, const KeyedNode& list) {
    std::vector<std::string> labels;
    for (const KeyedNode& value : values_of(document, list)) {
        labels.push_back(read_text(*value.value, value.place, list.key));
        if (!is_fit_name(labels.back())) {
            throw key_error(value.place, list.key, "expected 1 to 100 letters, digits and hyphens");
        }
    }
    return labels;
}

Axis linked_axis(const Document& document, const toml::table& table) {
    std::vector<KeyedNode> lists = flatten(document, table);
    std::vector<std::string> labels;
    const auto name = std::ranges::find(lists, "name", &KeyedNode::key);
    std::optional<KeyedNode> named;
    if (name != lists.end()) {
        named = {"arm.linked.name", name->place, name->value};
        labels = given_labels(document, *named);
        lists.erase(name);
    }
    if (lists.empty()) {
        throw key_error(document.place_of(table), "arm.linked", "has no list of values");
    }
    Axis axis{lists.front(), {}};
    for (const KeyedNode& list : lists) {
        std::vector<KeyedNode> values = values_of(document, list);
        if (&list == &lists.front()) axis.points.resize(values.size());
        if (values.size() != axis.points.size()) {
            throw key_error(list.place, list.key,
                            fmt::format("has {} values, {}, which it is linked with, has {}",
                                        values.size(), axis.origin.key, axis.points.size()));
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
            axis.points[i].values.push_back(std::move(values[i]));
        }
    }
    if (named && labels.size() != axis.points.size()) {
        throw key_error(named->place, named->key,
                        fmt::format("has {} names for the {} values of {}", labels.size(),
                                    axis.points.size(), axis.origin.key));
    }
    for (std::size_t i = 0; i < axis.points.size(); ++i) {
        Axis::Point& point = axis.points[i];
        point.label = named ? labels[i] : label_of(point.values.front());
    }
    refuse_equal_labels(axis);
    return axis;
}

/// What an [[arm]] says, list by list. What does not vary is an axis of one point.
struct ArmLists {
    std::string name;  ///< empty where it has none
    std::vector<Axis> axes;
};

/// The axis of task, source, profile or parameters, or none where the arm lacks the key.
void add_selection(const Document& document, TableReader& reader, const std::string& key,
                   ArmLists& lists) {
    const toml::node* node = reader.find(key);
    if (node == nullptr) return;
    const KeyedNode keyed{key, document.place_of(*node), node};
    if (node->is_array()) {
        lists.axes.push_back(axis_of(document, keyed));
        return;
    }
    const bool shows = lists.name.empty() && (key == "task" || key == "source");
    lists.axes.push_back({keyed, {{shows ? label_of(keyed) : "", {keyed}}}});
}

ArmLists read_lists(const Document& document, const toml::table& arm) {
    TableReader reader(document, arm, "arm");
    ArmLists lists;
    lists.name = reader.text("name").value_or("");
    if (reader.find("name") != nullptr && !is_fit_name(lists.name)) {
        throw reader.error("name", "expected 1 to 100 letters, digits and hyphens");
    }
    for (const std::string_view key : selection_keys) {
        add_selection(document, reader, std::string(key), lists);
    }
    if (const toml::table* settings = reader.table("settings")) {
        for (KeyedNode& node : flatten(document, *settings)) {
            lists.axes.push_back({node, {{"", {node}}}});
        }
    }
    std::vector<Axis> varied;
    if (const toml::table* grid = reader.table("grid")) {
        for (const KeyedNode& list : flatten(document, *grid)) {
            varied.push_back(axis_of(document, list));
        }
    }
    for (const toml::table* linked : reader.tables("linked")) {
        varied.push_back(linked_axis(document, *linked));
    }
    reader.refuse_other_keys();
    std::ranges::stable_sort(varied, {}, [](const Axis& axis) { return axis.origin.place.line; });
    std::ranges::move(varied, std::back_inserter(lists.axes));
    return lists;
}

/// Refuses keys that are there twice, or no keys of an arm, and an arm without task or source.
void check_keys(const Document& document, const toml::table& arm, const ArmLists& lists) {
    std::set<std::string> keys;
    for (const Axis& axis : lists.axes) {
        for (const KeyedNode& node : axis.points.front().values) {
            if (!is_selection_key(node.key)) check_setting_key(node.key, node.place);
            if (keys.insert(node.key).second) continue;
            throw key_error(node.place, node.key, "the arm has this key twice");
        }
    }
    for (const char* key : {"task", "source"}) {
        if (keys.contains(key)) continue;
        throw key_error(document.place_of(arm), fmt::format("arm.{}", key), "is missing");
    }
}

std::size_t checked_product(const Place& place, const std::vector<Axis>& axes,
                            std::size_t maximum) {
    std::size_t product = 1;
    for (const Axis& axis : axes) {
        if (axis.points.size() > maximum / product) {
            throw key_error(
                place, "arm",
                fmt::format("its lists give the study more than {} arms, the most that it may have",
                            arms_maximum));
        }
        product *= axis.points.size();
    }
    return product;
}

/// Joins a part to a name with a hyphen.
void join(std::string& name, const std::string& part) {
    if (!name.empty() && !part.empty()) name += '-';
    name += part;
}

}  // namespace

bool is_fit_name(const std::string& name) {
    return !name.empty() && name.size() <= 100 && std::ranges::all_of(name, is_fit_character);
}

std::vector<ArmPlan> expand_arm(const Document& document, const toml::table& arm,
                                std::size_t maximum) {
    const Place place = document.place_of(arm);
    const ArmLists lists = read_lists(document, arm);
    check_keys(document, arm, lists);
    const std::size_t count = checked_product(place, lists.axes, maximum);
    std::vector<ArmPlan> plans;
    for (std::size_t index = 0; index < count; ++index) {
        ArmPlan plan{lists.name, {}};
        std::size_t block = count;  // how many arms in a row share the point of this axis
        for (const Axis& axis : lists.axes) {
            block /= axis.points.size();
            const Axis::Point& point = axis.points[index / block % axis.points.size()];
            join(plan.name, point.label);
            std::ranges::copy(point.values, std::back_inserter(plan.values));
        }
        if (!is_fit_name(plan.name)) {
            throw key_error(
                place, "arm.name",
                fmt::format("\"{}\" is not 1 to 100 letters, digits and hyphens", plan.name));
        }
        plans.push_back(std::move(plan));
    }
    return plans;
}

}  // namespace gene_clocks::experiment
