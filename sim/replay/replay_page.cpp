#include "sim/replay/replay_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <gene_clocks/neat/innovation_source.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "sim/replay/genealogy.hpp"
#include "sim/settings/arena_file.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/embedded_files.hpp"

namespace gene_clocks::replay {
namespace {

using experiment::embedded_text;
using nlohmann::ordered_json;

constexpr std::string_view page_folder = "replay/page/";

/// In the order in which they build upon each other.
constexpr std::array<std::string_view, 9> scripts{
    "streams.js",       "recording.js",      "palette.js",   "svg_context.js", "arena_view.js",
    "timeline_view.js", "genealogy_view.js", "take_away.js", "player.js"};

/// Columns rather than objects: a run creates thousands of genes. Counters are text, for hashes
/// are greater than JavaScript's whole numbers.
ordered_json genes_to_json(const GeneHistory& history) {
    ordered_json columns = {{"counter", ordered_json::array()}, {"robot", ordered_json::array()},
                            {"kind", ordered_json::array()},    {"created", ordered_json::array()},
                            {"creator", ordered_json::array()}, {"birth", ordered_json::array()},
                            {"marked", ordered_json::array()},  {"upon", ordered_json::array()}};
    for (const Gene& gene : history.genes()) {
        columns["counter"].push_back(fmt::format("{}", gene.mark.counter));
        if (gene.mark.robot == neat::no_robot) {
            columns["robot"].push_back(nullptr);
        } else {
            columns["robot"].push_back(static_cast<std::uint32_t>(gene.mark.robot));
        }
        columns["kind"].push_back(static_cast<int>(gene.kind));
        columns["created"].push_back(gene.created_cycle);
        columns["creator"].push_back(static_cast<std::uint32_t>(gene.genome.robot));
        columns["birth"].push_back(gene.genome.birth);
        columns["marked"].push_back(gene.times_marked);
        columns["upon"].push_back(gene.builds_upon);
    }
    columns["genesis"] = history.genesis_genes();
    return columns;
}

ordered_json genealogy_to_json(const GeneHistory& history) {
    ordered_json rows = ordered_json::array();
    for (const FinalGene& gene : genealogy(history)) {
        ordered_json row = {{"gene", gene.gene}, {"carriers", gene.carriers}, {"follows", nullptr}};
        if (gene.follows) row["follows"] = *gene.follows;
        rows.push_back(std::move(row));
    }
    return rows;
}

/// For each set: how many genes, then these as differences.
std::string encode_gene_sets(const GeneHistory& history) {
    NumberStream stream;
    for (const auto& set : history.gene_sets()) {
        stream.put(set.size());
        GeneNumber before = 0;
        for (const GeneNumber gene : set) {
            stream.put(gene - before);
            before = gene;
        }
    }
    return base64(stream.bytes());
}

/// Rows of cycle, robot, gene set.
std::string encode_activations(const GeneHistory& history) {
    RowStream rows(3);
    for (const Activation& activation : history.activations()) {
        const std::array<std::int64_t, 3> row{activation.cycle, activation.robot,
                                              static_cast<std::int64_t>(activation.gene_set)};
        rows.put_row(row);
    }
    return base64(rows.bytes());
}

ordered_json samples_to_json(const std::vector<sim::Sample>& samples) {
    ordered_json cycles = ordered_json::array(), fitness = ordered_json::array();
    for (const sim::Sample& sample : samples) {
        cycles.push_back(sample.cycle);
        fitness.push_back(sample.swarm_fitness);
    }
    return {{"cycle", std::move(cycles)}, {"swarm_fitness", std::move(fitness)}};
}

ordered_json to_json(const RecordedRun& run) {
    const ReplayRecorder& recorder = run.recorder;
    const GeneHistory& history = recorder.genes();
    const FrameChoice& frames = recorder.frame_choice();
    ordered_json arena = experiment::geometry_to_json(run.arena);
    arena["name"] = run.arena.name;
    ordered_json facts = ordered_json::array();
    for (const auto& [name, value] : run.facts) facts.push_back({name, value});
    return {
        {"format", 1},
        {"task", experiment::name_of(run.settings.task)},
        {"source", experiment::name_of(run.settings.source)},
        {"source_title", sim::display_of(run.settings.source).title},
        {"robots", run.settings.world.robots},
        {"items", run.settings.task == sim::Task::collection ? run.settings.world.items : 0},
        {"cycles", run.settings.run.cycles},
        {"robot_radius_px", run.settings.world.robot_radius_px},
        {"item_radius_px", run.settings.world.item_radius_px},
        {"energy_maximum", run.settings.odneat.energy_maximum},
        {"facts", std::move(facts)},
        {"arena", std::move(arena)},
        {"samples", samples_to_json(run.result.samples)},
        {"genes", genes_to_json(history)},
        {"genealogy", genealogy_to_json(history)},
        {"gene_sets", {{"count", history.gene_sets().size()}, {"data", encode_gene_sets(history)}}},
        {"activations",
         {{"count", history.activations().size()}, {"data", encode_activations(history)}}},
        {"frames",
         {{"from", frames.from},
          {"to", frames.to},
          {"every", frames.every},
          {"count", frames.frames()},
          {"place_px", recorder.quanta().place_px},
          {"energy", recorder.quanta().energy},
          {"headings", Quanta::headings},
          {"x", base64(recorder.x().bytes())},
          {"y", base64(recorder.y().bytes())},
          {"heading", base64(recorder.heading().bytes())},
          {"energies", base64(recorder.energy().bytes())},
          {"clocks", base64(recorder.clock().bytes())},
          {"messages", base64(recorder.messages().bytes())},
          {"heard", base64(recorder.heard().bytes())},
          {"item_changes", base64(recorder.items().bytes())}}},
    };
}

/// JSON within a script element: nothing in it can end the element, or begin a comment.
std::string embeddable(const ordered_json& json) {
    std::string text =
        json.dump(-1, ' ', /*ensure_ascii=*/true, ordered_json::error_handler_t::replace);
    std::string escaped;
    escaped.reserve(text.size());
    for (const char character : text) {
        if (character == '<') {
            escaped += "\\u003c";
        } else {
            escaped += character;
        }
    }
    return escaped;
}

}  // namespace

void write_replay_page(const RecordedRun& run, std::ostream& out) {
    const std::string folder(page_folder);
    std::string_view rest = embedded_text(folder + "page.html");
    const auto copy_until = [&](std::string_view place) {
        const std::size_t at = rest.find(place);
        if (at == std::string_view::npos) throw std::logic_error("page.html lacks a place");
        out << rest.substr(0, at);
        rest.remove_prefix(at + place.size());
    };
    copy_until("{{style}}");
    out << embedded_text(folder + "page.css");
    copy_until("{{recording}}");
    out << embeddable(to_json(run));
    copy_until("{{scripts}}");
    for (const std::string_view script : scripts) {
        out << "<script>\n" << embedded_text(folder + std::string(script)) << "</script>\n";
    }
    out << rest;
}

}  // namespace gene_clocks::replay
