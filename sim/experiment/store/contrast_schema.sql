-- The tables [contrast] of studies' files, of those that have one. Stores that were begun before there
-- were any get this table when they are next written; where it is missing, no study has one.
CREATE TABLE IF NOT EXISTS contrast (
    study TEXT PRIMARY KEY REFERENCES study (name) ON DELETE CASCADE,
    baselines TEXT NOT NULL  -- JSON
) STRICT;
