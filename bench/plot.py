#!/usr/bin/env python3
"""Draws the record of stage times as an SVG: a bar a version, a piece of it a stage."""
import os
from xml.sax.saxutils import escape

import history

FILE = 'docs/images/stage_times.svg'

WIDTH, LEFT, RIGHT, TOP = 860, 230, 90, 64
BAR, PITCH, LEGEND_COLUMNS, LEGEND_PITCH = 18, 30, 6, 20
COLOURS = ('#4477aa', '#66ccee', '#228833', '#ccbb44', '#ee6677', '#aa3377', '#bbbbbb', '#dd8844',
           '#777777', '#99ddaa', '#88aadd', '#332288', '#882255', '#117733')


def stages(lines):
    """Every stage of the record, in the order in which it first appears."""
    names = {}
    for line in lines:
        names.update((name, None) for name in line['median_ms'] if name != 'total')
    return list(names)


def text(x, y, words, anchor='start', size=12):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}">'
            f'{escape(words)}</text>')


def box(x, y, width, height, colour, words):
    return (f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.2f}" height="{height}" fill="{colour}">'
            f'<title>{escape(words)}</title></rect>')


def legend(names, colour):
    for number, name in enumerate(names):
        x = LEFT + number % LEGEND_COLUMNS * (WIDTH - LEFT - 10) / LEGEND_COLUMNS
        y = 16 + number // LEGEND_COLUMNS * LEGEND_PITCH
        yield box(x, y - 10, 12, 12, colour[name], name)
        yield text(x + 17, y, name)


def bar(line, y, scale, colour):
    times = line['median_ms']
    yield text(LEFT - 8, y + 8, f'{line["version"]}  {line["date"]}', 'end')
    yield text(LEFT - 8, y + 20, f'{line["cpu"]}, {line["read_gb_per_s"]:g} GB/s', 'end', 9)
    x = LEFT
    for name in colour:
        width = times.get(name, 0) * scale
        if width > 0:
            yield box(x, y, width, BAR, colour[name], f'{name}: {times[name]:g} ms')
        x += width
    yield text(x + 6, y + 14, f'{times["total"]:.3g} ms')


def svg(lines):
    names = stages(lines)
    colour = {name: COLOURS[number % len(COLOURS)] for number, name in enumerate(names)}
    longest = max((line['median_ms']['total'] for line in lines), default=1)
    scale = (WIDTH - LEFT - RIGHT) / longest
    height = TOP + PITCH * len(lines) + 6
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
             f'width="{WIDTH}" height="{height}" font-family="sans-serif">',
             '<title>Milliseconds of each stage, by version</title>',
             f'<rect width="{WIDTH}" height="{height}" fill="white"/>',
             *legend(names, colour)]
    for number, line in enumerate(lines):
        parts += bar(line, TOP + PITCH * number, scale, colour)
    return '\n'.join([*parts, '</svg>', ''])


def draw(record, out):
    with open(out, 'w', encoding='utf-8') as file:
        file.write(svg(history.read(record)))


if __name__ == '__main__':
    ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    draw(os.path.join(ROOT, history.FILE), os.path.join(ROOT, FILE))
