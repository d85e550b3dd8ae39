#include <algorithm>
#include <cmath>
#include <ctime>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <gene_clocks/sim/swarm_view.hpp>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "sim/core/src/chronology/chronology.hpp"
#include "sim/core/src/observed_source.hpp"
#include "sim/core/src/radio.hpp"
#include "sim/core/src/random_streams.hpp"
#include "sim/core/src/source_factory.hpp"
#include "sim/core/src/task.hpp"
#include "sim/core/src/trajectory_hash.hpp"
#include "sim/core/src/volatile_source.hpp"
#include "sim/core/src/world.hpp"

namespace gene_clocks::sim {
namespace {

double thread_cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What a robot's controller is fed with: readings, energy and bias.
struct InputLayout {
    explicit InputLayout(Task task)
        : item(task == Task::collection ? ray_count : 0), energy(ray_count + item) {}
    std::size_t item;    // first item reading; 0 where there is none
    std::size_t energy;  // energy over its maximum; the bias follows
    std::size_t count() const { return energy + 2; }
};
constexpr std::size_t output_count = 2;
constexpr std::size_t input_stride = 20;  // floats between two robots' inputs; at least 18

std::int64_t late_robots(const Settings& settings) {
    return std::llround(settings.join.late_share * static_cast<double>(settings.world.robots));
}

/// By robot, the cycle in which it is switched on: 0 for those that are there at the start. Empty
/// where all are.
std::vector<std::int64_t> draw_join_cycles(const Settings& settings, std::uint64_t seed) {
    const std::int64_t late = late_robots(settings);
    if (late == 0) return {};
    neat::RandomStream random = make_stream(seed, Stream::joining);
    std::vector<std::int64_t> cycles(static_cast<std::size_t>(settings.world.robots), 0);
    for (std::int64_t i = 0; i < late; ++i) {
        std::size_t robot = 0;
        do {
            robot = random.below(static_cast<std::uint32_t>(cycles.size()));
        } while (cycles[robot] != 0);
        cycles[robot] = 1 + random.below(static_cast<std::uint32_t>(settings.join.cycles));
    }
    return cycles;
}

void check(const Settings& settings, const Arena& arena) {
    const auto require = [](bool condition, const char* what) {
        if (!condition) throw std::invalid_argument(what);
    };
    require(settings.world.robots >= 1, "world.robots must be at least 1");
    require(settings.run.sample_period_cycles >= 1, "run.sample_period_cycles must be at least 1");
    require(settings.run.cycles >= 1, "run.cycles must be at least 1");
    require(settings.odneat.population >= 1, "odneat.population must be at least 1");
    require(settings.radio.range_px <= settings.world.sensor_range_px,
            "radio.range_px must not exceed world.sensor_range_px: the rays find the receivers");
    require(late_robots(settings) < settings.world.robots,
            "join.late_share must leave a robot that is there at the start");
    // Then a robot that would leave the arena meets the frame before it is outside of the map.
    const double thinnest = std::min(
        {arena.frame_left_px, arena.frame_top_px, arena.frame_right_px, arena.frame_bottom_px});
    require(
        settings.world.translation_px < thinnest + settings.world.robot_radius_px,
        "world.translation_px must be less than the frame's thickness (times world.arena_scale) "
        "and the robot's radius");
}

InnovationNumber last_mark(const neat::Genome& genome) {
    const neat::Topology& topology = *genome.topology;
    return std::max(topology.neurons.back().mark, topology.connection_marks.back());
}

/// One run. Every cycle goes through the same phases, each of which is one function.
class Simulation {
public:
    /// `observer` may be null.
    Simulation(const Settings& settings, const Arena& arena, std::uint64_t seed,
               RunObserver* observer);

    void run_cycle(std::int64_t cycle);
    RunResult take_result();

private:
    bool is_on(std::size_t robot) const {
        return join_cycles_.empty() || join_cycles_[robot] <= cycle_;
    }
    std::unique_ptr<neat::InnovationSource> make_source(RobotId robot, std::uint64_t life) const;
    void reboot_robots();
    void log_sample(std::int64_t cycle);
    void show_swarm(std::int64_t cycle) const;
    void pick_up_items();
    void shuffle_order();
    void exchange_messages();
    void broadcast(std::uint32_t sender);
    void receive(std::uint32_t receiver, const neat::Message& message, std::uint64_t number);
    void run_controllers();
    void spend_energy();
    void replace_depleted(std::int64_t cycle);

