#include "columns.hpp"

#include <gene_clocks/general_checks.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace gene_clocks::python {
namespace {

std::string gene_text(const std::string& what, std::size_t index) {
    return what + " of gene " + std::to_string(index);
}

[[noreturn]] void refuse(const std::string& what, std::size_t index, const std::string& why) {
    throw py::value_error(gene_text(what, index) + ": " + why);
}

/// A number that came as a signed one, where it may be none.
std::uint64_t checked_number(std::uint64_t value, bool is_negative, const ColumnType& type,
                             const std::string& what, std::size_t index) {
    if (type.kind == ColumnType::integer) {
        if (!is_negative && value > INT64_MAX) refuse(what, index, "it has more than 64 bits");
        return value;
    }
    if (is_negative) {
        refuse(what, index,
               std::to_string(static_cast<std::int64_t>(value)) + " may not be negative");
    }
    if (type.kind == ColumnType::number && type.bits < 64 && value >> type.bits != 0) {
        refuse(what, index,
               std::to_string(value) + " has more than " + std::to_string(type.bits) + " bits");
    }
    return value;
}

bool is_float(const ColumnType& type) {
    return type.kind == ColumnType::single || type.kind == ColumnType::real;
}

std::uint64_t value_of_real(double number, const ColumnType& type) {
    if (type.kind == ColumnType::real) return gene_clocks_value_of_float64(number);
    return gene_clocks_value_of_float32(static_cast<float>(number));
}

template <class Number>
Number load(const char* place) {
    Number number;
    std::memcpy(&number, place, sizeof number);
    return number;
}

template <class Integer>
void read_integers(const char* place, py::ssize_t stride, const ColumnType& type,
                   const std::string& what, std::vector<std::uint64_t>& values) {
    const std::size_t size = values.size();
    std::uint64_t* const out = values.data();
    if constexpr (std::is_unsigned_v<Integer>) {
        // Such numbers are all admitted: by far the most common columns.
        if (type.kind == ColumnType::number && type.bits >= 8 * sizeof(Integer)) {
            for (std::size_t i = 0; i < size; ++i, place += stride) out[i] = load<Integer>(place);
            return;
        }
    }
    for (std::size_t i = 0; i < size; ++i, place += stride) {
        const Integer number = load<Integer>(place);
        if (is_float(type)) {
            out[i] = value_of_real(static_cast<double>(number), type);
            continue;
        }
        bool is_negative = false;
        if constexpr (std::is_signed_v<Integer>) is_negative = number < 0;
        out[i] = checked_number(static_cast<std::uint64_t>(number), is_negative, type, what, i);
    }
}

template <class Float>
bool read_floats(const char* place, py::ssize_t stride, const ColumnType& type,
                 std::vector<std::uint64_t>& values) {
    if (!is_float(type)) return false;
    const std::size_t size = values.size();
    std::uint64_t* const out = values.data();
    if (type.kind == ColumnType::real) {
        for (std::size_t i = 0; i < size; ++i, place += stride) {
            out[i] = gene_clocks_value_of_float64(load<Float>(place));
        }
    } else {
        for (std::size_t i = 0; i < size; ++i, place += stride) {
            out[i] = gene_clocks_value_of_float32(static_cast<float>(load<Float>(place)));
        }
    }
    return true;
}

/// NumPy, where it can be imported; asked once.
bool has_numpy() {
    static const bool found = [] {
        try {
            py::module_::import("numpy");
            return true;
        } catch (py::error_already_set& error) {
            if (!error.matches(PyExc_ImportError)) throw;
            return false;
        }
    }();
    return found;
}

/// Bytes of a number by its letter, as the module `struct` and NumPy have them for this machine.
py::ssize_t native_size(char letter) {
    switch (letter) {
        case 'h':
        case 'H':
            return sizeof(short);
        case 'i':
        case 'I':
        case 'f':
            return sizeof(int);
        case 'l':
        case 'L':
            return sizeof(long);
        case 'q':
        case 'Q':
        case 'd':
            return sizeof(long long);
        default:
            return 1;
    }
}

/// A buffer of numbers in the machine's own formats; anything else is no such buffer.
class NumberBuffer {
public:
    explicit NumberBuffer(py::handle object) {
        // Past the buffer protocol, which makes NumPy write down the format of each array.
        if (has_numpy() && py::detail::npy_api::get().PyArray_Check_(object.ptr())) {
            take_array(object);
        } else if (PyObject_CheckBuffer(object.ptr())) {
            take_buffer(object);
        }
    }
    NumberBuffer(const NumberBuffer&) = delete;
    NumberBuffer& operator=(const NumberBuffer&) = delete;
    ~NumberBuffer() {
        if (is_held_) PyBuffer_Release(&view_);
    }

