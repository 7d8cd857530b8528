#!/usr/bin/python3
"""Counts the instructions of one scan under emulation of a Cortex-A8 and prints them by stage and
class, with an estimate of the time. `./dev bench --a8` builds what this needs.

The count is of the second scan in the same memory: what a device does from its second scan on. It
is the same from run to run; instructions.json holds the recorded one."""
import argparse
import csv
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
RECORD = os.path.join(HERE, 'instructions.json')
TABLE = 'build/armhf/counted_scan.tsv'
BUNDLE = 'tests/data/face_still'

# Cycles an instruction on a Cortex-A8: it issues two a cycle at best, its VFP is not pipelined, and
# a move from NEON waits for NEON's queue. Within 8 % of GCC's own model of the processor.
CYCLES = {'int': 0.6, 'load': 1, 'store': 1, 'branch': 1.7, 'mul': 2, 'neon_int': 1,
          'neon_float': 2.4, 'neon_load': 2, 'neon_store': 2, 'f32': 11, 'f64': 14, 'div_sqrt': 40,
          'to_core': 20}
HZ = 1e9
LINE_BYTES = 64
MEMORY_BYTES_PER_S = 400e6  # boards of the time do 300 to 700

GROWTH = 0.03
SLACK = 20_000  # instructions; a stage of nothing may grow to this


def count():
    """Runs the program under the plugin: [(section, {counter: number})]"""
    # Relative paths and no environment: the length of both moves the stack, and with it the count.
    run = subprocess.run(
        ['qemu-arm', '-cpu', 'cortex-a8', '-L', 'build/sysroot/armhf',
         '-plugin', f'build/release/lib/count_instructions.so,out={TABLE}',
         'build/armhf/bin/counted_scan', BUNDLE],
        cwd=ROOT, env={}, stdout=subprocess.PIPE, text=True, check=True)
    with open(os.path.join(ROOT, TABLE), encoding='ascii') as table:
        rows = [{name: int(value) for name, value in row.items()}
                for row in csv.DictReader(table, delimiter='\t')]
    return list(zip(run.stdout.splitlines(), rows))


def scans(sections):
    """{stage: counts} of the first and of the second scan."""
    names = [name for name, _ in sections]
    first, second = names.index('before first'), names.index('before second')
    return dict(sections[first + 1:second]), dict(sections[second + 1:])


def total(stages):
    return {name: sum(counts[name] for counts in stages.values())
            for name in next(iter(stages.values()))}


def instructions(counts):
    return sum(counts[name] for name in CYCLES)


def core_ms(counts):
    return sum(cycles * counts[name] for name, cycles in CYCLES.items()) / HZ * 1e3


def memory_ms(counts):
    return counts['l2_miss'] * LINE_BYTES / MEMORY_BYTES_PER_S * 1e3


def print_table(stages):
    columns = [('instructions', instructions), *((name, lambda c, name=name: c[name])
                                                 for name in CYCLES)]
    print(f'{"":10}' + ''.join(f' {name:>{max(len(name), 7)}}' for name, _ in columns)
          + '  core ms  memory ms  larger     sum')
    for stage, counts in [*stages.items(), ('total', total(stages))]:
        core, memory = core_ms(counts), memory_ms(counts)
        print(f'{stage:10}'
              + ''.join(f' {value(counts) / 1e6:{max(len(name), 7)}.3f}' for name, value in columns)
              + f' {core:8.2f} {memory:10.2f} {max(core, memory):7.2f} {core + memory:7.2f}')


def print_estimate(first, second):
    counts = total(second)
    core, memory = core_ms(counts) / 1e3, memory_ms(counts) / 1e3
    weights = ' + '.join(f'{cycles:g} {name}' for name, cycles in CYCLES.items())
    print(f'\nMillions of executed instructions of one scan ({BUNDLE}), in memory that is there.\n'
          f'core   = ({weights}) / 1 GHz = {core:.3f} s\n'
          f'memory = {LINE_BYTES} B × {counts["l2_miss"]} misses of the second-level cache / '
          f'{MEMORY_BYTES_PER_S / 1e6:g} MB/s = {memory:.3f} s\n'
          f'One scan takes between the larger and the sum: {max(core, memory):.3f} to '
          f'{core + memory:.3f} s. The first scan, which also takes memory and knows no device yet: '
          f'{instructions(total(first)) / 1e6:.1f} million instructions, '
          f'{(core_ms(total(first)) + memory_ms(total(first))) / 1e3:.3f} s.')


def figures(stages):
    """What is recorded."""
    return {stage: {'instructions': instructions(counts), 'core_ms': round(core_ms(counts), 2),
                    'memory_ms': round(memory_ms(counts), 2)}
            for stage, counts in [*stages.items(), ('total', total(stages))]}


def growth(now, recorded):
    """A line for each stage that executes more than the record allows."""
    if list(now) != list(recorded):
        yield f'other stages than recorded: {", ".join(now)}'
        return
    for stage, counts in now.items():
        was, is_ = recorded[stage]['instructions'], counts['instructions']
        if is_ > was * (1 + GROWTH) and is_ > was + SLACK:
            yield f'{stage}: {is_} instructions, recorded {was} ({is_ / max(was, 1) - 1:+.1%})'


def check(now):
    with open(RECORD, encoding='utf-8') as file:
        complaints = list(growth(now, json.load(file)))
    for complaint in complaints:
        print(f'a8: {complaint}', file=sys.stderr)
    if complaints:
        print('a8: mend it, or record it on purpose: ./dev bench --a8 --record', file=sys.stderr)
    return 1 if complaints else 0


def record(now):
    with open(RECORD, 'w', encoding='utf-8') as file:
        json.dump(now, file, indent=2)
        file.write('\n')


def main():
    parser = argparse.ArgumentParser(prog='./dev bench --a8', description=__doc__.split('\n\n')[0])
    action = parser.add_mutually_exclusive_group()
    action.add_argument('--check', action='store_true',
                        help=f'fail where a stage or the whole grew by more than {GROWTH * 100:g} '
                             f'%% and {SLACK} instructions over the record')
    action.add_argument('--record', action='store_true', help='make this count the record')
    parser.add_argument('--json', action='store_true', help='print a JSON document')
    arguments = parser.parse_args()

    first, second = scans(count())
    now = figures(second)
    if arguments.json:
        print(json.dumps(now, indent=2))
    else:
        print_table(second)
        print_estimate(first, second)
    if arguments.record:
        record(now)
    return check(now) if arguments.check else 0


if __name__ == '__main__':
    sys.exit(main())
