#!/usr/bin/env python3
"""Times `facescan replay` of many scans: scans a second, processor time, and peak memory."""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections import namedtuple

import table

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUNDLE = os.path.join(ROOT, 'tests', 'data', 'face_still')
OUT = os.path.join(ROOT, 'build', 'bench', 'batch.json')

SINGLES = 5
GOAL_SCANS_PER_S = 200    # on two cores
GOAL_PEAK_MIB = 48        # of a single replay

Run = namedtuple('Run', 'scans threads wall_s user_s system_s peak_mib')


def measure(scans, threads, command, lines=()):
    """Runs a program that reads `lines`, to its end."""
    with tempfile.TemporaryFile('w+') as list_file:
        list_file.writelines(line + '\n' for line in lines)
        list_file.seek(0)
        start = time.monotonic()
        child = subprocess.Popen(command, stdin=list_file, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.monotonic() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise subprocess.CalledProcessError(child.returncode, command)
    return Run(scans, threads, wall, usage.ru_utime, usage.ru_stime, usage.ru_maxrss / 1024)


def single(program):
    """One scan by a process of its own: the one of median processor time, and the largest peak."""
    def replay(folder):
        return measure(1, 1, [program, 'replay', BUNDLE, '--no-preview', '-o',
                              os.path.join(folder, 'out')])
    with tempfile.TemporaryDirectory(prefix='facescan-bench-') as folder:
        runs = [replay(folder) for _ in range(SINGLES)]
    middle = sorted(runs, key=lambda run: run.user_s + run.system_s)[SINGLES // 2]
    return middle._replace(peak_mib=max(run.peak_mib for run in runs))


def batch(program, scans, threads):
    """The same bundle under many names, from the page cache, each into a folder of its own."""
    with tempfile.TemporaryDirectory(prefix='facescan-bench-') as folder:
        bundles = [os.path.join(folder, f'scan{number}') for number in range(scans)]
        for bundle in bundles:
            os.symlink(BUNDLE, bundle)
        return measure(scans, threads, [program, 'replay', '--from', '-', '--no-preview',
                                        '--threads', str(threads), '-o',
                                        os.path.join(folder, 'out')], bundles)


def text(alone, batches):
    def row(name, run):
        return (name, str(run.threads), f'{run.scans / run.wall_s:.1f}',
                f'{run.user_s / run.scans * 1e3:.2f}', f'{run.system_s / run.scans * 1e3:.2f}',
                f'{run.peak_mib:.1f}')
    rows = [('replay', 'threads', 'scans/s', 'user ms/scan', 'system ms/scan', 'peak MiB'),
            row('single', alone), *(row(f'{run.scans} scans', run) for run in batches)]
    return '\n'.join([*table.aligned(rows), '',
                      f'goals: {GOAL_SCANS_PER_S} scans/s on two cores; '
                      f'a peak of {GOAL_PEAK_MIB} MiB for a single scan'])


def measure_all(program, scans):
    """@returns the replay of one scan, and those of many: by one thread, and by one a core"""
    cores = len(os.sched_getaffinity(0))
    return single(program), [batch(program, scans, threads) for threads in sorted({1, cores})]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('scans', type=int, nargs='?', default=200)
    arguments = parser.parse_args()
    try:
        alone, batches = measure_all(os.path.join(ROOT, 'build', 'release', 'bin', 'facescan'),
                                     arguments.scans)
    except subprocess.CalledProcessError as error:
        sys.exit(str(error))
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, 'w', encoding='utf-8') as file:
        json.dump([run._asdict() for run in (alone, *batches)], file, indent=1)
    print(text(alone, batches))


if __name__ == '__main__':
    main()
