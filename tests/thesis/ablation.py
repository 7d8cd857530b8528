#!/usr/bin/python3
"""Scores the thesis' pipeline, facescan, and facescan without each of its stages, on scans with known
truth and on simulated heads, and rewrites the tables in docs/ablation.md. The text around the
tables stays as it is."""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, 'tests', 'accuracy'), os.path.join(ROOT, 'tests', 'evaluator')]
from accuracy import COLUMNS, bundles  # noqa: E402

EVERYTHING = 'facescan'
NO_SMOOTHING = '… without smoothing'
NO_FILLING = '… without hole filling'

# What is left out, and the options of `facescan replay` that leave it out.
LEFT_OUT = [
    ('… without motion compensation', ['--no-compensate-motion']),
    ('… without lens-blur correction', ['--lens-blur-px=0']),
    (NO_SMOOTHING, ['--no-smooth']),
    ('… without rejection of outliers', ['--outlier-sigmas=100', '--max-residual-px=100']),
    ('… without care for surface ends', ['--end-columns=0']),
    ('… without removal of small pieces', ['--min-component=1']),
    ('… without recovery of the device', ['--no-recover-device']),
    (NO_FILLING, ['--no-fill-holes']),
    ('… without regard for gaps in holes', ['--max-rim-residual-px=100']),
    ('… without the filter on faces', ['--max-edge-ratio=1000']),
]

# label, command with {bundle} and {out} to be put in
VARIANTS = [
    ('thesis', ['thesis_replay', '{bundle}', '{out}']),
    ('thesis, frames not shifted', ['thesis_replay', '{bundle}', '{out}', '--no-shift']),
] + [
    (label, ['facescan', 'replay', '{bundle}', '-o', '{out}', '--no-preview', *options])
    for label, options in [
        (EVERYTHING, []),
        *LEFT_OUT,
        ('… without any of these', [option for _, options in LEFT_OUT for option in options]),
    ]
]

# Persons on whom no threshold was chosen: name, options of `facescan simulate`.
HEADS = [
    ('head_light', ['--face=3', '--seed=3']),
    ('head_long_hair', ['--face=15', '--seed=15']),
    ('head_stubble', ['--face=22', '--seed=22']),
    ('head_tremor', ['--face=12', '--seed=12', '--tremor-mm=0.27,0.27,0.27',
                     '--tremor-deg=0.03,0.03,0.03']),
    ('head_very_dark', ['--face=17', '--seed=17', '--skin=0.06']),
]

SHOWN = ('rms', 'median', 'p95', 'over_1mm', 'normal_median', 'coverage_contrast', 'coverage',
         'filled_rms', 'holes')

# key: heading, format, where the evaluator has it
FIGURES = {key: (heading, form, read) for key, heading, form, _, read in COLUMNS if key in SHOWN} | {
    'coverage': ('coverage', '{:.2%}', lambda s: s['coverage']['within_1mm_area']),
    'filled': ('filled vertices', '{}', lambda s: s['filled']),
    'filled_over_1mm': ('filled > 1 mm', '{:.2%}',
                        lambda s: s['filled_error'] and s['filled_error']['share_over_1mm']),
}


def heading(key):
    return FIGURES[key][0]


def cell(row, key):
    return '–' if row[key] is None else FIGURES[key][1].format(row[key])


def table(headings, rows):
    """Lines of a Markdown table: the first column to the left, numbers to the right."""
    lines = ['| ' + ' | '.join(headings) + ' |', '| --- |' + ' ---: |' * (len(headings) - 1)]
    return lines + ['| ' + ' | '.join(row) + ' |' for row in rows]


# Scores.

def run(bins, command):
    """Runs a program of the build; its errors are on standard error."""
    program, *arguments = command
    path = os.path.join(bins, program)
    if not os.path.exists(path):
        raise SystemExit(f'{path} is not there: run ./dev build, or name its folder by --bin')
    status = subprocess.run([path, *arguments], stdout=subprocess.DEVNULL).returncode
    if status != 0:
        raise SystemExit(f'{program} {" ".join(arguments)} ended with {status}')


def score(bins, evaluate, command, bundle, truth):
    """{key: figure} of one scan, replayed one way."""
    with tempfile.TemporaryDirectory() as folder:
        run(bins, [part.format(bundle=bundle, out=folder) for part in command])
        scores, _ = evaluate(truth, os.path.join(folder, 'mesh.ply'))
    return {key: read(scores) for key, (_, _, read) in FIGURES.items()}


def scores_of(bins, evaluate, scans):
    """{scan: {variant: {key: figure}}}"""
    scores = {}
    for name, bundle, truth in scans:
        print(name, file=sys.stderr)
        scores[name] = {label: score(bins, evaluate, command, bundle, truth)
                        for label, command in VARIANTS}
    return scores


