#include "sim/statistics/mann_whitney.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "sim/statistics/finite_sample.hpp"

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

/// Of the two one-sided p-values, "less" and "greater", the one asked for; two-sided, twice the
/// smaller.
double choose(double less, double greater, Alternative alternative) {
    if (alternative == Alternative::less) return less;
    if (alternative == Alternative::greater) return greater;
    return std::min(1.0, 2.0 * std::min(less, greater));
}

double exact_p_value(double u, std::size_t n, std::size_t m, Alternative alternative) {
    const std::vector<Count> count = arrangements(n, m);
    const auto observed = static_cast<std::size_t>(u);  // no ties: an integer
    const auto tail = [&](std::size_t largest) {
        Count sum = 0;
        for (std::size_t i = 0; i <= largest; ++i) sum += count[i];
        return sum.convert_to<double>();
    };
    const double all = tail(n * m);
    // The distribution is symmetric: U is as likely to be at least u as to be at most nm - u.
    return choose(tail(observed) / all, tail(n * m - observed) / all, alternative);
}

double normal_p_value(const Ranking& ranking, double n, double m, Alternative alternative) {
    const double variance =
        n * m / 12.0 * ((n + m + 1.0) - ranking.tie_term / ((n + m) * (n + m - 1.0)));
    if (!(variance > 0.0)) return 1.0;
    const double deviation = ranking.u - n * m / 2.0;
    const boost::math::normal standard;
    const double less = boost::math::cdf(standard, (deviation + 0.5) / std::sqrt(variance));
    const double greater =
        boost::math::cdf(complement(standard, (deviation - 0.5) / std::sqrt(variance)));
    return choose(less, greater, alternative);
}

}  // namespace

MannWhitney mann_whitney(std::span<const double> x, std::span<const double> y,
                         Alternative alternative) {
    const Ranking ranking = rank(x, y);
    const std::size_t n = x.size();
    const std::size_t m = y.size();
    if (ranking.tie_term == 0.0 && n < exact_limit && m < exact_limit) {
        return {ranking.u, exact_p_value(ranking.u, n, m, alternative), NullDistribution::exact};
    }
    const double p_value =
        normal_p_value(ranking, static_cast<double>(n), static_cast<double>(m), alternative);
    return {ranking.u, p_value, NullDistribution::normal};
}

std::size_t tail_statistic(std::size_t n, std::size_t m, double probability) {
    if (n == 0 || m == 0) throw std::invalid_argument("a sample is empty");
    if (!(probability > 0.0 && probability < 1.0))
        throw std::invalid_argument("a probability lies outside (0, 1)");
    if (n < exact_limit && m < exact_limit) {
        const std::vector<Count> count = arrangements(n, m);
        double all = 0.0;
        for (const Count& of_u : count) all += of_u.convert_to<double>();
        double sum = 0.0;
        std::size_t u = 0;
        // As qwilcox does, a probability that rounding alone puts short of the sum counts as met.
        while ((sum += count[u].convert_to<double>()) < all * probability * (1.0 - 1e-14)) ++u;
        return u;
    }
    const double product = static_cast<double>(n) * static_cast<double>(m);
    const double deviation = std::sqrt(product * static_cast<double>(n + m + 1) / 12.0);
    const boost::math::normal standard;
    const double u = product / 2.0 + boost::math::quantile(standard, probability) * deviation;
    return static_cast<std::size_t>(std::clamp(std::ceil(u), 0.0, product));
}

double vargha_delaney_a(std::span<const double> x, std::span<const double> y) {
    return rank(x, y).u / (static_cast<double>(x.size()) * static_cast<double>(y.size()));
}

}  // namespace gene_clocks::statistics
