#include <algorithm>
#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/tabu_list.hpp>

namespace gene_clocks::neat {

void TabuList::add(std::shared_ptr<const Genome> genome) {
    if (lifetime_receptions_ <= 0) return;
    const auto listed = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.genome->id == genome->id;
    });
    if (listed != entries_.end()) {
        listed->receptions_left = lifetime_receptions_;
    } else {
        const Comparison with_itself{genome->id, 0.0f < threshold_};
        Entry entry{std::move(genome), lifetime_receptions_, {}};
        entry.compared.fill(with_itself);
        entries_.push_back(std::move(entry));
    }
}

bool TabuList::is_similar(Entry& entry, const Genome& received) const {
    auto& compared =
        entry.compared[static_cast<std::size_t>(received.id.robot) % entry.compared.size()];
    if (compared.with != received.id) {
        compared.with = received.id;
        compared.similar = distance(received, *entry.genome, measure_, threshold_) < threshold_;
    }
    return compared.similar;
}

bool TabuList::approves(const Genome& received) {
    bool approved = true;
    bool any_expired = false;
    for (Entry& entry : entries_) {
        if (is_similar(entry, received)) {
            approved = false;
            entry.receptions_left = lifetime_receptions_;
        } else if (--entry.receptions_left == 0) {
            any_expired = true;
        }
    }
    if (any_expired) {
        std::erase_if(entries_, [](const Entry& entry) { return entry.receptions_left == 0; });
    }
    return approved;
}

}  // namespace gene_clocks::neat
