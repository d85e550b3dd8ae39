#include "sim/app/mpi/messenger.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace gene_clocks::app {

Messenger::Messenger(int& argc, char**& argv) {
    int provided = 0;  // every MPI can do with one thread that calls it
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Messenger::~Messenger() {
    MPI_Finalize();
}

void Messenger::send(int receiver, Topic topic, std::span<const std::uint8_t> content) {
    MPI_Send(content.data(), static_cast<int>(content.size()), MPI_BYTE, receiver,
             static_cast<int>(topic), MPI_COMM_WORLD);
}

void Messenger::send(int receiver, Topic topic, const std::string& content) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(content.data());
    send(receiver, topic, {bytes, content.size()});
}

std::optional<Message> Messenger::receive() {
    int is_there = 0;
    MPI_Message handle{};
    MPI_Status status{};
    MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &handle, &status);
    if (is_there == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message message{static_cast<Topic>(status.MPI_TAG), status.MPI_SOURCE, {}};
    message.content.resize(static_cast<std::size_t>(size));
    MPI_Mrecv(message.content.data(), size, MPI_BYTE, &handle, &status);
    return message;
}

void Messenger::abort(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);
}

void wait_a_moment() {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace gene_clocks::app
