// General genomes as columns, without an object for each gene.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <gene_clocks/general_genome.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "columns.hpp"

using namespace pybind11::literals;

namespace gene_clocks::python {
namespace {

ColumnType type_of(const Attribute& attribute) {
    switch (attribute.type) {
        case AttributeType::flag:
            return {ColumnType::flag};
        case AttributeType::enumeration:
            return {ColumnType::enumeration, 64, &attribute.values};
        case AttributeType::integer:
            return {ColumnType::integer};
        case AttributeType::float32:
            return {ColumnType::single};
        case AttributeType::float64:
            break;
    }
    return {ColumnType::real};
}

constexpr ColumnType counter_type{ColumnType::number, 64};
constexpr ColumnType narrow_type{ColumnType::number, 32};

/// Keeps others out of a form's memory: code of Python's runs where values are asked, and may call
/// the form again, or let another thread do so.
class Use {
public:
    explicit Use(bool& is_used) : is_used_(is_used) {
        if (is_used_) throw std::runtime_error("this schema is at work already, in another call");
        is_used_ = true;
    }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use() { is_used_ = false; }

private:
    bool& is_used_;
};

/// A schema, with what conversion needs ready: names as Python has them, memory that is used again.
class Form {
public:
    explicit Form(Schema schema) : schema_(std::move(schema)) {
        for (const GeneClass& gene_class : schema_.classes()) {
            keys_.push_back(keys_of(gene_class.name, gene_class.attributes));
        }
        keys_.push_back(keys_of("genome", schema_.attributes()));
    }

    const Schema& schema() const { return schema_; }

    py::bytes encode(py::handle robot, py::handle birth, py::handle attributes,
                     const py::dict& classes, py::handle stamp, std::uint32_t genes_max);
    py::tuple decode(py::handle payload, py::handle stamp, std::uint32_t genes_max);

private:
    /// Names, interned; and how errors call each column.
    struct Keys {
        py::str name;
        std::string counters, robots, sources, targets;
        std::vector<py::str> attributes;
        std::vector<std::string> columns;
    };
    /// The genes of a class on their way.
    struct Rows {
        std::vector<gene_clocks_general_gene> genes;
        std::vector<std::uint64_t> values;  // one row for each gene
    };

    static Keys keys_of(const std::string& name, const std::vector<Attribute>& attributes) {
        Keys keys{py::str(name),
                  name + " counters",
                  name + " robots",
                  name + " sources",
                  name + " targets",
                  {},
                  {}};
        for (const Attribute& attribute : attributes) {
            keys.attributes.emplace_back(attribute.name);
            keys.columns.push_back(name + " " + attribute.name);
        }
        return keys;
    }

    py::object attribute_of(py::handle attributes, const Keys& keys, std::size_t index) const;
    void require_no_others(py::handle attributes, const Keys& keys) const;
    void read_ends(py::handle column, Ends ends, const std::string& what,
                   gene_clocks_gene_end gene_clocks_general_gene::*end, Rows& rows);
    void read_rows(py::handle genes, std::size_t index, Rows& rows);
    py::object write_ends(Ends ends, gene_clocks_gene_end gene_clocks_general_gene::*end,
                          const Rows& rows);
    py::object write_rows(std::size_t index, const Rows& rows);
    py::dict write_values(const std::vector<std::uint64_t>& values) const;
    [[noreturn]] void refuse(gene_clocks_fault fault, const gene_clocks_general_checks& checks,
                             const Rows* rows) const;

