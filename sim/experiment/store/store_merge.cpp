#include "sim/experiment/store/store_merge.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "sim/experiment/store/store.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/settings_io.hpp"

namespace gene_clocks::experiment {
namespace {

namespace fs = std::filesystem;

/// Throws InputError if two of the names are of one file.
void refuse_the_same_file_twice(const fs::path& out, const std::vector<fs::path>& in) {
    const auto is_same = [](const fs::path& a, const fs::path& b) {
        std::error_code absent;  // then opening it says so
        return fs::equivalent(a, b, absent);
    };
    for (std::size_t i = 0; i < in.size(); ++i) {
        if (is_same(out, in[i])) {
            throw InputError(fmt::format(
                "{}: is the output store; name only the stores that go into it", in[i].string()));
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (is_same(in[i], in[j])) {
                throw InputError(fmt::format("{}: is named twice; name it once", in[i].string()));
            }
        }
    }
}

/// What the second of two studies of one name has that the first has not, in words; empty where
/// they are the same.
std::string difference(const StoredStudy& a, const StoredStudy& b) {
    if (a.title != b.title) return "another title";
    if (a.description != b.description) return "another description";
    if (a.first_seed != b.first_seed || a.seeds != b.seeds) return "other seeds";
    // Older stores say nothing of contrasts.
    if (a.contrast && b.contrast && *a.contrast != *b.contrast) return "another table [contrast]";
    if (a.arms.size() != b.arms.size()) return "another number of arms";
    for (std::size_t i = 0; i < a.arms.size(); ++i) {
        const StoredArm& one = a.arms[i];
        const StoredArm& other = b.arms[i];
        if (one.name != other.name) return fmt::format("arm {} for {}", other.name, one.name);
        if (one.profile != other.profile || one.parameters != other.parameters ||
            one.settings_hash != other.settings_hash ||
            to_json(one.settings) != to_json(other.settings)) {
            return fmt::format("other settings of arm {}", one.name);
        }
    }
    return {};
}

/// What several stores hold all together, as far as they might contradict each other.
class Contents {
public:
    /// Throws InputError where the store contradicts one that was added before.
    void add(const Store& store, const std::string& file) {
        const auto hashes = store.current_hashes();
        for (StoredStudy& study : store.studies()) {
            for (StoredArm& arm : study.arms) arm.settings_hash = hashes.at(arm.settings_hash);
            const auto [known, is_new] = studies_.try_emplace(study.name, study, file);
            const std::string differs = is_new ? "" : difference(known->second.first, study);
            if (differs.empty()) continue;
            throw InputError(fmt::format("{}: study {} differs from that in {}: it has {}", file,
                                         study.name, known->second.second, differs));
        }
        for (const auto& [key, hash] : store.trajectory_hashes()) {
            const auto [known, is_new] = runs_.try_emplace(key, hash, file);
            if (is_new || known->second.first == hash) continue;
            throw InputError(fmt::format(
                "{}: the run with settings {} and seed {} differs from that in {}: trajectory "
                "hashes {:016x} and {:016x}",
                file, key.first, key.second, known->second.second, hash, known->second.first));
        }
    }

private:
    std::map<std::string, std::pair<StoredStudy, std::string>> studies_;
    std::map<RunKey, std::pair<std::uint64_t, std::string>> runs_;
};

/// A file of no bytes counts as none: opening it for writing makes it a store.
bool is_there(const fs::path& file) {
    std::error_code error;
    return fs::exists(file, error) &&
           (!fs::is_regular_file(file, error) || fs::file_size(file) > 0);
}

}  // namespace

MergeResult merge_stores(const fs::path& out, const std::vector<fs::path>& in) {
    refuse_the_same_file_twice(out, in);
    Contents contents;
    if (is_there(out)) contents.add(Store::open_for_reading(out), out.string());
    for (const fs::path& file : in) contents.add(Store::open_for_reading(file), file.string());

    Store store = Store::open_for_writing(out);
    MergeResult result;
    result.runs_added = store.take_over(in);
    result.runs_in_all = store.finished().size();
    result.runs_of_other_versions = static_cast<std::size_t>(store.runs_of_other_versions());
    return result;
}

}  // namespace gene_clocks::experiment
