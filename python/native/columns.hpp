// Columns of numbers between Python and C++: any buffer, or any sequence, in; NumPy's arrays out,
// or memory views where there is no NumPy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "support.hpp"

namespace gene_clocks::python {

/// What a column holds: numbers without sign of so many bits, or what an attribute has.
struct ColumnType {
    enum Kind { number, integer, single, real, flag, enumeration } kind = number;
    unsigned bits = 64;                               ///< numbers
    const std::vector<std::string>* names = nullptr;  ///< enumerations, which may be given by name
};

/// Reads a column of `size` values, each of which becomes 64 bits as general_checks.h has them.
/// ValueError, TypeError or OverflowError that names `what` and the gene where a value is none.
void read_column(py::handle object, const ColumnType& type, std::size_t size,
                 const std::string& what, std::vector<std::uint64_t>& values);

/// How many values a column has.
std::size_t column_size(py::handle object, const std::string& what);

/// Values as a column: values[start], values[start + step], …
py::object make_column(const ColumnType& type, const std::uint64_t* values, std::size_t size,
                       std::size_t step);

/// Rows of `size` integers each, as an array of two dimensions, or a tuple of views.
py::object make_rows(std::initializer_list<const std::uint64_t*> rows, std::size_t size);

}  // namespace gene_clocks::python
