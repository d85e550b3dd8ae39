// The protocol in Python: clocks, marks, alignment and the wire format, for a NEAT that is written
// there. Thin over the C++ headers; what would abort there raises ValueError here.
#include <pybind11/operators.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <gene_clocks/align.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/wire.hpp>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace pybind11::literals;
using namespace gene_clocks;

namespace {

constexpr std::uint64_t counter_maximum = std::numeric_limits<std::uint64_t>::max();

std::uint32_t number_of(RobotId robot) {
    return static_cast<std::uint32_t>(robot);
}

std::string repr(InnovationNumber mark) {
    return "InnovationNumber(" + std::to_string(mark.counter) + ", " +
           std::to_string(number_of(mark.robot)) + ")";
}

// ---- Clock --------------------------------------------------------------------------------------

GeneClock make_clock(std::uint32_t robot, std::uint64_t genesis_count, GeneClock::Limits limits) {
    if (robot == 0) throw py::value_error("robot 0 is reserved for the initial genes");
    if (genesis_count >= limits.maximum) {
        throw py::value_error("genesis_count leaves no counter up to maximum");
    }
    return GeneClock(RobotId{robot}, genesis_count, limits);
}

GeneClock restart_clock(std::uint32_t robot, std::uint64_t stored, std::uint64_t genesis_count,
                        GeneClock::Limits limits) {
    auto clock = GeneClock::restart(RobotId{robot}, stored, genesis_count, limits);
    if (!clock) {
        throw py::value_error(
            "no clock of this robot with these limits and genesis marks stored that counter");
    }
    return *std::move(clock);
}

std::optional<std::vector<InnovationNumber>> mint_many(GeneClock& clock, std::uint64_t count) {
    std::vector<InnovationNumber> marks;
    marks.reserve(count);  // may fail, and so comes before the clock moves
    const auto minted = clock.mint(count);
    if (!minted) return std::nullopt;
    for (std::uint64_t i = 0; i < count; ++i) marks.push_back((*minted)[i]);
    return marks;
}

void define_clock(py::module_& module) {
    py::class_<InnovationNumber>(module, "InnovationNumber",
                                 "The mark of a gene; ordered by counter, then by robot.")
        .def(py::init([](std::uint64_t counter, std::uint32_t robot) {
                 return InnovationNumber{counter, RobotId{robot}};
             }),
             "counter"_a, "robot"_a)
        .def_readonly("counter", &InnovationNumber::counter)
        .def_property_readonly("robot", [](InnovationNumber m) { return number_of(m.robot); })
        .def(py::self == py::self)
        .def(py::self < py::self)
        .def(py::self <= py::self)
        .def(py::self > py::self)
        .def(py::self >= py::self)
        .def("__hash__",
             [](InnovationNumber m) {
                 return py::hash(py::make_tuple(m.counter, number_of(m.robot)));
             })
        .def("__repr__", &repr)
        .def(py::pickle(
            [](InnovationNumber m) { return py::make_tuple(m.counter, number_of(m.robot)); },
            [](const py::tuple& state) {
                return InnovationNumber{state[0].cast<std::uint64_t>(),
                                        RobotId{state[1].cast<std::uint32_t>()}};
            }));

    py::class_<GeneClock>(module, "GeneClock",
                          "A robot's or process's logical clock for genes. Send stamp() with every "
                          "genome; observe() the stamp of every genome received, before its genes "
                          "are used.")
        .def(py::init([](std::uint32_t robot, std::uint64_t genesis_count, std::uint64_t maximum,
                         std::uint64_t block, std::uint64_t window) {
                 return make_clock(robot, genesis_count, {maximum, block, window});
             }),
             "robot"_a, "genesis_count"_a = 0, py::kw_only(), "maximum"_a = counter_maximum,
             "block"_a = 0, "window"_a = counter_maximum,
             "A fresh clock above the marks of the initial genes, 1 to genesis_count of robot 0.")
        .def_static(
            "restart",
            [](std::uint32_t robot, std::uint64_t stored, std::uint64_t genesis_count,
               std::uint64_t maximum, std::uint64_t block, std::uint64_t window) {
                return restart_clock(robot, stored, genesis_count, {maximum, block, window});
            },
            "robot"_a, "stored"_a, "genesis_count"_a, py::kw_only(), "maximum"_a = counter_maximum,
            "block"_a = 0, "window"_a = counter_maximum,
            "A clock that goes on after a crash, from the last durable_needed() that was stored. "
            "ValueError where that lies among the fleet's genesis marks, or beyond maximum.")
        .def("mint", py::overload_cast<>(&GeneClock::mint),
             "The mark of one new gene; None at exhaustion, and nothing changes.")
        .def("mint", &mint_many, "count"_a, "That many consecutive marks, or None: all or none.")
        .def(
            "observe",
            [](GeneClock& clock, std::uint64_t stamp) { return clock.observe(Stamp{stamp}); },
            "stamp"_a, "Takes the maximum; False where the message must be dropped whole.")
        .def(
            "observe",
            [](GeneClock& clock, std::uint64_t stamp, const std::vector<InnovationNumber>& marks) {
                return clock.observe(Stamp{stamp}, marks);
            },
            "stamp"_a, "marks"_a, "The same, and False too where a mark is not below the stamp.")
        .def(
            "stamp", [](const GeneClock& clock) { return clock.stamp().value; },
            "The next unused counter, to be sent with every message.")
        .def("durable_needed", &GeneClock::durable_needed,
             "The counter that must be on stable storage before anything leaves.")
        .def_property_readonly("robot",
                               [](const GeneClock& clock) { return number_of(clock.robot()); });
}

// ---- Alignment ----------------------------------------------------------------------------------

using Aligned = std::tuple<GeneMatch, std::optional<std::size_t>, std::optional<std::size_t>>;

void require_ascending(const std::vector<InnovationNumber>& marks) {
    const auto wrong =
        std::adjacent_find(marks.begin(), marks.end(), [](auto a, auto b) { return !(a < b); });
    if (wrong == marks.end()) return;
    throw py::value_error("marks must ascend without repetition; " + repr(*wrong) +
                          " is followed by " + repr(*(wrong + 1)));
}

std::vector<Aligned> align_marks(const std::vector<InnovationNumber>& first,
                                 const std::vector<InnovationNumber>& second) {
    require_ascending(first);
    require_ascending(second);
    std::vector<Aligned> genes;
    align(first, second, [&](GeneMatch match, std::size_t i, std::size_t j) {
        const bool only_first =
            match == GeneMatch::disjoint_first || match == GeneMatch::excess_first;
        const bool only_second =
            match == GeneMatch::disjoint_second || match == GeneMatch::excess_second;
        genes.emplace_back(match, only_second ? std::nullopt : std::optional(i),
                           only_first ? std::nullopt : std::optional(j));
    });
    return genes;
}

void define_alignment(py::module_& module) {
    py::enum_<GeneMatch>(module, "GeneMatch", "How a gene stands in the alignment of two genomes.")
        .value("matching", GeneMatch::matching)
        .value("disjoint_first", GeneMatch::disjoint_first)
        .value("disjoint_second", GeneMatch::disjoint_second)
        .value("excess_first", GeneMatch::excess_first)
        .value("excess_second", GeneMatch::excess_second);
    module.def("align", &align_marks, "first"_a, "second"_a,
               "Aligns two ascending lists of marks: a list of (GeneMatch, index in first or None, "
               "index in second or None), in the order of marks. ValueError where they do not "
               "ascend.");
}

// ---- Wire format --------------------------------------------------------------------------------

using Gene = kernel::gene_clocks_gene;
using GeneKind = kernel::gene_clocks_gene_kind;

struct Message {
    std::uint32_t sender = 0;
    std::uint64_t stamp = 0;
    float energy = 0.0f;
    std::uint32_t robot = 0;
    std::uint32_t birth = 0;
    std::vector<Gene> genes;
};

/// Becomes gene_clocks.WireError, with the fault's name and offset.
struct Refused {
    WireFault fault;
};

Message decode(const py::bytes& data, const WireLimits& limits) {
    char* characters = nullptr;
    py::ssize_t size = 0;
    if (PyBytes_AsStringAndSize(data.ptr(), &characters, &size) != 0) throw py::error_already_set();
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(characters);
    const auto frame = decode_frame({bytes, static_cast<std::size_t>(size)}, limits);
    if (!frame) throw Refused{frame.fault()};
    const auto kernel_limits = limits.kernel_limits();
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.connections));
    kernel::gene_clocks_genome_reader reader;
    auto fault =
        kernel::gene_clocks_open_genome(&reader, frame->payload.data(), frame->payload.size(),
                                        frame->stamp.value, &kernel_limits, joined.data());
    std::vector<Gene> genes;
    while (!fault.error && kernel::gene_clocks_genes_left(&reader) > 0) {
        Gene gene;
        fault = kernel::gene_clocks_next_gene(&reader, &gene);
        if (!fault.error) genes.push_back(gene);
    }
    if (!fault.error) fault = kernel::gene_clocks_close_genome(&reader);
    if (fault.error) {
        fault.offset += static_cast<std::size_t>(frame->payload.data() - bytes);
        throw Refused{WireFault::from(fault)};
    }
    const auto& genome = reader.checks.genome;
    return {number_of(frame->sender), frame->stamp.value, frame->energy, genome.robot, genome.birth,
            std::move(genes)};
}

