#!/usr/bin/env python3
"""Runs a program of benchmarks and prints its results as one table."""
import argparse
import os
import subprocess
import sys

import history
import plot
import results as measured
import table

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


# Repetitions of one benchmark are spread over the run, so that a busy spell of the machine does not
# fall on all of them.
OPTIONS = ['--benchmark_repetitions=11', '--benchmark_min_time=0.1',
           '--benchmark_enable_random_interleaving=true', '--benchmark_out_format=json']


def run(program, out, options):
    """@returns the results; the JSON stays in `out`"""
    os.makedirs(os.path.dirname(out), exist_ok=True)
    subprocess.run([program, *OPTIONS, f'--benchmark_out={out}', *options], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    return measured.load(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program', help='with an absolute path, or in build/release/bin')
    parser.add_argument('--record', action='store_true',
                        help='add the figures to bench/history.jsonl and draw the plot again')
    arguments, options = parser.parse_known_args()

    program = os.path.join(ROOT, 'build', 'release', 'bin', arguments.program)
    name = os.path.basename(program)
    if arguments.record:
        history.require_clean_tree(ROOT, apart_from=[history.FILE, plot.FILE])
    try:
        results = run(program, os.path.join(ROOT, 'build', 'bench', name + '.json'), options)
    except subprocess.CalledProcessError as error:
        sys.exit(error.stderr.decode() + f'{name} failed ({error.returncode})')
    if not results:
        sys.exit('no benchmark of that name')
    print(table.table(results))
    if arguments.record:
        history.append(os.path.join(ROOT, history.FILE), history.entry(ROOT, results))
        plot.draw(os.path.join(ROOT, history.FILE), os.path.join(ROOT, plot.FILE))


if __name__ == '__main__':
    main()
