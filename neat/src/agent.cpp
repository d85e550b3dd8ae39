#include <algorithm>
#include <cassert>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/crossover.hpp>

namespace gene_clocks::neat {
namespace {

/// Energy is kept within [0, energy_maximum]; only a genome that has not lived yet may have more.
float largest_energy(const OdneatSettings& settings) {
    return static_cast<float>(std::max(settings.energy_maximum, settings.energy_initial));
}

}  // namespace

Agent::Agent(RobotId robot, SharedSettings settings, std::shared_ptr<const Topology> topology,
             std::unique_ptr<InnovationSource> source, RandomStream random, PeerLimits peers)
    : energy_(static_cast<float>(settings->energy_initial)),
      energy_maximum_(static_cast<float>(settings->energy_maximum)),
      maturation_cycles_(settings->maturation_cycles),
      controller_(Genome{{},
                         topology,
                         std::vector<float>(topology->connection_marks.size()),
                         std::vector<float>(topology->connection_marks.size())},
                  settings->activation_slope),
      robot_(robot),
      births_(source->first_birth()),
      energy_possible_(largest_energy(*settings)),
      settings_(std::move(settings)),
      peers_(peers),
      source_(std::move(source)),
      random_(random),
      population_(*settings_),
      tabu_(*settings_) {
    activate_initial_genome(std::move(topology));
}

void Agent::activate_initial_genome(std::shared_ptr<const Topology> topology) {
    activate(std::make_shared<const Genome>(make_initial_genome(
        {robot_, births_++}, std::move(topology), settings_->weight_limit, random_)));
}

void Agent::reboot(std::shared_ptr<const Topology> topology,
                   std::unique_ptr<InnovationSource> source) {
    population_ = Population(*settings_);
    tabu_ = TabuList(*settings_);
    if (source) source_ = std::move(source);
    activate_initial_genome(std::move(topology));
}

/// Makes a genome the active one; its initial energy is its first fitness sample.
void Agent::activate(std::shared_ptr<const Genome> genome) {
    controller_ = Controller(*genome, settings_->activation_slope);
    energy_ = static_cast<float>(settings_->energy_initial);
    fitness_ = energy_;
    energy_sum_ = energy_;
    energy_samples_ = 1;
    age_cycles_ = 0;
    cycles_to_sample_ = settings_->fitness_period_cycles;
    message_.genome = genome;
    population_.add(std::move(genome), fitness_);
    population_.speciate();
    share_is_current_ = false;
}

void Agent::sample_fitness() {
    cycles_to_sample_ = settings_->fitness_period_cycles;
    energy_sum_ += energy_;
    ++energy_samples_;
    fitness_ = static_cast<float>(energy_sum_ / static_cast<double>(energy_samples_));
    population_.set_fitness(*population_.find(active().id), fitness_);
    share_is_current_ = false;
}

void Agent::refresh_share() {
    share_ = population_.species_share(*population_.find(active().id));
    share_is_current_ = true;
}

/// Those of whom a genome of this maker may only take the place of one; nullopt where it may take
/// any.
std::optional<Population::MadeBy> Agent::rivals_of(RobotId maker) const {
    const Population::MadeBy one{maker, true};
    const Population::MadeBy others{robot_, false};
    if (population_.has(one, peers_.members_per_maker)) return one;
    if (population_.has(others, peers_.members_of_others)) return others;
    return std::nullopt;
}

/// What a claimed energy counts for where it may not excel.
float Agent::believed(float energy) const {
    float own = 0.0f;
    for (const auto& member : population_.members()) {
        if (member.id.robot == robot_) own = std::max(own, member.fitness);
    }
    return std::min(energy, own);
}

Reception Agent::receive(RobotId sender, const Message& message) {
    const GenomeId id = message.genome->id;
    if (id.robot != sender || sender == robot_) return Reception::not_its_maker;
    // Written so that it refuses what is no number.
    const bool is_possible = message.energy >= 0.0f && message.energy <= energy_possible_;
    if (!is_possible) return Reception::impossible_energy;
    // The clock advances on every message, whether or not its genome is then accepted; a message
    // whose stamp is refused must leave no trace.
    const Admission admission = source_->admit(message.stamp, *message.genome);
    if (admission == Admission::identity_conflict) return Reception::identity_conflict;
    if (admission != Admission::admitted) return Reception::refused;
    if (!tabu_.approves(*message.genome)) return Reception::tabu;

    const auto held = population_.find(id);
    const auto rivals = held || peers_.is_trusting() ? std::nullopt : rivals_of(id.robot);
    const auto worst = rivals ? population_.worst_of(*rivals) : population_.worst(active().id);
    const bool has_room = !rivals && !population_.is_full();
    const float energy = peers_.may_excel ? message.energy : believed(message.energy);
    const bool is_fitter = worst && population_.members()[*worst].fitness < energy;
    const bool counts_anyway = held && settings_->held_reports == HeldReports::all;
    if (!has_room && !is_fitter && !counts_anyway) return Reception::unfit;

    share_is_current_ = false;
    if (held) {
        population_.report(*held, energy, settings_->held_energy);
        return Reception::updated;
    }
    if (!has_room) {
        auto dropped = population_.remove(*worst);
        // Or its maker could put on the list whatever it likes.
        if (!rivals) tabu_.add(std::move(dropped));
    }
    population_.add(message.genome, energy);
    return Reception::accepted;
}

Genome Agent::make_offspring(Birth& birth, double now_cycles) {
    const auto& members = population_.members();
    const std::size_t species = population_.select_species(random_);
    const std::size_t first_index = population_.select_parent(species, random_);
    const auto& first = members[first_index];
    const GenomeId id{robot_, births_++};
    Genome offspring = *first.genome;
    birth.first_parent = first.genome;
    offspring.id = id;
    if (random_.chance(settings_->p_mate)) {
        const auto& second = members[population_.select_second_parent(
            settings_->second_parent, species, first_index, random_)];
        birth.mated = second.genome != first.genome;
        if (birth.mated) {
            birth.second_parent = second.genome;
            offspring = crossover(id, {first.genome.get(), first.fitness},
                                  {second.genome.get(), second.fitness}, *settings_, random_);
        }
    }
    birth.inherited = offspring.topology;
    if (random_.chance(settings_->p_mutate)) {
        birth.mutation = mutate(offspring, *settings_, *source_, now_cycles, random_);
    }
    return offspring;
}

Birth Agent::replace(double now_cycles) {
    // The dead genome is tabu from now on, but stays a candidate parent.
    tabu_.add(message_.genome);
    Birth birth;
    auto offspring = std::make_shared<const Genome>(make_offspring(birth, now_cycles));
    if (population_.is_full()) tabu_.add(population_.remove(*population_.worst()));
    activate(std::move(offspring));
    return birth;
}

}  // namespace gene_clocks::neat
