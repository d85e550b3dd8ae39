#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "sim/report/report.hpp"
#include "sim/settings/input_error.hpp"
#include "tests/sim/report/sample_input.hpp"

namespace gene_clocks::report {
namespace {

namespace fs = std::filesystem;

/// A folder for one test.
fs::path empty_folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const fs::path folder = fs::path(testing::TempDir()) / (std::string("report-") + test->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

/// All files below a folder, by path.
std::map<std::string, std::string> read_all(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ifstream stream(entry.path(), std::ios::binary);
        files[fs::relative(entry.path(), folder).string()] =
            std::string(std::istreambuf_iterator<char>(stream), {});
    }
    return files;
}

/// Two arms and few runs: quick to draw.
Input small_input() {
    Input input = sample_input();
    input.arms.resize(2);
    return input;
}

/// Sets an environment variable for a test's time.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        setenv(name, value.c_str(), 1);
    }
    ~Environment() {
        if (old_) {
            setenv(name_, old_->c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::optional<std::string> old_;
};

TEST(WriteReport, TheSameRunsGiveTheSameBytes) {
    const fs::path folder = empty_folder();
    write_report(small_input(), folder / "a");
    write_report(small_input(), folder / "b" / "nested");
    const auto first = read_all(folder / "a");
    EXPECT_EQ(first, read_all(folder / "b" / "nested"));
    std::set<std::string> names;
    for (const auto& [name, text] : first) names.insert(name);
    EXPECT_TRUE(names.contains("index.html"));
    EXPECT_TRUE(names.contains("report.json"));
    EXPECT_TRUE(names.contains("figures/as-run/figure-03-navigation-swarm-fitness.svg"));
    EXPECT_TRUE(names.contains("figures/as-run/figure-11-controller-sizes.png"));
    EXPECT_TRUE(names.contains("figures/navigation-gecco15-swarm-fitness.png"));
    EXPECT_TRUE(names.contains("figures/navigation-gecco15-f_c.png"));
}

TEST(WriteReport, AReportTakesThePlaceOfAnOlderOne) {
    const fs::path folder = empty_folder();
    Input older;
    older.arms.push_back(sample_arm({.parameters = "A"}));
    write_report(older, folder);
    EXPECT_TRUE(fs::exists(folder / "figures" / "as-printed"));
    Input newer;
    newer.arms.push_back(sample_arm({.parameters = "B"}));
    write_report(newer, folder);
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
    EXPECT_EQ(names, (std::set<std::string>{"figures", "index.html", "report.json"}));
    EXPECT_FALSE(fs::exists(folder / "figures" / "as-printed"));
    EXPECT_EQ(read_all(folder).at("index.html").find("as-printed"), std::string::npos);
}

TEST(WriteReport, ASingleMethodIsEnough) {
    const fs::path folder = empty_folder();
    Input input = small_input();
    input.arms.pop_back();
    write_report(input, folder);
    EXPECT_NE(read_all(folder).at("index.html").find("only one method was run"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "figures" / "as-run" / "figure-11-controller-sizes.svg"));
}

TEST(WriteReport, RunsOfOtherParametersHaveNoneOfThePapersFigures) {
    const fs::path folder = empty_folder();
    Input input = small_input();
    for (ArmRuns& arm : input.arms) arm.settings.odneat.sigma = 0.2;
    write_report(input, folder);
    const auto files = read_all(folder);
    EXPECT_FALSE(fs::exists(folder / "figures" / "as-run"));
    EXPECT_EQ(files.at("index.html").find("Figure 3"), std::string::npos);
    EXPECT_TRUE(files.contains("figures/navigation-gecco15-f_c.png"));
}

TEST(WriteReport, NothingIsWrittenWithoutAPythonThatCanDraw) {
    const fs::path folder = empty_folder();
    for (const std::string python : {"/no/such/python", "/bin/false"}) {
        const Environment environment("GENE_CLOCKS_PYTHON", python);
        try {
            write_report(small_input(), folder / "report");
            ADD_FAILURE() << "drew with " << python;
        } catch (const experiment::InputError& error) {
            EXPECT_NE(std::string(error.what()).find(python), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("python3-matplotlib"), std::string::npos);
        }
    }
    EXPECT_FALSE(fs::exists(folder / "report"));
}

TEST(WriteReport, NothingIsWrittenWithoutRuns) {
    const fs::path folder = empty_folder();
    Input input = small_input();
    for (ArmRuns& arm : input.arms) arm.runs.clear();
    EXPECT_THROW(write_report(input, folder / "report"), experiment::InputError);
    EXPECT_FALSE(fs::exists(folder / "report"));
}

TEST(WriteReport, AFileIsNoFolderToWriteInto) {
    const fs::path folder = empty_folder();
    std::ofstream(folder / "taken") << "kept";
    Input input;
    input.arms.push_back(sample_arm({.runs = 1}));
    EXPECT_THROW(write_report(input, folder / "taken"), experiment::InputError);
    EXPECT_THROW(write_report(input, folder / "taken" / "below"), experiment::InputError);
    EXPECT_EQ(read_all(folder), (std::map<std::string, std::string>{{"taken", "kept"}}));
}

}  // namespace
}  // namespace gene_clocks::report
