"""How the arms of a study look: a colour, a line style and a marker for each, in a fixed order."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Look:
    """How an arm is drawn. Line style and marker tell it from all others without the colour."""

    colour: str
    line: object = "-"
    marker: str = "o"


# From Okabe and Ito's colours and Tol's "muted" ones, which all common kinds of colour vision tell
# apart on white; page.css has each again for dark pages.
SOURCES = {
    "gene-clock": Look("#0072b2", "-", "o"),
    "gene-clock-no-merge": Look("#56b4e9", (0, (6, 1.5)), "v"),
    "timestamp": Look("#d55e00", (0, (4, 2)), "s"),
    "timestamp-drift": Look("#e69f00", (0, (4, 1.5, 1, 1.5)), "D"),
    "random-identifier": Look("#cc79a7", (0, (1.6, 1)), "X"),
    "global-counter": Look("#44494f", (0, (8, 2)), "^"),
    "congruence-class": Look("#009e73", (0, (5, 1.2, 1, 1.2, 1, 1.2)), "P"),
    "content-hash": Look("#882255", (0, (2.5, 1.2)), "p"),
    "hybrid-logical-clock": Look("#999933", (0, (7, 1.5, 2, 1.5)), "h"),
}

# Of arms that differ in something else.
OTHERS = tuple(SOURCES.values())
HIGHLIGHT = SOURCES["timestamp"]
BASELINE = SOURCES["gene-clock"]
ANY = Look("#5f6670", (0, (4, 2)))  # stands for any of them in a legend
# The same for all on every page, light or dark: text on the coloured cells of a heat map.
ON_DARK, ON_LIGHT = "#fdfdfd", "#101214"
