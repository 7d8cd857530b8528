"""From Google Benchmark's JSON to table, record and plot."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, 'bench'))

import batch
import history
import plot
import results as measured
import run
import table

PROGRAM = os.path.join(os.environ['SCANEVAL_BIN'], 'benchmarks')
FACESCAN = os.path.join(os.environ['SCANEVAL_BIN'], 'facescan')
KERNELS = os.path.join(ROOT, 'reconstruct', 'kernels', 'kernels.h')


def repetition(name, cpu_ms, **more):
    return {'run_name': name, 'run_type': 'iteration', 'cpu_time': cpu_ms, 'real_time': 10 * cpu_ms,
            'time_unit': 'ms', 'bytes': 8e6, 'pixels': 5e5, 'frames': 16, **more}


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def load(self, *repetitions):
        path = self.path('results.json')
        with open(path, 'w', encoding='utf-8') as file:
            json.dump({'benchmarks': repetitions}, file)
        return measured.load(path)


class Results(Case):
    def test_are_medians_of_the_repetitions(self):
        results = self.load(*(repetition('a', ms) for ms in (3, 1, 100)))
        self.assertAlmostEqual(results['a'].seconds, 0.003)

    def test_are_wall_time_where_several_threads_work(self):
        results = self.load(repetition('batch/real_time', 1))
        self.assertAlmostEqual(results['batch'].seconds, 0.010)

    def test_stand_in_the_order_of_the_program(self):
        results = self.load(repetition('b', 1, family_index=1), repetition('a', 1, family_index=0),
                            repetition('b', 1, family_index=1))
        self.assertEqual(list(results), ['a', 'b'])

    def test_keep_stages_in_their_order(self):
        results = self.load(repetition('a', 1, **{'stage:11:alpha': 2, 'stage:10:beta': 1}))
        self.assertEqual(results['a'].stages, {'beta': 1, 'alpha': 2})
        self.assertEqual(list(results['a'].stages), ['beta', 'alpha'])

    def test_of_a_benchmark_that_failed_are_none(self):
        with self.assertRaisesRegex(SystemExit, 'a: no surface'):
            self.load({'run_name': 'a', 'error_occurred': True, 'error_message': 'no surface'})

    def test_growth_is_that_of_the_time_a_pixel_and_frame(self):
        results = self.load(repetition('reconstruct/small', 2),
                            repetition('reconstruct/large', 60, pixels=1e7, frames=20))
        self.assertAlmostEqual(measured.growth(results), 60 / 2 / (1e7 / 5e5) / (20 / 16))


class Table(Case):
    def rows(self, *repetitions):
        text = table.table(self.load(*repetitions))
        return {line.split()[0]: line.split()[1:] for line in text.splitlines() if line}

    def test_has_time_and_rates_of_benchmarks_and_stages(self):
        rows = self.rows(repetition('bandwidth/memory', 0.5),
                         repetition('a', 4, **{'stage:10:decode': 0.002, 'stage:11:total': 0.004}))
        self.assertEqual(rows['a'], ['4.000', '2.00', '8.000', '0.500', '8.0'])
        self.assertEqual(rows['decode'], ['2.000', '4.00', '4.000', '0.250', '4.0'])

    def test_tells_no_bandwidth_of_what_cannot_have_read_all(self):
        rows = self.rows(repetition('bandwidth/cache', 1), repetition('a', 0.5))
        self.assertEqual(rows['a'], ['0.500', '1.000', '0.062'])

    def test_has_a_line_a_kernel_with_its_forms_side_by_side(self):
        kernel = {'items': 1e6, 'pixels': 0, 'frames': 0}
        rows = self.rows(repetition('bandwidth/cache', 1),
                         repetition('kernel/fill/plain/min_time:0.010', 4, **kernel),
                         repetition('kernel/fill/neon/min_time:0.010', 2, **kernel))
        self.assertEqual(rows['fill'], ['4.000', '2.000', '8', '4.0', '2.0'])
        self.assertNotIn('kernel/fill/plain', rows)

    def test_compares_steps_of_the_same_name_with_opencv(self):
        stages = ('stage:10:decode', 'stage:11:total')
        rows = self.rows(repetition('reconstruct/face', 4, **dict(zip(stages, (0.001, 0.004)))),
                         repetition('opencv/face', 40, **dict(zip(stages, (0.030, 0.040)))))
        self.assertEqual(rows['decode'], ['30.000', '1.000', '30.00'])
        self.assertEqual(rows['total'], ['40.000', '4.000', '10.00'])


def record(commit, cpu='A8', total=2.0):
    return {'version': commit, 'commit': commit, 'date': '2025-01-02', 'cpu': cpu,
            'read_gb_per_s': 20.0, 'median_ms': {'decode': total / 2, 'fill <&': total / 2,
                                                'total': total}}


class History(Case):
    def test_has_a_line_a_version_and_processor(self):
        path = self.path('history.jsonl')
        for line in (record('a'), record('b'), record('b', cpu='A53'), record('b', total=1.0)):
            history.append(path, line)
        self.assertEqual(history.read(path), [record('a'), record('b', cpu='A53'),
                                              record('b', total=1.0)])

    def test_line_has_the_figures_of_the_face_scan(self):
        stages = {'stage:10:decode': 0.00123456, 'stage:11:total': 0.0045}
        line = history.entry(ROOT, self.load(repetition('bandwidth/memory', 0.5),
                                             repetition('reconstruct/face', 5, **stages)))
        self.assertEqual(line['median_ms'], {'decode': 1.235, 'total': 4.5})
        self.assertEqual(line['read_gb_per_s'], 16)
        self.assertTrue(line['cpu'])


class Plot(Case):
    def test_shows_each_stage_of_each_version(self):
        history.append(self.path('history.jsonl'), record('a'))
        history.append(self.path('history.jsonl'), record('b'))
        plot.draw(self.path('history.jsonl'), self.path('plot.svg'))
        texts = [element.text for element in ElementTree.parse(self.path('plot.svg')).iter()]
        self.assertEqual(texts.count('decode: 1 ms'), 2)
        self.assertEqual(texts.count('fill <&: 1 ms'), 2)
        self.assertEqual(texts.count('2 ms'), 2)

    def test_in_the_manual_shows_the_record_as_it_is(self):
        plot.draw(os.path.join(ROOT, history.FILE), self.path('plot.svg'))
        with open(self.path('plot.svg'), encoding='utf-8') as drawn, \
                open(os.path.join(ROOT, plot.FILE), encoding='utf-8') as kept:
            self.assertEqual(drawn.read(), kept.read())


class Run(Case):
    def test_of_the_program_gives_results(self):
        results = run.run(PROGRAM, self.path('out.json'),
                          ['--benchmark_filter=^bandwidth/cache$', '--benchmark_min_time=0.000001'])
        self.assertEqual(list(results), ['bandwidth/cache'])
        text = table.table(results)
        self.assertRegex(text, re.compile('^bandwidth/cache +[0-9.]+ ', re.MULTILINE))


class Kernels(Case):
    def test_all_have_a_benchmark(self):
        names = subprocess.run([PROGRAM, '--benchmark_list_tests', '--benchmark_filter=^kernel/'],
                               check=True, capture_output=True, text=True).stdout
        with open(KERNELS, encoding='utf-8') as file:
            kernels = re.findall(r'\(\*(\w+)\)\(', file.read())
        self.assertEqual(set(re.findall('^kernel/([^/]+)/plain', names, re.MULTILINE)),
                         set(kernels))


class Batch(Case):
    def test_replays_all_scans(self):
        run = batch.batch(FACESCAN, scans=3, threads=1)
        self.assertEqual((run.scans, run.threads), (3, 1))
        self.assertGreater(run.user_s + run.system_s, 0)

    def test_that_fails_has_no_figures(self):
        with self.assertRaises(subprocess.CalledProcessError):
            batch.measure(1, 1, ['false'])

    def test_is_told_by_scans_a_second_and_memory(self):
        text = batch.text(batch.Run(1, 1, 0.02, 0.01, 0.005, 40.0),
                          [batch.Run(100, 2, 0.5, 0.8, 0.1, 75.0)])
        rows = [line.split() for line in text.splitlines()]
        self.assertEqual(rows[1], ['single', '1', '50.0', '10.00', '5.00', '40.0'])
        self.assertEqual(rows[2], ['100', 'scans', '2', '200.0', '8.00', '1.00', '75.0'])


if __name__ == '__main__':
    unittest.main()
