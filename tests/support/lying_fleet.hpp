#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <limits>
#include <memory>
#include <random>
#include <unordered_set>
#include <utility>
#include <vector>

namespace gene_clocks::test {

/// What liars say to whom they meet, once a cycle to each of two robots.
enum class Lie : std::uint8_t {
    none,             ///< nothing: they are silent, so that all the others lack is their help
    takes_ids,        ///< "this worthless genome of highest energy is the next one of robot x"
    slanders_own,     ///< "the genome that you have active is worth nothing"
    slanders_others,  ///< the same of a genome of another robot that the receiver holds
    impossible,       ///< energies of their own genomes that no robot has
    boasts,           ///< "this worthless genome of mine has the highest energy"
};

struct LyingSettings {
    int robots = 100;
    int liars = 0;  ///< of the robots
    Lie lie = Lie::none;
    /// Each robot has a key of its own, so that a liar cannot speak as another.
    bool senders_are_known = true;
    neat::PeerLimits peers{};
    int cycles = 3'000;
    std::uint64_t seed = 1;
};

struct LyingResult {
    std::uint64_t lies = 0;    ///< that honest robots heard …
    std::uint64_t taken = 0;   ///< … and accepted, or took as a report
    double lied_members = 0;   ///< share of lied-about genomes in honest populations, its mean …
    double worst_robot = 0;    ///< … and that of the worst honest robot, over the second half
    double lied_parents = 0;   ///< share of births, in the second half, of which a parent is one
    double right_answers = 0;  ///< of honest robots, in the second half: what evolution achieves
};

/// Robots that learn, by odNEAT, which of two numbers is the larger, and liars among them. Each
/// robot earns energy with right answers and loses it with wrong ones; messages reach two random
/// robots. There is no world, so that nothing but what robots tell each other matters.
class LyingFleet {
public:
    static constexpr std::size_t inputs = 4;

    explicit LyingFleet(const LyingSettings& settings)
        : settings_{settings}, random_{settings.seed} {
        neat::OdneatSettings odneat;
        odneat.p_node = odneat.p_connection = 0.05;
        const neat::SharedSettings shared{odneat};
        energy_maximum_ = static_cast<float>(odneat.energy_maximum);
        for (int r = 0; r < settings.robots; ++r) {
            const RobotId robot{static_cast<std::uint32_t>(r + 1)};
            agents_.emplace_back(robot, shared, topology_,
                                 std::make_unique<neat::GeneClockSource>(robot, topology_->size()),
                                 neat::RandomStream(settings.seed, static_cast<std::uint64_t>(r)),
                                 settings.peers);
        }
    }

    LyingResult run() {
        for (cycle_ = 0; cycle_ < settings_.cycles; ++cycle_) {
            for (std::size_t r = 0; r < agents_.size(); ++r) {
                if (is_liar(r)) {
                    lie(r);
                } else {
                    live(r);
                }
            }
            if (is_measured()) measure();
        }
        const double honest = static_cast<double>(settings_.robots - settings_.liars);
        result_.lied_members /= measured_ * honest;
        for (const double share : shares_) {
            result_.worst_robot = std::max(result_.worst_robot, share / measured_);
        }
        result_.right_answers = right_ / answers_;
        result_.lied_parents = births_ == 0 ? 0.0 : lied_births_ / births_;
        return result_;
    }

private:
    [[nodiscard]] bool is_liar(std::size_t robot) const {
        return robot >= agents_.size() - static_cast<std::size_t>(settings_.liars);
    }
    [[nodiscard]] bool is_measured() const { return 2 * cycle_ >= settings_.cycles; }
    double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    std::size_t any_robot() { return static_cast<std::size_t>(random_() % agents_.size()); }
    std::size_t any_honest_robot() {
        return static_cast<std::size_t>(
            random_() % static_cast<std::uint64_t>(settings_.robots - settings_.liars));
    }

    // ---- Honest robots ----

    void live(std::size_t r) {
        neat::Agent& agent = agents_[r];
        std::vector<float> numbers(inputs);
        for (float& number : numbers) number = static_cast<float>(uniform());
        const bool says_larger = agent.control(numbers)[0] > 0.5f;
        const bool is_right = says_larger == (numbers[0] > numbers[1]);
        agent.spend(is_right ? 1.0f : -2.0f);
        if (is_measured()) {
            right_ += is_right ? 1.0 : 0.0;
            answers_ += 1.0;
        }
        if (agent.random().chance(agent.broadcast_probability())) {
            if (const neat::Message* const sent = agent.broadcast()) {
                for (int i = 0; i < 2; ++i) {
                    const std::size_t to = any_robot();
                    // A liar listens, and so knows what there is.
                    if (to != r) static_cast<void>(agents_[to].receive(agent.robot(), *sent));
                }
            }
        }
        if (agent.is_depleted()) {
            const neat::Birth birth = agent.replace(cycle_);
            if (is_measured()) {
                births_ += 1.0;
                const bool is_lied = is_lied_about(birth.first_parent) ||
                                     (birth.mated && is_lied_about(birth.second_parent));
                lied_births_ += is_lied ? 1.0 : 0.0;
            }
        }
    }

