// Makes the golden runs (golden_runs.hpp) and compares what they come to with the file in which
// that is kept, bit for bit: a change that is not meant to alter a trajectory alters none, and
// compiler, optimisation, processor and threads make no difference to a run.
//
// Usage: trajectories FILE [THREADS]     compare; one run after the other, or on that many threads
//        trajectories --write FILE      keep what the runs come to now
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/sim/determinism/golden_runs.hpp"

namespace {

using gene_clocks::test::GoldenRun;

/// The line of each run, in their order.
std::vector<std::string> make(const std::vector<GoldenRun>& runs, int threads) {
    std::vector<std::string> lines(runs.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < runs.size(); i = next++) {
            const auto result =
                gene_clocks::sim::simulate(runs[i].settings, runs[i].arena, runs[i].seed);
            lines[i] = describe(runs[i], *result);
        }
    };
    std::vector<std::jthread> workers;
    for (int i = 1; i < threads; ++i) workers.emplace_back(work);
    work();
    return lines;
}

std::string name_of(const std::string& line) {
    return line.substr(0, line.find(':'));
}

std::string outcome_of(const std::string& line) {
    return line.substr(name_of(line).size());
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(outcome_of(line));
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

/// What the runs must be to be worth keeping: complaints, none if all is well.
std::vector<std::string> find_idle(const std::vector<GoldenRun>& runs,
                                   const std::vector<std::string>& lines) {
    std::vector<std::string> complaints;
    std::map<std::string, std::string> outcomes;
    std::set<std::string> always_zero;
    for (const std::string& line : lines) {
        outcomes[name_of(line)] = outcome_of(line);
        for (const std::string& word : words_of(line)) {
            if (word.ends_with("=0")) always_zero.insert(word);
        }
    }
    for (const std::string& line : lines) {
        for (const std::string& word : words_of(line)) {
            if (!word.ends_with("=0")) always_zero.erase(word.substr(0, word.find('=')) + "=0");
        }
    }
    // A child has the genes of its fitter parent, and that has no structure twice.
    always_zero.erase("crossovers_repeated=0");
    for (const std::string& word : always_zero) complaints.push_back(word + " in every run");
    for (const GoldenRun& run : runs) {
        if (run.differs_from && outcomes.at(run.name) == outcomes.at(*run.differs_from)) {
            complaints.push_back(run.name + ": its last setting changes nothing");
        }
    }
    return complaints;
}

/// "births=27 (28)" for every word that is not as it was kept.
std::string difference(const std::string& line, const std::string& kept) {
    const auto words = words_of(line);
    const auto kept_words = words_of(kept);
    std::string text;
    for (std::size_t i = 0; i < std::max(words.size(), kept_words.size()); ++i) {
        const std::string word = i < words.size() ? words[i] : "nothing";
        const std::string was = i < kept_words.size() ? kept_words[i] : "nothing";
        if (word != was) text += " " + word + " (" + was.substr(was.find('=') + 1) + ")";
    }
    return text;
}

/// The runs that did not come to what is kept of them, each in a line.
std::vector<std::string> compare(const std::vector<std::string>& lines, const std::string& path) {
    std::ifstream file(path);
    if (!file) return {path + " cannot be read"};
    std::map<std::string, std::string> kept;
    std::vector<std::string> order;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.starts_with('#')) continue;
        order.push_back(name_of(line));
        kept[name_of(line)] = line;
    }
    std::vector<std::string> differing;
    for (const std::string& line : lines) {
        const auto found = kept.find(name_of(line));
        if (found == kept.end()) {
            differing.push_back(name_of(line) + ": is not in the file");
        } else if (found->second != line) {
            differing.push_back(name_of(line) + ":" + difference(line, found->second));
        }
        if (found != kept.end()) kept.erase(found);
    }
    for (const std::string& name : order) {
        if (kept.contains(name)) differing.push_back(name + ": is in the file only");
    }
    return differing;
}

bool write(const std::vector<std::string>& lines, const char* path) {
    std::ofstream file(path);
    file << "# What fixed runs come to, bit for bit: tests/sim/determinism. Written by ./run "
            "goldens.\n";
    for (const std::string& line : lines) file << line << '\n';
    return static_cast<bool>(file.flush());
}

int run(int argc, char** argv) {
    const std::string first = argc > 1 ? argv[1] : "";
    const bool writes = first == "--write";
    if (first.empty() || (writes && argc != 3)) {
        std::fprintf(stderr, "usage: trajectories FILE [THREADS] | trajectories --write FILE\n");
        return 2;
    }
    const auto runs = gene_clocks::test::golden_runs();
    const auto lines = make(runs, !writes && argc > 2 ? std::atoi(argv[2]) : 1);
    const auto idle = find_idle(runs, lines);
    for (const std::string& complaint : idle) std::printf("%s\n", complaint.c_str());
    if (!idle.empty()) return 1;
    if (writes) {
        if (write(lines, argv[2])) return 0;
        std::fprintf(stderr, "%s cannot be written\n", argv[2]);
        return 1;
    }
    const auto differing = compare(lines, first);
    if (differing.empty()) return 0;
    std::printf("%zu of %zu runs do not come to what %s says (in brackets):\n", differing.size(),
                lines.size(), first.c_str());
    for (std::size_t i = 0; i < std::min<std::size_t>(differing.size(), 12); ++i) {
        std::printf("  %s\n", differing[i].c_str());
    }
    std::printf("Where that is meant: ./run goldens, and say so in the commit.\n");
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}