py::bytes encode(const Message& message, const WireLimits& limits) {
    const auto is_connection = [](const Gene& gene) {
        return gene.kind == kernel::gene_clocks_connection;
    };
    const auto connections = static_cast<std::size_t>(
        std::count_if(message.genes.begin(), message.genes.end(), is_connection));
    const std::size_t neurons = message.genes.size() - connections;
    if (neurons > limits.neurons || connections > limits.connections) {
        throw Refused{{WireError::too_many_genes, 0}};
    }
    const auto kernel_limits = limits.kernel_limits();
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.connections));
    std::vector<std::uint8_t> payload(genome_payload_bytes_max(neurons, connections));
    kernel::gene_clocks_genome_writer writer;
    auto fault = kernel::gene_clocks_begin_genome(
        &writer, payload.data(), payload.size(),
        {message.robot, message.birth, static_cast<std::uint16_t>(neurons),
         static_cast<std::uint16_t>(connections)},
        message.stamp, &kernel_limits, joined.data());
    for (const Gene& gene : message.genes) {
        if (!fault.error) fault = kernel::gene_clocks_put_gene(&writer, &gene);
    }
    if (!fault.error) fault = kernel::gene_clocks_end_genome(&writer);
    if (fault.error) throw Refused{WireFault::from(fault)};
    payload.resize(writer.bytes.size);
    std::vector<std::uint8_t> bytes(payload.size() + frame_overhead_bytes);
    const auto frame = encode_frame(
        {RobotId{message.sender}, Stamp{message.stamp}, message.energy, payload}, bytes, limits);
    if (!frame) throw Refused{frame.fault()};
    return {reinterpret_cast<const char*>(frame->data()), frame->size()};
}

