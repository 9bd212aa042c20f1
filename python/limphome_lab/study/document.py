"""A page of headings, paragraphs, tables and figures, written as Markdown and as HTML."""

from dataclasses import dataclass
from html import escape

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #222; max-width: 75rem; margin: 2rem auto; padding: 0 1rem }
table { border-collapse: collapse; margin: 1rem 0; display: block; overflow-x: auto }
th, td { border-bottom: 1px solid #e3e7eb; padding: .25rem .7rem; text-align: left; vertical-align: top }
th { border-bottom: 2px solid #9aa5b1 }
img { max-width: 100% }
figcaption { color: #555 }
"""


@dataclass
class Heading:
    level: int
    text: str

    def markdown(self):
        return f"{'#' * self.level} {self.text}"

    def html(self):
        return f"<h{self.level}>{escape(self.text)}</h{self.level}>"


@dataclass
class Paragraph:
    text: str

    def markdown(self):
        return self.text

    def html(self):
        return f"<p>{escape(self.text)}</p>"


@dataclass
class Table:
    columns: list
    rows: list

    def markdown(self):
        def line(cells):
            return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"

        return "\n".join([line(self.columns), "|" + "---|" * len(self.columns), *map(line, self.rows)])

    def html(self):
        def line(cells, tag):
            return "<tr>" + "".join(f"<{tag}>{escape(str(cell))}</{tag}>" for cell in cells) + "</tr>"

        rows = "\n".join([line(self.columns, "th"), *(line(row, "td") for row in self.rows)])
        return f"<table>\n{rows}\n</table>"


@dataclass
class Figure:
    file: str  # relative to the page
    caption: str

    def markdown(self):
        return f"![{self.caption}]({self.file})\n\n*{self.caption}*"

    def html(self):
        caption = escape(self.caption)
        image = f'<img src="{escape(self.file)}" alt="{caption}">'
        return f"<figure>{image}<figcaption>{caption}</figcaption></figure>"


def markdown(blocks):
    return "\n\n".join(block.markdown() for block in blocks) + "\n"


def html(title, blocks):
    body = "\n".join(block.html() for block in blocks)
    return (
        f'<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n<title>{escape(title)}</title>\n'
        f"<style>{STYLE}</style>\n{body}\n</html>\n"
    )
