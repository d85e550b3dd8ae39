"""report.json, whose every number knows where in it it stands, so that the page can say so."""

import json
from html import escape
from pathlib import Path

from markupsafe import Markup

import wording

FORMAT = 1


class DataError(Exception):
    """report.json cannot be used."""


class Number(float):
    """A number of report.json. `path` leads to it, as in 'comparisons.0.best_swarm_fitness'."""

    def __new__(cls, value, path):
        number = super().__new__(cls, value)
        number.path = path
        return number


class Node:
    """An object or array of report.json. Reads like it; its numbers are Numbers."""

    def __init__(self, value, path=""):
        self._value = value
        self._path = path

    def __getitem__(self, key):
        path = f"{self._path}.{key}" if self._path else str(key)
        value = self._value[key]
        if isinstance(value, (dict, list)):
            return Node(value, path)
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return Number(value, path)
        return value

    def __contains__(self, key):
        return key in self._value

    def __iter__(self):
        """The elements of an array, the keys of an object."""
        if isinstance(self._value, dict):
            return iter(self._value)
        return (self[i] for i in range(len(self._value)))

    def __len__(self):
        return len(self._value)

    def plain(self):
        """The same without paths, for drawing."""
        return self._value


def load(path):
    """Reads report.json. Throws DataError where it is none, or of another format."""
    try:
        value = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise DataError(f"{path}: {error}") from error
    if not isinstance(value, dict) or value.get("format") != FORMAT:
        raise DataError(f"{path}: is not the data of a report in format {FORMAT}")
    return Node(value)


def bests(data):
    """What t_f and f_a refer to: the runs that the best was taken over, and their best swarm fitness."""
    found = {}
    for comparison in data["comparisons"]:
        best = comparison["best_swarm_fitness"]
        found.setdefault((comparison["best_over"], float(best)), best)
    return [(over, best) for (over, _), best in found.items()]


def show(number, decimals=0):
    """A number for the page: rounded for people, exact and with its place for programs."""
    return _element(number, wording.number(number, decimals))


def show_exact(number):
    """A number with all the digits that it has."""
    text = wording.number(number, 0) if number.is_integer() else wording.minus(repr(float(number)))
    return _element(number, text)


def show_p_value(number):
    return _element(number, wording.p_value(number))


def _element(number, text):
    return Markup(f'<data value="{float(number)!r}" data-path="{escape(number.path)}">'
                  f"{escape(text)}</data>")