    Schema schema_;
    std::vector<Keys> keys_;  // of each class, then the genome's
    std::array<Rows, gene_clocks_classes_max> rows_;
    std::vector<std::uint64_t> column_, own_;
    std::vector<std::uint8_t> payload_;
    bool is_used_ = false;
};

py::object Form::attribute_of(py::handle attributes, const Keys& keys, std::size_t index) const {
    PyObject* const found = PyDict_GetItemWithError(attributes.ptr(), keys.attributes[index].ptr());
    if (!found) {
        if (PyErr_Occurred()) throw py::error_already_set();
        throw py::value_error(keys.columns[index] + " is missing");
    }
    return py::reinterpret_borrow<py::object>(found);
}

/// An attribute that the schema has not would be lost in silence.
void Form::require_no_others(py::handle attributes, const Keys& keys) const {
    if (!PyDict_Check(attributes.ptr())) {
        throw py::type_error("attributes of " + std::string(keys.name) + " are a dict, not " +
                             std::string(py::repr(attributes)));
    }
    if (static_cast<std::size_t>(PyDict_Size(attributes.ptr())) == keys.attributes.size()) return;
    for (const auto& [name, value] : py::reinterpret_borrow<py::dict>(attributes)) {
        const auto text = std::string(py::str(name));
        if (std::none_of(keys.attributes.begin(), keys.attributes.end(),
                         [&](const py::str& known) { return std::string(known) == text; })) {
            throw py::value_error(std::string(keys.name) + " " + text +
                                  " is no attribute of the schema");
        }
    }
}

void Form::read_ends(py::handle column, Ends ends, const std::string& what,
                     gene_clocks_gene_end gene_clocks_general_gene::*end, Rows& rows) {
    const std::size_t size = rows.genes.size();
    if (ends == Ends::by_index) {
        read_column(column, narrow_type, size, what, column_);
        for (std::size_t i = 0; i < size; ++i) {
            (rows.genes[i].*end).index = static_cast<std::uint32_t>(column_[i]);
        }
        return;
    }
    if (!PyTuple_Check(column.ptr()) || PyTuple_GET_SIZE(column.ptr()) != 2) {
        throw py::type_error(what + " by mark are two columns, (counters, robots), not " +
                             std::string(py::repr(column)));
    }
    read_column(PyTuple_GET_ITEM(column.ptr(), 0), counter_type, size, what, column_);
    for (std::size_t i = 0; i < size; ++i) (rows.genes[i].*end).counter = column_[i];
    read_column(PyTuple_GET_ITEM(column.ptr(), 1), narrow_type, size, what, column_);
    for (std::size_t i = 0; i < size; ++i) {
        (rows.genes[i].*end).robot = static_cast<std::uint32_t>(column_[i]);
    }
}

/// `genes`: the fields of a gene_clocks.Genes: counters, robots, sources, targets, attributes.
void Form::read_rows(py::handle genes, std::size_t index, Rows& rows) {
    const GeneClass& gene_class = schema_.classes()[index];
    const Keys& keys = keys_[index];
    const auto field = [&](const char* name) { return genes.attr(name); };
    const py::object counters = field("counters"), sources = field("sources");
    const py::object& first =
        gene_class.is_marked ? counters
        : gene_class.ends == Ends::by_mark && PyTuple_Check(sources.ptr()) &&
                PyTuple_GET_SIZE(sources.ptr()) == 2
            ? py::reinterpret_borrow<py::object>(PyTuple_GET_ITEM(sources.ptr(), 0))
            : sources;
    const std::size_t size =
        column_size(first, gene_class.is_marked ? keys.counters : keys.sources);
    rows.genes.assign(size, {});
    if (gene_class.is_marked) {
        read_column(counters, counter_type, size, keys.counters, column_);
        for (std::size_t i = 0; i < size; ++i) rows.genes[i].counter = column_[i];
        read_column(field("robots"), narrow_type, size, keys.robots, column_);
        for (std::size_t i = 0; i < size; ++i) {
            rows.genes[i].robot = static_cast<std::uint32_t>(column_[i]);
        }
    }
    if (gene_class.ends != Ends::none) {
        read_ends(sources, gene_class.ends, keys.sources, &gene_clocks_general_gene::source, rows);
        read_ends(field("targets"), gene_class.ends, keys.targets,
                  &gene_clocks_general_gene::target, rows);
    }
    const std::size_t columns = gene_class.attributes.size();
    const py::object attributes = field("attributes");
    require_no_others(attributes, keys);
    rows.values.resize(size * columns);
    for (std::size_t j = 0; j < columns; ++j) {
        read_column(attribute_of(attributes, keys, j), type_of(gene_class.attributes[j]), size,
                    keys.columns[j], column_);
        for (std::size_t i = 0; i < size; ++i) rows.values[i * columns + j] = column_[i];
    }
}

void Form::refuse(gene_clocks_fault fault, const gene_clocks_general_checks& checks,
                  const Rows* rows) const {
    std::string where = "genome";
    py::dict details;
    const bool is_gene = checks.gene_class < schema_.classes().size();
    const auto& attributes =
        is_gene ? schema_.classes()[checks.gene_class].attributes : schema_.attributes();
    if (is_gene) {
        const GeneClass& gene_class = schema_.classes()[checks.gene_class];
        where = gene_class.name + " gene " + std::to_string(checks.gene);
        details["gene_class"] = gene_class.name;
        details["gene"] = checks.gene;
        if (rows && gene_class.is_marked && checks.gene < rows[checks.gene_class].genes.size()) {
            const auto& gene = rows[checks.gene_class].genes[checks.gene];
            const InnovationNumber mark{gene.counter, RobotId{gene.robot}};
            where += ", " + text_of(mark);
            details["mark"] = mark_from(mark);
        }
    }
    if (checks.part >= gene_clocks_part_attribute && fault.error == gene_clocks_wire_attribute) {
        const auto& name = attributes[checks.part - gene_clocks_part_attribute].name;
        where += ", " + name;
        details["attribute"] = name;
    } else if (fault.error == gene_clocks_wire_ends) {
        where += checks.part == gene_clocks_part_source ? ", source" : ", target";
    }
    throw WireRefusal{WireFault::from(fault), where, details, rows != nullptr};
}

py::bytes Form::encode(py::handle robot, py::handle birth, py::handle attributes,
                       const py::dict& classes, py::handle stamp, std::uint32_t genes_max) {
    const Use use(is_used_);
    gene_clocks_general_header header{static_cast<std::uint32_t>(unsigned_of(robot, 32, "robot")),
                                      unsigned_of(birth, 64, "birth"),
                                      {}};
    const auto number = unsigned_of(stamp, 64, "stamp");
    const Keys& own = keys_.back();
    require_no_others(attributes, own);
    own_.clear();
    for (std::size_t j = 0; j < schema_.attributes().size(); ++j) {
        const py::tuple alone = py::make_tuple(attribute_of(attributes, own, j));
        read_column(alone, type_of(schema_.attributes()[j]), 1, own.columns[j], column_);
        own_.push_back(column_[0]);
    }
    if (classes.size() != schema_.classes().size()) {
        throw py::value_error("the genome has " + std::to_string(classes.size()) +
                              " classes of genes, the schema " +
                              std::to_string(schema_.classes().size()));
    }
    // Marker, fingerprint, identity, counts and the genome's own attributes.
    std::size_t bytes = 1 + 4 + 5 + 10 + 5 * gene_clocks_classes_max + 8 + 10 * own_.size();
    for (std::size_t i = 0; i < schema_.classes().size(); ++i) {
        PyObject* const genes = PyDict_GetItemWithError(classes.ptr(), keys_[i].name.ptr());
        if (!genes) {
            if (PyErr_Occurred()) throw py::error_already_set();
            throw py::value_error("the genome has no genes of class " + std::string(keys_[i].name));
        }
        read_rows(genes, i, rows_[i]);
        if (rows_[i].genes.size() > genes_max) {
            throw WireRefusal{
                {WireError::too_many_genes, 0},
                std::string(keys_[i].name) + " genes: " + std::to_string(rows_[i].genes.size()),
                {},
                true};
        }
        header.counts[i] = static_cast<std::uint32_t>(rows_[i].genes.size());
        // Head, more, robot, ends, and for each attribute at most 10 bytes.
        bytes +=
            rows_[i].genes.size() * (8 + 10 + 5 + 30 + 10 * schema_.classes()[i].attributes.size());
    }
    if (payload_.size() < bytes) payload_.resize(bytes);
    gene_clocks_general_writer writer;
    auto fault = gene_clocks_begin_general(&writer, payload_.data(), payload_.size(), &header,
                                           own_.data(), number, &schema_.layout(), genes_max);
    for (std::size_t i = 0; !fault.error && i < schema_.classes().size(); ++i) {
        const std::size_t columns = schema_.classes()[i].attributes.size();
        for (std::size_t j = 0; !fault.error && j < rows_[i].genes.size(); ++j) {
            fault = gene_clocks_put_general_gene(&writer, &rows_[i].genes[j],
                                                 rows_[i].values.data() + j * columns);
        }
    }
    if (!fault.error) fault = gene_clocks_end_general(&writer);
    if (fault.error) refuse(fault, writer.checks, rows_.data());
    return bytes_from(std::span(payload_).first(writer.bytes.size));
}

py::object Form::write_ends(Ends ends, gene_clocks_gene_end gene_clocks_general_gene::*end,
                            const Rows& rows) {
    const std::size_t size = rows.genes.size();
    const auto column = [&](const ColumnType& type, auto number) {
        column_.resize(size);
        for (std::size_t i = 0; i < size; ++i) column_[i] = (rows.genes[i].*end).*number;
        return make_column(type, column_.data(), size, 1);
    };
    if (ends == Ends::none) return py::none();
    if (ends == Ends::by_index) return column(narrow_type, &gene_clocks_gene_end::index);
    return py::make_tuple(column(counter_type, &gene_clocks_gene_end::counter),
                          column(narrow_type, &gene_clocks_gene_end::robot));
}

py::object Form::write_rows(std::size_t index, const Rows& rows) {
    static const py::handle type = python_object("gene_clocks._genomes", "Genes");
    const GeneClass& gene_class = schema_.classes()[index];
    const std::size_t size = rows.genes.size(), columns = gene_class.attributes.size();
    py::object counters = py::none(), robots = py::none();
    if (gene_class.is_marked) {
        column_.resize(size);
        for (std::size_t i = 0; i < size; ++i) column_[i] = rows.genes[i].counter;
        counters = make_column(counter_type, column_.data(), size, 1);
        for (std::size_t i = 0; i < size; ++i) column_[i] = rows.genes[i].robot;
        robots = make_column(narrow_type, column_.data(), size, 1);
    }
    py::dict attributes;
    for (std::size_t j = 0; j < columns; ++j) {
        attributes[keys_[index].attributes[j]] =
            make_column(type_of(gene_class.attributes[j]), rows.values.data() + j, size, columns);
    }
    return type(counters, robots,
                write_ends(gene_class.ends, &gene_clocks_general_gene::source, rows),
                write_ends(gene_class.ends, &gene_clocks_general_gene::target, rows), attributes);
}

py::dict Form::write_values(const std::vector<std::uint64_t>& values) const {
    py::dict attributes;
    for (std::size_t j = 0; j < schema_.attributes().size(); ++j) {
        const auto value = [&]() -> py::object {
            switch (schema_.attributes()[j].type) {
                case AttributeType::flag:
                    return py::bool_(values[j] != 0);
                case AttributeType::integer:
                    return py::int_(gene_clocks_integer_of_value(values[j]));
                case AttributeType::float32:
                    return py::float_(gene_clocks_float32_of_value(values[j]));
                case AttributeType::float64:
                    return py::float_(gene_clocks_float64_of_value(values[j]));
                case AttributeType::enumeration:
                    break;
            }
            return py::int_(values[j]);
        };
        attributes[keys_.back().attributes[j]] = value();
    }
    return attributes;
}

py::tuple Form::decode(py::handle payload, py::handle stamp, std::uint32_t genes_max) {
    const Use use(is_used_);
    const Bytes bytes(payload);
    const auto number = unsigned_of(stamp, 64, "stamp");
    gene_clocks_general_reader reader;
    own_.resize(schema_.attributes().size());
    auto fault = gene_clocks_open_general(&reader, bytes.get().data(), bytes.get().size(), number,
                                          &schema_.layout(), genes_max, own_.data());
    if (fault.error) refuse(fault, reader.checks, nullptr);
    for (std::size_t i = 0; i < schema_.classes().size(); ++i) {
        const std::size_t columns = schema_.classes()[i].attributes.size();
        const std::size_t size = reader.checks.genome.counts[i];
        rows_[i].genes.resize(size);
        rows_[i].values.resize(size * columns);
        for (std::size_t j = 0; j < size; ++j) {
            fault = gene_clocks_next_general_gene(&reader, &rows_[i].genes[j],
                                                  rows_[i].values.data() + j * columns);
            if (fault.error) refuse(fault, reader.checks, nullptr);
        }
    }
    fault = gene_clocks_close_general(&reader);
    if (fault.error) refuse(fault, reader.checks, nullptr);
    // The genome is whole; only now does Python hear of it.
    py::dict classes;
    for (std::size_t i = 0; i < schema_.classes().size(); ++i) {
        classes[keys_[i].name] = write_rows(i, rows_[i]);
    }
    return py::make_tuple(reader.checks.genome.robot, reader.checks.genome.birth,
                          write_values(own_), classes);
}

Attribute attribute_of(const py::tuple& described) {
    return {described[0].cast<std::string>(),
            static_cast<AttributeType>(described[1].cast<int>()),
            described[2].cast<std::vector<std::string>>(),
            described[3].cast<std::int64_t>(),
            described[4].cast<std::int64_t>(),
            described[5].cast<double>()};
}

std::vector<Attribute> attributes_of(py::handle described) {
    std::vector<Attribute> attributes;
    for (const py::handle one : py::iter(described)) {
        attributes.push_back(attribute_of(py::reinterpret_borrow<py::tuple>(one)));
    }
    return attributes;
}

}  // namespace

void define_genomes(py::module_& module) {
    using PythonForm = Guarded<Form>;
    py::class_<PythonForm>(module, "_Form", plain_metaclass())
        .def_static(
            "make",
            [](py::handle genesis_count, py::handle classes, py::handle attributes) -> py::object {
                std::vector<GeneClass> list;
                for (const py::handle one : py::iter(classes)) {
                    const auto fields = py::reinterpret_borrow<py::tuple>(one);
                    list.push_back({fields[0].cast<std::string>(), fields[1].cast<bool>(),
                                    static_cast<Ends>(fields[2].cast<int>()),
                                    attributes_of(fields[3])});
                }
                const auto schema = Schema::make(unsigned_of(genesis_count, 64, "genesis_count"),
                                                 std::move(list), attributes_of(attributes));
                if (!schema) {
                    const SchemaFault fault = schema.fault();
                    return py::make_tuple(std::string(name_of(fault.error)), fault.gene_class,
                                          fault.attribute);
                }
                return py::cast(std::make_unique<PythonForm>(std::in_place, Form(*schema)));
            })
        .def("encode",
             [](PythonForm& form, py::handle robot, py::handle birth, py::handle attributes,
                const py::dict& classes, py::handle stamp, py::handle genes_max) {
                 return form.get().encode(
                     robot, birth, attributes, classes, stamp,
                     static_cast<std::uint32_t>(unsigned_of(genes_max, 32, "genes_max")));
             })
        .def("decode",
             [](PythonForm& form, py::handle payload, py::handle stamp, py::handle genes_max) {
                 return form.get().decode(
                     payload, stamp,
                     static_cast<std::uint32_t>(unsigned_of(genes_max, 32, "genes_max")));
             })
        .def("bytes",
             [](const PythonForm& form) { return bytes_from(form.get().schema().bytes()); })
        .def("fingerprint",
             [](const PythonForm& form) { return form.get().schema().fingerprint(); });
}

}  // namespace gene_clocks::python
