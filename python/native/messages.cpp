// Messages of version 1: odNEAT's genes, as objects.
#include <gene_clocks/genome_payload.h>

#include <algorithm>
#include <vector>

#include "support.hpp"

using namespace pybind11::literals;

namespace gene_clocks::python {
namespace {

using kernel::gene_clocks_gene;

// The fields of gene_clocks.Gene, in order.
enum GeneField {
    mark_field,
    kind_field,
    source_field,
    target_field,
    weight_field,
    enabled_field,
    recurrent_field,
    gene_fields
};
// The fields of gene_clocks.Message, in order.
enum MessageField {
    sender_field,
    stamp_field,
    energy_field,
    robot_field,
    birth_field,
    genes_field
};

std::string gene_text(std::size_t index, const gene_clocks_gene& gene) {
    return "gene " + std::to_string(index) + ", " +
           text_of({gene.mark.counter, RobotId{gene.mark.robot}});
}

gene_clocks_gene gene_of(py::handle object, std::size_t index) {
    if (!PyTuple_Check(object.ptr()) || PyTuple_GET_SIZE(object.ptr()) != gene_fields) {
        throw py::type_error("gene " + std::to_string(index) +
                             " is no Gene: " + std::string(py::repr(object)));
    }
    const auto field = [&](GeneField which) {
        return py::handle(PyTuple_GET_ITEM(object.ptr(), which));
    };
    try {
        gene_clocks_gene gene{};
        gene.mark = mark_of(field(mark_field)).kernel_mark();
        gene.kind = static_cast<kernel::gene_clocks_gene_kind>(
            unsigned_of(field(kind_field), 8, "its kind"));
        if (gene.kind != kernel::gene_clocks_connection) return gene;
        gene.ends = {
            static_cast<std::uint16_t>(unsigned_of(field(source_field), 16, "its source")),
            static_cast<std::uint16_t>(unsigned_of(field(target_field), 16, "its target"))};
        gene.weight = static_cast<float>(PyFloat_AsDouble(field(weight_field).ptr()));
        if (PyErr_Occurred()) throw py::error_already_set();
        gene.is_enabled = PyObject_IsTrue(field(enabled_field).ptr()) == 1;
        gene.is_recurrent = PyObject_IsTrue(field(recurrent_field).ptr()) == 1;
        return gene;
    } catch (const py::value_error& error) {
        throw py::value_error("gene " + std::to_string(index) + ": " + error.what());
    }
}

py::object gene_from(const gene_clocks_gene& gene) {
    static const py::handle type = python_object("gene_clocks._messages", "Gene");
    static const auto* const kinds = [] {
        auto* all = new std::vector<py::object>;
        for (int i = 0; i < 5; ++i)
            all->push_back(python_object("gene_clocks._messages", "GeneKind")(i));
        return all;
    }();
    const py::tuple fields =
        py::make_tuple(mark_from({gene.mark.counter, RobotId{gene.mark.robot}}),
                       (*kinds)[static_cast<std::size_t>(gene.kind)], gene.ends.source,
                       gene.ends.target, gene.weight, gene.is_enabled, gene.is_recurrent);
    const py::tuple arguments = py::make_tuple(fields);
    PyObject* const made =
        PyTuple_Type.tp_new(reinterpret_cast<PyTypeObject*>(type.ptr()), arguments.ptr(), nullptr);
    if (!made) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(made);
}

/// The fields of a Message, its genes as a list.
py::tuple decode(py::handle data, const Limits& limits) {
    const Bytes bytes(data);
    const auto frame = decode_frame(bytes.get(), limits.get());
    if (!frame) throw WireRefusal{frame.fault(), "", {}};
    const auto kernel_limits = limits.get().kernel_limits();
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.get().connections));
    kernel::gene_clocks_genome_reader reader;
    auto fault =
        kernel::gene_clocks_open_genome(&reader, frame->payload.data(), frame->payload.size(),
                                        frame->stamp.value, &kernel_limits, joined.data());
    std::vector<gene_clocks_gene> genes;
    std::string where;
    while (!fault.error && kernel::gene_clocks_genes_left(&reader) > 0) {
        gene_clocks_gene gene;
        fault = kernel::gene_clocks_next_gene(&reader, &gene);
        if (fault.error) {
            where = "gene " + std::to_string(genes.size());
        } else {
            genes.push_back(gene);
        }
    }
    if (!fault.error) fault = kernel::gene_clocks_close_genome(&reader);
    if (fault.error) {
        fault.offset += static_cast<std::size_t>(frame->payload.data() - bytes.get().data());
        throw WireRefusal{WireFault::from(fault), where, {}};
    }
    py::tuple list(genes.size());
    for (std::size_t i = 0; i < genes.size(); ++i) list[i] = gene_from(genes[i]);
    const auto& genome = reader.checks.genome;
    return py::make_tuple(static_cast<std::uint32_t>(frame->sender), frame->stamp.value,
                          frame->energy, genome.robot, genome.birth, list);
}

