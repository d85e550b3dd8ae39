"""The words and number formats of figures and page."""

SOURCES = {
    "gene-clock": "Gene Clocks",
    "gene-clock-no-merge": "Gene Clocks, no merge",
    "timestamp": "Timestamps",
    "timestamp-drift": "Drifting timestamps",
    "random-identifier": "Random identifiers",
    "global-counter": "Global counter",
    "congruence-class": "Congruence classes",
    "content-hash": "Content hash",
    "hybrid-logical-clock": "Hybrid logical clocks",
}
PAPER_SOURCES = ("gene-clock", "timestamp")
TASKS = {"navigation": "navigation", "collection": "item collection"}
ORIGINS = {"paper": "paper", "reference": "reference system"}
ROLES = {"as-run": "As run", "as-printed": "As printed"}

VERDICTS = {"equivalent": "equivalent", "small": "small difference", "different": "different",
            "undecided": "undecided"}

# By measure: its symbol in HTML, what it is, its unit, and the decimals to show.
MEASURES = {
    "f_c": ("<i>f<sub>c</sub></i>", "average accumulated swarm fitness", "energy", 1),
    "f_b": ("<i>f<sub>b</sub></i>", "fixed budget swarm fitness", "energy", 1),
    "t_f": ("<i>t<sub>f</sub></i>", "time to reach target", "cycles", 0),
    "f_a": ("<i>f<sub>a</sub></i>", "accumulated fitness above target", "energy", 0),
    "final_swarm_fitness": ("<i>F<sub>s</sub></i> at the end", "swarm fitness of the last sample",
                            "energy", 1),
    "swarm_fitness_at_10000": ("<i>F<sub>s</sub></i> at cycle 10\u202f000",
                               "swarm fitness at cycle 10 000", "energy", 1),
    "species": ("species", "species in a local population", "species", 2),
    "added_elements": ("added", "neurons and connections added", "elements", 2),
    "controller_size": ("size", "neurons and connections of a controller", "elements", 2),
}


def minus(text):
    """With the sign that is as wide as a plus."""
    return text.replace("-", "\u2212")


def number(value, decimals):
    """A number as people read it, for example '40 000' (narrow no-break spaces) or '−1.5'."""
    text = minus(f"{value:,.{decimals}f}".replace(",", "\u202f"))
    return text if text.strip("\u22120.") else text.lstrip("\u2212")


def quantity(value):
    """A value of a setting: all its digits, as in '40 000', '0.05' or '1e−05'."""
    if float(value).is_integer() and abs(value) < 1e15:
        return number(value, 0)
    return minus(f"{value:g}") if float(f"{value:g}") == value else minus(repr(value))


def p_value(value):
    return "< 0.001" if value < 0.001 else f"{value:.3f}"
