/* What lets one text be C99 and C++ from 11 on, inside or outside of extern "C", without old-style
 * casts: for the headers that are plain C in every language. */
#ifndef GENE_CLOCKS_LANGUAGE_H
#define GENE_CLOCKS_LANGUAGE_H

/* clang-format off */
#if !defined(__cplusplus)
#include <stdbool.h>
#define GENE_CLOCKS_PLAIN static inline
#define GENE_CLOCKS_COPIES static inline /* not at compile time */
#define GENE_CLOCKS_CAST(type, value) ((type)(value))
#define GENE_CLOCKS_NULL ((void*)0)
#define GENE_CLOCKS_BEGIN
#define GENE_CLOCKS_END
#else
#if __cplusplus < 201103L
#error "Gene Clocks needs C99 or C++11: compile with -std=c++11 or later"
#elif __cplusplus >= 202002L
#define GENE_CLOCKS_PLAIN constexpr
#else
#define GENE_CLOCKS_PLAIN inline
#endif
#define GENE_CLOCKS_COPIES inline
#define GENE_CLOCKS_CAST(type, value) (static_cast<type>(value))
#define GENE_CLOCKS_NULL nullptr
/* An extern "C" around the include would forbid what is C++ in here. */
#define GENE_CLOCKS_BEGIN extern "C++" {
#define GENE_CLOCKS_END }
#endif
/* clang-format on */

#endif /* GENE_CLOCKS_LANGUAGE_H */