struct Content {
    Frame frame;
    kernel::gene_clocks_genome genome;
    std::vector<gene_clocks_gene> genes;
};

Content content_of(const py::tuple& message) {
    const auto narrow = [&](MessageField field, const char* what) {
        return static_cast<std::uint32_t>(unsigned_of(message[field], 32, what));
    };
    Content content{{RobotId{narrow(sender_field, "sender")},
                     Stamp{unsigned_of(message[stamp_field], 64, "stamp")},
                     static_cast<float>(py::float_(message[energy_field])),
                     {}},
                    {narrow(robot_field, "robot"), narrow(birth_field, "birth"), 0, 0},
                    {}};
    for (const py::handle gene : py::iter(message[genes_field])) {
        content.genes.push_back(gene_of(gene, content.genes.size()));
    }
    return content;
}

py::bytes encode(const py::tuple& message, const Limits& limits) {
    Content content = content_of(message);
    const auto is_connection = [](const gene_clocks_gene& gene) {
        return gene.kind == kernel::gene_clocks_connection;
    };
    const auto connections = static_cast<std::size_t>(
        std::count_if(content.genes.begin(), content.genes.end(), is_connection));
    const std::size_t neurons = content.genes.size() - connections;
    if (neurons > limits.get().neurons || connections > limits.get().connections) {
        throw WireRefusal{{WireError::too_many_genes, 0},
                          "genome with " + std::to_string(neurons) + " neurons and " +
                              std::to_string(connections) + " connections",
                          {},
                          true};
    }
    content.genome.neurons = static_cast<std::uint16_t>(neurons);
    content.genome.connections = static_cast<std::uint16_t>(connections);
    const auto kernel_limits = limits.get().kernel_limits();
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.get().connections));
    std::vector<std::uint8_t> payload(genome_payload_bytes_max(neurons, connections));
    kernel::gene_clocks_genome_writer writer;
    auto fault =
        kernel::gene_clocks_begin_genome(&writer, payload.data(), payload.size(), content.genome,
                                         content.frame.stamp.value, &kernel_limits, joined.data());
    std::string where = "genome";
    for (std::size_t i = 0; !fault.error && i < content.genes.size(); ++i) {
        fault = kernel::gene_clocks_put_gene(&writer, &content.genes[i]);
        if (fault.error) where = gene_text(i, content.genes[i]);
    }
    if (!fault.error) fault = kernel::gene_clocks_end_genome(&writer);
    if (fault.error) throw WireRefusal{WireFault::from(fault), where, {}, true};
    content.frame.payload = std::span(payload).first(writer.bytes.size);
    std::vector<std::uint8_t> bytes(writer.bytes.size + frame_overhead_bytes);
    const auto frame = encode_frame(content.frame, bytes, limits.get());
    if (!frame) throw WireRefusal{frame.fault(), "frame", {}, true};
    return bytes_from(*frame);
}

}  // namespace

void define_messages(py::module_& module) {
    module.def("_encode", &encode);
    module.def("_decode", &decode);
}

}  // namespace gene_clocks::python
