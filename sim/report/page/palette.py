"""How the arms of a study look: a colour, a line style and a marker for each, in a fixed order."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Look:
    """How an arm is drawn. Line style and marker tell it from all others without the colour."""

    colour: str
    line: object = "-"
    marker: str = "o"


SOURCES = {}  # by name; filled by `use`, from the simulator's one list


def use(sources):
    """Takes over how report.json says that innovation sources are drawn."""
    SOURCES.clear()
    for name, source in sources.items():
        dashes = tuple(float(length) for length in source["dashes"].split())
        SOURCES[name] = Look(source["colour"], (0, dashes) if dashes else "-", source["marker"])


def other(position):
    """The look of an arm that differs from others in something else than its source."""
    return tuple(SOURCES.values())[position % len(SOURCES)]


def baseline():
    return other(0)


def distinct(position):
    """One of three looks whose colours are far apart."""
    return SOURCES[("gene-clock", "timestamp", "congruence-class")[position]]


def highlight():
    """What stands out best beside the baseline."""
    return SOURCES["timestamp"]


ANY = Look("#5f6670", (0, (4, 2)))  # stands for any of them in a legend
# The same for all on every page, light or dark: text on the coloured cells of a heat map.
ON_DARK, ON_LIGHT = "#fdfdfd", "#101214"
