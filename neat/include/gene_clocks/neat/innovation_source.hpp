#pragma once

#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <optional>

namespace gene_clocks::neat {

/// What stands for the robot in a mark that names none: its counter alone is the identity.
inline constexpr RobotId no_robot{0xffff'ffff};

/// The marks of the three genes that add-neuron creates.
struct SplitMarks {
    InnovationNumber neuron;
    InnovationNumber incoming;
    InnovationNumber outgoing;
};

/// The next three marks of a clock; all or none.
inline std::optional<SplitMarks> mint_split(GeneClock& clock) {
    const auto marks = clock.mint(3);
    if (!marks) return std::nullopt;
    return SplitMarks{(*marks)[0], (*marks)[1], (*marks)[2]};
}

/// What marks the new genes of one robot.
///
/// Called at structural mutations and once per message, never in the path of every cycle. A
/// source may look at the genome and the place that the mutation changes, so that sources which
/// derive a mark from structure fit behind the same interface as clocks.
///
/// A mark that is returned is new to the genome and sorts after the genesis marks. nullopt means
/// that the source cannot mark this innovation (exhausted, say): the mutation does not happen.
class InnovationSource {
public:
    virtual ~InnovationSource() = default;

    /// Marks for splitting `genome`'s connection at index `connection` at time `now_cycles`.
    virtual std::optional<SplitMarks> mark_split(const Genome& genome, std::size_t connection,
                                                 double now_cycles) = 0;

    /// A mark for joining `ends` in `genome` at time `now_cycles`.
    virtual std::optional<InnovationNumber> mark_connection(const Genome& genome,
                                                            const ConnectionEnds& ends,
                                                            double now_cycles) = 0;

    /// What a message carries beside the genome; zero, as here, for a source that sends nothing.
    virtual Stamp stamp() const { return {}; }

    /// The stamp of a message that is to leave now, with the robot's genome number `birth`; nullopt
    /// while it must be held, since what it says is not yet on stable storage.
    virtual std::optional<Stamp> stamp_to_send(std::uint32_t birth) {
        static_cast<void>(birth);
        return stamp();
    }

    /// The number of the robot's first genome in this life (GenomeId::birth): beyond all that it
    /// sent in earlier ones, where the source remembers those.
    virtual std::uint32_t first_birth() const { return 0; }

    /// Reception of a message's stamp. False: the message must be dropped whole. A source that
    /// learns nothing from others takes every message, as here.
    virtual bool observe(Stamp stamp) {
        static_cast<void>(stamp);
        return true;
    }

    /// The same with a look at the genome, for a source that trusts nobody.
    virtual Admission admit(Stamp stamp, const Genome&) {
        return observe(stamp) ? Admission::admitted : Admission::beyond_window;
    }
};

}  // namespace gene_clocks::neat
