#include "sim/core/src/item_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gene_clocks/neat/random.hpp>
#include <vector>

namespace gene_clocks::sim {
namespace {

std::vector<std::size_t> near(const ItemField& items, float x_px, float y_px) {
    std::vector<std::size_t> found;
    items.visit_near(x_px, y_px, [&](std::size_t item) { found.push_back(item); });
    return found;
}

TEST(ItemField, BeginsWithoutItems) {
    const ItemField items(3, 100.0f, 100.0f, 20.0f);
    EXPECT_EQ(items.size(), 3u);
    EXPECT_EQ(items.absent(), 3u);
    EXPECT_FALSE(items.is_present(0));
    EXPECT_TRUE(near(items, 50.0f, 50.0f).empty());
}

TEST(ItemField, EveryItemWithinReachIsVisitedInOrder) {
    constexpr std::size_t count = 130;  // three words of bits
    constexpr float reach_px = 20.0f;
    ItemField items(count, 200.0f, 120.0f, reach_px);
    neat::RandomStream random(1, 1);
    const auto place = [&](double end) { return static_cast<float>(random.uniform(0.0, end)); };
    for (std::size_t item = 0; item < count; ++item) {
        const float x = place(200.0);
        items.put(item, x, place(120.0));
    }
    for (int i = 0; i < 2000; ++i) {
        if (i % 3 == 0) {  // one goes and another comes, so that old places must be forgotten
            const std::size_t item = random.below(count);
            if (items.is_present(item)) {
                items.take(item, 1);
            } else {
                const float x = place(200.0);
                items.put(item, x, place(120.0));
            }
        }
        const float x = place(200.0);
        const float y = place(120.0);
        const auto found = near(items, x, y);
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
        for (const std::size_t item : found) EXPECT_TRUE(items.is_present(item));
        for (std::size_t item = 0; item < count; ++item) {
            if (items.is_present(item) &&
                std::hypot(items.x_px(item) - x, items.y_px(item) - y) < reach_px) {
                EXPECT_TRUE(std::binary_search(found.begin(), found.end(), item));
            }
        }
        EXPECT_LT(found.size(), count);  // and not simply all
    }
}

TEST(ItemField, ATakenItemIsDueAfterItsAbsenceUntilItIsPut) {
    ItemField items(1, 100.0f, 100.0f, 20.0f);
    items.put(0, 50.0f, 50.0f);
    EXPECT_EQ(items.absent(), 0u);
    EXPECT_FALSE(items.count_down(0));
    items.take(0, 2);
    EXPECT_EQ(items.absent(), 1u);
    EXPECT_FALSE(items.count_down(0));
    EXPECT_TRUE(items.count_down(0));
    EXPECT_TRUE(items.count_down(0));
    items.put(0, 10.0f, 10.0f);
    EXPECT_FALSE(items.count_down(0));
    EXPECT_EQ(near(items, 10.0f, 10.0f), std::vector<std::size_t>{0});
    EXPECT_TRUE(near(items, 90.0f, 90.0f).empty());
}

}  // namespace
}  // namespace gene_clocks::sim