void define_genes(py::module_& module) {
    py::enum_<GeneKind>(module, "GeneKind")
        .value("input", kernel::gene_clocks_input)
        .value("bias", kernel::gene_clocks_bias)
        .value("output", kernel::gene_clocks_output)
        .value("hidden", kernel::gene_clocks_hidden)
        .value("connection", kernel::gene_clocks_connection);
    py::class_<Gene>(module, "Gene",
                     "A gene of a message. source and target count the message's neurons from 0; "
                     "they, weight, enabled and recurrent are of connections only.")
        .def(py::init([](InnovationNumber mark, GeneKind kind, std::uint16_t source,
                         std::uint16_t target, float weight, bool enabled, bool recurrent) {
                 const bool is_connection = kind == kernel::gene_clocks_connection;
                 return Gene{mark.kernel_mark(), kind,  is_connection && enabled, recurrent,
                             {source, target},   weight};
             }),
             "mark"_a, "kind"_a, py::kw_only(), "source"_a = 0, "target"_a = 0, "weight"_a = 0.0f,
             "enabled"_a = true, "recurrent"_a = false)
        .def_property_readonly(
            "mark",
            [](const Gene& gene) {
                return InnovationNumber{gene.mark.counter, RobotId{gene.mark.robot}};
            })
        .def_readonly("kind", &Gene::kind)
        .def_property_readonly("source", [](const Gene& gene) { return gene.ends.source; })
        .def_property_readonly("target", [](const Gene& gene) { return gene.ends.target; })
        .def_readonly("weight", &Gene::weight)
        .def_readonly("enabled", &Gene::is_enabled)
        .def_readonly("recurrent", &Gene::is_recurrent);
}

