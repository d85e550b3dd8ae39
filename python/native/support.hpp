// What all parts of the extension share: objects that are safe before they are initialised, bytes
// of any buffer, marks as Python has them.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/wire.hpp>
#include <new>
#include <span>
#include <string>
#include <utility>

namespace gene_clocks::python {

namespace py = pybind11;

/// A value that Python owns. `Class.__new__(Class)` makes an object without __init__; pybind11 then
/// takes raw memory for the value, which is zeroed here, so that such an object is known for what
/// it is and its methods raise.
template <class T>
class Guarded {
public:
    static void* operator new(std::size_t size) {
        return std::memset(::operator new(size), 0, size);
    }
    static void operator delete(void* memory) { ::operator delete(memory); }
    // pybind11 asks for it where it constructs in place.
    static void* operator new(std::size_t, void* place) { return place; }

    template <class... Arguments>
    explicit Guarded(std::in_place_t, Arguments&&... arguments)
        : mark_(initialised), value_(std::forward<Arguments>(arguments)...) {}

    T& get() {
        if (mark_ != initialised) {
            throw py::type_error("this object was never initialised: __init__ was not called");
        }
        return value_;
    }
    const T& get() const { return const_cast<Guarded*>(this)->get(); }

private:
    static constexpr std::uint64_t initialised = 0x67656e65636c6f63;
    std::uint64_t mark_;
    T value_;
};

/// The bytes of anything that has the buffer protocol, for as long as this lives.
class Bytes {
public:
    explicit Bytes(py::handle object) {
        if (PyObject_GetBuffer(object.ptr(), &view_, PyBUF_SIMPLE) != 0) {
            throw py::error_already_set();
        }
    }
    Bytes(const Bytes&) = delete;
    Bytes& operator=(const Bytes&) = delete;
    ~Bytes() { PyBuffer_Release(&view_); }

    std::span<const std::uint8_t> get() const {
        return {static_cast<const std::uint8_t*>(view_.buf), static_cast<std::size_t>(view_.len)};
    }

private:
    Py_buffer view_{};
};

inline py::bytes bytes_from(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The metaclass that classes of Python's own have. pybind11's only adds a check that __init__ was
/// called, for which Guarded is here.
inline py::metaclass plain_metaclass() {
    return py::metaclass(reinterpret_cast<PyObject*>(&PyType_Type));
}

/// A number of Python's below 2^`bits`; ValueError with `what` else, TypeError for no integer.
std::uint64_t unsigned_of(py::handle object, unsigned bits, const char* what);

/// A class or function of a module of the package, found once and kept.
py::handle python_object(const char* module, const char* name);

/// gene_clocks.InnovationNumber.
py::object mark_from(InnovationNumber mark);
InnovationNumber mark_of(py::handle object);
/// As messages show marks: <counter, robot>.
std::string text_of(InnovationNumber mark);

/// The limits behind a gene_clocks.WireLimits.
using Limits = Guarded<WireLimits>;

/// A GeneClock of Python's: refuses to work in a process that is not its own, and after it was
/// handed over.
class Clock {
public:
    explicit Clock(GeneClock clock);
    /// Raises where the clock may not be used here.
    GeneClock& get();
    GeneClock hand_over();

private:
    GeneClock clock_;
    std::uint32_t generation_;
    bool is_handed_over_ = false;
};
using PythonClock = Guarded<Clock>;

/// How often this process came of a fork, since the extension was loaded.
std::uint32_t fork_generation();

/// Raises gene_clocks.WireError. `where` says which gene, or is empty. What cannot be written has
/// no offset.
struct WireRefusal {
    WireFault fault;
    std::string where;
    py::dict details;
    bool is_of_writing = false;
};

void define_clock(py::module_& module);
void define_alignment(py::module_& module);
void define_frames(py::module_& module);
void define_messages(py::module_& module);
void define_genomes(py::module_& module);
void define_fragments(py::module_& module);
void define_storage(py::module_& module);
#ifdef GENE_CLOCKS_AUTHENTICATION
void define_authentication(py::module_& module);
#endif

}  // namespace gene_clocks::python
