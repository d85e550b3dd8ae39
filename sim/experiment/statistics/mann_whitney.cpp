#include "mann_whitney.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "finite_sample.hpp"

namespace gene_clocks::statistics {
namespace {

/// Both samples smaller than this: exact where there are no ties.
constexpr std::size_t exact_limit = 50;

/// The ranks of two samples pooled.
struct Ranking {
    double u{};
    double tie_term{};  ///< Σ t³ − t over the groups of t equal values
};

Ranking rank(std::span<const double> x, std::span<const double> y) {
    require_finite(x);
    require_finite(y);
    struct Value {
        double value;
        bool from_x;
    };
    std::vector<Value> pooled;
    pooled.reserve(x.size() + y.size());
    for (const double value : x) pooled.push_back({value, true});
    for (const double value : y) pooled.push_back({value, false});
    std::ranges::sort(pooled, {}, &Value::value);

    Ranking ranking;
    std::size_t y_below = 0;
    for (auto first = pooled.begin(); first != pooled.end();) {
        const auto last = std::find_if(
            first, pooled.end(), [&](const Value& other) { return other.value != first->value; });
        const auto size = static_cast<std::size_t>(last - first);
        const auto of_x = static_cast<std::size_t>(
            std::count_if(first, last, [](const Value& other) { return other.from_x; }));
        const std::size_t of_y = size - of_x;
        ranking.u += static_cast<double>(of_x) *
                     (static_cast<double>(y_below) + 0.5 * static_cast<double>(of_y));
        const auto ties = static_cast<double>(size);
        ranking.tie_term += ties * ties * ties - ties;
        y_below += of_y;
        first = last;
    }
    return ranking;
}

// The largest sum, the number of ways to choose 49 of 98 ranks, is below 2^95; the products on
// the way to it are below twice that.
using Count = boost::multiprecision::uint128_t;

/// How many of the C(n + m, m) arrangements of two samples without ties give each U: the
/// coefficients of the Gaussian binomial ∏ (1 − q^(n+i)) / (1 − q^i), i = 1…m (Mann and Whitney
/// 1947). Exact; Count wraps where a product is negative for a moment.
std::vector<Count> arrangements(std::size_t n, std::size_t m) {
    std::vector<Count> count(n * m + 1);
    count[0] = 1;
    for (std::size_t i = 1; i <= m; ++i) {
        for (std::size_t u = n * m; u >= n + i; --u) count[u] -= count[u - n - i];
        for (std::size_t u = i; u <= n * m; ++u) count[u] += count[u - i];
    }
    return count;
}

double exact_p_value(double u, std::size_t n, std::size_t m) {
    const std::vector<Count> count = arrangements(n, m);
    const auto u_integer = static_cast<std::size_t>(u);  // no ties: an integer
    const std::size_t smaller = std::min(u_integer, n * m - u_integer);
    Count tail = 0;
    Count all = 0;
    for (std::size_t i = 0; i < count.size(); ++i) {
        all += count[i];
        if (i <= smaller) tail += count[i];
    }
    return std::min(1.0, 2.0 * (tail.convert_to<double>() / all.convert_to<double>()));
}

double normal_p_value(const Ranking& ranking, double n, double m) {
    const double variance =
        n * m / 12.0 * ((n + m + 1.0) - ranking.tie_term / ((n + m) * (n + m - 1.0)));
    const double distance = std::fabs(ranking.u - n * m / 2.0);
    if (!(variance > 0.0) || distance == 0.0) return 1.0;
    const double z = (distance - 0.5) / std::sqrt(variance);
    return std::min(1.0, 2.0 * boost::math::cdf(complement(boost::math::normal{}, z)));
}

}  // namespace

MannWhitney mann_whitney(std::span<const double> x, std::span<const double> y) {
    const Ranking ranking = rank(x, y);
    if (ranking.tie_term == 0.0 && x.size() < exact_limit && y.size() < exact_limit)
        return {ranking.u, exact_p_value(ranking.u, x.size(), y.size()), NullDistribution::exact};
    return {ranking.u,
            normal_p_value(ranking, static_cast<double>(x.size()), static_cast<double>(y.size())),
            NullDistribution::normal};
}

double vargha_delaney_a(std::span<const double> x, std::span<const double> y) {
    return rank(x, y).u / (static_cast<double>(x.size()) * static_cast<double>(y.size()));
}

}  // namespace gene_clocks::statistics
