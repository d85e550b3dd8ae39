#pragma once

#include <array>
#include <cstdint>
#include <gene_clocks/neat/congruence_class_source.hpp>
#include <gene_clocks/neat/content_hash_source.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/global_counter_source.hpp>
#include <gene_clocks/neat/hybrid_logical_clock_source.hpp>
#include <gene_clocks/neat/random_identifier_source.hpp>
#include <gene_clocks/neat/timestamp_source.hpp>
#include <gene_clocks/neat/unmerged_gene_clock_source.hpp>
#include <string_view>

// clang-format off
/// Every innovation source of the simulator, once: all that is known about it outside of its own
/// header in neat/. Who adds one adds its header above and a row here; the command line, settings,
/// stores, reports and replays then know it.
///
/// A row: its name in C++ and in files, its class, its title, its colours on light and on dark
/// pages, the dashes of its line (lengths of lines and gaps; none: solid) and its marker, as
/// matplotlib calls it. The colours are Okabe and Ito's and of Tol's "muted" ones, which all common
/// kinds of colour vision tell apart; dashes and markers tell sources apart without them.
#define GENE_CLOCKS_SOURCES(X)                                                                                                                       \
    /* the paper's */                                                                                                                                \
    X(gene_clock,           "gene-clock",           GeneClockSource,          "Gene Clocks",           "#0072b2", "#56b4e9", "",                "o") \
    /* the same without the maximum on reception */                                                                                                  \
    X(gene_clock_no_merge,  "gene-clock-no-merge",  UnmergedGeneClockSource,  "Gene Clocks, no merge", "#56b4e9", "#a8d8f5", "6 1.5",           "v") \
    /* local clocks, perfect unless TimestampSettings say otherwise */                                                                               \
    X(timestamp,            "timestamp",            TimestampSource,          "Timestamps",            "#d55e00", "#f0923c", "4 2",             "s") \
    /* local clocks that are off */                                                                                                                  \
    X(timestamp_drift,      "timestamp-drift",      TimestampSource,          "Drifting timestamps",   "#e69f00", "#f2c14e", "4 1.5 1 1.5",     "D") \
    /* IM-(mu+1) */                                                                                                                                  \
    X(random_identifier,    "random-identifier",    RandomIdentifierSource,   "Random identifiers",    "#cc79a7", "#e0a3c6", "1.6 1",           "X") \
    /* NEAT's */                                                                                                                                     \
    X(global_counter,       "global-counter",       GlobalCounterSource,      "Global counter",        "#44494f", "#b9c0c8", "8 2",             "^") \
    /* robot i of n marks i, i + n, … */                                                                                                             \
    X(congruence_class,     "congruence-class",     CongruenceClassSource,    "Congruence classes",    "#009e73", "#38c99a", "5 1.2 1 1.2 1 1.2", "P") \
    /* what is changed is the identity */                                                                                                            \
    X(content_hash,         "content-hash",         ContentHashSource,        "Content hash",          "#882255", "#d46a9a", "2.5 1.2",         "p") \
    /* physical and logical time in one */                                                                                                           \
    X(hybrid_logical_clock, "hybrid-logical-clock", HybridLogicalClockSource, "Hybrid logical clocks", "#999933", "#c4c45a", "7 1.5 2 1.5",     "h")
// clang-format on

namespace gene_clocks::sim {

/// What marks new genes: the rows of GENE_CLOCKS_SOURCES.
enum class Source : std::uint8_t {
#define GENE_CLOCKS_SOURCE_ENUMERATOR(enumerator, ...) enumerator,
    GENE_CLOCKS_SOURCES(GENE_CLOCKS_SOURCE_ENUMERATOR)
#undef GENE_CLOCKS_SOURCE_ENUMERATOR
};

/// How a source is called and drawn.
struct SourceDisplay {
    Source source{};
    std::string_view name;   ///< in files and on the command line
    std::string_view title;  ///< for people
    std::string_view colour;
    std::string_view dark_colour;
    std::string_view dashes;
    std::string_view marker;
};

/// All sources, in the order of the enumeration.
inline constexpr auto sources = std::to_array<SourceDisplay>({
#define GENE_CLOCKS_SOURCE_DISPLAY(enumerator, name, class_name, ...) \
    {Source::enumerator, name, __VA_ARGS__},
    GENE_CLOCKS_SOURCES(GENE_CLOCKS_SOURCE_DISPLAY)
#undef GENE_CLOCKS_SOURCE_DISPLAY
});

/// How a source is called and drawn. Precondition: it is one of the enumeration's.
constexpr const SourceDisplay& display_of(Source source) {
    return sources[static_cast<std::size_t>(source)];
}

}  // namespace gene_clocks::sim
