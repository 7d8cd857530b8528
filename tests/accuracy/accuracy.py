#!/usr/bin/python3
"""Replays scans with known truth, scores each mesh with the evaluator, prints one table and holds it
against the limits of limits.json. Exit status 0 when every limit is kept, 1 when one is broken."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
DATA = [os.path.join(ROOT, 'tests', 'data'), os.path.join(ROOT, '..', 'shared', 'data')]
FAULTS = ('unused_vertices', 'degenerate_faces', 'duplicate_faces', 'nonmanifold_edges',
          'nonmanifold_vertices', 'inconsistent_edges')



def closed_share(scores):
    """Of the holes up to 10 mm across, how many were closed: those that the scan's report counts as
    filled, against those that the evaluator still finds."""
    filled = scores['report']['counts']['fill']['holes_filled']
    left = scores['holes']['up_to_10mm']
    return filled / (filled + left) if filled + left else None


# key, heading, format, at least (+1) or at most (-1) the limit, where the evaluator has it
COLUMNS = [
    ('rms', 'RMS mm', '{:.3f}', -1, lambda s: s['vertex_error']['rms']),
    ('median', 'median mm', '{:.3f}', -1, lambda s: s['vertex_error']['median_abs']),
    ('p95', '95 % mm', '{:.3f}', -1, lambda s: s['vertex_error']['p95']),
    ('over_1mm', '> 1 mm', '{:.3%}', -1, lambda s: s['vertex_error']['share_over_1mm']),
    ('normal_median', 'normals median °', '{:.2f}', -1, lambda s: s['normal_error_deg']['median']),
    ('normal_p90', '90 % °', '{:.2f}', -1, lambda s: s['normal_error_deg']['p90']),
    ('coverage_contrast', 'coverage, contrast ≥ 16', '{:.2%}', +1,
     lambda s: s['coverage']['within_1mm_area_where_contrast_16dn']),
    ('coverage', 'of all', '{:.2%}', +1, lambda s: s['coverage']['within_1mm_area']),
    ('filled_rms', 'filled RMS mm', '{:.3f}', -1,
     lambda s: s['filled_error']['rms'] if s['filled_error'] else None),
    ('holes', 'holes ≤ 10 mm', '{}', -1, lambda s: s['holes']['up_to_10mm']),
    ('closed', 'closed', '{:.1%}', +1, closed_share),
    ('flatness', 'flatness mm', '{:.3f}', -1,
     lambda s: s['plane']['flatness_rms'] if 'plane' in s else None),
    ('faults', 'faults', '{}', -1,
     lambda s: sum(s['topology'][k] for k in FAULTS) + len(s['contract'])),
]


def bundles(folders):
    """(name, bundle, truth) of each scan in the folders that has a truth, each name once."""
    found = {}
    for folder in folders:
        if not os.path.isdir(folder):
            print(f'{folder} is not there; its scans are left out', file=sys.stderr)
            continue
        for name in sorted(os.listdir(folder)):
            bundle, truth = os.path.join(folder, name), os.path.join(folder, 'truth', name)
            if os.path.exists(f'{bundle}/scan.xml') and os.path.exists(f'{truth}/truth.json'):
                found.setdefault(name, (name, bundle, truth))
    return list(found.values())


def score(evaluate, facescan, options, bundle, truth, folder):
    """The row of one scan, {key: value}; an exception tells why there is none."""
    run = subprocess.run([facescan, 'replay', bundle, '-o', folder, '--no-preview', *options],
                         capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(f'facescan replay ended with {run.returncode}: {run.stderr.strip()}')
    scores, _ = evaluate(truth, os.path.join(folder, 'mesh.ply'))
    with open(os.path.join(folder, 'report.json'), encoding='utf-8') as f:
        scores['report'] = json.load(f)
    for complaint in scores['contract']:
        print(f'{bundle}: mesh.ply: {complaint}', file=sys.stderr)
    return {key: read(scores) for key, _, _, _, read in COLUMNS}


def broken(name, row, limits):
    """One line for each limit that the row breaks. Says which exceptions it no longer needs."""
    goals = {**limits['every scan'], **limits['goals'].get(name, {})}
    excused = limits['not met yet'].get(name, {})
    for key, heading, form, sign, _ in COLUMNS:
        if key not in goals or row[key] is None:
            continue
        limit = excused.get(key, goals[key])
        bound = 'at least' if sign > 0 else 'at most'
        if not sign * row[key] >= sign * limit:
            yield f'{name}: {heading} is {form.format(row[key])}, expected {bound} {form.format(limit)}'
        elif key in excused and sign * row[key] >= sign * goals[key]:
            print(f'{name}: {heading} now meets its goal of {form.format(goals[key])}; '
                  f'take it out of "not met yet" in limits.json', file=sys.stderr)


def print_table(rows):
    print('| scan | ' + ' | '.join(heading for _, heading, *_ in COLUMNS) + ' |')
    print('| --- |' + ' ---: |' * len(COLUMNS))
    for name, row in rows.items():
        cells = ['–' if row[key] is None else form.format(row[key]) for key, _, form, *_ in COLUMNS]
        print(f'| {name} | ' + ' | '.join(cells) + ' |')


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--bin', default=os.path.join(ROOT, 'build', 'release', 'bin'),
                        help='folder of facescan and meshdist (default: build/release/bin)')
    parser.add_argument('--data', action='append', metavar='DIR',
                        help='folder of bundles with truth/ beside them; may be repeated '
                             '(default: tests/data, and ../shared/data where it exists)')
    parser.add_argument('--limits', default=os.path.join(HERE, 'limits.json'))
    parser.add_argument('--json', metavar='OUT', help='write the table as JSON too')
    parser.add_argument('options', nargs='*', help='after --: options passed on to facescan replay')
    arguments = parser.parse_args()

    os.environ['SCANEVAL_BIN'] = os.path.abspath(arguments.bin)
    sys.path.insert(0, os.path.join(ROOT, 'tests', 'evaluator'))
    from scaneval import evaluate

    with open(arguments.limits, encoding='utf-8') as f:
        limits = json.load(f)
    rows, failures = {}, []
    for name, bundle, truth in bundles(arguments.data or DATA):
        with tempfile.TemporaryDirectory() as folder:
            try:
                rows[name] = score(evaluate, os.path.join(arguments.bin, 'facescan'),
                                   arguments.options, bundle, truth, folder)
                failures += broken(name, rows[name], limits)
            except (Exception, SystemExit) as error:
                failures.append(f'{name}: no score: {error}')
    print_table(rows)
    if arguments.json:
        with open(arguments.json, 'w', encoding='utf-8') as f:
            json.dump(rows, f, indent=1)
    if not rows:
        failures.append('no scan was scored')
    for line in failures:
        print(line, file=sys.stderr)
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())
