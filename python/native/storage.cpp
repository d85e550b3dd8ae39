// A counter in two files.
#include <pybind11/stl.h>

#include <gene_clocks/storage/file_store.hpp>
#include <memory>

#include "support.hpp"

using namespace pybind11::literals;

namespace gene_clocks::python {
namespace {

using storage::FileStore;
using storage::PosixFiles;

/// In a box of its own, so that close() gives the folder free.
struct Store {
    std::unique_ptr<FileStore> store;
    std::uint64_t stored = 0;
    std::uint64_t flushes = 0;

    FileStore& open_store() {
        if (!store) throw std::runtime_error("this store was closed");
        return *store;
    }
};
using PythonStore = Guarded<Store>;

py::tuple status_of(StorageStatus status) {
    return py::make_tuple(static_cast<int>(status.error), status.system_error);
}

}  // namespace

void define_storage(py::module_& module) {
    py::class_<PythonStore>(module, "FileStore", plain_metaclass())
        .def(py::init([](const std::string& folder, py::handle robot) {
                 const RobotId id{static_cast<std::uint32_t>(unsigned_of(robot, 32, "robot"))};
                 return std::make_unique<PythonStore>(
                     std::in_place, Store{std::make_unique<FileStore>(PosixFiles(folder), id)});
             }),
             "folder"_a, "robot"_a)
        .def("_create",
             [](PythonStore& store, py::handle counter) {
                 const auto number = unsigned_of(counter, 64, "counter");
                 return status_of(store.get().open_store().create(number));
             })
        .def("_open", [](PythonStore& store) { return status_of(store.get().open_store().open()); })
        .def("_store",
             [](PythonStore& store, py::handle counter) {
                 const auto number = unsigned_of(counter, 64, "counter");
                 return status_of(store.get().open_store().store(number));
             })
        .def(
            "close",
            [](PythonStore& store) {
                Store& content = store.get();
                if (!content.store) return;
                content.stored = content.store->stored();
                content.flushes = content.store->flushes();
                content.store.reset();
            },
            "Gives the folder free for other processes.")
        .def_property_readonly(
            "stored",
            [](PythonStore& store) {
                const Store& content = store.get();
                return content.store ? content.store->stored() : content.stored;
            },
            "The counter on stable storage; 0 before create() or open() has succeeded.")
        .def_property_readonly(
            "flushes",
            [](PythonStore& store) {
                const Store& content = store.get();
                return content.store ? content.store->flushes() : content.flushes;
            },
            "How often storage was written.");
}

}  // namespace gene_clocks::python
