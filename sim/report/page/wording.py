"""The words and number formats of figures and page."""

from markupsafe import escape

SOURCES = {}  # titles by name; filled by `use`, from the simulator's one list


def use(sources):
    """Takes over how report.json says that innovation sources are called."""
    SOURCES.clear()
    SOURCES.update({name: source["title"] for name, source in sources.items()})


PAPER_SOURCES = ("gene-clock", "timestamp")
TASKS = {"navigation": "navigation", "collection": "item collection"}
ORIGINS = {"paper": "paper", "reference": "reference system"}
ROLES = {"as-run": "As run", "as-printed": "As printed"}

VERDICTS = {"equivalent": "equivalent", "small": "small difference", "different": "different",
            "undecided": "undecided", "identical": "identical"}

# Of the measures of chronology: its symbol in HTML, what it is, and the decimals to show.
CHRONOLOGY = {
    "concurrent": ("concurrent", "share of pairs of genes of which neither can have caused the other", 3),
    "cause_inverted": ("against cause", "share of the other pairs that the marks sort the wrong way", 4),
    "time_inverted": ("against time", "share of pairs that the marks sort against their creation", 4),
    "genome_inverted": ("in a genome", "the same among the connections of one genome", 4),
    "same_collisions": ("same", "share of genes with a mark that the same innovation has", 4),
    "different_collisions": ("another", "share of genes with a mark that another innovation has", 4),
    "matching": ("matching", "matching connections in an alignment", 2),
    "disjoint": ("disjoint", "disjoint connections in an alignment", 3),
    "excess": ("excess", "excess connections in an alignment", 3),
    "missed_homologies": ("missed", "unmatched pairs of one innovation in an alignment", 4),
    "false_homologies": ("false", "matching pairs of two innovations in an alignment", 4),
    "crossovers": ("crossovers", "share of births with two different parents", 4),
    "crossovers_repeated": ("repeated", "share of these whose child has an innovation twice", 4),
    "message_bytes": ("bytes", "bytes of a message", 1),
    "stamp_bytes": ("of the clock", "bytes of the clock in a message", 2),
    "stamp_largest": ("largest stamp", "largest counter at the end", 0),
}

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


def signed(value, decimals):
    text = number(value, decimals)
    return text if text.startswith("\u2212") or not text.strip("0.") else f"+{text}"


def significant(value):
    """A measured value to three digits, as in '1 230', '12.0', '0.0123' or '0'."""
    if value == 0:
        return "0"
    if abs(value) >= 100:
        return number(value, 0)
    return minus(f"{value:#.3g}") if abs(value) >= 0.001 else "< 0.001"


def escaped(text):
    """A text as HTML."""
    return str(escape(text))


def p_value(value):
    return "< 0.001" if value < 0.001 else f"{value:.3f}"


def changes(settings):
    """How arms differ from their baselines, from settings as "key=value"."""
    words = []
    for setting in settings:
        key, value = setting.split("=", 1)
        words.append(SOURCES[value] if key == "source" else f"{key} = {value}")
    return ", ".join(words) or "conditions"
