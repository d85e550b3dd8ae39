"""Writes a report: write_page.py REPORT.JSON FOLDER

Draws the figures and fills the page; then puts both and the data into the folder, which is made
where it does not exist. Where something is amiss the folder stays as it was.
"""

import shutil
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import jinja2

import chronology_figures
import exhibits
import figures
import palette
import report_data
import study_figures
import study_groups
import sweep_figures
import wording

EXIT_BAD_INPUT = 2


SHOWN_MEASURES = ("f_c", "f_b", "t_f", "f_a", "species", "controller_size")


@dataclass(frozen=True)
class GroupFigures:
    """The figures of a group, by what they are about."""

    fitness: list
    chronology: list


def draw_group(group, folder):
    curves = study_figures.curves(group, folder)
    fitness = [curves] if curves is not None else []
    fitness += [*study_figures.boxes(group, folder), *sweep_figures.fitness(group, folder)]
    return GroupFigures(fitness, list(chronology_figures.figures_of(group, folder)))


def page(data, parts, groups, drawn):
    """The text of index.html."""
    here = Path(__file__).parent
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(here), autoescape=True, undefined=jinja2.StrictUndefined,
        trim_blocks=True, lstrip_blocks=True)
    environment.globals.update(
        show=report_data.show, show_exact=report_data.show_exact,
        show_p_value=report_data.show_p_value, wording=wording, groups=study_groups,
        shown_measures=SHOWN_MEASURES,
        style=(here / "page.css").read_text(encoding="utf-8"))
    return environment.get_template("page.html.jinja").render(
        bests=report_data.bests(data), data=data, parts=parts, all_groups=groups, figures=drawn,
        is_paper=exhibits.is_paper(groups))


def write(data_path, folder):
    data = report_data.load(data_path)
    palette.use(data["sources"].plain())
    wording.use(data["sources"].plain())
    figures.use_style()
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".unfinished-", dir=folder) as temporary:
        unfinished = Path(temporary)
        place = unfinished / "figures"
        place.mkdir()
        groups = study_groups.read_groups(data)
        parts = exhibits.parts(data, groups, place)
        drawn = {group.identifier: draw_group(group, place) for group in groups}
        (unfinished / "index.html").write_text(page(data, parts, groups, drawn), encoding="utf-8")
        shutil.copyfile(data_path, unfinished / "report.json")
        shutil.rmtree(folder / "figures", ignore_errors=True)
        for name in ("figures", "report.json", "index.html"):
            (unfinished / name).replace(folder / name)


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    try:
        write(Path(arguments[0]), Path(arguments[1]))
    except report_data.DataError as error:
        problem = str(error)
    except OSError as error:
        problem = f"{error.filename or arguments[1]}: {error.strerror or error}"
    except (LookupError, TypeError, jinja2.UndefinedError) as error:
        problem = f"{arguments[0]}: something is missing or misplaced in it: {error!r}"
    else:
        return
    print(f"report: {problem}", file=sys.stderr)
    sys.exit(EXIT_BAD_INPUT)


if __name__ == "__main__":
    main(sys.argv[1:])