def simulate_heads(bins, folder):
    for name, options in HEADS:
        run(bins, ['facescan', 'simulate', os.path.join(folder, name), *options,
                   '--truth', os.path.join(folder, 'truth', name)])


# Tables.

def scan_tables(scores):
    for name, variants in scores.items():
        yield from (f'### {name}', '')
        yield from table(['', *(heading(key) for key in SHOWN)],
                         [[label, *(cell(row, key) for key in SHOWN)]
                          for label, row in variants.items()])
        yield ''


def without_and_with(variants, missing, key):
    return f'{cell(variants[missing], key)} → {cell(variants[EVERYTHING], key)}'


def change(missing, key):
    """What leaving nothing out adds to a figure, as a function of a scan's variants."""
    return lambda variants: variants[EVERYTHING][key] - variants[missing][key]


def figure(key):
    return lambda variants: variants[EVERYTHING][key]


def worst(scores, badness):
    """The scan whose badness is largest; scans where it is None do not count."""
    known = {name: badness(variants) for name, variants in scores.items()}
    known = {name: value for name, value in known.items() if value is not None}
    return max(known, key=known.get)


def smoothing_table(scores):
    keys = ('rms', 'median', 'p95', 'over_1mm', 'normal_median')
    yield from table(['without → with', *(heading(key) for key in keys)],
                     [[name, *(without_and_with(variants, NO_SMOOTHING, key) for key in keys)]
                      for name, variants in scores.items()])
    yield from ('', 'The worst, where smoothing gains least or costs most:', '')
    for key in keys:
        name = worst(scores, change(NO_SMOOTHING, key))
        yield f'- {heading(key)}: {without_and_with(scores[name], NO_SMOOTHING, key)} (`{name}`)'
    yield ''


def filling_table(scores):
    changed, figures = ('holes', 'coverage'), ('filled', 'filled_rms', 'filled_over_1mm')
    yield from table(['without → with', *(heading(key) for key in changed),
                      *(heading(key) for key in figures)],
                     [[name, *(without_and_with(variants, NO_FILLING, key) for key in changed),
                       *(cell(variants[EVERYTHING], key) for key in figures)]
                      for name, variants in scores.items()])
    yield from ('', 'The worst:', '')
    for key in ('holes', 'filled_rms', 'filled_over_1mm'):
        name = worst(scores, figure(key))
        yield f'- {heading(key)}: {without_and_with(scores[name], NO_FILLING, key)} (`{name}`)'
    yield ''


def replaced(text, marker, lines):
    """The text with other lines between <!-- marker --> and <!-- end -->."""
    pattern = re.compile(f'(<!-- {marker} -->\n).*?(<!-- end -->)', re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f'no <!-- {marker} --> … <!-- end --> in the document')
    return pattern.sub(lambda match: match[1] + '\n' + '\n'.join(lines) + '\n' + match[2], text)


def write_document(path, blocks):
    with open(path, encoding='utf-8') as f:
        text = f.read()
    for marker, lines in blocks.items():
        text = replaced(text, marker, lines)
    with open(path, 'w', encoding='utf-8') as f:
        f.write(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--bin', default=os.path.join(ROOT, 'build', 'release', 'bin'),
                        help='folder of the programs (default: build/release/bin)')
    parser.add_argument('--data', action='append', default=[], metavar='DIR',
                        help='folder of further bundles with truth/ beside them; may be repeated')
    parser.add_argument('--heads', metavar='DIR',
                        help='keep the simulated heads there, and use those that are there')
    parser.add_argument('--print', metavar='SCAN', dest='scan',
                        help='only this scan and no heads: print its table and leave the document')
    parser.add_argument('--json', metavar='OUT', help='write all figures there too')
    arguments = parser.parse_args()

    bins = os.path.abspath(arguments.bin)
    os.environ['SCANEVAL_BIN'] = bins
    from scaneval import evaluate

    scans = bundles([os.path.join(ROOT, 'tests', 'data'), *arguments.data])
    if arguments.scan:
        scans = [scan for scan in scans if scan[0] == arguments.scan]
        print('\n'.join(scan_tables(scores_of(bins, evaluate, scans))))
        return 0 if scans else 1

    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.heads or temporary
        if not os.path.exists(os.path.join(folder, 'truth')):
            simulate_heads(bins, folder)
        recorded = scores_of(bins, evaluate, scans)
        heads = scores_of(bins, evaluate, bundles([folder]))

    everything = {**recorded, **heads}
    write_document(os.path.join(ROOT, 'docs', 'ablation.md'), {
        'recorded scans': scan_tables(recorded),
        'simulated heads': scan_tables(heads),
        'smoothing': smoothing_table(everything),
        'hole filling': filling_table(everything),
    })
    if arguments.json:
        with open(arguments.json, 'w', encoding='utf-8') as f:
            json.dump(everything, f, indent=1)
    return 0


if __name__ == '__main__':
    sys.exit(main())
