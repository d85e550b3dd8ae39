#pragma once

#include <cstdint>
#include <gene_clocks/neat/crossover.hpp>
#include <gene_clocks/neat/distance_measure.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/random.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace gene_clocks::neat {

/// The genomes that a robot holds, divided into species with shared fitness (paper, section 3.2).
class Population {
public:
    struct Member {
        std::shared_ptr<const Genome> genome;
        GenomeId id;           ///< the genome's, at hand for look-ups
        float fitness;         ///< raw: mean energy, as measured here or reported by messages
        std::int64_t reports;  ///< energies that `fitness` is the mean of, for received genomes
        std::size_t species;   ///< index; meaningless until placed
    };

    explicit Population(const OdneatSettings& settings);

    const std::vector<Member>& members() const { return members_; }
    std::size_t species_count() const { return species_.size(); }
    bool is_full() const { return members_.size() >= capacity_; }
    std::optional<std::size_t> find(GenomeId id) const;

    /// The member of lowest raw fitness, the first of equals; `except` is passed over. nullopt
    /// where there is no other.
    std::optional<std::size_t> worst(std::optional<GenomeId> except = std::nullopt) const;

    /// The members that one robot has made, or those that it has not.
    struct MadeBy {
        RobotId robot;
        bool is_maker;
        bool operator()(const Member& member) const {
            return (member.id.robot == robot) == is_maker;
        }
    };
    /// Of those, the one of lowest raw fitness, the first of equals; nullopt where there is none.
    std::optional<std::size_t> worst_of(MadeBy members) const;
    /// Whether there are at least `count` of them.
    bool has(MadeBy members, std::size_t count) const;

    /// Adds a genome and places it in the first species whose representative is nearer than the
    /// threshold, or in a new one. Precondition: not full.
    void add(std::shared_ptr<const Genome> genome, float fitness);

    /// Takes a member out and returns its genome.
    std::shared_ptr<const Genome> remove(std::size_t index);

    void set_fitness(std::size_t index, float fitness);

    /// Another report of a held genome's energy.
    void report(std::size_t index, float energy, HeldEnergy rule);

    /// Divides all members anew, in the order in which they came.
    void speciate();

    /// The species' share of all species' fitness, a probability; 0 where the sum is 0.
    /// The fitness of a species is the mean of its members' fitness over its size.
    float species_share(std::size_t member);

    /// A species by roulette on fitness; a uniform one where all have none.
    std::size_t select_species(RandomStream& random);

    /// The fitter of two distinct random members of a species, or its only one.
    std::size_t select_parent(std::size_t species, RandomStream& random) const;

    /// The other parent of an offspring of `first`, a member of that species: the fitter of two
    /// distinct random members of those whom the rule admits, or its only one; `first` itself where
    /// it admits nobody else.
    std::size_t select_second_parent(SecondParent rule, std::size_t species, std::size_t first,
                                     RandomStream& random) const;

private:
    struct Species {
        std::shared_ptr<const Genome> representative;  // invariant: its first member
        float fitness = 0.0f;
    };

    template <class IsCandidate>
    std::optional<std::size_t> worst_where(IsCandidate is_candidate) const;
    template <class IsCandidate>
    std::optional<std::size_t> hold_tournament(IsCandidate is_candidate,
                                               RandomStream& random) const;
    void place(Member& member);
    void refresh_fitness();

    DistanceMeasure measure_;
    float threshold_;
    std::size_t capacity_;
    std::vector<Member> members_;   // invariant: at most capacity_, no genome twice
    std::vector<Species> species_;  // invariant: none is empty once every member is placed
    bool fitness_is_current_ = false;
    float total_fitness_ = 0.0f;  // over species
};

}  // namespace gene_clocks::neat
