#include "sim/settings/arena_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/experiment/expect_input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using test::input_error;

constexpr const char* frame = "frame = { left_px = 5, top_px = 6, right_px = 7, bottom_px = 8 }\n";

sim::Arena read(const std::string& text) {
    return read_arena(parse_document(text, "x.toml"));
}

std::string with_walls(const std::string& walls) {
    return std::string("name = \"x\"\nwidth_px = 100\nheight_px = 200\n") + frame +
           "walls = " + walls;
}

TEST(Arena, IsRead) {
    const sim::Arena arena = read(with_walls("[[10, 20, 30.5, 40, 7.5]]"));
    EXPECT_EQ(arena.name, "x");
    EXPECT_EQ(arena.width_px, 100);
    EXPECT_EQ(arena.height_px, 200);
    EXPECT_EQ(arena.frame_left_px, 5);
    EXPECT_EQ(arena.frame_top_px, 6);
    EXPECT_EQ(arena.frame_right_px, 7);
    EXPECT_EQ(arena.frame_bottom_px, 8);
    ASSERT_EQ(arena.walls.size(), 1U);
    EXPECT_EQ(arena.walls[0].x1_px, 10);
    EXPECT_EQ(arena.walls[0].y1_px, 20);
    EXPECT_EQ(arena.walls[0].x2_px, 30.5);
    EXPECT_EQ(arena.walls[0].y2_px, 40);
    EXPECT_EQ(arena.walls[0].thickness_px, 7.5);
}

TEST(Arena, MayHaveNoWalls) {
    EXPECT_TRUE(read(with_walls("[]")).walls.empty());
}

TEST(Arena, RefusesUnfitWallsWithTheirLine) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"[\n[10, 20, 30, 40]]", "x.toml:6: walls[0]: expected five numbers"},
        {"[\n[10, 20, 30, 40, 5, 6]]", "expected five numbers"},
        {"[\n[10, 20, 30, 40, 5],\n[10, 20, 30, 40, 0]]",
         "x.toml:7: walls[1]: 0 is outside (0, 200]"},
        {"[[10, 20, 30, 40, -1]]", "outside"},
        {"[[10, 20, 101, 40, 5]]", "101 is outside [0, 100]"},
        {"[[10, -1, 30, 40, 5]]", "-1 is outside [0, 200]"},
        {"[[10, nan, 30, 40, 5]]", "outside"},
        {"[[inf, 20, 30, 40, 5]]", "outside"},
        {"[[10, 20, 10, 20, 5]]", "no length"},
        {"[[10, 20, 30, \"40\", 5]]", "expected a real number, found a text"},
        {"[5]", "expected five numbers"},
        {"5", "walls: expected an array"},
    };
    for (const auto& [walls, message] : cases) {
        EXPECT_THAT(input_error([&] { read(with_walls(walls)); }), testing::HasSubstr(message))
            << walls;
    }
}

TEST(Arena, RefusesTooManyWalls) {
    std::string walls = "[";
    for (int i = 0; i <= 10'000; ++i) walls += "[10, 20, 30, 40, 5],";
    EXPECT_THAT(input_error([&] { read(with_walls(walls + "]")); }),
                testing::HasSubstr("10001 walls are more than 10000"));
}

TEST(Arena, RefusesUnfitSizeAndFrame) {
    const std::string tail = "walls = []\n";
    EXPECT_THAT(input_error([&] {
                    read(std::string("name = \"x\"\nwidth_px = 0\nheight_px = 9\n") + frame + tail);
                }),
                testing::HasSubstr("x.toml:2: width_px: 0 is outside"));
    EXPECT_THAT(
        input_error([&] {
            read(std::string("name = \"x\"\nwidth_px = 1e9\nheight_px = 9\n") + frame + tail);
        }),
        testing::HasSubstr("outside"));
    EXPECT_THAT(input_error([&] {
                    read(std::string("name = \"x\"\nwidth_px = 100\nheight_px = 100\n") + tail);
                }),
                testing::HasSubstr("frame: is missing"));
    EXPECT_THAT(
        input_error([&] {
            read(std::string("name = \"x\"\nwidth_px = 12\nheight_px = 100\n") + frame + tail);
        }),
        testing::HasSubstr("frame.right_px: the frame leaves no room"));
    EXPECT_THAT(
        input_error([&] {
            read(std::string("name = \"x\"\nwidth_px = 100\nheight_px = 14\n") + frame + tail);
        }),
        testing::HasSubstr("frame.bottom_px: the frame leaves no room"));
    EXPECT_THAT(input_error([&] { read(with_walls("[]\nheigth_px = 3")); }),
                testing::HasSubstr("heigth_px: unknown key; did you mean height_px?"));
    EXPECT_THAT(input_error([&] { read("width_px = 100"); }),
                testing::HasSubstr("name: is missing"));
}

TEST(PaperArena, HasTheFrameAndThe18Bars) {
    const sim::Arena arena = find_arena("gecco15");
    EXPECT_EQ(arena.width_px, 512);
    EXPECT_EQ(arena.height_px, 512);
    EXPECT_EQ(arena.frame_left_px, 5);
    EXPECT_EQ(arena.frame_top_px, 6);
    EXPECT_EQ(arena.walls.size(), 18U);
    for (const sim::ThickSegment& wall : arena.walls) {
        EXPECT_EQ(wall.thickness_px, 7.5);
        // At plus or minus 45 degrees.
        EXPECT_EQ(std::abs(wall.x2_px - wall.x1_px), std::abs(wall.y2_px - wall.y1_px));
    }
}

TEST(BuiltinArenas, AreAllFit) {
    for (const std::string& name : builtin_names(Builtin::arena)) {
        EXPECT_EQ(find_arena(name).name, name);
    }
}

TEST(ArenaFile, TakesTheBuiltinOnesPlace) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(find_arena(folder.write("mine.toml", with_walls("[]")).string()).name, "x");
}

}  // namespace
}  // namespace gene_clocks::experiment
