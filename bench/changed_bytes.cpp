// What sending only what changed could save: whole runs of the paper's tasks, where each genome
// that a robot takes in is compared with the one that it had from the same sender before. Prints
// the table of docs/wire-format.md.
//
// "Changed" is a lower bound for any such format: the bytes of genes that are new or have another
// weight or flag (a reference to a gene counted as one byte, a weight as four), 24 bytes of frame
// and identity, and 2 to name the genome that it is the difference to.

#include <bit>
#include <cstdio>
#include <gene_clocks/neat/message_codec.hpp>
#include <gene_clocks/sim/run_observer.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <gene_clocks/sim/swarm_view.hpp>
#include <map>
#include <memory>
#include <vector>

#include "sim/settings/arena_file.hpp"
#include "sim/settings/profile.hpp"

namespace {

using namespace gene_clocks;
using GenomePointer = std::shared_ptr<const neat::Genome>;

constexpr double frame_bytes = 24.0;

/// The fewest bytes that turn one genome into the other.
double changed_bytes(const neat::Genome& old, const neat::Genome& genome) {
    std::map<InnovationNumber, std::size_t> places;
    for (std::size_t i = 0; i < old.connections(); ++i) {
        places[old.topology->connection_marks[i]] = i;
    }
    double bytes = 2.0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        const auto found = places.find(genome.topology->connection_marks[i]);
        if (found == places.end()) {
            bytes += 9.0;  // head, robot, two ends, a weight, and some of the marks
            continue;
        }
        ++kept;
        const bool same_weight = std::bit_cast<std::uint32_t>(old.weights[found->second]) ==
                                 std::bit_cast<std::uint32_t>(genome.weights[i]);
        if (!same_weight) {
            bytes += 5.0;
        } else if (old.is_enabled(found->second) != genome.is_enabled(i)) {
            bytes += 1.0;
        }
    }
    bytes += static_cast<double>(old.connections() - kept);  // those that are gone
    if (genome.topology->neurons.size() > old.topology->neurons.size()) {
        bytes += 3.0 * static_cast<double>(genome.topology->neurons.size() -
                                           old.topology->neurons.size());
    }
    return bytes;
}

class Comparison : public sim::RunObserver {
public:
    void gene_marked(RobotId, InnovationNumber, double) override {}
    void message_sent(RobotId robot, Stamp, InnovationNumber) override {
        const auto& genome = active_.at(static_cast<std::uint32_t>(robot));
        sent_.push_back({static_cast<std::uint32_t>(robot), genome});
    }
    void message_admitted(RobotId robot, std::uint64_t message, Stamp) override {
        const auto& [sender, genome] = sent_[message];
        ++receptions;
        const double whole = frame_bytes + static_cast<double>(neat::payload_bytes(*genome));
        whole_bytes += whole;
        GenomePointer& last = known_[{static_cast<std::uint32_t>(robot), sender}];
        if (!last) {
            ++unknown;
            best_bytes += whole;
        } else if (last->id == genome->id) {
            ++repeated;
            best_bytes += frame_bytes;
        } else {
            ++changed;
            const double difference = frame_bytes + changed_bytes(*last, *genome);
            changed_whole_bytes += whole;
            changed_best_bytes += difference < whole ? difference : whole;
            best_bytes += difference < whole ? difference : whole;
        }
        last = genome;
    }
    void between_cycles(const sim::SwarmView& swarm) override {
        for (const neat::Agent& agent : swarm.agents) {
            GenomePointer& genome = active_[static_cast<std::uint32_t>(agent.robot())];
            if (!genome || genome->id != agent.active().id) {
                genome = std::make_shared<const neat::Genome>(agent.active());
            }
        }
    }

    double receptions = 0, unknown = 0, repeated = 0, changed = 0;
    double whole_bytes = 0, best_bytes = 0, changed_whole_bytes = 0, changed_best_bytes = 0;

private:
    struct Sent {
        std::uint32_t sender;
        GenomePointer genome;
    };
    std::map<std::uint32_t, GenomePointer> active_;
    std::vector<Sent> sent_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, GenomePointer> known_;
};

void run(const char* name, sim::Task task) {
    experiment::Selection selection;
    selection.task = task;
    selection.profile = "gecco15";
    const sim::Settings settings = experiment::select(selection);
    const sim::Arena arena = experiment::find_arena(settings.world.arena);
    Comparison all;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Comparison one;
        sim::simulate_observed(settings, arena, seed, one);
        all.receptions += one.receptions;
        all.unknown += one.unknown;
        all.repeated += one.repeated;
        all.changed += one.changed;
        all.whole_bytes += one.whole_bytes;
        all.best_bytes += one.best_bytes;
        all.changed_whole_bytes += one.changed_whole_bytes;
        all.changed_best_bytes += one.changed_best_bytes;
    }
    const double percent = 100.0 / all.receptions;
    std::printf("| %s | %.0f %% | %.0f %% | %.0f %% | %.0f | %.0f | %.0f |\n", name,
                all.repeated * percent, all.changed * percent, all.unknown * percent,
                all.whole_bytes / all.receptions, all.changed_whole_bytes / all.changed,
                all.changed_best_bytes / all.changed);
}

}  // namespace

int main() {
    std::printf(
        "| task | the genome that it had | another one | first of this sender | bytes, mean | "
        "of the others, whole | of the others, changed |\n");
    std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
    run("navigation", sim::Task::navigation);
    run("collection", sim::Task::collection);
}
