// Frames under a key in Python; part of the extension where libsodium is at hand.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <exception>
#include <gene_clocks/authentication/sealed_frames.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "support.hpp"

using namespace pybind11::literals;

namespace gene_clocks::python {
namespace {

using namespace authentication;

constexpr std::size_t tag_bytes = 16;
/// Those of sealed frames, in the order of Refusal.
constexpr std::array<const char*, 5> refusal_names{"forged", "malformed", "replayed", "too_old",
                                                   "too_many_senders"};

using Windows = std::map<std::uint32_t, std::pair<std::uint64_t, std::uint64_t>>;
/// A sealer, in a box since it cannot be moved, which does not work in a process that came of a
/// fork: both would use the same numbers.
struct SealerOfProcess {
    std::unique_ptr<Sealer> sealer;
    std::uint32_t generation = fork_generation();

    Sealer& get() {
        if (generation == fork_generation()) return *sealer;
        throw std::runtime_error(
            "this sealer crossed a fork: parent and child would use the same numbers. Give the "
            "child a robot id and a sealer of its own");
    }
};
using PythonSealer = Guarded<SealerOfProcess>;
using PythonOpener = Guarded<std::unique_ptr<Opener>>;

/// Becomes gene_clocks.SealError, with the refusal's name.
struct SealRefusal {
    Refusal refusal;
};

Key key_of(py::handle data) {
    const Bytes bytes(data);
    Key key;
    if (bytes.get().size() != key.size()) {
        throw py::value_error("a key has 32 bytes, not " + std::to_string(bytes.get().size()));
    }
    std::copy(bytes.get().begin(), bytes.get().end(), key.begin());
    return key;
}

std::unique_ptr<PythonOpener> make_opener(py::handle key, const Limits& limits,
                                          std::size_t senders_max, const Windows& windows) {
    Opener::Windows by_sender;
    for (const auto& [sender, window] : windows) {
        by_sender[sender] = {window.first, window.second};
    }
    return std::make_unique<PythonOpener>(
        std::in_place,
        std::make_unique<Opener>(key_of(key), limits.get(), senders_max, std::move(by_sender)));
}

py::bytes open_frame(PythonOpener& opener, py::handle data) {
    const Bytes bytes(data);
    const auto sealed = bytes.get();
    const auto opened = opener.get()->open(sealed);
    if (const auto* refusal = std::get_if<Refusal>(&opened)) throw SealRefusal{*refusal};
    // What is opened has a version and a number before the frame.
    gene_clocks_reader reader{sealed.data(), sealed.size(), 1};
    std::uint64_t number = 0;
    gene_clocks_get_varint(&reader, 64, &number);
    return bytes_from(sealed.subspan(reader.offset, sealed.size() - reader.offset - tag_bytes));
}

py::dict counts_of(const PythonOpener& opener) {
    py::dict counts("opened"_a = opener.get()->counts().opened);
    for (std::size_t i = 0; i < refusal_names.size(); ++i) {
        counts[refusal_names[i]] = opener.get()->counts().refused[i];
    }
    return counts;
}

Windows windows_of(const PythonOpener& opener) {
    Windows windows;
    for (const auto& [sender, window] : opener.get()->windows()) {
        windows[sender] = {window.highest, window.opened};
    }
    return windows;
}

void define_error() {
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const SealRefusal& refused) {
            const py::handle type = python_object("gene_clocks._errors", "SealError");
            const py::object error = type(refusal_names[static_cast<std::size_t>(refused.refusal)]);
            PyErr_SetObject(type.ptr(), error.ptr());
        }
    });
}

}  // namespace

void define_authentication(py::module_& module) {
    define_error();
    py::class_<PythonSealer>(
        module, "Sealer", plain_metaclass(),
        "Seals frames under a key of 32 bytes. numbers is a GeneClock of its own, stored and "
        "restarted as that of genes is; it is handed over, and mints nothing more itself.")
        .def(py::init([](py::handle key, PythonClock& numbers) {
                 const Key bytes = key_of(key);
                 return std::make_unique<PythonSealer>(
                     std::in_place,
                     SealerOfProcess{std::make_unique<Sealer>(bytes, numbers.get().hand_over())});
             }),
             "key"_a, "numbers"_a)
        .def(
            "seal",
            [](PythonSealer& sealer, py::handle frame) -> std::optional<py::bytes> {
                const Bytes bytes(frame);
                const auto sealed = sealer.get().get().seal(bytes.get());
                if (!sealed) return std::nullopt;
                return bytes_from(*sealed);
            },
            "frame"_a, "The sealed frame; None where no number is left.")
        .def(
            "durable_needed",
            [](PythonSealer& sealer) { return sealer.get().get().durable_needed(); },
            "Must be on stable storage before what seal() returned last may leave.");
    py::class_<PythonOpener>(
        module, "Opener", plain_metaclass(),
        "Opens what Sealer sealed, each frame once. windows are those of an earlier life; without "
        "them frames of old are opened once more.")
        .def(py::init(&make_opener), "key"_a, "limits"_a, py::kw_only(), "senders_max"_a = 1024,
             "windows"_a = Windows{})
        .def("open", &open_frame, "sealed"_a, "The frame in it, for decode(); else SealError.")
        .def("windows", &windows_of,
             "By sender: the largest number opened, and a bit for each of the 64 numbers down from "
             "it.")
        .def("counts", &counts_of, "Frames opened, and refused by reason.");
}

}  // namespace gene_clocks::python
