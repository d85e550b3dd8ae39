// A study under mpirun gives the same store as one without, also where one of the processes is
// killed on the way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "tests/sim/app/program.hpp"
#include "tests/sim/app/store_contents.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks {
namespace {

using test::Program;
using testing::HasSubstr;

/// Arms of different length, of runs that take some 20 ms and less.
constexpr const char* study = R"(
name = "x"
title = "X"
seeds = 8
settings = { world.robots = 30, run.cycles = 3000 }
[[arm]]
task = ["navigation", "collection"]
source = ["gene-clock", "timestamp"]
[[arm]]
name = "short"
task = "navigation"
source = "gene-clock"
settings = { run.cycles = 500, run.record_creation_times = true }
)";

class MpiTest : public testing::Test {
protected:
    void SetUp() override {
        folder.write("x.toml", study);
        for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                                 "OMPI_MCA_rmaps_base_oversubscribe"}) {
            setenv(name, "1", 1);
        }
        // One machine: nothing that reaches others, nor binds processes to processors.
        setenv("OMPI_MCA_plm", "isolated", 1);
        setenv("OMPI_MCA_btl", "self,vader", 1);
        setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    }
    static Program::Arguments mpirun(int processes, const Program::Arguments& arguments) {
        Program::Arguments all{"-n", std::to_string(processes), PROGRAM};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return all;
    }
    Program::Result run(int processes, const Program::Arguments& arguments) const {
        return Program(folder.path(), mpirun(processes, arguments), MPIRUN).wait();
    }
    static Program::Arguments arguments(const std::string& store, const std::string& seeds = "8") {
        return {"study", "x.toml", "--store", store, "--seeds", seeds};
    }
    [[nodiscard]] std::string contents(const std::string& store) const {
        return test::store_contents(folder.path(), store);
    }
    [[nodiscard]] std::string whole() const {
        EXPECT_EQ(test::gene_clocks(folder.path(), arguments("whole.sqlite")).status, 0);
        return contents("whole.sqlite");
    }
    /// The process of that rank among those that mpirun started.
    static pid_t process_of_rank(pid_t mpirun, int rank) {
        const auto task = "/proc/" + std::to_string(mpirun) + "/task/" + std::to_string(mpirun);
        std::ifstream children(task + "/children");
        const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
        for (pid_t child = 0; children >> child;) {
            const auto environment = test::read_all("/proc/" + std::to_string(child) + "/environ");
            if (('\0' + environment).find('\0' + wanted + '\0') != std::string::npos) return child;
        }
        return 0;
    }
    test::TemporaryFolder folder;
};

TEST_F(MpiTest, GivesTheSameStore) {
    const auto result = run(3, arguments("x.sqlite"));
    ASSERT_EQ(result.status, 0) << result.messages;
    EXPECT_THAT(result.messages, HasSubstr("x: executing 40 runs"));
    EXPECT_THAT(result.messages, HasSubstr("x.sqlite: all 40 runs are finished"));
    EXPECT_EQ(contents("x.sqlite"), whole());
    const auto again = run(3, arguments("x.sqlite"));
    EXPECT_EQ(again.status, 0) << again.messages;
    EXPECT_THAT(again.messages, HasSubstr("40 of 40 runs are finished already"));
}

TEST_F(MpiTest, TheRunsAreMadeByTheWorkers) {
#ifdef GENE_CLOCKS_SANITIZED
    GTEST_SKIP() << "asks how fast the program is";
#endif
    Program program(folder.path(), mpirun(3, arguments("x.sqlite", "100000")), MPIRUN);
    ASSERT_TRUE(program.wait_for_message("executing"));
    // Processor time of a process so far, in ticks.
    const auto ticks = [&](int rank) {
        const pid_t process = process_of_rank(program.process(), rank);
        std::ifstream file("/proc/" + std::to_string(process) + "/stat");
        std::string word;
        for (int i = 0; i < 13; ++i) file >> word;
        long user = 0;
        long system = 0;
        file >> user >> system;
        return user + system;
    };
    const long before = ticks(0);
    // Both workers work, and meanwhile the coordinator hardly does: it waits without spinning.
    ASSERT_TRUE(program.wait_until([&] { return ticks(1) >= 100 && ticks(2) >= 100; }));
    EXPECT_LT(ticks(0) - before, 50);
    program.signal(SIGTERM);
    program.wait();
}

TEST_F(MpiTest, AShardIsAShard) {
    auto shard = arguments("a.sqlite");
    shard.insert(shard.end(), {"--shard", "2/3"});
    const auto result = run(3, shard);
    ASSERT_EQ(result.status, 0) << result.messages;
    shard[3] = "b.sqlite";
    EXPECT_EQ(test::gene_clocks(folder.path(), shard).status, 0);
    EXPECT_EQ(contents("a.sqlite"), contents("b.sqlite"));
}

TEST_F(MpiTest, OneProcessIsTheOrdinaryProgram) {
    const auto result = run(1, arguments("x.sqlite", "1"));
    EXPECT_EQ(result.status, 0) << result.messages;
    EXPECT_THAT(result.messages, HasSubstr("all 5 runs are finished"));
}

