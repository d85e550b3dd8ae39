#include "sim/app/study_report.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "sim/experiment/store/store.hpp"
#include "sim/report/report.hpp"
#include "sim/settings/program_version.hpp"

namespace gene_clocks::app {
namespace {

using experiment::Store;
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

/// Places of arms, by the hash of their settings and by profile.
using ArmsByKind = std::map<std::pair<std::string, std::string>, std::size_t>;

report::Arm arm_of(const Store& store, const StoredStudy& study,
                   const experiment::StoredArm& stored) {
    report::Arm arm{stored.name, stored.profile, stored.settings, {}};
    for (experiment::RunRecord& run : store.runs(study, stored)) {
        arm.runs.push_back({run.seed, std::move(run.result), std::move(run.program_version)});
    }
    return arm;
}

}  // namespace

report::Input read_input(const std::filesystem::path& file, const std::vector<std::string>& names) {
    const Store store = Store::open_for_reading(file);
    report::Input input;
    ArmsByKind of_others;  // what several studies have in common is one arm, with the most runs
    input.program_version = experiment::program_version();
    for (const StoredStudy& study : named_studies(store, names)) {
        if (input.study.empty()) {
            input.study = study.name;
            input.title = study.title;
        } else {
            input.title += "; " + study.title;
        }
        ArmsByKind of_this;
        for (const experiment::StoredArm& stored : study.arms) {
            report::Arm arm = arm_of(store, study, stored);
            const auto kind = std::pair(stored.settings_hash, stored.profile);
            if (const auto other = of_others.find(kind); other != of_others.end()) {
                auto& runs = input.arms[other->second].runs;
                if (arm.runs.size() > runs.size()) runs = std::move(arm.runs);
            } else {
                of_this.emplace(kind, input.arms.size());
                input.arms.push_back(std::move(arm));
            }
        }
        of_others.merge(of_this);
    }
    return input;
}

void report_on(const std::filesystem::path& file, const std::vector<std::string>& names,
               const std::string& command, const std::filesystem::path& folder) {
    report::Input input = read_input(file, names);
    input.command = command;
    report::write_report(input, folder);
    fmt::print(stderr, "Report: {}\n", (folder / "index.html").string());
}

std::filesystem::path report_folder(std::filesystem::path store) {
    if (store.has_extension()) return store.replace_extension();
    return store += "-report";
}

}  // namespace gene_clocks::app
