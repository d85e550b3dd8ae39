// Clocks and the gate before them.
#include <gene_clocks/admission_gate.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "support.hpp"

using namespace pybind11::literals;

namespace gene_clocks::python {

Clock::Clock(GeneClock clock) : clock_(std::move(clock)), generation_(fork_generation()) {}

GeneClock& Clock::get() {
    if (is_handed_over_) {
        throw std::runtime_error("this clock was handed over to a Sealer, which mints its numbers");
    }
    if (generation_ != fork_generation()) {
        throw std::runtime_error(
            "this clock crossed a fork: parent and child would make the same marks. Give the child "
            "a robot id and a clock of its own");
    }
    return clock_;
}

GeneClock Clock::hand_over() {
    GeneClock clock = std::move(get());
    is_handed_over_ = true;
    return clock;
}

namespace {

constexpr std::uint64_t counter_maximum = std::numeric_limits<std::uint64_t>::max();

RobotId robot_of(py::handle robot) {
    const auto number = static_cast<std::uint32_t>(unsigned_of(robot, 32, "robot"));
    if (number == 0) throw py::value_error("robot 0 is reserved for the initial genes");
    return RobotId{number};
}

GeneClock::Limits limits_of(py::handle maximum, py::handle block, py::handle window) {
    return {unsigned_of(maximum, 64, "maximum"), unsigned_of(block, 64, "block"),
            unsigned_of(window, 64, "window")};
}

std::vector<InnovationNumber> marks_of(py::handle marks) {
    std::vector<InnovationNumber> list;
    for (const py::handle mark : py::iter(marks)) list.push_back(mark_of(mark));
    return list;
}

std::optional<std::uint64_t> stamp_of(py::handle stamp) {
    // More than 64 bits: no clock has it, and it may come off a wire, so it is refused, not raised.
    const py::object integer = py::reinterpret_steal<py::object>(PyNumber_Index(stamp.ptr()));
    if (!integer) throw py::error_already_set();
    const std::uint64_t value = PyLong_AsUnsignedLongLong(integer.ptr());
    if (PyErr_Occurred()) {
        PyErr_Clear();
        return std::nullopt;
    }
    return value;
}

/// One mark without a count, else a sequence of so many; None where there are not so many, however
/// many are asked for.
py::object mint(PythonClock& clock, py::handle count) {
    static const py::handle range = python_object("gene_clocks._marks", "MintedMarks");
    GeneClock& minting = clock.get().get();
    if (count.is_none()) {
        const auto mark = minting.mint();
        return mark ? mark_from(*mark) : py::none();
    }
    const py::object integer = py::reinterpret_steal<py::object>(PyNumber_Index(count.ptr()));
    if (!integer) throw py::error_already_set();
    if (integer < py::int_(0)) throw py::value_error("a count of marks is not negative");
    const std::uint64_t number = PyLong_AsUnsignedLongLong(integer.ptr());
    if (PyErr_Occurred()) {
        PyErr_Clear();
        return py::none();
    }
    const auto marks = minting.mint(number);
    return marks ? range(mark_from(marks->first), number) : py::none();
}

bool observe(PythonClock& clock, py::handle stamp, py::handle marks) {
    const auto list = marks.is_none() ? std::vector<InnovationNumber>{} : marks_of(marks);
    const auto number = stamp_of(stamp);
    return number && clock.get().get().observe(Stamp{*number}, list);
}

std::string repr(PythonClock& clock) {
    const GeneClock& shown = clock.get().get();
    return "<GeneClock of robot " + std::to_string(static_cast<std::uint32_t>(shown.robot())) +
           ", stamp " + std::to_string(shown.stamp().value) + ">";
}

py::object refuse_copy(py::handle, const py::args&) {
    throw py::type_error(
        "a clock is not copied or pickled: two of one robot would make the same marks. Store "
        "durable_needed() and go on with restart(), or take state() and from_state() where the "
        "other clock is gone");
}

void define_gate(py::module_& module) {
    using Gate = Guarded<AdmissionGate>;
    py::class_<Gate>(
        module, "AdmissionGate", plain_metaclass(),
        "Stands before a clock where messages may be forged or damaged: receptions may "
        "advance it by allowance counters, and by per_cycle more with each elapse(). "
        "The default refuses nothing that the clock's own limits admit.")
        .def(py::init([](py::handle allowance, py::handle per_cycle) {
                 return std::make_unique<Gate>(
                     std::in_place, AdmissionGate::Policy{unsigned_of(allowance, 64, "allowance"),
                                                          unsigned_of(per_cycle, 64, "per_cycle")});
             }),
             py::kw_only(), "allowance"_a = counter_maximum, "per_cycle"_a = 0)
        .def(
            "elapse", [](Gate& gate) { gate.get().elapse(); },
            "A cycle of the receiver's own time has gone by.")
        .def(
            "_admit",
            [](Gate& gate, PythonClock& clock, py::handle stamp, py::handle marks) -> int {
                const auto list = marks_of(marks);
                const auto number = stamp_of(stamp);
                if (!number) return static_cast<int>(Admission::beyond_maximum);
                return static_cast<int>(gate.get().admit(clock.get().get(), Stamp{*number}, list));
            },
            "clock"_a, "stamp"_a, "marks"_a)
        .def("_counts",
             [](const Gate& gate) {
                 py::list counts;
                 for (std::size_t i = 0; i < admission_kinds; ++i) {
                     counts.append(gate.get().counts()[static_cast<Admission>(i)]);
                 }
                 return counts;
             })
        .def_property_readonly(
            "allowance", [](const Gate& gate) { return gate.get().allowance(); },
            "Counters that receptions may still add to the clock.")
        .def_property_readonly(
            "conflicting_mark",
            [](const Gate& gate) {
                const auto mark = gate.get().conflicting_mark();
                return mark ? mark_from(*mark) : py::none();
            },
            "The mark that the first identity conflict was about, or None.");
}

}  // namespace

void define_clock(py::module_& module) {
    py::class_<PythonClock>(
        module, "GeneClock", plain_metaclass(),
        "A robot's or process's logical clock for genes. mint() a mark for "
        "every new gene; send stamp() with every genome; observe() the stamp of "
        "every genome received, before its genes are used. One owner.")
        .def(py::init([](py::handle robot, py::handle genesis_count, py::handle maximum,
                         py::handle block, py::handle window) {
                 const RobotId id = robot_of(robot);
                 const auto count = unsigned_of(genesis_count, 64, "genesis_count");
                 const auto limits = limits_of(maximum, block, window);
                 if (count >= limits.maximum) {
                     throw py::value_error("genesis_count leaves no counter up to maximum");
                 }
                 return std::make_unique<PythonClock>(std::in_place, GeneClock(id, count, limits));
             }),
             "robot"_a, "genesis_count"_a = 0, py::kw_only(), "maximum"_a = counter_maximum,
             "block"_a = 0, "window"_a = counter_maximum,
             "A fresh clock above the marks of the initial genes, 1 to genesis_count of robot 0. "
             "maximum: no stamp exceeds it. block: counters that storage reserves beyond need. "
             "window: the largest leap of a received stamp.")
        .def_static(
            "restart",
            [](py::handle robot, py::handle stored, py::handle genesis_count, py::handle maximum,
               py::handle block, py::handle window) {
                auto clock = GeneClock::restart(robot_of(robot), unsigned_of(stored, 64, "stored"),
                                                unsigned_of(genesis_count, 64, "genesis_count"),
                                                limits_of(maximum, block, window));
                if (!clock) {
                    throw py::value_error(
                        "no clock with these limits and genesis marks stored that counter: it lies "
                        "among "
                        "the genesis marks, or above maximum");
                }
                return std::make_unique<PythonClock>(std::in_place, *std::move(clock));
            },
            "robot"_a, "stored"_a, "genesis_count"_a, py::kw_only(), "maximum"_a = counter_maximum,
            "block"_a = 0, "window"_a = counter_maximum,
            "A clock that goes on after a crash, from the last durable_needed() that was stored: "
            "no "
            "mark is made twice. ValueError where that lies among the fleet's genesis marks, or "
            "beyond maximum.")
        .def_static(
            "from_state",
            [](py::handle robot, py::handle next, py::handle durable, py::handle maximum,
               py::handle block, py::handle window) {
                auto clock = GeneClock::from_state(
                    robot_of(robot),
                    {unsigned_of(next, 64, "next"), unsigned_of(durable, 64, "durable")},
                    limits_of(maximum, block, window));
                if (!clock) {
                    throw py::value_error("a state has 1 <= next <= durable <= maximum");
                }
                return std::make_unique<PythonClock>(std::in_place, *std::move(clock));
            },
            "robot"_a, "next"_a, "durable"_a, py::kw_only(), "maximum"_a = counter_maximum,
            "block"_a = 0, "window"_a = counter_maximum,
            "A clock that goes on exactly where another one of this robot was left, which must be "
            "gone.")
        .def("mint", &mint, "count"_a = py::none(),
             "The mark of one new gene or, with a count, a sequence of so many consecutive ones, "
             "all or none. None at exhaustion; then nothing changes.")
        .def("observe", &observe, "stamp"_a, "marks"_a = py::none(),
             "Takes the maximum with a received stamp, before any of the message's genes is used. "
             "False where the message must be dropped whole: the stamp lies beyond maximum or "
             "window, or one of marks is not below it.")
        .def("__copy__", &refuse_copy)
        .def("__deepcopy__", &refuse_copy)
        .def("__reduce_ex__", &refuse_copy)
        .def("__repr__", &repr)
        .def(
            "stamp", [](PythonClock& clock) { return clock.get().get().stamp().value; },
            "The next unused counter, to be sent with every message.")
        .def(
            "durable_needed", [](PythonClock& clock) { return clock.get().get().durable_needed(); },
            "The counter that must be on stable storage before anything leaves.")
        .def(
            "state",
            [](PythonClock& clock) {
                const auto state = clock.get().get().state();
                return py::make_tuple(state.next, state.durable);
            },
            "(next, durable), for from_state().")
        .def_property_readonly("robot", [](PythonClock& clock) {
            return static_cast<std::uint32_t>(clock.get().get().robot());
        });
    define_gate(module);
}

}  // namespace gene_clocks::python
