// Frames, their limits and their errors; frames in fragments.
#include <gene_clocks/fragments.hpp>
#include <memory>
#include <random>
#include <vector>

#include "support.hpp"

using namespace pybind11::literals;

namespace gene_clocks::python {
namespace {

float limit_of(py::handle number, const char* what) {
    const double limit = PyFloat_AsDouble(number.ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
    if (!(limit >= 0.0)) {
        throw py::value_error(std::string("the limit of ") + what + " is " +
                              std::string(py::str(number)) + ", and may not be negative");
    }
    return static_cast<float>(limit);
}

py::tuple fields_of(const Limits& limits) {
    const WireLimits& values = limits.get();
    return py::make_tuple(values.frame_bytes, values.genesis_count, values.neurons,
                          values.connections, values.energy, values.weight);
}

void define_limits(py::module_& module) {
    const WireLimits standard;
    py::class_<Limits>(module, "WireLimits", plain_metaclass(),
                       "What a deployment admits. Everything beyond is refused before it costs "
                       "memory.")
        .def(
            py::init([](py::handle frame_bytes, py::handle genesis_count, py::handle neurons,
                        py::handle connections, py::handle energy, py::handle weight) {
                const auto narrow = [](py::handle number, const char* what) {
                    return static_cast<std::uint16_t>(unsigned_of(number, 16, what));
                };
                return std::make_unique<Limits>(
                    std::in_place,
                    WireLimits{
                        static_cast<std::uint32_t>(unsigned_of(frame_bytes, 32, "frame_bytes")),
                        unsigned_of(genesis_count, 64, "genesis_count"), narrow(neurons, "neurons"),
                        narrow(connections, "connections"), limit_of(energy, "energy"),
                        limit_of(weight, "weight"), std::random_device{}()});
            }),
            py::kw_only(), "frame_bytes"_a = standard.frame_bytes,
            "genesis_count"_a = standard.genesis_count, "neurons"_a = standard.neurons,
            "connections"_a = standard.connections, "energy"_a = standard.energy,
            "weight"_a = standard.weight)
        .def_property_readonly("frame_bytes", [](const Limits& l) { return l.get().frame_bytes; })
        .def_property_readonly("genesis_count",
                               [](const Limits& l) { return l.get().genesis_count; })
        .def_property_readonly("neurons", [](const Limits& l) { return l.get().neurons; })
        .def_property_readonly("connections", [](const Limits& l) { return l.get().connections; })
        .def_property_readonly("energy", [](const Limits& l) { return l.get().energy; })
        .def_property_readonly("weight", [](const Limits& l) { return l.get().weight; })
        .def("_fields", &fields_of);
}

void define_errors(py::module_& module) {
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const WireRefusal& refusal) {
            const py::handle type = python_object("gene_clocks._errors", "WireError");
            const py::object error =
                type(std::string(name_of(refusal.fault.error)),
                     refusal.is_of_writing ? py::object(py::none())
                                           : py::object(py::int_(refusal.fault.offset)),
                     refusal.where, **refusal.details);
            PyErr_SetObject(type.ptr(), error.ptr());
        }
    });
    py::list names;
    for (int error = 0;; ++error) {
        const auto name = name_of(static_cast<WireError>(error));
        if (name == "unknown") break;
        names.append(std::string(name));
    }
    module.attr("_wire_errors") = names;
}

}  // namespace

void define_frames(py::module_& module) {
    define_errors(module);
    define_limits(module);
    module.def("_encode_frame", [](py::handle sender, py::handle stamp, double energy,
                                   py::handle payload, const Limits& limits) {
        const Bytes content(payload);
        const Frame frame{RobotId{static_cast<std::uint32_t>(unsigned_of(sender, 32, "sender"))},
                          Stamp{unsigned_of(stamp, 64, "stamp")}, static_cast<float>(energy),
                          content.get()};
        // Refused with nothing written where it is too long; so no more memory than that.
        std::vector<std::uint8_t> buffer(
            std::min<std::size_t>(content.get().size(), limits.get().frame_bytes) +
            frame_overhead_bytes);
        const auto written = encode_frame(frame, buffer, limits.get());
        if (!written) throw WireRefusal{written.fault(), "frame", {}, true};
        return bytes_from(*written);
    });
    module.def("_decode_frame", [](py::handle data, const Limits& limits) {
        const Bytes bytes(data);
        const auto frame = decode_frame(bytes.get(), limits.get());
        if (!frame) throw WireRefusal{frame.fault(), "", {}};
        return py::make_tuple(static_cast<std::uint32_t>(frame->sender), frame->stamp.value,
                              frame->energy, bytes_from(frame->payload));
    });
}

void define_fragments(py::module_& module) {
    module.def("_split", [](py::handle message, py::handle sender, py::handle number,
                            std::size_t fragment_bytes) {
        const Bytes bytes(message);
        const auto fragments = split_message(
            bytes.get(), RobotId{static_cast<std::uint32_t>(unsigned_of(sender, 32, "sender"))},
            static_cast<std::uint8_t>(unsigned_of(number, 8, "number")), fragment_bytes);
        if (!fragments) throw WireRefusal{fragments.fault(), "message", {}, true};
        py::list list;
        for (const auto& fragment : *fragments) list.append(bytes_from(fragment));
        return list;
    });
    using Assembler = Guarded<MessageAssembler>;
    py::class_<Assembler>(module, "MessageAssembler", plain_metaclass())
        .def(py::init([](std::size_t messages, std::size_t message_bytes) {
                 if (messages == 0 || message_bytes == 0) {
                     throw py::value_error("messages and message_bytes are at least 1");
                 }
                 if (messages > PTRDIFF_MAX / message_bytes) throw std::bad_alloc();
                 return std::make_unique<Assembler>(std::in_place, messages, message_bytes);
             }),
             "messages"_a = 16, "message_bytes"_a = 65'507)
        .def("_take", [](Assembler& assembler, py::handle data) {
            const Bytes bytes(data);
            const auto taken = assembler.get().take(bytes.get());
            const bool is_whole = taken.outcome == FragmentOutcome::completes;
            return py::make_tuple(std::string(name_of(taken.outcome)),
                                  is_whole ? py::object(bytes_from(taken.message)) : py::none());
        });
}

}  // namespace gene_clocks::python