TEST_F(MpiTest, AKilledWorkerLeavesAWholeStoreThatASecondStartGoesOnFrom) {
    for (const int rank : {1, 2, 0}) {
        const std::string store = std::to_string(rank) + ".sqlite";
        Program program(folder.path(), mpirun(3, arguments(store, "100000")), MPIRUN);
        ASSERT_TRUE(program.wait_for_message("executing"));
        // In the middle of its runs: it has used processor time since.
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        const pid_t process = process_of_rank(program.process(), rank);
        ASSERT_NE(process, 0);
        kill(process, SIGKILL);
        EXPECT_NE(program.wait().status, 0);
        // The store is whole: what is in it can be read, and is what it would have been.
        const auto result = run(3, arguments(store));
        ASSERT_EQ(result.status, 0) << result.messages;
        EXPECT_EQ(contents(store), whole());
    }
}

TEST_F(MpiTest, CtrlCKeepsFinishedRuns) {
#ifdef GENE_CLOCKS_SANITIZED
    GTEST_SKIP() << "asks how fast the program is";
#endif
    for (const int signal : {SIGINT, SIGTERM}) {
        Program program(folder.path(), mpirun(3, arguments("x.sqlite", "100000")), MPIRUN);
        ASSERT_TRUE(program.wait_for_message("executing"));
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        program.signal(signal);
        EXPECT_NE(program.wait().status, 0);
    }
    const auto result = run(3, arguments("x.sqlite"));
    ASSERT_EQ(result.status, 0) << result.messages;
    EXPECT_THAT(result.messages, HasSubstr("runs are finished already"));
    EXPECT_EQ(contents("x.sqlite"), whole());
}

TEST_F(MpiTest, AWorkerThatIsToldToStopStopsAll) {
    Program program(folder.path(), mpirun(3, arguments("x.sqlite", "100000")), MPIRUN);
    ASSERT_TRUE(program.wait_for_message("executing"));
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    kill(process_of_rank(program.process(), 2), SIGTERM);
    const auto result = program.wait();
    EXPECT_EQ(result.status, 130) << result.messages;
    EXPECT_THAT(result.messages, HasSubstr("runs are kept in x.sqlite; the same command goes on"));
}

TEST_F(MpiTest, BadInputIsRefusedOnceAndWritesNothing) {
    const auto refused = [&](const Program::Arguments& arguments, const std::string& message) {
        const auto result = run(3, arguments);
        EXPECT_EQ(result.status, 2) << result.messages;
        const auto first = result.messages.find(message);
        EXPECT_NE(first, std::string::npos) << result.messages;
        EXPECT_EQ(result.messages.find(message, first + 1), std::string::npos) << result.messages;
        EXPECT_FALSE(std::filesystem::exists(folder / "x.sqlite"));
    };
    refused({"study", "x.toml", "--store", "x.sqlite", "--sede", "3"}, "did you mean --seeds?");
    refused({"study", "none.toml"}, "none.toml: there is no such file");
    refused({"study", "x.toml", "--store", "x.sqlite", "--threads", "2"},
            "--threads: under mpirun each process executes one run at a time");
    folder.write("full.toml",
                 "name = \"full\"\nwidth_px = 30\nheight_px = 30\nwalls = []\n"
                 "frame = { left_px = 5, top_px = 5, right_px = 5, bottom_px = 5 }\n");
    refused({"study", "x.toml", "--store", "x.sqlite", "--set", "world.arena=full.toml",
             "world.robots=500"},
            "free place");
}

TEST_F(MpiTest, DryRunsAndHelpPrintOnce) {
    for (const char* option : {"--dry-run", "--help"}) {
        const auto result = run(3, {"study", "x.toml", option});
        EXPECT_EQ(result.status, 0) << result.messages;
        const std::string first = result.output.substr(0, result.output.find('\n') + 1);
        EXPECT_GT(first.size(), 3U);
        EXPECT_EQ(result.output.find(first, first.size()), std::string::npos) << result.output;
    }
}

// Machines that do not have the same files, played by two folders.
TEST_F(MpiTest, AWorkerWithAnotherStudyIsRefused) {
    std::filesystem::create_directory(folder / "other");
    std::string other = study;
    other.replace(other.find("3000"), 4, "2000");
    folder.write("other/x.toml", other);
    const Program::Arguments separate{
        "-n",       "1",     PROGRAM,  "study",   "x.toml",  "--store",
        "x.sqlite", ":",     "-n",     "1",       "-wdir",   (folder / "other").string(),
        PROGRAM,    "study", "x.toml", "--store", "x.sqlite"};
    const auto result = Program(folder.path(), separate, MPIRUN).wait();
    EXPECT_EQ(result.status, 2) << result.messages;
    EXPECT_THAT(result.messages, HasSubstr("process 1 of 2 has another study"));
    std::filesystem::remove(folder / "other/x.toml");
    const auto without = Program(folder.path(), separate, MPIRUN).wait();
    EXPECT_EQ(without.status, 2) << without.messages;
    EXPECT_THAT(without.messages, HasSubstr("process 1 of 2 cannot execute the runs of the study"));
}

}  // namespace
}  // namespace gene_clocks
