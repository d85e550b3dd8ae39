"""Turns a figure's SVG file into markup that lives inside a page.

There it follows the page's colours, light or dark, its identifiers clash with no other figure's, and
it has a text for those who do not see it.
"""

import re
from html import escape

import palette

# The colours of figures.mplstyle, by the CSS variable that stands for each.
VARIABLES = {
    "#1b1f24": "--ink",
    "#5f6670": "--muted",
    "#d9dde2": "--grid",
    "#ffffff": "--paper",
}


def inline(svg, identifier, text):
    """The <svg> element of a figure. `identifier` is unique on the page, `text` describes it."""
    start = svg.index("<svg")
    markup = svg[start:].strip()
    markup = re.sub(r"<metadata>.*?</metadata>", "", markup, flags=re.DOTALL)
    markup = re.sub(r' xmlns:xlink="[^"]*"', "", markup, count=1)
    markup = markup.replace("xlink:href=", "href=")
    markup = re.sub(r'\bid="([^"]+)"', rf'id="{identifier}-\1"', markup)
    markup = re.sub(r'href="#([^"]+)"', rf'href="#{identifier}-\1"', markup)
    markup = re.sub(r"url\(#([^)]+)\)", rf"url(#{identifier}-\1)", markup)
    of_sources = {look.colour: f"--{source}" for source, look in palette.SOURCES.items()}
    for colour, variable in {**VARIABLES, **of_sources}.items():
        markup = markup.replace(colour, f"var({variable})")
    opening = (f'<svg role="img" aria-labelledby="{identifier}-text" '
               f'width="100%" {_attribute(markup, "viewBox")} xmlns="http://www.w3.org/2000/svg">'
               f'<title id="{identifier}-text">{escape(text)}</title>')
    return re.sub(r"<svg[^>]*>", lambda _: opening, markup, count=1)


def _attribute(markup, name):
    return re.search(rf'\b{name}="[^"]*"', markup).group(0)
