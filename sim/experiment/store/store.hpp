#pragma once

#include <cstdint>
#include <filesystem>
#include <gene_clocks/sim/settings.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/experiment/study/run_key.hpp"
#include "sim/experiment/study/study.hpp"

namespace SQLite {
class Database;
}

namespace gene_clocks::experiment {

/// A finished run, as the store keeps it.
struct RunRecord {
    std::string settings_hash;
    std::uint64_t seed{};
    sim::RunResult result;
    double wall_seconds{};
    std::string finished_at;      ///< UTC, ISO 8601
    std::string program_version;  ///< of the program that executed the run
};

/// How long runs took, all together.
struct RecordedTime {
    std::size_t runs{};
    std::uint64_t robot_steps{};
    double wall_seconds{};
};

/// An arm of a stored study. Its runs are those with its settings and the study's seeds.
struct StoredArm {
    std::string name;
    std::string profile;
    std::string parameters;
    std::string settings_hash;
    sim::Settings settings;
};

/// A study that the store has runs of.
struct StoredStudy {
    std::string name;
    std::string title;
    std::string description;
    std::uint64_t first_seed{};
    std::int64_t seeds{};
    std::vector<StoredArm> arms;
    std::optional<ContrastTable> contrast = {};  ///< what its arms are compared with, if it says
};

/// The results of runs in one SQLite file. Every function may throw InputError, where the file is
/// unfit, and std::runtime_error, where writing fails on the way (a full disk). Both name the file.
///
/// Invariant: the file holds finished runs only. Each enters it in one transaction, so that nothing
/// that stops the program, a power cut included, leaves part of a run behind.
class Store {
public:
    /// Opens a store for writing, for this process alone; makes it where the file does not exist.
    /// Throws InputError, and leaves the file as it was, if it is not a store, one of another
    /// version, not writable, or in use.
    static Store open_for_writing(const std::filesystem::path& file);

    /// Opens a store that exists, for reading. Throws InputError as above.
    static Store open_for_reading(const std::filesystem::path& file);

    Store(Store&&) noexcept;
    Store& operator=(Store&&) noexcept;
    ~Store();

    /// Enters a study's description and arms, in place of what it held under that name; its runs
    /// stay, those of arms that are gone included.
    void put_study(const Study& study);

    /// Enters a finished run. The settings must be those of an arm of a study that was put.
    void put_run(const RunRecord& record);

    /// All runs that the store holds. The hashes are those that the settings have today, also where
    /// a store that is open for reading was written before some settings were introduced.
    [[nodiscard]] std::set<RunKey> finished() const;

    /// How long the runs took, by the hash of their settings, as in finished().
    [[nodiscard]] std::map<std::string, RecordedTime> recorded_times() const;

    /// The trajectory hash of each run, as in finished().
    [[nodiscard]] std::map<RunKey, std::uint64_t> trajectory_hashes() const;

    /// By the hash of settings that this store has: the hash that they have today. Another one only
    /// where the store is open for reading and was written before some settings were introduced.
    [[nodiscard]] std::map<std::string, std::string> current_hashes() const;

    /// Enters all studies and runs of other stores that this one lacks, in one transaction; what it
    /// has stays as it is. Returns how many runs were entered.
    std::size_t take_over(const std::vector<std::filesystem::path>& stores);

    /// All studies, by name.
    [[nodiscard]] std::vector<StoredStudy> studies() const;

    /// The study of that name; the only one if the name is empty.
    /// Throws InputError, with the names there are, where that finds none.
    [[nodiscard]] StoredStudy study(const std::string& name) const;

    /// The finished runs of an arm, by seed.
    [[nodiscard]] std::vector<RunRecord> runs(const StoredStudy& study, const StoredArm& arm) const;

    /// How many runs another version of the program made.
    [[nodiscard]] std::int64_t runs_of_other_versions() const;

    /// The settings keys that were introduced since the store was written, if open_for_writing
    /// found any. Its runs then count as made with the defaults of those keys.
    [[nodiscard]] const std::vector<std::string>& new_keys() const { return new_keys_; }

private:
    explicit Store(std::unique_ptr<SQLite::Database> database);
    template <typename Function>
    auto naming_file(Function&& function) const;
    void take_over_new_keys();
    void insert_study(const StoredStudy& study);
    void insert_run(const RunRecord& record);
    std::size_t insert_missing_from(const Store& other);

    std::unique_ptr<SQLite::Database> database_;
    std::vector<std::string> new_keys_;
};

}  // namespace gene_clocks::experiment
