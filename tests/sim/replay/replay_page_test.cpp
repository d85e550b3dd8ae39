#include "sim/replay/replay_page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/replay/genealogy.hpp"
#include "tests/sim/replay/sample_run.hpp"

namespace gene_clocks::replay {
namespace {

std::size_t count(const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

class ReplayPageTest : public testing::Test {
protected:
    std::string page(const sim::Arena& arena, Facts facts = {}) const {
        std::ostringstream out;
        write_replay_page({run_.settings, arena, run_.result, run_.recorder, std::move(facts)},
                          out);
        return out.str();
    }
    static std::string recording(const std::string& page) {
        const std::string begin = "<script type=\"application/json\" id=\"recording\">";
        const auto at = page.find(begin) + begin.size();
        return page.substr(at, page.find("</script>", at) - at);
    }
    SampleRun run_{sample_settings(), {0, 2500, 100}};
};

TEST_F(ReplayPageTest, HoldsTheRecording) {
    const auto data = nlohmann::json::parse(recording(page(run_.arena, {{"Seed", "1"}})));
    const ReplayRecorder& recorder = run_.recorder;
    EXPECT_EQ(data["format"], 1);
    EXPECT_EQ(data["robots"], 12);
    EXPECT_EQ(data["items"], 5);
    EXPECT_EQ(data["cycles"], 2500);
    EXPECT_EQ(data["facts"].dump(), R"([["Seed","1"]])");
    EXPECT_EQ(data["arena"]["size_px"], (nlohmann::json{140.0, 120.0}));
    EXPECT_EQ(data["frames"]["count"], 26);
    EXPECT_EQ(data["frames"]["x"], base64(recorder.x().bytes()));
    EXPECT_EQ(data["frames"]["y"], base64(recorder.y().bytes()));
    EXPECT_EQ(data["frames"]["heading"], base64(recorder.heading().bytes()));
    EXPECT_EQ(data["frames"]["energies"], base64(recorder.energy().bytes()));
    EXPECT_EQ(data["frames"]["clocks"], base64(recorder.clock().bytes()));
    EXPECT_EQ(data["frames"]["messages"], base64(recorder.messages().bytes()));
    EXPECT_EQ(data["frames"]["heard"], base64(recorder.heard().bytes()));
    EXPECT_EQ(data["frames"]["item_changes"], base64(recorder.items().bytes()));
    ASSERT_EQ(data["samples"]["cycle"].size(), 25u);
    EXPECT_EQ(data["samples"]["swarm_fitness"][24], run_.result.samples[24].swarm_fitness);
}

TEST_F(ReplayPageTest, HoldsTheGenes) {
    const auto data = nlohmann::json::parse(recording(page(run_.arena)));
    const GeneHistory& history = run_.recorder.genes();
    const auto& columns = data["genes"];
    EXPECT_EQ(columns["genesis"], history.genesis_genes());
    ASSERT_EQ(columns["counter"].size(), history.genes().size());
    for (std::size_t i = 0; i < history.genes().size(); ++i) {
        const Gene& gene = history.genes()[i];
        EXPECT_EQ(columns["counter"][i], std::to_string(gene.mark.counter));
        EXPECT_EQ(columns["robot"][i], static_cast<std::uint32_t>(gene.mark.robot));
        EXPECT_EQ(columns["kind"][i], static_cast<int>(gene.kind));
        EXPECT_EQ(columns["created"][i], gene.created_cycle);
        EXPECT_EQ(columns["creator"][i], static_cast<std::uint32_t>(gene.genome.robot));
        EXPECT_EQ(columns["birth"][i], gene.genome.birth);
        EXPECT_EQ(columns["upon"][i], gene.builds_upon);
    }
    const auto rows = genealogy(history);
    ASSERT_EQ(data["genealogy"].size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(data["genealogy"][i]["gene"], rows[i].gene);
        EXPECT_EQ(data["genealogy"][i]["carriers"], rows[i].carriers);
        EXPECT_EQ(data["genealogy"][i]["follows"].is_null(), !rows[i].follows);
    }
    EXPECT_EQ(data["gene_sets"]["count"], history.gene_sets().size());
    EXPECT_EQ(data["activations"]["count"], history.activations().size());
}

TEST_F(ReplayPageTest, NamesCannotBreakOutOfTheirPlace) {
    const std::string hostile =
        "</script><script>alert(1)</script><!--<img src=x onerror=alert(2)>\"'&\xff";
    const std::string plain = page(run_.arena);
    sim::Arena arena = run_.arena;
    arena.name = hostile;
    const std::string text = page(arena, {{hostile, hostile}});
    EXPECT_EQ(count(text, "<script"), count(plain, "<script"));
    EXPECT_EQ(count(text, "</script"), count(plain, "</script"));
    EXPECT_EQ(count(text, "<!--"), 0u);
    EXPECT_EQ(count(text, "<img"), 0u);
    EXPECT_EQ(recording(text).find('<'), std::string::npos);
    const auto data = nlohmann::json::parse(recording(text));
    const std::string name = data["arena"]["name"];
    EXPECT_TRUE(name.starts_with(hostile.substr(0, hostile.size() - 1)));  // all but the stray byte
}

TEST_F(ReplayPageTest, NeedsNoOtherFile) {
    const std::string text = page(run_.arena);
    EXPECT_TRUE(text.starts_with("<!DOCTYPE html>"));
    EXPECT_EQ(count(text, "{{"), 0u);
    EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
    EXPECT_EQ(count(text, " src="), 0u);
    EXPECT_EQ(count(text, "@import"), 0u);
    EXPECT_EQ(count(text, "url("), 0u);
    EXPECT_EQ(count(text, "fetch("), 0u);
    // The one address is the name of a vocabulary.
    EXPECT_EQ(count(text, "://"), count(text, "http://www.w3.org/2000/svg"));
}

}  // namespace
}  // namespace gene_clocks::replay
