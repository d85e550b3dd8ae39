// A NEAT whose innovation numbers and neuron ids are integers, as MultiNEAT's are (32-bit `int`),
// on several islands: its database of innovations, with the same calls, over gene clocks.
#include <cstdio>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/generation_marks.hpp>
#include <gene_clocks/integer_ids.hpp>
#include <set>
#include <stdexcept>
#include <tuple>

// ---- begin: what Gene Clocks takes
using namespace gene_clocks;

/// Numbers for new links and neurons: unique on all islands, the same for equal mutations of one
/// generation on this one.
class InnovationDatabase {
public:
    static constexpr unsigned robot_bits = 11;  // up to 2047 islands, and 2^20 − 1 counters

    /// `genesis_count`: numbers 1 … genesis_count are those of the initial genes, everywhere alike.
    InnovationDatabase(std::uint32_t island, std::uint64_t genesis_count)
        : clock_(RobotId{island}, genesis_count, {.maximum = 1u << 20, .window = 1u << 16}) {}

    int AddLinkInnovation(int from, int to) { return take({0, from, to}, 1, 0); }
    /// The neuron's id; the links into it and out of it have the next two marks of the same split.
    int AddNeuronInnovation(int from, int to) { return take({1, from, to}, 3, 0); }
    int LinkIntoNeuron(int from, int to) { return take({1, from, to}, 3, 1); }
    int LinkOutOfNeuron(int from, int to) { return take({1, from, to}, 3, 2); }

    void Flush() { marks_.next_generation(); }  // at the end of a generation

    std::uint64_t StampToSend() const { return clock_.stamp().value; }
    /// Before any gene of a genome that arrived is used; false: drop it.
    bool Hear(std::uint64_t stamp) { return clock_.observe(Stamp{stamp}); }

private:
    int take(std::tuple<int, int, int> mutation, std::uint64_t count, std::uint64_t which) {
        const auto marks = marks_.get(mutation, clock_, count);
        const auto id = marks ? pack<int>((*marks)[which], robot_bits) : std::nullopt;
        if (!id) throw std::runtime_error("no number is left for new genes");
        return *id;
    }

    GeneClock clock_;
    GenerationMarks<std::tuple<int, int, int>> marks_;
};
// ---- end

int main() {
    InnovationDatabase one(1, 5), two(2, 5);
    // The same mutation twice in a generation is one; on another island it is another.
    const int link = one.AddLinkInnovation(1, 4);
    bool is_right = one.AddLinkInnovation(1, 4) == link && two.AddLinkInnovation(1, 4) != link;
    one.Flush();
    is_right &= one.AddLinkInnovation(1, 4) != link;
    const std::set<int> split{one.AddNeuronInnovation(1, 4), one.LinkIntoNeuron(1, 4),
                              one.LinkOutOfNeuron(1, 4)};
    is_right &= split.size() == 3;
    // What is made with knowledge of a gene has a larger number, on any island.
    is_right &= two.Hear(one.StampToSend());
    is_right &= two.AddNeuronInnovation(2, 4) > *split.rbegin();
    is_right &= !two.Hear(1u << 20);
    std::printf("link %d, split %d %d %d: %s\n", link, *split.begin(), *std::next(split.begin()),
                *split.rbegin(), is_right ? "as it should be" : "WRONG");
    return is_right ? 0 : 1;
}
