// Property: whatever comes off a link, putting messages together stays within its memory (of which
// the fuzzer's sanitizers see each byte), agrees with a plain model on every outcome and message,
// and puts together what is split. Bytes are a sequence of fragments: a length, then so many bytes;
// an odd length stands for a well-formed head, so that much of it goes on.

#include <gene_clocks/fragments.hpp>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"

namespace {

using namespace gene_clocks;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t message_bytes = 60;

/// The pieces of one sender's message, as a map; without thought for memory.
struct Model {
    std::uint8_t number{}, last{};
    std::map<std::uint8_t, Bytes> pieces;

    std::optional<std::size_t> piece_bytes() const {
        for (const auto& [index, piece] : pieces) {
            if (index != last) return piece.size();
        }
        return std::nullopt;
    }
    std::optional<std::size_t> last_bytes() const {
        const auto found = pieces.find(last);
        return found == pieces.end() ? std::nullopt : std::optional(found->second.size());
    }
    bool goes_with(std::uint8_t others, std::uint8_t index, const Bytes& piece) const {
        if (others != last) return false;
        const auto found = pieces.find(index);
        if (found != pieces.end() && found->second != piece) return false;
        if (index == last) return piece.size() <= piece_bytes().value_or(piece.size());
        return piece.size() == piece_bytes().value_or(piece.size()) &&
               last_bytes().value_or(0) <= piece.size();
    }
    bool fits() const {
        return last * piece_bytes().value_or(0) + last_bytes().value_or(1) <= message_bytes;
    }
};

/// What becomes of a well-formed fragment of a single sender; the whole message where it completes.
std::pair<FragmentOutcome, Bytes> expect(std::optional<Model>& model,
                                         const gene_clocks_fragment& read) {
    const Bytes piece(read.piece, read.piece + read.piece_bytes);
    if (model) {
        const auto behind = static_cast<std::uint8_t>(model->number - read.number);
        if (behind >= 1 && behind <= 8) return {FragmentOutcome::late, {}};
    }
    if (!model || model->number != read.number || !model->goes_with(read.last, read.index, piece)) {
        model = Model{read.number, read.last, {}};
    }
    if (model->pieces.contains(read.index)) return {FragmentOutcome::repeated, {}};
    model->pieces[read.index] = piece;
    if (!model->fits()) {
        model.reset();
        return {FragmentOutcome::too_long, {}};
    }
    if (model->pieces.size() <= model->last) return {FragmentOutcome::kept, {}};
    Bytes whole;
    for (const auto& [index, one] : model->pieces)
        whole.insert(whole.end(), one.begin(), one.end());
    return {FragmentOutcome::completes, whole};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::ByteReader bytes({data, size});
    MessageAssembler assembler(3, message_bytes);
    std::map<std::uint32_t, std::optional<Model>> models;  // up to three senders, as many as fit
    bool are_all_kept = true;
    while (!bytes.empty()) {
        const std::size_t length = bytes.below(32);
        Bytes fragment;
        if (length % 2 == 1) {
            const auto sender = static_cast<std::uint8_t>(1 + bytes.below(4));
            const auto last = static_cast<std::uint8_t>(1 + bytes.below(6));
            const auto number = bytes.byte();
            fragment = {64, sender, number, last,
                        static_cast<std::uint8_t>(bytes.below(last + 1u))};
        }
        for (std::size_t i = 0; i < length; ++i) fragment.push_back(bytes.byte());
        fragment.shrink_to_fit();
        const auto [outcome, message] = assembler.take(fragment);
        gene_clocks_fragment read{};
        if (!gene_clocks_read_fragment(fragment.data(), fragment.size(), &read)) {
            const bool is_whole = !fragment.empty() && fragment[0] != 64;
            GENE_CLOCKS_REQUIRE(
                outcome == (is_whole ? FragmentOutcome::completes : FragmentOutcome::malformed));
            continue;
        }
        models.try_emplace(read.sender);
        // A fourth sender takes another's memory: from then on only bounds are looked at.
        are_all_kept = are_all_kept && models.size() <= 3;
        if (!are_all_kept) continue;
        const auto [expected, whole] = expect(models[read.sender], read);
        GENE_CLOCKS_REQUIRE(outcome == expected);
        if (outcome == FragmentOutcome::completes) {
            GENE_CLOCKS_REQUIRE(Bytes(message.begin(), message.end()) == whole);
        }
    }
    return 0;
}
