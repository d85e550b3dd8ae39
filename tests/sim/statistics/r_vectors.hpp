#pragma once

#include <gtest/gtest.h>

#include <boost/algorithm/string.hpp>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace gene_clocks::statistics {

/// The rows of a file that make_vectors.R wrote, without its header.
inline std::vector<std::vector<std::string>> read_rows(const std::string& name,
                                                       std::size_t columns) {
    std::ifstream file(std::string(VECTORS_FOLDER "/") + name);
    std::vector<std::vector<std::string>> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::vector<std::string>& row = rows.emplace_back();
        boost::split(row, line, boost::is_any_of(","));
        EXPECT_EQ(row.size(), columns) << name << ": " << line;
    }
    return rows;
}

/// The numbers of one field.
inline std::vector<double> numbers(const std::string& text) {
    std::vector<std::string> words;
    boost::split(words, text, boost::is_any_of(" "));
    std::vector<double> values;
    for (const std::string& word : words) values.push_back(std::stod(word));
    return values;
}

inline void expect_close(double value, double expected, const std::string& what) {
    EXPECT_LE(std::fabs(value - expected), 1e-12 * std::fabs(expected))
        << what << ": " << value << " against R's " << expected;
}

}  // namespace gene_clocks::statistics
