// The test vectors come from R: make_vectors.R beside this file writes them.
#include <gtest/gtest.h>

#include <boost/algorithm/string.hpp>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "statistics/mann_whitney.hpp"
#include "statistics/quantiles.hpp"

namespace gene_clocks::statistics {
namespace {

std::vector<std::vector<std::string>> read_rows(const std::string& name, std::size_t columns) {
    std::ifstream file(std::string(VECTORS_FOLDER "/") + name);
    std::vector<std::vector<std::string>> rows;
    std::string line;
    std::getline(file, line);  // the header
    while (std::getline(file, line)) {
        std::vector<std::string>& row = rows.emplace_back();
        boost::split(row, line, boost::is_any_of(","));
        EXPECT_EQ(row.size(), columns) << name << ": " << line;
    }
    return rows;
}

std::vector<double> numbers(const std::string& text) {
    std::vector<std::string> words;
    boost::split(words, text, boost::is_any_of(" "));
    std::vector<double> values;
    for (const std::string& word : words) values.push_back(std::stod(word));
    return values;
}

void expect_close(double value, double expected, const std::string& what) {
    EXPECT_LE(std::fabs(value - expected), 1e-12 * std::fabs(expected))
        << what << ": " << value << " against R's " << expected;
}

TEST(RVectors, MannWhitneyEqualsWilcoxTest) {
    const auto rows = read_rows("mann_whitney.csv", 7);
    ASSERT_GE(rows.size(), 21U);
    for (const auto& row : rows) {
        const MannWhitney test = mann_whitney(numbers(row[1]), numbers(row[2]));
        EXPECT_EQ(test.u, std::stod(row[3])) << row[0];
        expect_close(test.p_value, std::stod(row[4]), row[0]);
        EXPECT_EQ(test.distribution == NullDistribution::exact, row[6] == "1") << row[0];
    }
}

TEST(RVectors, EffectSizeEqualsTheShareOfPairs) {
    const auto rows = read_rows("mann_whitney.csv", 7);
    ASSERT_FALSE(rows.empty());
    for (const auto& row : rows)
        expect_close(vargha_delaney_a(numbers(row[1]), numbers(row[2])), std::stod(row[5]), row[0]);
}

TEST(RVectors, QuantilesEqualType7) {
    const auto rows = read_rows("quantiles.csv", 4);
    ASSERT_GE(rows.size(), 70U);
    for (const auto& row : rows)
        expect_close(quantile(numbers(row[1]), std::stod(row[2])), std::stod(row[3]), row[0]);
}

}  // namespace
}  // namespace gene_clocks::statistics
