// Alignment: of lists of marks, and of columns.
#include <algorithm>
#include <gene_clocks/align.hpp>
#include <memory>
#include <vector>

#include "columns.hpp"

using namespace pybind11::literals;

namespace gene_clocks::python {
namespace {

using Marks = std::vector<InnovationNumber>;

[[noreturn]] void refuse_order(const char* which, std::size_t gene, const std::string& mark,
                               const std::string& next) {
    throw py::value_error("marks must ascend without repetition: in the " + std::string(which) +
                          " genome gene " + std::to_string(gene) + ", " + mark +
                          ", is followed by " + next);
}

void require_ascending(const Marks& marks, const char* which) {
    const auto wrong =
        std::adjacent_find(marks.begin(), marks.end(), [](auto a, auto b) { return !(a < b); });
    if (wrong == marks.end()) return;
    refuse_order(which, static_cast<std::size_t>(wrong - marks.begin()), text_of(*wrong),
                 text_of(*(wrong + 1)));
}

Marks marks_in(py::handle sequence, const char* which) {
    Marks marks;
    const py::object fast = py::reinterpret_steal<py::object>(PySequence_Tuple(sequence.ptr()));
    if (!fast) throw py::error_already_set();
    const py::ssize_t size = PyTuple_GET_SIZE(fast.ptr());
    marks.reserve(static_cast<std::size_t>(size));
    for (py::ssize_t i = 0; i < size; ++i) {
        marks.push_back(mark_of(PyTuple_GET_ITEM(fast.ptr(), i)));
    }
    require_ascending(marks, which);
    return marks;
}

/// A list of (match, index or None, index or None).
py::list align_marks(py::handle first_marks, py::handle second_marks) {
    static const py::handle type = python_object("gene_clocks._marks", "GeneMatch");
    static const std::vector<py::object>* const matches = [] {
        auto* all = new std::vector<py::object>;
        for (int i = 0; i < 5; ++i) all->push_back(type(i));
        return all;
    }();
    const Marks first = marks_in(first_marks, "first");
    const Marks second = marks_in(second_marks, "second");
    py::list genes;
    align(first, second, [&](GeneMatch match, std::size_t i, std::size_t j) {
        const bool only_first =
            match == GeneMatch::disjoint_first || match == GeneMatch::excess_first;
        const bool only_second =
            match == GeneMatch::disjoint_second || match == GeneMatch::excess_second;
        genes.append(py::make_tuple((*matches)[static_cast<std::size_t>(match)],
                                    only_second ? py::object(py::none()) : py::object(py::int_(i)),
                                    only_first ? py::object(py::none()) : py::object(py::int_(j))));
    });
    return genes;
}

/// A genome's marks, in the columns that they came in; what the kernel reads marks from.
struct Side {
    std::vector<std::uint64_t> counters, robots;

    void read(py::handle counter_column, py::handle robot_column, const char* which) {
        static const std::string counters_name = "counters", robots_name = "robots";
        const std::size_t size = column_size(counter_column, counters_name);
        read_column(counter_column, {ColumnType::number, 64}, size, counters_name, counters);
        read_column(robot_column, {ColumnType::number, 32}, size, robots_name, robots);
        for (std::size_t i = 1; i < size; ++i) {
            if (!kernel::gene_clocks_less((*this)[i - 1], (*this)[i])) refuse(i - 1, which);
        }
    }

    kernel::gene_clocks_mark<std::uint64_t> operator[](std::size_t i) const {
        return {counters[i], static_cast<std::uint32_t>(robots[i])};
    }

private:
    [[noreturn]] void refuse(std::size_t i, const char* which) const {
        const auto text = [&](std::size_t j) {
            return text_of({counters[j], RobotId{static_cast<std::uint32_t>(robots[j])}});
        };
        refuse_order(which, i, text(i), text(i + 1));
    }
};

/// Three rows: how each gene stands, and its index in either genome, -1 where it is not in it.
py::object align_columns(py::handle first_counters, py::handle first_robots,
                         py::handle second_counters, py::handle second_robots) {
    constexpr std::uint64_t none = UINT64_MAX;  // -1
    Side first, second;
    first.read(first_counters, first_robots, "first");
    second.read(second_counters, second_robots, "second");
    const std::size_t most = first.counters.size() + second.counters.size();
    const auto memory = std::make_unique_for_overwrite<std::uint64_t[]>(3 * most);
    std::uint64_t* const matches = memory.get();
    std::uint64_t* const in_first = matches + most;
    std::uint64_t* const in_second = in_first + most;
    std::size_t genes = 0;
    auto visit = [&](kernel::gene_clocks_match match, std::size_t i, std::size_t j) {
        const bool is_in_first = match != kernel::gene_clocks_disjoint_second &&
                                 match != kernel::gene_clocks_excess_second;
        const bool is_in_second = match != kernel::gene_clocks_disjoint_first &&
                                  match != kernel::gene_clocks_excess_first;
        matches[genes] = static_cast<std::uint64_t>(match);
        in_first[genes] = is_in_first ? i : none;
        in_second[genes] = is_in_second ? j : none;
        ++genes;
    };
    kernel::gene_clocks_align(first, first.counters.size(), second, second.counters.size(), visit);
    return make_rows({matches, in_first, in_second}, genes);
}

}  // namespace

void define_alignment(py::module_& module) {
    module.def("_align", &align_marks);
    module.def("_align_columns", &align_columns);
}

}  // namespace gene_clocks::python
