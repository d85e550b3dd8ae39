#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/neat/controller.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <gene_clocks/neat/population.hpp>
#include <gene_clocks/neat/random.hpp>
#include <gene_clocks/neat/settings.hpp>
#include <gene_clocks/neat/tabu_list.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace gene_clocks::neat {

/// What a robot broadcasts (paper, section 3.2): its active genome, its energy, and what its
/// innovation source adds; with gene clocks that is the counter c_r.
///
/// Invariants: the genome is valid (see `find_fault`) and has the initial genes that all robots
/// start from. What comes off a wire gets them from `MessageCodec::decode`, which refuses
/// everything else.
struct Message {
    std::shared_ptr<const Genome> genome;  ///< never null
    float energy{};
    Stamp stamp;
};

/// What became of a received message.
enum class Reception : std::uint8_t {
    accepted,  ///< the genome is now in the population
    updated,   ///< it was held already; its fitness has been updated
    tabu,      ///< it resembles a tabu entry
    unfit,     ///< the population is full of better ones
    refused,   ///< the innovation source refused the stamp; nothing changed
    /// Refused as well: it shows that this robot's marks are no longer unique, or is forged; see
    /// Admission::identity_conflict.
    identity_conflict,
    /// Refused: only the robot that made a genome has its energy, and so only it may report on it;
    /// and none but the receiver makes the receiver's genomes.
    not_its_maker,
    impossible_energy,  ///< refused: no robot has it with the fleet's settings
};

/// Whether the message was dropped whole. Nothing has changed then.
constexpr bool is_refused(Reception reception) {
    return reception == Reception::refused || reception == Reception::identity_conflict ||
           reception == Reception::not_its_maker || reception == Reception::impossible_energy;
}

/// How many places in its population a robot gives to genomes whose energy it only hears of, where
/// others may lie. odNEAT itself trusts them: the default.
///
/// Where all such places are taken, a fitter genome may still take that of the least fit in them.
struct PeerLimits {
    static constexpr std::size_t any = std::numeric_limits<std::size_t>::max();

    std::size_t members_per_maker = any;  ///< to genomes of one other robot
    std::size_t members_of_others = any;  ///< to those of all others together
    /// Whether a genome of another robot may count as fitter than the fittest of one's own.
    bool may_excel = true;

    /// Whether every place is for anyone.
    constexpr bool is_trusting() const {
        return members_per_maker == any && members_of_others == any;
    }
};

/// How an offspring came about.
struct Birth {
    bool mated = false;  ///< it has two different parents
    Mutation mutation = Mutation::none;
    std::shared_ptr<const Genome> first_parent;   ///< never null after a birth
    std::shared_ptr<const Genome> second_parent;  ///< null unless mated
    std::shared_ptr<const Topology> inherited;    ///< its structure before the mutation
};

/// One robot's odNEAT (paper, Algorithm 1), as a state machine without I/O, threads or time.
///
/// The caller runs, once a cycle: `broadcast_probability()` and `broadcast()`, `receive()` for each
/// message that arrives, `control()`, `spend()`, and `replace()` where `is_depleted()`.
class Agent {
public:
    /// `topology` is the one all robots start from. Others may hold genomes of the robot's earlier
    /// lives and know them by their GenomeId: births go on from `source->first_birth()`.
    Agent(RobotId robot, SharedSettings settings, std::shared_ptr<const Topology> topology,
          std::unique_ptr<InnovationSource> source, RandomStream random, PeerLimits peers = {});

    /// Probability of a broadcast in this cycle: the fitness share of the active genome's species.
    double broadcast_probability() {
        if (!share_is_current_) refresh_share();
        return share_;
    }
    /// What there is to send, to look at; valid until the next call.
    const Message& message() {
        message_.energy = energy_;
        message_.stamp = source_->stamp();
        return message_;
    }

    /// The message that a broadcast sends now; nullptr while it must be held, which changes nothing
    /// but leaves the broadcast undone. Valid until the next call.
    const Message* broadcast() {
        const auto stamp = source_->stamp_to_send(message_.genome->id.birth);
        if (!stamp) return nullptr;
        message_.energy = energy_;
        message_.stamp = *stamp;
        return &message_;
    }

    /// A message that `sender` has sent: as its signature says, where frames are signed. Where they
    /// are not, anyone speaks as anyone, and a genome may come from others than its maker.
    ///
    /// Precondition: the invariants of `Message`; they are not checked again here.
    Reception receive(RobotId sender, const Message& message);

    /// Runs the controller; see Controller::update.
    std::span<const float> control(std::span<const float> inputs) {
        return controller_.update(inputs);
    }

    /// Applies a change of energy without ageing (an item, say). Clamped to [0, energy_maximum].
    void gain(float energy_change) {
        const float changed = energy_ + energy_change;
        const float capped = changed < energy_maximum_ ? changed : energy_maximum_;
        energy_ = capped > 0.0f ? capped : 0.0f;
    }

    /// Ends a cycle: applies its change of energy, ages the genome, samples its fitness when due.
    void spend(float energy_change) {
        gain(energy_change);
        ++age_cycles_;
        if (--cycles_to_sample_ == 0) sample_fitness();
    }

    /// Whether the active genome is to be replaced: out of energy, and past maturation.
    bool is_depleted() const { return energy_ <= 0.0f && age_cycles_ > maturation_cycles_; }

    /// Replaces the active genome by an offspring of the population.
    Birth replace(double now_cycles);

    /// Loses what is in memory (population, tabu list, active genome) and starts anew with a random
    /// initial genome of `topology`. Its innovation source goes on, unless another is given. Its
    /// genomes' ids go on, too, since others may still hold the old ones.
    void reboot(std::shared_ptr<const Topology> topology,
                std::unique_ptr<InnovationSource> source = nullptr);

    RandomStream& random() { return random_; }
    RobotId robot() const { return robot_; }
    float energy() const { return energy_; }
    float fitness() const { return fitness_; }
    const Genome& active() const { return *message_.genome; }
    const Population& population() const { return population_; }
    const TabuList& tabu_list() const { return tabu_; }
    const InnovationSource& source() const { return *source_; }

private:
    void activate_initial_genome(std::shared_ptr<const Topology> topology);
    void activate(std::shared_ptr<const Genome> genome);
    void sample_fitness();
    void refresh_share();
    std::optional<Population::MadeBy> rivals_of(RobotId maker) const;
    float believed(float energy) const;
    Genome make_offspring(Birth& birth, double now_cycles);

    // What every cycle touches comes first.
    float energy_;
    float energy_maximum_;
    float fitness_ = 0.0f;  // mean of the energy samples of the active genome
    bool share_is_current_ = false;
    double share_ = 0.0;
    std::int64_t age_cycles_ = 0;
    std::int64_t cycles_to_sample_ = 0;  // invariant: > 0
    std::int64_t maturation_cycles_;
    Controller controller_;  // of the active genome
    Message message_;        // invariant: its genome, the active one, is a member of population_

    double energy_sum_ = 0.0;
    std::int64_t energy_samples_ = 0;
    RobotId robot_;
    std::uint32_t births_;
    float energy_possible_;  // the largest that a robot of these settings has
    SharedSettings settings_;
    PeerLimits peers_;
    std::unique_ptr<InnovationSource> source_;
    RandomStream random_;
    Population population_;
    TabuList tabu_;
};

}  // namespace gene_clocks::neat
