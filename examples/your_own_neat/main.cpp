// Two processes evolve XOR with a NEAT of their own and send each other their best genome over a
// local socket, in frames. No process hands out innovation numbers; each has a gene clock, whose
// counter is in a file before anything leaves.
//
// At the end it is checked that a mark names the same gene on both sides. Status 1 where not, or
// where XOR was not solved.
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <gene_clocks/storage/file_store.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "message.hpp"

namespace your_own_neat {
namespace {

using namespace gene_clocks;

constexpr std::size_t population_size = 100;
constexpr int generations_max = 1000;

void evaluate(Genome& genome) {
    float error = 0.0f;
    for (const auto& [first, second, wanted] : {std::array{0.0f, 0.0f, 0.0f},
                                                {0.0f, 1.0f, 1.0f},
                                                {1.0f, 0.0f, 1.0f},
                                                {1.0f, 1.0f, 0.0f}}) {
        error += std::abs(wanted - activate(genome, first, second));
    }
    genome.fitness = (4.0f - error) * (4.0f - error);
}

/// With fitness 15 every one of the four outputs is within 0.13 of what it should be.
bool is_solution(const Genome& genome) {
    return genome.fitness >= 15.0f;
}

/// One process of the two: a population, a clock, and the socket to the other.
class Island {
public:
    Island(RobotId robot, int socket, const std::string& folder)
        : socket_(socket),
          random_(static_cast<std::uint32_t>(robot)),
          store_(storage::PosixFiles{folder}, robot) {
        if (!store_.create(genesis_count + 1)) fail("the counter cannot be stored");
        clock_ = GeneClock::restart(robot, store_.stored(), genesis_count, {.block = 1000});
        for (std::size_t i = 0; i < population_size; ++i) {
            Genome genome = initial_genome(random_);
            identify(genome);
            evaluate(genome);
            population_.push_back(std::move(genome));
        }
    }

    /// Evolves until either side has a solution; both then stop in the same generation.
    int run() {
        for (int generation = 1; generation <= generations_max; ++generation) {
            const auto best = std::max_element(population_.begin(), population_.end(), worse);
            send(*best);
            const Genome immigrant = receive();
            if (is_solution(*best) || is_solution(immigrant)) return generation;
            *std::min_element(population_.begin(), population_.end(), worse) = immigrant;
            breed();
        }
        return 0;
    }

    void send(const Genome& genome) {
        const auto frame = encode(genome, *clock_);
        if (!frame) fail("a genome has outgrown the limits");
        // Nothing leaves before the counter is safe; a flush covers the next 1000 marks.
        if (!store_.store(clock_->durable_needed())) fail("the counter cannot be stored");
        if (::send(socket_, frame->data(), frame->size(), 0) != std::ssize(*frame)) {
            fail("the other process is gone");
        }
    }

    Genome receive() {
        std::array<std::uint8_t, limits.frame_bytes> bytes;
        const auto size = ::recv(socket_, bytes.data(), bytes.size(), 0);
        if (size <= 0) fail("the other process is gone");
        // Among strangers one would count this and go on; here every frame must be good.
        auto genome = decode({bytes.data(), static_cast<std::size_t>(size)}, *clock_);
        if (!genome) fail("a frame was refused");
        return *std::move(genome);
    }

    const std::vector<Genome>& population() const { return population_; }
    const GeneClock& clock() const { return *clock_; }
    std::uint64_t flushes() const { return store_.flushes(); }

private:
    static bool worse(const Genome& a, const Genome& b) { return a.fitness < b.fitness; }

    [[noreturn]] static void fail(const char* why) {
        std::fprintf(stderr, "your_own_neat: %s\n", why);
        std::exit(1);
    }

    /// The best of three drawn at random, by `shared_fitness`.
    const Genome& draw_parent(const std::vector<float>& shared_fitness) {
        std::size_t best = below(random_, population_size);
        for (int tries = 0; tries < 2; ++tries) {
            const std::size_t other = below(random_, population_size);
            if (shared_fitness[other] > shared_fitness[best]) best = other;
        }
        return population_[best];
    }

    /// For every genome that is made here. Processes of this example live once; one that may be
    /// restarted has to go on with numbers that it has not given yet.
    void identify(Genome& genome) {
        genome.maker = clock_->robot();
        genome.birth = births_++;
    }

