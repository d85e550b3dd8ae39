// Frames under a key in Python; part of the module where libsodium is at hand.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <gene_clocks/authentication/sealed_frames.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace py = pybind11;
using namespace pybind11::literals;
using namespace gene_clocks;
using namespace gene_clocks::authentication;

namespace {

constexpr std::size_t tag_bytes = 16;
constexpr std::array<const char*, 5> refusal_names{"forged", "malformed", "replayed", "too_old",
                                                   "too_many_senders"};

using Windows = std::map<std::uint32_t, std::pair<std::uint64_t, std::uint64_t>>;

/// Becomes gene_clocks.SealError, with the refusal's name.
struct Refused {
    Refusal refusal;
};

std::span<const std::uint8_t> bytes_of(const py::bytes& data) {
    const std::string_view view = data;
    return {reinterpret_cast<const std::uint8_t*>(view.data()), view.size()};
}

py::bytes bytes_from(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Key key_of(const py::bytes& data) {
    const auto bytes = bytes_of(data);
    Key key;
    if (bytes.size() != key.size()) throw py::value_error("a key has 32 bytes");
    std::copy(bytes.begin(), bytes.end(), key.begin());
    return key;
}

std::unique_ptr<Opener> make_opener(const py::bytes& key, const WireLimits& limits,
                                    std::size_t senders_max, const Windows& windows) {
    Opener::Windows by_sender;
    for (const auto& [sender, window] : windows) {
        by_sender[sender] = {window.first, window.second};
    }
    return std::make_unique<Opener>(key_of(key), limits, senders_max, std::move(by_sender));
}

py::bytes open_frame(Opener& opener, const py::bytes& data) {
    const auto sealed = bytes_of(data);
    const auto opened = opener.open(sealed);
    if (const auto* refusal = std::get_if<Refusal>(&opened)) throw Refused{*refusal};
    // What is opened has a version and a number before the frame.
    kernel::gene_clocks_reader reader{sealed.data(), sealed.size(), 1};
    std::uint64_t number = 0;
    kernel::gene_clocks_get_varint(&reader, 64, &number);
    return bytes_from(sealed.subspan(reader.offset, sealed.size() - reader.offset - tag_bytes));
}

py::dict counts_of(const Opener& opener) {
    py::dict counts("opened"_a = opener.counts().opened);
    for (std::size_t i = 0; i < refusal_names.size(); ++i) {
        counts[refusal_names[i]] = opener.counts().refused[i];
    }
    return counts;
}

Windows windows_of(const Opener& opener) {
    Windows windows;
    for (const auto& [sender, window] : opener.windows()) {
        windows[sender] = {window.highest, window.opened};
    }
    return windows;
}

void define_error(py::module_& module) {
    static PyObject* const seal_error = PyErr_NewExceptionWithDoc(
        "gene_clocks.SealError", "A sealed frame that is not opened: refusal is the reason's name.",
        PyExc_ValueError, nullptr);
    if (!seal_error) throw py::error_already_set();
    module.attr("SealError") = py::handle(seal_error);
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const Refused& refused) {
            const char* const name = refusal_names[static_cast<std::size_t>(refused.refusal)];
            const py::object error = py::handle(seal_error)(name);
            error.attr("refusal") = name;
            PyErr_SetObject(seal_error, error.ptr());
        }
    });
}

}  // namespace

void define_authentication(py::module_& module) {
    define_error(module);
    py::class_<Sealer>(
        module, "Sealer",
        "Seals frames under a key of 32 bytes. numbers is a GeneClock of its own, "
        "stored and restarted as that of genes is; it is handed over, and mints nothing more "
        "itself.")
        .def(py::init([](const py::bytes& key, GeneClock& numbers) {
                 return std::make_unique<Sealer>(key_of(key), std::move(numbers));
             }),
             "key"_a, "numbers"_a)
        .def(
            "seal",
            [](Sealer& sealer, const py::bytes& frame) -> std::optional<py::bytes> {
                const auto sealed = sealer.seal(bytes_of(frame));
                if (!sealed) return std::nullopt;
                return bytes_from(*sealed);
            },
            "frame"_a, "The sealed frame; None where no number is left.")
        .def("durable_needed", &Sealer::durable_needed,
             "Must be on stable storage before what seal() returned last may leave.");
    py::class_<Opener>(module, "Opener",
                       "Opens what Sealer sealed, each frame once. windows are those of an earlier "
                       "life; without them frames of old are opened once more.")
        .def(py::init(&make_opener), "key"_a, "limits"_a = WireLimits{}, py::kw_only(),
             "senders_max"_a = 1024, "windows"_a = Windows{})
        .def("open", &open_frame, "sealed"_a, "The frame in it, for decode(); else SealError.")
        .def("windows", &windows_of,
             "By sender: the largest number opened, and a bit for each of "
             "the 64 numbers down from it.")
        .def("counts", &counts_of, "Frames opened, and refused by reason.");
}