    const Settings settings_;
    const InputLayout layout_;
    const std::shared_ptr<const neat::Topology> initial_;  // that all robots start from
    neat::RandomStream placement_random_;
    neat::RandomStream order_random_;
    neat::RandomStream radio_random_;
    neat::RandomStream reboot_random_;
    World world_;
    Radio radio_;
    RunResult result_;
    RunObserver* observer_;  // null: nobody watches
    Chronology chronology_;
    const SourceFactory sources_;                  // refers to settings_
    const std::vector<std::int64_t> join_cycles_;  // by robot; empty: all are there at the start
    std::int64_t cycle_ = 0;
    std::vector<neat::Agent> agents_;      // refer to settings_
    std::vector<std::uint32_t> order_;     // of broadcasts and moves, shuffled anew each cycle
    std::vector<std::uint32_t> depleted_;  // whose active genome is to be replaced in this cycle

    // One entry for each robot.
    std::vector<std::uint64_t> lives_;  // innovation sources that it has lost
    std::vector<float> inputs_;         // input_stride for each
    std::vector<float> output_0_, output_1_;
    std::vector<float> translation_, rotation_;
    std::vector<float> nearest_obstacle_;
    std::vector<float> energy_change_;

    TrajectoryHash hash_;
};

Simulation::Simulation(const Settings& settings, const Arena& arena, std::uint64_t seed,
                       RunObserver* observer)
    : settings_(settings),
      layout_(settings.task),
      initial_(neat::make_initial_topology(layout_.count(), output_count)),
      placement_random_(make_stream(seed, Stream::placement)),
      order_random_(make_stream(seed, Stream::order)),
      radio_random_(make_stream(seed, Stream::radio)),
      reboot_random_(make_stream(seed, Stream::reboots)),
      world_(settings_,
             std::make_shared<ArenaMap>(
                 arena, settings.world.sensor_range_px + settings.world.robot_radius_px,
                 settings.world.robot_radius_px),
             placement_random_),
      radio_(settings.radio),
      observer_(observer),
      chronology_(world_.robots(), settings.radio.delay_cycles, initial_),
      sources_(settings_, genesis_count(settings_), seed),
      join_cycles_(draw_join_cycles(settings_, seed)) {
    const std::size_t robots = world_.robots();
    agents_.reserve(robots);
    const neat::SharedSettings odneat{settings_.odneat};
    for (std::size_t i = 0; i < robots; ++i) {
        const RobotId robot{static_cast<std::uint32_t>(i + 1)};
        agents_.emplace_back(robot, odneat, initial_, make_source(robot, 0),
                             make_stream(seed, Stream::robots, i));
    }
    lives_.assign(robots, 0);
    order_.resize(robots);
    std::iota(order_.begin(), order_.end(), 0u);
    for (auto* values :
         {&output_0_, &output_1_, &translation_, &rotation_, &nearest_obstacle_, &energy_change_}) {
        values->assign(robots, 0.0f);
    }
    inputs_.assign(robots * input_stride, 1.0f);
    if (settings_.run.sample_period_cycles > 0) {
        result_.samples.reserve(static_cast<std::size_t>(
            settings_.run.cycles / settings_.run.sample_period_cycles + 1));
    }
}

std::unique_ptr<neat::InnovationSource> Simulation::make_source(RobotId robot,
                                                                std::uint64_t life) const {
    auto source = sources_.make(robot, life);
    if (settings_.reboot.probability > 0.0 && settings_.reboot.clock == RebootClock::lost) {
        source = std::make_unique<VolatileSource>(std::move(source));
    }
    if (observer_ != nullptr) {
        source = std::make_unique<ObservedSource>(std::move(source), robot, *observer_);
    }
    return source;
}

void Simulation::run_cycle(std::int64_t cycle) {
    cycle_ = cycle;
    chronology_.begin_cycle(cycle);
    reboot_robots();
    world_.replace_items(placement_random_);
    if (cycle % settings_.run.sample_period_cycles == 0) log_sample(cycle);
    if (observer_ != nullptr) show_swarm(cycle);
    pick_up_items();
    shuffle_order();
    exchange_messages();
    run_controllers();
    spend_energy();
    replace_depleted(cycle);
    result_.counters.collisions += world_.move(translation_, rotation_, order_);
    world_.sense();
    result_.robot_steps += agents_.size();
}

void Simulation::reboot_robots() {
    if (!(settings_.reboot.probability > 0.0)) return;
    for (std::size_t i = 0; i < agents_.size(); ++i) {
        if (!reboot_random_.chance(settings_.reboot.probability) || !is_on(i)) continue;
        neat::Agent& agent = agents_[i];
        const bool is_lost = settings_.reboot.clock == RebootClock::lost;
        agent.reboot(initial_, is_lost ? make_source(agent.robot(), ++lives_[i]) : nullptr);
        ++result_.counters.reboots;
    }
}

void Simulation::log_sample(std::int64_t cycle) {
    Sample sample;
    sample.cycle = cycle;
    double robots = 0.0;
    for (std::size_t i = 0; i < agents_.size(); ++i) {
        const neat::Agent& agent = agents_[i];
        hash_.add(agent.fitness());
        if (!is_on(i)) continue;
        robots += 1.0;
        const neat::Topology& topology = *agent.active().topology;
        sample.swarm_fitness += agent.fitness();
        sample.species += static_cast<double>(agent.population().species_count());
        sample.controller_size += static_cast<double>(topology.size());
        sample.added_elements += static_cast<double>(topology.size() - topology.initial_size());
    }
    hash_.add(world_.x_px());
    hash_.add(world_.y_px());
    for (double* mean : {&sample.swarm_fitness, &sample.species, &sample.controller_size,
                         &sample.added_elements}) {
        *mean /= robots;
    }
    result_.samples.push_back(sample);
}

void Simulation::show_swarm(std::int64_t cycle) const {
    const ItemField& items = world_.items();
    observer_->between_cycles({cycle, agents_, world_.x_px(), world_.y_px(), world_.heading_x(),
                               world_.heading_y(), items.x_px(), items.y_px(), items.is_present()});
}

void Simulation::pick_up_items() {
    if (settings_.task != Task::collection) return;
    for (std::size_t i = 0; i < agents_.size(); ++i) {
        if (is_on(i) && world_.pick_up(i))
            agents_[i].gain(static_cast<float>(settings_.energy.item_gain));
    }
}

/// Fisher and Yates.
void Simulation::shuffle_order() {
    for (std::size_t i = order_.size() - 1; i > 0; --i) {
        std::swap(order_[i], order_[order_random_.below(static_cast<std::uint32_t>(i + 1))]);
    }
}

void Simulation::exchange_messages() {
    if (settings_.radio.delay_cycles > 0) {
        radio_.deliver_delayed([this](std::uint32_t receiver, const neat::Message& sent,
                                      std::uint64_t which) { receive(receiver, sent, which); });
    }
    for (const std::uint32_t sender : order_) {
        if (world_.senses(sender).hears_robot && is_on(sender)) broadcast(sender);
    }
}

void Simulation::broadcast(std::uint32_t sender) {
    neat::Agent& agent = agents_[sender];
    if (!agent.random().chance(agent.broadcast_probability())) return;
    const neat::Message* const sent = agent.broadcast();
    if (sent == nullptr) return;
    const neat::Message& message = *sent;
    const std::uint64_t number = result_.counters.messages_sent++;
    chronology_.sent(sender, number, message.genome, message.stamp);
    if (observer_ != nullptr) {
        observer_->message_sent(agent.robot(), message.stamp, last_mark(*message.genome));
    }
    const auto& hit = world_.senses(sender).robot;
    for (auto robot = hit.begin(); robot != hit.end(); ++robot) {
        // A robot that several rays meet hears the message once.
        if (*robot < 0 || std::find(hit.begin(), robot, *robot) != robot) continue;
        radio_.send(message, number, static_cast<std::uint32_t>(*robot), radio_random_,
                    [this](std::uint32_t receiver, const neat::Message& sent, std::uint64_t which) {
                        receive(receiver, sent, which);
                    });
    }
}

void Simulation::receive(std::uint32_t receiver, const neat::Message& message,
                         std::uint64_t number) {
    if (!is_on(receiver)) return;
    ++result_.counters.messages_received;
    neat::Agent& agent = agents_[receiver];
    // Everyone sends its own active genome here, and says the truth.
    const neat::Reception reception = agent.receive(message.genome->id.robot, message);
    if (is_refused(reception)) return;
    chronology_.admitted(receiver, number);
    if (reception == neat::Reception::accepted) {
        ++result_.counters.genomes_accepted;
        chronology_.accepted(agent.active(), *message.genome);
    }
    if (observer_ != nullptr) {
        observer_->message_admitted(agent.robot(), number, agent.source().stamp());
    }
}

void Simulation::run_controllers() {
    const float per_energy = 1.0f / static_cast<float>(settings_.odneat.energy_maximum);
    for (std::size_t i = 0; i < agents_.size(); ++i) {
        if (!is_on(i)) {
            output_0_[i] = output_1_[i] = 0.5f;  // stands still
            continue;
        }
        const Senses& senses = world_.senses(i);
        float* const inputs = inputs_.data() + i * input_stride;
        std::copy(senses.obstacle.begin(), senses.obstacle.end(), inputs);
        if (layout_.item > 0)
            std::copy(senses.item.begin(), senses.item.end(), inputs + layout_.item);
        inputs[layout_.energy] = agents_[i].energy() * per_energy;
        const auto outputs = agents_[i].control({inputs, layout_.count()});
        output_0_[i] = outputs[0];
        output_1_[i] = outputs[1];
        nearest_obstacle_[i] = senses.nearest_obstacle;
    }
}

void Simulation::spend_energy() {
    const Commands commands{agents_.size(), output_0_.data(), output_1_.data(), translation_.data(),
                            rotation_.data()};
    interpret_outputs(settings_.world.actuation, commands);
    if (settings_.task == Task::navigation) {
        navigation_energy(settings_.energy.navigation, commands, nearest_obstacle_.data(),
                          energy_change_.data());
    } else {
        std::fill(energy_change_.begin(), energy_change_.end(),
                  -static_cast<float>(settings_.energy.decay));
    }
    depleted_.clear();
    for (std::size_t i = 0; i < agents_.size(); ++i) {
        if (!is_on(i)) continue;
        agents_[i].spend(energy_change_[i]);
        if (agents_[i].is_depleted()) depleted_.push_back(static_cast<std::uint32_t>(i));
    }
}

void Simulation::replace_depleted(std::int64_t cycle) {
    for (const std::uint32_t i : depleted_) {
        const neat::Birth birth = agents_[i].replace(static_cast<double>(cycle));
        chronology_.born(i, birth, agents_[i].active());
        ++result_.counters.births;
        if (birth.mated) ++result_.counters.matings;
        if (birth.mutation != neat::Mutation::none) ++result_.counters.mutations;
        if (birth.mutation == neat::Mutation::add_neuron) result_.counters.genes_created += 3;
        if (birth.mutation == neat::Mutation::add_connection) ++result_.counters.genes_created;
    }
}

RunResult Simulation::take_result() {
    if (observer_ != nullptr) show_swarm(settings_.run.cycles);
    hash_.add(world_.x_px());
    hash_.add(world_.y_px());
    result_.trajectory_hash = hash_.digest();
    for (const neat::Agent& agent : agents_) {
        chronology_.ended(agent.active(), agent.source().stamp());
    }
    result_.chronology = chronology_.measures();
    if (settings_.run.record_creation_times) result_.creations = chronology_.creations();
    return std::move(result_);
}

std::optional<RunResult> run(const Settings& settings, const Arena& unscaled, std::uint64_t seed,
                             RunControl* control, RunObserver* observer) {
    const Arena arena = scaled(unscaled, settings.world.arena_scale);
    check(settings, arena);
    const double start = thread_cpu_seconds();
    Simulation simulation(settings, arena, seed, observer);
    for (std::int64_t cycle = 0; cycle < settings.run.cycles; ++cycle) {
        if (control != nullptr && control->stop.load(std::memory_order_relaxed)) {
            return std::nullopt;
        }
        simulation.run_cycle(cycle);
        if (control != nullptr) control->cycles_done.store(cycle + 1, std::memory_order_relaxed);
    }
    RunResult result = simulation.take_result();
    result.cpu_seconds = thread_cpu_seconds() - start;
    return result;
}

}  // namespace

std::uint64_t genesis_count(const Settings& settings) {
    return neat::genesis_mark_count(InputLayout(settings.task).count(), output_count);
}

std::optional<RunResult> simulate(const Settings& settings, const Arena& arena, std::uint64_t seed,
                                  RunControl* control) {
    return run(settings, arena, seed, control, nullptr);
}

std::optional<RunResult> simulate_observed(const Settings& settings, const Arena& arena,
                                           std::uint64_t seed, RunObserver& observer,
                                           RunControl* control) {
    return run(settings, arena, seed, control, &observer);
}

}  // namespace gene_clocks::sim
