// The extension gene_clocks._core: the protocol for Python, thin over the C++ headers. What would
// abort there raises here. What needs no speed is Python, in src/gene_clocks.
#include <pthread.h>

#include <atomic>
#include <map>

#include "support.hpp"

namespace gene_clocks::python {
namespace {

std::atomic<std::uint32_t> forks{0};

}  // namespace

std::uint32_t fork_generation() {
    return forks.load(std::memory_order_relaxed);
}

std::uint64_t unsigned_of(py::handle object, unsigned bits, const char* what) {
    const py::object integer = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
    if (!integer) throw py::error_already_set();
    const std::uint64_t value = PyLong_AsUnsignedLongLong(integer.ptr());
    if (PyErr_Occurred() || (bits < 64 && value >> bits != 0)) {
        PyErr_Clear();
        throw py::value_error(std::string(what) + " is " + std::string(py::str(integer)) +
                              ", not from 0 to 2^" + std::to_string(bits) + " - 1");
    }
    return value;
}

py::handle python_object(const char* module, const char* name) {
    // Kept until the process ends: the interpreter may be gone before statics are.
    static auto* const found = new std::map<std::pair<std::string, std::string>, py::object>;
    auto& object = (*found)[{module, name}];
    if (!object) object = py::module_::import(module).attr(name);
    return object;
}

py::object mark_from(InnovationNumber mark) {
    static const py::handle type = python_object("gene_clocks._marks", "InnovationNumber");
    const py::tuple pair = py::make_tuple(mark.counter, static_cast<std::uint32_t>(mark.robot));
    const py::tuple arguments = py::make_tuple(pair);
    PyObject* const made =
        PyTuple_Type.tp_new(reinterpret_cast<PyTypeObject*>(type.ptr()), arguments.ptr(), nullptr);
    if (!made) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(made);
}

InnovationNumber mark_of(py::handle object) {
    if (!PyTuple_Check(object.ptr()) || PyTuple_GET_SIZE(object.ptr()) != 2) {
        throw py::type_error("a mark is an InnovationNumber or a tuple of counter and robot, not " +
                             std::string(py::repr(object)));
    }
    return {unsigned_of(PyTuple_GET_ITEM(object.ptr(), 0), 64, "a mark's counter"),
            RobotId{static_cast<std::uint32_t>(
                unsigned_of(PyTuple_GET_ITEM(object.ptr(), 1), 32, "a mark's robot"))}};
}

std::string text_of(InnovationNumber mark) {
    return "<" + std::to_string(mark.counter) + ", " +
           std::to_string(static_cast<std::uint32_t>(mark.robot)) + ">";
}

}  // namespace gene_clocks::python

PYBIND11_MODULE(_core, module) {
    using namespace gene_clocks::python;
    module.doc() = "The protocol of Gene Clocks in C++; use it by way of the package gene_clocks.";
    module.attr("__version__") = GENE_CLOCKS_VERSION;
    static const int registered =
        pthread_atfork(nullptr, nullptr, [] { forks.fetch_add(1, std::memory_order_relaxed); });
    if (registered != 0) throw std::bad_alloc();
    define_frames(module);  // first: its errors and limits are those of the others
    define_clock(module);
    define_alignment(module);
    define_messages(module);
    define_genomes(module);
    define_fragments(module);
    define_storage(module);
#ifdef GENE_CLOCKS_AUTHENTICATION
    define_authentication(module);
    module.attr("has_authentication") = true;
#else
    module.attr("has_authentication") = false;
#endif
}
