#include <algorithm>
#include <cassert>
#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/population.hpp>

namespace gene_clocks::neat {

Population::Population(const OdneatSettings& settings)
    : measure_(settings),
      threshold_(static_cast<float>(settings.species_threshold)),
      capacity_(static_cast<std::size_t>(settings.population)) {
    members_.reserve(capacity_);
}

std::optional<std::size_t> Population::find(GenomeId id) const {
    for (std::size_t i = 0; i < members_.size(); ++i) {
        if (members_[i].id == id) return i;
    }
    return std::nullopt;
}

template <class IsCandidate>
std::optional<std::size_t> Population::worst_where(IsCandidate is_candidate) const {
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        if (!is_candidate(members_[i])) continue;
        if (!worst || members_[i].fitness < members_[*worst].fitness) worst = i;
    }
    return worst;
}

std::optional<std::size_t> Population::worst(std::optional<GenomeId> except) const {
    return worst_where([&](const Member& member) { return !except || member.id != *except; });
}

std::optional<std::size_t> Population::worst_of(MadeBy members) const {
    return worst_where(members);
}

bool Population::has(MadeBy members, std::size_t count) const {
    if (count > members_.size()) return false;
    return static_cast<std::size_t>(std::count_if(members_.begin(), members_.end(), members)) >=
           count;
}

void Population::add(std::shared_ptr<const Genome> genome, float fitness) {
    assert(!is_full() && !find(genome->id));
    const GenomeId id = genome->id;
    members_.push_back({std::move(genome), id, fitness, 1, 0});
    place(members_.back());
}

std::shared_ptr<const Genome> Population::remove(std::size_t index) {
    const std::size_t species = members_[index].species;
    auto genome = std::move(members_[index].genome);
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(index));
    fitness_is_current_ = false;

    const auto heir = std::find_if(members_.begin(), members_.end(),
                                   [&](const Member& member) { return member.species == species; });
    if (heir == members_.end()) {
        species_.erase(species_.begin() + static_cast<std::ptrdiff_t>(species));
        for (Member& member : members_) {
            if (member.species > species) --member.species;
        }
    } else {
        species_[species].representative = heir->genome;
    }
    return genome;
}

void Population::set_fitness(std::size_t index, float fitness) {
    members_[index].fitness = fitness;
    fitness_is_current_ = false;
}

void Population::report(std::size_t index, float energy, HeldEnergy rule) {
    Member& member = members_[index];
    ++member.reports;
    if (rule == HeldEnergy::overwrite) {
        set_fitness(index, energy);
    } else {
        set_fitness(
            index, member.fitness + (energy - member.fitness) / static_cast<float>(member.reports));
    }
}

void Population::place(Member& member) {
    fitness_is_current_ = false;
    for (std::size_t i = 0; i < species_.size(); ++i) {
        if (distance(*member.genome, *species_[i].representative, measure_, threshold_) <
            threshold_) {
            member.species = i;
            return;
        }
    }
    member.species = species_.size();
    species_.push_back({member.genome});
}

void Population::speciate() {
    species_.clear();
    for (Member& member : members_) place(member);
}

void Population::refresh_fitness() {
    if (fitness_is_current_) return;
    fitness_is_current_ = true;
    total_fitness_ = 0.0f;
    for (std::size_t s = 0; s < species_.size(); ++s) {
        float sum = 0.0f;
        float size = 0.0f;
        for (const Member& member : members_) {
            if (member.species != s) continue;
            sum += member.fitness;
            size += 1.0f;
        }
        species_[s].fitness = sum / (size * size);
        total_fitness_ += species_[s].fitness;
    }
}

float Population::species_share(std::size_t member) {
    refresh_fitness();
    if (!(total_fitness_ > 0.0f)) return 0.0f;
    return species_[members_[member].species].fitness / total_fitness_;
}

std::size_t Population::select_species(RandomStream& random) {
    refresh_fitness();
    if (!(total_fitness_ > 0.0f)) return random.below(static_cast<std::uint32_t>(species_.size()));
    float left = static_cast<float>(random.uniform()) * total_fitness_;
    for (std::size_t s = 0; s + 1 < species_.size(); ++s) {
        left -= species_[s].fitness;
        if (left < 0.0f) return s;
    }
    return species_.size() - 1;
}

/// The fitter of two distinct random candidates, or the only one; nullopt where there is none.
template <class IsCandidate>
std::optional<std::size_t> Population::hold_tournament(IsCandidate is_candidate,
                                                       RandomStream& random) const {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < members_.size(); ++i) size += is_candidate(i) ? 1u : 0u;
    const auto nth = [&](std::uint32_t n) {
        std::size_t index = 0;
        while (!is_candidate(index) || n-- > 0) ++index;
        return index;
    };
    if (size == 0) return std::nullopt;
    if (size == 1) return nth(0);
    const std::uint32_t draw = random.below(size);
    const std::uint32_t other = (draw + 1 + random.below(size - 1)) % size;
    const std::size_t a = nth(draw);
    const std::size_t b = nth(other);
    return members_[b].fitness > members_[a].fitness ? b : a;
}

std::size_t Population::select_parent(std::size_t species, RandomStream& random) const {
    const auto is_member = [&](std::size_t i) { return members_[i].species == species; };
    const auto parent = hold_tournament(is_member, random);
    assert(parent);
    return *parent;
}

std::size_t Population::select_second_parent(SecondParent rule, std::size_t species,
                                             std::size_t first, RandomStream& random) const {
    assert(members_[first].species == species);
    if (rule == SecondParent::tournament) return select_parent(species, random);
    const bool is_any_species = rule == SecondParent::population;
    const auto is_candidate = [&](std::size_t i) {
        return i != first && (is_any_species || members_[i].species == species);
    };
    return hold_tournament(is_candidate, random).value_or(first);
}

}  // namespace gene_clocks::neat
