#include <cassert>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/crossover.hpp>

namespace gene_clocks::neat {

Agent::Agent(RobotId robot, const OdneatSettings& settings,
             std::shared_ptr<const Topology> topology, std::unique_ptr<InnovationSource> source,
             RandomStream random)
    : energy_(static_cast<float>(settings.energy_initial)),
      energy_maximum_(static_cast<float>(settings.energy_maximum)),
      maturation_cycles_(settings.maturation_cycles),
      controller_(Genome{{},
                         topology,
                         std::vector<float>(topology->connection_marks.size()),
                         std::vector<float>(topology->connection_marks.size())},
                  settings.activation_slope),
      robot_(robot),
      births_(source->first_birth()),
      settings_(settings),
      source_(std::move(source)),
      random_(random),
      population_(settings),
      tabu_(settings) {
    activate_initial_genome(std::move(topology));
}

void Agent::activate_initial_genome(std::shared_ptr<const Topology> topology) {
    activate(std::make_shared<const Genome>(make_initial_genome(
        {robot_, births_++}, std::move(topology), settings_.weight_limit, random_)));
}

void Agent::reboot(std::shared_ptr<const Topology> topology,
                   std::unique_ptr<InnovationSource> source) {
    population_ = Population(settings_);
    tabu_ = TabuList(settings_);
    if (source) source_ = std::move(source);
    activate_initial_genome(std::move(topology));
}

/// Makes a genome the active one; its initial energy is its first fitness sample.
void Agent::activate(std::shared_ptr<const Genome> genome) {
    controller_ = Controller(*genome, settings_.activation_slope);
    energy_ = static_cast<float>(settings_.energy_initial);
    fitness_ = energy_;
    energy_sum_ = energy_;
    energy_samples_ = 1;
    age_cycles_ = 0;
    cycles_to_sample_ = settings_.fitness_period_cycles;
    message_.genome = genome;
    population_.add(std::move(genome), fitness_);
    population_.speciate();
    share_is_current_ = false;
}

void Agent::sample_fitness() {
    cycles_to_sample_ = settings_.fitness_period_cycles;
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

Reception Agent::receive(const Message& message) {
    // The clock advances on every message, whether or not its genome is then accepted; a message
    // whose stamp is refused must leave no trace.
    const Admission admission = source_->admit(message.stamp, *message.genome);
    if (admission == Admission::identity_conflict) return Reception::identity_conflict;
    if (admission != Admission::admitted) return Reception::refused;
    if (!tabu_.approves(*message.genome)) return Reception::tabu;

    const auto held = population_.find(message.genome->id);
    const auto worst = population_.worst(active().id);
    const bool has_room = !population_.is_full();
    const bool is_fitter = worst && population_.members()[*worst].fitness < message.energy;
    const bool counts_anyway = held && settings_.held_reports == HeldReports::all;
    if (!has_room && !is_fitter && !counts_anyway) return Reception::unfit;

    share_is_current_ = false;
    if (held) {
        population_.report(*held, message.energy, settings_.held_energy);
        return Reception::updated;
    }
    if (!has_room) tabu_.add(population_.remove(*worst));
    population_.add(message.genome, message.energy);
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
    if (random_.chance(settings_.p_mate)) {
        const auto& second = members[population_.select_second_parent(
            settings_.second_parent, species, first_index, random_)];
        birth.mated = second.genome != first.genome;
        if (birth.mated) {
            birth.second_parent = second.genome;
            offspring = crossover(id, {first.genome.get(), first.fitness},
                                  {second.genome.get(), second.fitness}, settings_, random_);
        }
    }
    birth.inherited = offspring.topology;
    if (random_.chance(settings_.p_mutate)) {
        birth.mutation = mutate(offspring, settings_, *source_, now_cycles, random_);
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
