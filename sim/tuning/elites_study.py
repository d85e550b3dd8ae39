"""A study file of what came of a tuning: the elites, beside the parameter sets of the paper."""

import json

PAPER_SETS = ("A", "B", "C")
SEEDS = 64


def study_text(task, source, profile, changed_settings, elites, comment):
    """TOML. `changed_settings`, and each of `elites`, best first: values by key; `comment`: lines."""
    lines = [f"# {line}".rstrip() for line in comment]
    lines += [
        "",
        f'name = "tuned-{task}-{source}"',
        f'title = "Tuned parameters for {task} with {source}, beside the paper\'s"',
        'description = "All arms on the same seeds, none of which the tuning has seen."',
        "",
        f"profile = {_toml(profile)}",
        f"seeds = {SEEDS}",
        "",
    ]
    if changed_settings:
        lines += ["[settings]", *_assignments(changed_settings), ""]
    for rank, elite in enumerate(elites, 1):
        lines += [*_arm(f"elite-{rank}", task, source), *_assignments(elite, "settings."), ""]
    for name in PAPER_SETS:
        lines += [*_arm(f"paper-{name}", task, source), f'parameters = "{name}"', ""]
    lines += ["[quick]", "seeds = 2", "settings.run.cycles = 2000", ""]
    return "\n".join(lines)


def _arm(name, task, source):
    return ["[[arm]]", f'name = "{name}"', f'task = "{task}"', f'source = "{source}"']


def _assignments(values, prefix=""):
    return [f"{prefix}{key} = {_toml(value)}" for key, value in values.items()]


def _toml(value):
    """Numbers, booleans and texts are written in TOML as in JSON."""
    return json.dumps(value)
