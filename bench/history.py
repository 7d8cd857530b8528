"""The record of what each version took: a line of JSON a version and machine, oldest first."""
import datetime
import json
import os
import subprocess
import sys

import results as measured

FILE = 'bench/history.jsonl'
SCAN = 'reconstruct/face'


def git(root, *arguments):
    return subprocess.run(['git', '-C', root, *arguments], check=True, capture_output=True,
                          text=True).stdout.strip()


def require_clean_tree(root, apart_from):
    """A record names the version that it measured. `apart_from` are files that it may change."""
    others = [f':!{file}' for file in apart_from]
    if git(root, 'status', '--porcelain', '--', '.', *others):
        sys.exit('--record measures a commit: commit your changes first')


def processor():
    """The name that Linux has for the first processor."""
    names = {}
    with open('/proc/cpuinfo', encoding='utf-8') as file:
        for line in file:
            key, _, value = line.partition(':')
            names.setdefault(key.strip().lower(), value.strip())
    return names.get('model name') or names.get('hardware') or os.uname().machine


def milliseconds(seconds):
    return float(f'{seconds * 1e3:.4g}')


def entry(root, results):
    if SCAN not in results or 'bandwidth/memory' not in results:
        sys.exit(f'a record needs {SCAN} and bandwidth/memory')
    memory, face = results['bandwidth/memory'], results[SCAN]
    line = {
        'version': git(root, 'describe', '--always', '--tags'),
        'commit': git(root, 'rev-parse', 'HEAD'),
        'date': datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
        'cpu': processor(),
        'read_gb_per_s': float(f'{memory.bytes / memory.seconds / 1e9:.3g}'),
        'median_ms': {stage: milliseconds(time) for stage, time in face.stages.items()},
    }
    if 'reconstruct/large' in results:
        line['large_ms'] = milliseconds(results['reconstruct/large'].seconds)
    growth = measured.growth(results)
    if growth:
        line['growth'] = round(growth, 3)
    return line


def read(path):
    if not os.path.exists(path):
        return []
    with open(path, encoding='utf-8') as file:
        return [json.loads(line) for line in file if line.strip()]


def append(path, new):
    """What was measured of the same commit on the same kind of processor is replaced."""
    def same(line):
        return (line['commit'], line['cpu']) == (new['commit'], new['cpu'])
    lines = [line for line in read(path) if not same(line)] + [new]
    with open(path, 'w', encoding='utf-8') as file:
        file.writelines(json.dumps(line) + '\n' for line in lines)