    std::optional<std::size_t> size() const {
        if (format_ == 0) return std::nullopt;
        return size_;
    }

    /// False where its numbers are not such as the column holds.
    bool read(const ColumnType& type, const std::string& what,
              std::vector<std::uint64_t>& values) const {
        const char* const place = place_;
        const py::ssize_t stride = stride_;
        switch (format_) {
            case '?':
                read_integers<std::uint8_t>(place, stride, type, what, values);
                return true;
            case 'f':
                return read_floats<float>(place, stride, type, values);
            case 'd':
                return read_floats<double>(place, stride, type, values);
            case 'b':
            case 'h':
            case 'i':
            case 'l':
            case 'q':
                switch (item_size_) {
                    case 1:
                        read_integers<std::int8_t>(place, stride, type, what, values);
                        break;
                    case 2:
                        read_integers<std::int16_t>(place, stride, type, what, values);
                        break;
                    case 4:
                        read_integers<std::int32_t>(place, stride, type, what, values);
                        break;
                    default:
                        read_integers<std::int64_t>(place, stride, type, what, values);
                }
                return true;
            case 'B':
            case 'H':
            case 'I':
            case 'L':
            case 'Q':
                switch (item_size_) {
                    case 1:
                        read_integers<std::uint8_t>(place, stride, type, what, values);
                        break;
                    case 2:
                        read_integers<std::uint16_t>(place, stride, type, what, values);
                        break;
                    case 4:
                        read_integers<std::uint32_t>(place, stride, type, what, values);
                        break;
                    default:
                        read_integers<std::uint64_t>(place, stride, type, what, values);
                }
                return true;
            default:
                return false;
        }
    }

private:
    static constexpr bool is_little = std::endian::native == std::endian::little;

    void take_array(py::handle object) {
        const auto* const array = py::detail::array_proxy(object.ptr());
        const auto* const type = py::detail::array_descriptor_proxy(array->descr);
        const bool is_native = type->byteorder == '=' || type->byteorder == '|' ||
                               type->byteorder == (is_little ? '<' : '>');
        if (array->nd != 1 || !is_native) return;
        place_ = array->data;
        stride_ = array->strides[0];
        size_ = static_cast<std::size_t>(array->dimensions[0]);
        format_ = type->type;
        item_size_ = native_size(format_);
    }

    void take_buffer(py::handle object) {
        if (PyObject_GetBuffer(object.ptr(), &view_, PyBUF_RECORDS_RO) != 0) {
            PyErr_Clear();
            return;
        }
        is_held_ = true;
        const char* format = view_.format ? view_.format : "B";
        // This machine's byte order; the size of an item is told apart from its letter.
        if (*format == '@' || *format == '=' || *format == (is_little ? '<' : '>')) ++format;
        if (view_.ndim != 1 || *format == '\0' || format[1] != '\0') return;
        place_ = static_cast<const char*>(view_.buf);
        stride_ = view_.strides[0];
        size_ = static_cast<std::size_t>(view_.shape[0]);
        format_ = *format;
        item_size_ = view_.itemsize;
    }

