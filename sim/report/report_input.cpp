#include "sim/report/report_input.hpp"

#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "sim/experiment/store/store.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::report {
namespace {

using experiment::Store;
using experiment::StoredArm;
using experiment::StoredStudy;

std::vector<StoredStudy> named_studies(const Store& store, const std::vector<std::string>& names) {
    if (names.empty()) return store.studies();
    std::vector<StoredStudy> studies;
    std::set<std::string> known;
    for (const std::string& name : names) {
        if (known.insert(name).second) studies.push_back(store.study(name));
    }
    return studies;
}

/// What two arms have in common that are one: profile, settings and arena; and how they are
/// measured, of which the hash says nothing.
using Kind = std::tuple<std::string, std::string, std::vector<experiment::Value>>;

Kind kind_of(const StoredArm& arm) {
    std::vector<experiment::Value> measuring;
    for (const experiment::Setting& setting : experiment::settings_table()) {
        if (!setting.shapes_run()) measuring.push_back(setting.get(arm.settings));
    }
    return {arm.settings_hash, arm.profile, std::move(measuring)};
}

/// Adds the runs that an arm lacks.
void add_runs(ArmRuns& arm, std::vector<experiment::RunRecord> records) {
    std::set<std::uint64_t> present;
    for (const Run& run : arm.runs) present.insert(run.seed);
    for (experiment::RunRecord& record : records) {
        if (!present.insert(record.seed).second) continue;
        arm.runs.push_back(
            {record.seed, std::move(record.result), std::move(record.program_version)});
    }
}

}  // namespace

Input read_input(const std::filesystem::path& file, const std::vector<std::string>& names) {
    const Store store = Store::open_for_reading(file);
    Input input;
    input.program_version = experiment::program_version();
    std::map<Kind, std::size_t> of_others;  // places of arms
    for (const StoredStudy& study : named_studies(store, names)) {
        if (input.study.empty()) {
            input.study = study.name;
            input.title = study.title;
            input.contrast = study.contrast;
        } else {
            input.title += "; " + study.title;
            if (study.contrast != input.contrast && !input.contrary_studies)
                input.contrary_studies.emplace(input.study, study.name);
        }
        std::map<Kind, std::size_t> of_this;
        for (const StoredArm& stored : study.arms) {
            const Kind kind = kind_of(stored);
            auto place = input.arms.size();
            if (const auto other = of_others.find(kind); other != of_others.end()) {
                place = other->second;
            } else {
                of_this.emplace(kind, place);
                input.arms.push_back(
                    {stored.name, stored.profile, stored.settings_hash, stored.settings, {}});
            }
            add_runs(input.arms[place], store.runs(study, stored));
        }
        of_others.merge(of_this);
    }
    return input;
}

}  // namespace gene_clocks::report
