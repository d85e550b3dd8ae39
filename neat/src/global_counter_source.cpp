#include <gene_clocks/neat/global_counter_source.hpp>

namespace gene_clocks::neat {

SplitMarks InnovationRecord::split(InnovationNumber connection, std::uint64_t repetition) {
    const auto [entry, is_new] = splits_.try_emplace({connection, repetition});
    if (is_new) {
        entry->second.neuron = next();
        entry->second.incoming = next();
        entry->second.outgoing = next();
    }
    return entry->second;
}

InnovationNumber InnovationRecord::join(InnovationNumber source, InnovationNumber target) {
    const auto [entry, is_new] = joins_.try_emplace({source, target});
    if (is_new) entry->second = next();
    return entry->second;
}

}  // namespace gene_clocks::neat
