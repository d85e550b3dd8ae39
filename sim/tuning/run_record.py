"""The finished runs of a tuning, in one SQLite file.

irace keeps what it has learnt at the end of each iteration only. With this record nothing is lost in
between: irace draws its configurations from a seed, so a tuning that is started again asks for the same
runs in the same order, and gets those that are finished from here.
"""

import contextlib
import json
import sqlite3

SCHEMA = """
CREATE TABLE IF NOT EXISTS run (
    assignments TEXT NOT NULL,    -- JSON object: key of a setting, its value as irace wrote it
    seed INTEGER NOT NULL,
    f_c REAL NOT NULL,
    cpu_seconds REAL NOT NULL,
    PRIMARY KEY (assignments, seed)
) STRICT, WITHOUT ROWID
"""


class RunRecord:
    """Safe for several processes at once: each finished run is one transaction."""

    def __init__(self, path):
        self._database = sqlite3.connect(path, timeout=60, isolation_level=None)
        self._database.execute(SCHEMA)

    def close(self):
        self._database.close()

    def find(self, assignments, seed):
        """f_c of a finished run, or None."""
        row = self._database.execute("SELECT f_c FROM run WHERE assignments = ? AND seed = ?",
                                     (_text(assignments), seed)).fetchone()
        return row and row[0]

    def add(self, assignments, seed, f_c, cpu_seconds):
        self._database.execute("INSERT OR IGNORE INTO run VALUES (?, ?, ?, ?)",
                               (_text(assignments), seed, f_c, cpu_seconds))

    def count(self):
        return self._database.execute("SELECT COUNT(*) FROM run").fetchone()[0]

    def cpu_seconds(self):
        return self._database.execute("SELECT TOTAL(cpu_seconds) FROM run").fetchone()[0]

    def values_of(self, configuration):
        """f_c of all runs of a configuration: a dictionary of numbers by key."""
        rows = self._database.execute("SELECT assignments, f_c FROM run ORDER BY seed")
        return [f_c for assignments, f_c in rows
                if {key: float(text) for key, text in json.loads(assignments).items()} == configuration]


def open_record(path):
    return contextlib.closing(RunRecord(path))


def _text(assignments):
    return json.dumps(assignments, sort_keys=True)