    Py_buffer view_{};
    const char* place_ = nullptr;
    py::ssize_t stride_ = 0;
    std::size_t size_ = 0;
    py::ssize_t item_size_ = 0;
    bool is_held_ = false;
    char format_ = 0;  // 0 where it is no buffer of numbers
};

/// One value that is a Python object.
std::uint64_t value_of_object(py::handle object, const ColumnType& type, const std::string& what,
                              std::size_t index) {
    if (is_float(type)) {
        const double number = PyFloat_AsDouble(object.ptr());
        if (!PyErr_Occurred()) return value_of_real(number, type);
        PyErr_Clear();
        throw py::type_error(gene_text(what, index) + ": " + std::string(py::repr(object)) +
                             " is no number");
    }
    if (type.names && PyUnicode_Check(object.ptr())) {
        const auto name = object.cast<std::string>();
        const auto found = std::find(type.names->begin(), type.names->end(), name);
        if (found == type.names->end()) {
            refuse(what, index, "'" + name + "' is not among the values of the schema");
        }
        return static_cast<std::uint64_t>(found - type.names->begin());
    }
    const py::object integer = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
    if (!integer) {
        PyErr_Clear();
        throw py::type_error(gene_text(what, index) + ": " + std::string(py::repr(object)) +
                             " is no integer");
    }
    int overflow = 0;
    const long long number = PyLong_AsLongLongAndOverflow(integer.ptr(), &overflow);
    if (overflow == 0) {
        return checked_number(static_cast<std::uint64_t>(number), number < 0, type, what, index);
    }
    const std::uint64_t large = PyLong_AsUnsignedLongLong(integer.ptr());
    if (PyErr_Occurred()) {
        PyErr_Clear();
        refuse(what, index, std::string(py::str(integer)) + " does not fit into 64 bits");
    }
    return checked_number(large, false, type, what, index);
}

[[noreturn]] void refuse_size(const std::string& what, std::size_t found, std::size_t size) {
    throw py::value_error(what + " has " + std::to_string(found) + " values for " +
                          std::to_string(size) + " genes");
}

template <class Number, class Convert>
py::object fill(const char* format, const std::uint64_t* values, std::size_t size, std::size_t step,
                Convert convert) {
    if (has_numpy()) {
        py::array_t<Number> array(static_cast<py::ssize_t>(size));
        Number* const numbers = array.mutable_data();
        for (std::size_t i = 0; i < size; ++i) numbers[i] = convert(values[i * step]);
        return array;
    }
    const py::object memory = py::reinterpret_steal<py::object>(
        PyByteArray_FromStringAndSize(nullptr, static_cast<py::ssize_t>(size * sizeof(Number))));
    if (!memory) throw py::error_already_set();
    char* const place = PyByteArray_AS_STRING(memory.ptr());
    for (std::size_t i = 0; i < size; ++i) {
        const Number number = convert(values[i * step]);
        std::memcpy(place + i * sizeof number, &number, sizeof number);
    }
    return py::memoryview(memory).attr("cast")(format);
}

}  // namespace

py::object make_rows(std::initializer_list<const std::uint64_t*> rows, std::size_t size) {
    if (!has_numpy()) {
        py::list columns;
        for (const auto* row : rows) {
            columns.append(make_column({ColumnType::integer}, row, size, 1));
        }
        return py::tuple(columns);
    }
    py::array_t<std::int64_t> array({rows.size(), size});
    std::int64_t* place = array.mutable_data();
    for (const auto* row : rows) {
        std::memcpy(place, row, size * sizeof *row);
        place += size;
    }
    return array;
}

std::size_t column_size(py::handle object, const std::string& what) {
    const py::ssize_t size = PyObject_Size(object.ptr());
    if (size < 0) {
        PyErr_Clear();
        throw py::type_error(what + " is no column: " + std::string(py::repr(object)) +
                             " has no length");
    }
    return static_cast<std::size_t>(size);
}

void read_column(py::handle object, const ColumnType& type, std::size_t size,
                 const std::string& what, std::vector<std::uint64_t>& values) {
    values.resize(size);
    const NumberBuffer buffer(object);
    if (const auto found = buffer.size()) {
        if (*found != size) refuse_size(what, *found, size);
        if (buffer.read(type, what, values)) return;
    }
    // A tuple of its own: what its values do when they are asked could change a list.
    const py::object sequence = py::reinterpret_steal<py::object>(PySequence_Tuple(object.ptr()));
    if (!sequence) {
        PyErr_Clear();
        throw py::type_error(what + " is no column: " + std::string(py::repr(object)));
    }
    const auto found = static_cast<std::size_t>(PyTuple_GET_SIZE(sequence.ptr()));
    if (found != size) refuse_size(what, found, size);
    for (std::size_t i = 0; i < size; ++i) {
        values[i] = value_of_object(PyTuple_GET_ITEM(sequence.ptr(), static_cast<py::ssize_t>(i)),
                                    type, what, i);
    }
}

py::object make_column(const ColumnType& type, const std::uint64_t* values, std::size_t size,
                       std::size_t step) {
    const auto as = [](auto zero) {
        return [](std::uint64_t value) { return static_cast<decltype(zero)>(value); };
    };
    switch (type.kind) {
        case ColumnType::number:
            return type.bits == 32
                       ? fill<std::uint32_t>("I", values, size, step, as(std::uint32_t{}))
                       : fill<std::uint64_t>("Q", values, size, step, as(std::uint64_t{}));
        case ColumnType::integer:
            return fill<std::int64_t>("q", values, size, step, as(std::int64_t{}));
        case ColumnType::single:
            return fill<float>("f", values, size, step,
                               [](auto value) { return gene_clocks_float32_of_value(value); });
        case ColumnType::real:
            return fill<double>("d", values, size, step,
                                [](auto value) { return gene_clocks_float64_of_value(value); });
        case ColumnType::flag:
            return fill<bool>("?", values, size, step, [](auto value) { return value != 0; });
        case ColumnType::enumeration:
            break;
    }
    return fill<std::uint8_t>("B", values, size, step, as(std::uint8_t{}));
}

}  // namespace gene_clocks::python
