-- The tables of a store of runs. The file also carries an application_id and, as user_version, the
-- version of these tables (store_file.cpp).

-- What runs depend on besides their seeds: canonical JSON, and its XXH3-128.
CREATE TABLE settings (
    hash TEXT PRIMARY KEY,
    canonical TEXT NOT NULL
) STRICT;

CREATE TABLE study (
    name TEXT PRIMARY KEY,
    title TEXT NOT NULL,
    description TEXT NOT NULL,
    first_seed INTEGER NOT NULL,
    seeds INTEGER NOT NULL
) STRICT;

CREATE TABLE arm (
    study TEXT NOT NULL REFERENCES study (name) ON DELETE CASCADE,
    position INTEGER NOT NULL,
    name TEXT NOT NULL,
    profile TEXT NOT NULL,
    parameters TEXT NOT NULL,
    settings_hash TEXT NOT NULL REFERENCES settings (hash) ON UPDATE CASCADE,
    settings TEXT NOT NULL,  -- all of them, JSON
    PRIMARY KEY (study, name)
) STRICT;

-- A row is a finished run; its samples are in the table sample.
CREATE TABLE run (
    id INTEGER PRIMARY KEY,
    settings_hash TEXT NOT NULL REFERENCES settings (hash) ON UPDATE CASCADE,
    seed INTEGER NOT NULL,
    births INTEGER NOT NULL,
    matings INTEGER NOT NULL,
    mutations INTEGER NOT NULL,
    genes_created INTEGER NOT NULL,
    messages_sent INTEGER NOT NULL,
    messages_received INTEGER NOT NULL,
    genomes_accepted INTEGER NOT NULL,
    collisions INTEGER NOT NULL,
    reboots INTEGER NOT NULL,
    trajectory_hash TEXT NOT NULL,
    robot_steps INTEGER NOT NULL,
    cpu_seconds REAL NOT NULL,
    wall_seconds REAL NOT NULL,
    finished_at TEXT NOT NULL,
    program_version TEXT NOT NULL,
    UNIQUE (settings_hash, seed)
) STRICT;

CREATE TABLE sample (
    run INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    cycle INTEGER NOT NULL,
    swarm_fitness REAL NOT NULL,
    species REAL NOT NULL,
    added_elements REAL NOT NULL,
    controller_size REAL NOT NULL,
    PRIMARY KEY (run, cycle)
) STRICT, WITHOUT ROWID;

-- What each run shows of its marking: the fields of ChronologyMeasures, which docs/markings.md defines.
CREATE TABLE chronology (
    run INTEGER PRIMARY KEY REFERENCES run (id) ON DELETE CASCADE,
    genes INTEGER NOT NULL,
    pairs INTEGER NOT NULL,
    caused_pairs INTEGER NOT NULL,
    timed_pairs INTEGER NOT NULL,
    cause_inverted INTEGER NOT NULL,
    time_inverted INTEGER NOT NULL,
    same_collisions INTEGER NOT NULL,
    different_collisions INTEGER NOT NULL,
    genome_pairs INTEGER NOT NULL,
    genome_inverted INTEGER NOT NULL,
    alignments INTEGER NOT NULL,
    matching INTEGER NOT NULL,
    disjoint INTEGER NOT NULL,
    excess INTEGER NOT NULL,
    missed_homologies INTEGER NOT NULL,
    false_homologies INTEGER NOT NULL,
    crossovers INTEGER NOT NULL,
    crossovers_missed INTEGER NOT NULL,
    crossovers_false INTEGER NOT NULL,
    crossovers_repeated INTEGER NOT NULL,
    stamp_smallest INTEGER NOT NULL,
    stamp_mean REAL NOT NULL,
    stamp_largest INTEGER NOT NULL,
    bytes_sent INTEGER NOT NULL,
    stamp_bytes INTEGER NOT NULL
) STRICT;

-- When each gene arose, in order, for runs whose settings ask for it.
CREATE TABLE creation (
    run INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    position INTEGER NOT NULL,
    counter INTEGER NOT NULL,     -- of the gene's mark
    mark_robot INTEGER NOT NULL,  -- of the gene's mark
    robot INTEGER NOT NULL,
    cycle REAL NOT NULL,
    PRIMARY KEY (run, position)
) STRICT, WITHOUT ROWID;