    // ---- Liars ----

    void lie(std::size_t liar) {
        for (int i = 0; i < 2; ++i) {
            neat::Agent& receiver = agents_[any_honest_robot()];
            if (settings_.lie == Lie::none) continue;
            neat::Message message = lie_to(liar, receiver);
            const RobotId claimed = message.genome->id.robot;
            const RobotId sender = settings_.senders_are_known ? agents_[liar].robot() : claimed;
            ++result_.lies;
            const auto reception = receiver.receive(sender, message);
            const bool is_accepted = reception == neat::Reception::accepted;
            if (is_accepted) accepted_lies_.insert(message.genome);
            result_.taken += is_accepted || reception == neat::Reception::updated;
        }
    }

    neat::Message lie_to(std::size_t liar, const neat::Agent& receiver) {
        const Stamp stamp = receiver.source().stamp();  // nothing to refuse it for
        const RobotId robot = agents_[liar].robot();
        switch (settings_.lie) {
            case Lie::none:
                break;
            case Lie::takes_ids: {
                const neat::Agent& victim = agents_[any_honest_robot()];
                const neat::GenomeId next{victim.robot(), victim.active().id.birth + 1};
                return {worthless(next), energy_maximum_, stamp};
            }
            case Lie::slanders_own:
                return {std::make_shared<const neat::Genome>(receiver.active()), 0.0f, stamp};
            case Lie::slanders_others: {
                const auto& members = receiver.population().members();
                return {members[random_() % members.size()].genome, 0.0f, stamp};
            }
            case Lie::impossible: {
                static constexpr float energies[] = {-50.0f, 1e6f,
                                                     std::numeric_limits<float>::infinity(),
                                                     std::numeric_limits<float>::quiet_NaN()};
                return {worthless({robot, births_of_liars_++}), energies[random_() % 4], stamp};
            }
            case Lie::boasts:
                return {worthless({robot, births_of_liars_++}), energy_maximum_, stamp};
        }
        return {worthless({robot, births_of_liars_++}), 0.0f, stamp};
    }

    /// A genome that says which number is the larger, the wrong way round. No two are alike, so
    /// that no tabu list knows them all.
    std::shared_ptr<const neat::Genome> worthless(neat::GenomeId id) {
        const std::size_t connections = topology_->connection_marks.size();
        neat::Genome genome{id, topology_, std::vector<float>(connections),
                            std::vector<float>(connections, 1.0f)};
        for (float& weight : genome.weights) weight = static_cast<float>(20.0 * uniform() - 10.0);
        genome.weights[0] = -10.0f;
        genome.weights[1] = 10.0f;
        return std::make_shared<const neat::Genome>(std::move(genome));
    }

    // ---- What came of it ----

    /// Comes from a liar, under whatever name.
    bool is_lied_about(const std::shared_ptr<const neat::Genome>& genome) const {
        return accepted_lies_.contains(genome);
    }

    void measure() {
        shares_.resize(agents_.size());
        measured_ += 1.0;
        for (std::size_t r = 0; r < agents_.size(); ++r) {
            if (is_liar(r)) continue;
            const auto& members = agents_[r].population().members();
            double lied = 0.0;
            for (const auto& member : members) lied += is_lied_about(member.genome) ? 1.0 : 0.0;
            const double share = lied / static_cast<double>(members.size());
            result_.lied_members += share;
            shares_[r] += share;
        }
    }

    LyingSettings settings_;
    std::mt19937_64 random_;
    std::shared_ptr<const neat::Topology> topology_ = neat::make_initial_topology(inputs, 1);
    std::vector<neat::Agent> agents_;
    float energy_maximum_ = 0.0f;
    std::uint32_t births_of_liars_ = 1'000'000;
    std::unordered_set<std::shared_ptr<const neat::Genome>> accepted_lies_;
    int cycle_ = 0;
    double measured_ = 0.0;
    double right_ = 0.0;
    double answers_ = 0.0;
    double births_ = 0.0;
    double lied_births_ = 0.0;
    std::vector<double> shares_;
    LyingResult result_;
};

}  // namespace gene_clocks::test
