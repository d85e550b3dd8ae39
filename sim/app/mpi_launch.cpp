#include "sim/app/mpi_launch.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "sim/app/commands.hpp"

namespace gene_clocks::app {
namespace {

/// A variable of the environment; empty where there is none.
std::string_view environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

}  // namespace

bool is_study_under_mpirun(int argc, char** argv) {
    const auto size = environment("OMPI_COMM_WORLD_SIZE");
    return !size.empty() && size != "1" && argc > 1 && std::strcmp(argv[1], "study") == 0;
}

int become_mpi_program(char** argv) {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto program = self.parent_path() / "gene-clocks-mpi";
    execv(program.c_str(), argv);
    if (environment("OMPI_COMM_WORLD_RANK") == "0") {
        fmt::print(stderr,
                   "gene-clocks: mpirun needs {}, which cannot be started: {}. It is built where "
                   "CMake finds MPI\n",
                   program.string(), std::strerror(errno));
    }
    return bad_input;
}

}  // namespace gene_clocks::app