    void breed() {
        // Fitness is shared among kin, so that new structure has time to become good.
        std::vector<float> shared_fitness;
        for (const Genome& genome : population_) {
            const auto kin =
                std::count_if(population_.begin(), population_.end(),
                              [&](const Genome& other) { return distance(genome, other) < 1.0f; });
            shared_fitness.push_back(genome.fitness / static_cast<float>(kin));
        }
        std::vector<Genome> next{*std::max_element(population_.begin(), population_.end(), worse)};
        while (next.size() < population_size) {
            const Genome& first = draw_parent(shared_fitness);
            const Genome& second = draw_parent(shared_fitness);
            Genome child = worse(first, second) ? crossover(second, first, random_)
                                                : crossover(first, second, random_);
            const float choice = uniform(random_, 0.0f, 1.0f);
            if (choice < 0.1f) {
                add_node(child, *clock_, random_);
            } else if (choice < 0.3f) {
                add_link(child, *clock_, random_);
            } else {
                mutate_weights(child, random_);
            }
            identify(child);
            evaluate(child);
            next.push_back(std::move(child));
        }
        population_ = std::move(next);
    }

    int socket_;
    Random random_;
    storage::FileStore store_;
    std::optional<GeneClock> clock_;
    std::uint32_t births_ = 0;
    std::vector<Genome> population_;
};

/// What a mark names: the ends of a link.
using Ends = std::pair<InnovationNumber, InnovationNumber>;

/// Takes the links of a genome into `known`; false where one of their marks names another link.
bool agree(const Genome& genome, std::map<InnovationNumber, Ends>& known) {
    return std::all_of(genome.links.begin(), genome.links.end(), [&](const Link& link) {
        const Ends ends{link.from, link.to};
        return known.try_emplace(link.mark, ends).first->second == ends;
    });
}

int run(int socket, RobotId robot, const std::string& folder) {
    Island island(robot, socket, folder);
    const int generation = island.run();
    if (robot == RobotId{2}) {  // shows all it has to the other
        for (const Genome& genome : island.population()) island.send(genome);
        return generation > 0 ? 0 : 1;
    }
    std::map<InnovationNumber, Ends> ours, all;
    bool is_consistent = true;
    for (const Genome& genome : island.population()) is_consistent &= agree(genome, ours);
    all = ours;
    std::map<InnovationNumber, Ends> theirs;
    for (std::size_t i = 0; i < population_size; ++i) {
        const Genome genome = island.receive();
        is_consistent &= agree(genome, all) && agree(genome, theirs);
    }
    const auto shared = ours.size() + theirs.size() - all.size();
    std::printf("solved in generation %d\n", generation);
    std::printf("links: %zu here, %zu there, %zu of them in both\n", ours.size(), theirs.size(),
                shared);
    std::printf("a mark names the same link in both processes: %s\n", is_consistent ? "yes" : "NO");
    std::printf("counters used: %llu; times the counter was written: %llu\n",
                static_cast<unsigned long long>(island.clock().stamp().value - 1),
                static_cast<unsigned long long>(island.flushes()));
    return generation > 0 && is_consistent && shared > genesis_count - 4 ? 0 : 1;
}

}  // namespace
}  // namespace your_own_neat

int main() {
    using gene_clocks::RobotId;
    // Message boundaries are kept, as in a datagram, and the end of the other process is noticed.
    int sockets[2];
    std::string folder = (std::filesystem::temp_directory_path() / "your_own_neat.XXXXXX").string();
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, sockets) != 0 || !::mkdtemp(folder.data())) {
        std::perror("your_own_neat");
        return 1;
    }
    std::filesystem::create_directory(folder + "/1");
    std::filesystem::create_directory(folder + "/2");
    const ::pid_t child = ::fork();
    if (child < 0) {
        std::perror("your_own_neat");
        return 1;
    }
    if (child == 0) {
        ::close(sockets[0]);
        std::_Exit(your_own_neat::run(sockets[1], RobotId{2}, folder + "/2"));
    }
    ::close(sockets[1]);
    const int ours = your_own_neat::run(sockets[0], RobotId{1}, folder + "/1");
    int theirs = 0;
    ::waitpid(child, &theirs, 0);
    std::filesystem::remove_all(folder);
    return ours == 0 && theirs == 0 ? 0 : 1;
}
