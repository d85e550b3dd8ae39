#include "sim/report/published.hpp"

#include <array>
#include <limits>
#include <string_view>

#include "sim/experiment/study/measures.hpp"
#include "sim/report/compared_measures.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/embedded_files.hpp"

namespace gene_clocks::report {
namespace {

using experiment::Document;
using experiment::Range;
using experiment::TableReader;

constexpr double huge = std::numeric_limits<double>::max();
constexpr Range any_number{0.0, huge};
constexpr Range probability{0.0, 1.0};
constexpr Range count{1.0, 1e9};

template <typename Choice>
Choice required_choice(TableReader& reader, const std::string& key) {
    const std::string name = reader.required_text(key);
    if (const auto choice = experiment::choice_of<Choice>(name)) return *choice;
    throw reader.error(key, "there is no " + name);
}

/// A table that has to be there.
const toml::table& required_table(TableReader& reader, const std::string& key) {
    if (const toml::table* table = reader.table(key)) return *table;
    throw reader.error(key, "is missing");
}

PublishedRange read_range(const Document& document, const toml::array& array,
                          const std::string& key) {
    const auto place = document.place_of(array);
    if (array.size() != 2 && array.size() != 3)
        throw experiment::key_error(place, key, "expected two or three numbers");
    std::vector<double> numbers;
    for (const toml::node& node : array)
        numbers.push_back(experiment::read_real(node, any_number, place, key));
    for (std::size_t i = 1; i < numbers.size(); ++i) {
        if (numbers[i] < numbers[i - 1])
            throw experiment::key_error(place, key, "the numbers do not ascend");
    }
    PublishedRange range{numbers.front(), std::nullopt, numbers.back()};
    if (numbers.size() == 3) range.median = numbers[1];
    return range;
}

std::vector<PublishedRuns> read_runs(const Document& document, TableReader& reader,
                                     const std::string& key, bool with_parameters) {
    std::vector<PublishedRuns> all;
    for (const toml::table* table : reader.tables(key)) {
        TableReader entry(document, *table, key);
        PublishedRuns& runs = all.emplace_back();
        runs.task = required_choice<sim::Task>(entry, "task");
        runs.source = required_choice<sim::Source>(entry, "source");
        if (with_parameters) runs.parameters = entry.required_text("parameters");
        for (const experiment::Measure& measure : experiment::measures) {
            const std::string id(measure.id);
            if (table->contains(id))
                runs.ranges[id] = read_range(document, entry.array(id), key + "." + id);
        }
        entry.refuse_other_keys();
    }
    return all;
}

void read_p_values(const Document& document, TableReader& reader, Published& published) {
    TableReader tables(document, required_table(reader, "p_values"), "p_values");
    published.significance_level = tables.required_real("significance_level", probability);
    TableReader bounds(document, required_table(reader, "p_values_above"), "p_values_above");
    for (const std::string_view name : experiment::choice_names<sim::Task>) {
        const std::string task(name);
        PublishedTask& entry = published.tasks[*experiment::choice_of<sim::Task>(name)];
        TableReader values(document, required_table(tables, task), "p_values." + task);
        for (const std::string_view measure : compared_measures) {
            const std::string id(measure);
            entry.p_values[id] = values.required_real(id, probability);
        }
        values.refuse_other_keys();
        entry.controller_size_p_value_above = bounds.required_real(task, probability);
    }
    bounds.refuse_other_keys();
    tables.refuse_other_keys();
}

void read_set_up(const Document& document, TableReader& reader, Published& published) {
    TableReader table_1(document, required_table(reader, "table_1"), "table_1");
    TableReader as_run(document, required_table(reader, "as_run"), "as_run");
    TableReader set_up(document, required_table(reader, "set_up"), "set_up");
    for (const std::string_view name : experiment::choice_names<sim::Task>) {
        const std::string task(name);
        PublishedTask& entry = published.tasks[*experiment::choice_of<sim::Task>(name)];
        entry.printed_parameters = table_1.required_text(task);
        entry.run_parameters = as_run.required_text(task);
        entry.cycles = static_cast<std::int64_t>(set_up.required_real(task + "_cycles", count));
    }
    published.runs = static_cast<std::int64_t>(set_up.required_real("runs", count));
    for (const char* key : {"c_excess", "c_disjoint", "c_weight"})
        published.fixed["odneat." + std::string(key)] = table_1.required_real(key, any_number);
    for (const char* key : {"robots", "items"})
        published.fixed["world." + std::string(key)] = table_1.required_real(key, count);
    table_1.refuse_other_keys();
    as_run.refuse_other_keys();
    set_up.refuse_other_keys();
}

}  // namespace

Published read_published(const Document& document) {
    Published published;
    TableReader reader(document, document.table);
    published.paper = read_runs(document, reader, "paper", false);
    published.reference = read_runs(document, reader, "reference", true);
    read_p_values(document, reader, published);
    read_set_up(document, reader, published);
    reader.refuse_other_keys();
    return published;
}

const Published& published() {
    static const Published numbers = read_published(experiment::parse_document(
        std::string(experiment::embedded_text("report/published.toml")), "report/published.toml"));
    return numbers;
}

}  // namespace gene_clocks::report