void define_wire_format(py::module_& module) {
    static PyObject* const wire_error =
        PyErr_NewExceptionWithDoc("gene_clocks.WireError",
                                  "A frame that is refused: error is the reason's name, offset the "
                                  "byte where it was found.",
                                  PyExc_ValueError, nullptr);
    if (!wire_error) throw py::error_already_set();
    module.attr("WireError") = py::handle(wire_error);
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const Refused& refused) {
            const std::string name{name_of(refused.fault.error)};
            const py::object error =
                py::handle(wire_error)(name + " at byte " + std::to_string(refused.fault.offset));
            error.attr("error") = name;
            error.attr("offset") = refused.fault.offset;
            PyErr_SetObject(wire_error, error.ptr());
        }
    });

    const WireLimits standard;
    py::class_<WireLimits>(module, "WireLimits", "What a deployment admits; see the wire format.")
        .def(py::init([](std::uint32_t frame_bytes, std::uint64_t genesis_count,
                         std::uint16_t neurons, std::uint16_t connections, float energy,
                         float weight) {
                 if (!(energy >= 0.0f) || !(weight >= 0.0f)) {
                     throw py::value_error("the limits of energy and weight are not negative");
                 }
                 return WireLimits{frame_bytes, genesis_count,         neurons, connections, energy,
                                   weight,      std::random_device{}()};
             }),
             py::kw_only(), "frame_bytes"_a = standard.frame_bytes,
             "genesis_count"_a = standard.genesis_count, "neurons"_a = standard.neurons,
             "connections"_a = standard.connections, "energy"_a = standard.energy,
             "weight"_a = standard.weight);
    py::class_<Message>(module, "Message", "A genome on its way, with its sender's stamp.")
        .def(py::init([](std::uint32_t sender, std::uint64_t stamp, float energy,
                         std::uint32_t robot, std::uint32_t birth, std::vector<Gene> genes) {
                 return Message{sender, stamp, energy, robot, birth, std::move(genes)};
             }),
             py::kw_only(), "sender"_a, "stamp"_a, "energy"_a, "robot"_a, "birth"_a, "genes"_a)
        .def_readonly("sender", &Message::sender)
        .def_readonly("stamp", &Message::stamp)
        .def_readonly("energy", &Message::energy)
        .def_readonly("robot", &Message::robot, "who made the genome")
        .def_readonly("birth", &Message::birth, "a number that the robot gives to no other genome")
        .def_readonly("genes", &Message::genes, "in the order of their marks");
    module.def("encode", &encode, "message"_a, "limits"_a = WireLimits{},
               "The frame of a message, as bytes; WireError where decode would refuse it.");
    module.def("decode", &decode, "data"_a, "limits"_a = WireLimits{},
               "The message in a frame; WireError for any other bytes. Its stamp still has to pass "
               "the clock's observe.");
}

}  // namespace

#ifdef GENE_CLOCKS_AUTHENTICATION
void define_authentication(py::module_& module);  // authentication.cpp
#endif

PYBIND11_MODULE(gene_clocks, module) {
    module.doc() = "Decentralized innovation marking for distributed NEAT.";
    module.attr("__version__") = GENE_CLOCKS_VERSION;
    define_clock(module);
    define_alignment(module);
    define_genes(module);
    define_wire_format(module);
#ifdef GENE_CLOCKS_AUTHENTICATION
    define_authentication(module);
#endif
}
