"""Which tests are tried on a fault, in which order: those that most likely notice it come first."""

from dataclasses import replace

import faults
from workshop import Step


def programs(link, folder, *names):
    return Step(link, tuple(f"tests/{folder}/{name}_test" for name in names))


PROTOCOL = programs("unit", "protocol", "innovation_number", "align", "gene_clock", "admission_gate",
                    "kernel")
NEAT = programs("unit", "neat", "agent", "comparison_sources", "crossover", "distance",
                "durable_gene_clock_source", "gene_clock_source", "genome", "message_codec", "mutation",
                "population", "random", "tabu_list", "timestamp_source")
AUTHENTICATION = programs("unit", "protocol/authentication", "sealed_frames")
WIRE = programs("unit", "protocol", "wire")
FRAGMENTS = programs("unit", "protocol", "fragments")
GENERAL = programs("unit", "protocol", "general_genome")
CODEC = programs("unit", "neat", "message_codec")
STORAGE = programs("unit", "protocol/storage", "stored_counter", "file_store")
POWER_CUTS = programs("explorer", "protocol/storage", "simulated_disk")
TRACE = programs("unit", "protocol/trace", "trace")
MUST_NOT_COMPILE = Step("must not compile", (), r"^protocol\.must_not_compile\.")
PAPER = programs("paper", "paper", "section_2_related_work", "section_3_1_marking",
                 "section_3_2_algorithm", "section_3_2_variation")
EXPERIMENTS = programs("paper", "paper", "section_4_experiments")
SWARMS = programs("property", "protocol", "swarm_property")
OPERATORS = programs("property", "neat", "operators_property", "swarm_property")
CORE = programs("unit", "sim/core", "simulation", "arena_map", "chronology", "control_cycle",
                "item_field", "measures", "messages", "neighbour_index", "placement", "radio",
                "run_counters", "run_results", "sample", "source", "source_factory", "task", "world")
# Trajectories that are kept: they notice nearly everything, and do not say what. So they come last.
GOLDENS = Step(faults.GOLDENS, ("trajectories",), r"^determinism\.goldens$")
STATISTICS = programs("unit", "sim/statistics", "statistics")
CONTRASTS = programs("unit", "sim/report", "report")
STORE = programs("unit", "sim/experiment", "experiment")
EXPLORER = programs("explorer", "model", "model")
ORACLE = Step("oracle", ("oracle", "oracle_schedule", "oracle_replay", "oracle_random_traces",
                         "oracle_check_traces"), r"^oracle\.(counters_of_.*|traces)$")
FUZZ = Step("fuzz", ("align_fuzz_replay", "canary_fuzz_replay", "clock_schedule_fuzz_replay",
                     "genome_operators_fuzz_replay", "oracle_fuzz_replay", "trace_fuzz_replay"),
            r"^fuzz\.(align|canary|clock_schedule|genome_operators|oracle|trace)$")

# By the folder that the fault is in; the first that fits.
AREAS = {
    "protocol/include/gene_clocks/stored_counter.hpp": [STORAGE, POWER_CUTS],
    "protocol/storage/": [STORAGE, POWER_CUTS],
    "protocol/authentication/": [AUTHENTICATION],
    "protocol/include/gene_clocks/bytes.h": [WIRE, CODEC, GENERAL],
    "protocol/include/gene_clocks/checksum.h": [WIRE],
    "protocol/include/gene_clocks/fragments.h": [FRAGMENTS],
    "protocol/include/gene_clocks/general_": [GENERAL],
    "protocol/include/gene_clocks/schema.h": [GENERAL],
    "protocol/include/gene_clocks/genome_payload.h": [WIRE, CODEC],
    "protocol/include/gene_clocks/wire.h": [WIRE, CODEC],
    "protocol/trace/": [TRACE, ORACLE, FUZZ],
    "protocol/": [MUST_NOT_COMPILE, PROTOCOL, SWARMS, EXPLORER, ORACLE, FUZZ, PAPER, NEAT, OPERATORS,
                  TRACE],
    "neat/": [NEAT, OPERATORS, PAPER, FUZZ, GOLDENS],
    "sim/statistics/": [STATISTICS],
    "sim/report/": [CONTRASTS],
    "sim/experiment/": [STORE, CONTRASTS],
    "sim/core/include/": [CORE, STORE],
    "sim/core/src/": [CORE, EXPERIMENTS, GOLDENS],
    "sim/": [EXPERIMENTS],
    "fuzz/": [FUZZ],
    "tests/model/": [EXPLORER],
    "tests/support/": [SWARMS],
    "tests/neat/": [OPERATORS],
}
EVERY_STEP = list(dict.fromkeys(step for steps in AREAS.values() for step in steps))

# Where the test is not called as the file: by the beginning of the fault's name.
LIKELY = {
    "causal_past.cpp/": "tests/sim/core/chronology_test",
    "gene_log.cpp/": "tests/sim/core/chronology_test",
    "gene_log.hpp/": "tests/sim/core/chronology_test",
    "gene_origins.hpp/": "tests/sim/core/chronology_test",
    "lanes.hpp/": "tests/sim/core/world_test",
    "sensing.cpp/": "tests/sim/core/world_test",
    "kernel.h/align": "tests/protocol/align_test",
    "kernel.h/equal": "tests/protocol/align_test",
    "kernel.h/less": "tests/protocol/innovation_number_test",
    "kernel.h/find-unmade": "tests/protocol/admission_gate_test",
    "kernel.h/earn": "tests/protocol/admission_gate_test",
    "kernel.h/admit": "tests/protocol/admission_gate_test",
    "kernel.h/": "tests/protocol/gene_clock_test",
    "marks.hpp/": "tests/protocol/align_test",
    "local_time.hpp/": "tests/neat/timestamp_source_test",
    "innovation_source.hpp/": "tests/neat/gene_clock_source_test",
    "distance_measure.hpp/": "tests/neat/distance_test",
    "hybrid_logical_clock_source.hpp/": "tests/neat/comparison_sources_test",
    "congruence_class_source.hpp/": "tests/neat/comparison_sources_test",
    "random_identifier_source.hpp/": "tests/neat/comparison_sources_test",
    "global_counter_source.hpp/": "tests/neat/comparison_sources_test",
}


def meant_step(fault, steps):
    """The tests that are to notice a fault; None where its folder's first ones are."""
    if fault.meant == faults.GOLDENS:
        return GOLDENS
    if fault.meant:
        program, _, test = fault.meant.partition(" ")
        target = f"tests/{program}_test"
        link = next((step.link for step in EVERY_STEP if target in step.targets), "unit")
        return Step(link, (target,), only=test)
    mirror = f"/{fault.name.split('/')[0].split('.')[0]}_test"  # tests/ mirrors the sources
    likely = next((test for name, test in LIKELY.items() if fault.name.startswith(name)), None)
    for step in steps:
        for target in step.targets:
            if len(step.targets) > 1 and (target == likely or target.endswith(mirror)):
                return Step(step.link, (target,))
    return None


def steps_for(fault):
    """First the tests that are meant to notice the fault, then whatever else could."""
    steps = next(steps for folder, steps in AREAS.items() if fault.file.startswith(folder))
    meant = meant_step(fault, steps)
    if meant is None:
        return [replace(steps[0], is_meant=True), *steps[1:]]
    return [replace(meant, is_meant=True), *(step for step in steps if step != meant)]
