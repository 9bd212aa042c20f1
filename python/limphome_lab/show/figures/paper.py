"""A figure that was drawn for the screen, brought to the width of a paper's column or page."""

from matplotlib.collections import PathCollection
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.text import Text

DPI = 300
COLUMN, PAGE = 3.35, 7.0  # widths: one column (85 mm), both (178 mm) [in]
WIDEST_OF_A_COLUMN = 9.0  # on the screen [in]; what is wider takes both columns
FONT, SMALL = 8, 7  # [pt]
TALLER = 1.4  # letters do not shrink with the axes
LETTER = 0.55  # width of one in sizes of the font, at the mean


def save_for_paper(figure, out, name):
    """The figure as PDF and PNG in the folder `out`; returns the files."""
    fit(figure)
    out.mkdir(exist_ok=True)
    files = [out / f"{name}.{form}" for form in ("pdf", "png")]
    for file in files:
        figure.savefig(file, dpi=DPI)
    return files


def fit(figure):
    """Without its title, as captions have that; letters, lines and marks in sizes that can be read in print."""
    width, height = figure.get_size_inches()
    target = COLUMN if width <= WIDEST_OF_A_COLUMN else PAGE
    shrunk = target / width
    figure.set_size_inches(target, height * shrunk * (TALLER if target == COLUMN else 1.1))
    figure.suptitle("").set_in_layout(False)
    panels = figure.axes
    for axes in panels:
        if len(panels) == 1 or len(axes.get_title()) > 30:
            axes.set_title("")
    for text in figure.findobj(Text):
        text.set_fontsize(min(text.get_fontsize(), SMALL if text.get_fontsize() < 10 else FONT))
    for line in figure.findobj(Line2D):
        line.set_linewidth(max(0.5, line.get_linewidth() * shrunk**0.6))
        line.set_markersize(line.get_markersize() * shrunk**0.6)
    for marks in figure.findobj(PathCollection):
        marks.set_sizes(marks.get_sizes() * shrunk)
    for legend in [*figure.legends, *(axes.get_legend() for axes in panels)]:
        if legend is not None:
            _narrow(legend, target)


def _narrow(legend: Legend, target):
    """As many columns as the width has room for."""
    longest = max(len(text.get_text()) for text in legend.get_texts())
    room = int(target * 72 / (SMALL * (LETTER * longest + 4)))
    legend.set_ncols(max(1, min(legend._ncols, room)))
