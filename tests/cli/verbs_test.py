"""facescan bench, info, convert and --help, and the manual page."""
import json
import os
import re

from program import (DATA, ROOT, STEPS, STILL, Case, DATA_ERROR, files_under, main, read, run,
                     write_truncated_bundle)
from replay_test import STAGES
from scaneval import read_ply

VERBS = ['replay', 'bench', 'info', 'simulate', 'convert']


class Bench(Case):
    def test_json_has_the_median_of_each_stage_and_in_all(self):
        document = json.loads(self.succeed('bench', STEPS, '--repeat', 2, '--json'))
        median = document['median_ms']
        self.assertEqual(list(median), ['total', *STAGES])
        self.assertGreater(median['total'], 0)

    def test_table_has_them_too(self):
        table = self.succeed('bench', STEPS, '--repeat', 1)
        self.assertEqual(re.findall(r'(?m)^(\w+) +[0-9.]+ ms$', table), [*STAGES, 'total'])

    def test_knows_the_options_of_the_stages(self):
        self.succeed('bench', STEPS, '--repeat', 1, '--no-smooth')


class Info(Case):
    def test_tells_what_a_bundle_holds(self):
        document = json.loads(self.succeed('info', os.path.join(DATA, 'face_flipped'), '--json'))
        self.assertEqual(document['sound'], True)
        self.assertEqual(document['frames'], {'count': 19, 'width': 480, 'height': 768,
                                              'row_stride': 512, 'first_pattern': 1,
                                              'patterns': 16})
        self.assertEqual(document['image'], {'x': 0, 'y': 14, 'width': 480, 'height': 754})
        self.assertEqual(document['pattern'],
                         {'type': 'gray', 'bits': 8, 'axis': 'y', 'order': 'grouped'})
        self.assertEqual(document['calibration'],
                         {'degree': 5, 'range_min_mm': 300, 'range_max_mm': 520})
        self.assertEqual(document['timing'], {'start_time_ns': 1700000000000000000,
                                              'frame_interval_ns': 16666667})

    def test_table_tells_it_too(self):
        table = self.succeed('info', os.path.join(DATA, 'face_sideways'))
        self.assertIn('7 bits along x', table)
        self.assertRegex(table, r'(?m)^sound +yes$')

    def test_json_of_an_unsound_bundle_has_the_first_broken_rule(self):
        bad = write_truncated_bundle(self.path('bad'))
        result = run('info', bad, '--json')
        document = json.loads(result.stdout)
        self.assertEqual((result.returncode, document['sound']), (DATA_ERROR, False))
        self.assertEqual(result.stderr, 'facescan: ' + document['error'] + '\n')


class Convert(Case):
    def setUp(self):
        super().setUp()
        self.succeed('replay', STEPS, '-o', self.path('out'), '--no-preview', '--format',
                     'obj,stl,glb')

    def test_a_mesh_comes_back_the_same_as_ply(self):
        os.mkdir(self.path('copy'))
        self.succeed('convert', self.path('out', 'mesh.ply'), self.path('copy', 'mesh.ply'))
        for name in ('mesh.ply', 'texture.png'):
            self.assertEqual(read(self.path('copy', name)), read(self.path('out', name)))
        self.assertEqual(read_ply(self.path('copy', 'mesh.ply'))[2], [])

    def test_writes_what_replay_writes_in_each_format(self):
        for name in ('mesh.stl', 'mesh.glb'):
            self.succeed('convert', self.path('out', 'mesh.ply'), self.path(name))
            self.assertEqual(read(self.path(name)), read(self.path('out', name)), name)
        self.succeed('convert', self.path('out', 'mesh.ply'), self.path('face.OBJ'))
        self.assertEqual(read(self.path('face.png')), read(self.path('out', 'texture.png')))

    def test_what_is_no_mesh_is_an_error_of_data(self):
        self.fail_with(DATA_ERROR, 'convert', os.path.join(STILL, 'scan.xml'), self.path('a.stl'))
        self.assertEqual(files_under(self.folder),
                         sorted(['out'] + ['out/' + n for n in files_under(self.path('out'))]))


class Help(Case):
    def test_every_verb_has_examples(self):
        for arguments in ([], *([verb] for verb in VERBS)):
            help_text = self.succeed(*arguments, '--help')
            self.assertIn('facescan ' + ' '.join(arguments), help_text)
            self.assertIn('Examples:', help_text)

    def test_fits_a_terminal_of_100_columns(self):
        for verb in VERBS:
            for line in self.succeed(verb, '--help').splitlines():
                self.assertLessEqual(len(line), 100, line)


class Manual(Case):
    """docs/man/facescan.1.scd against --help."""

    def setUp(self):
        super().setUp()
        self.manual = read(ROOT, 'docs', 'man', 'facescan.1.scd').decode()

    def section(self, title):
        return self.manual.split(f'\n# {title}\n')[1].split('\n# ')[0]

    def test_names_every_option_of_every_verb_with_its_default(self):
        stages = self.section('OPTIONS OF THE STAGES')
        for verb in VERBS:
            text = self.section(verb.upper()) + self.section('DESCRIPTION') + stages
            entries = dict(re.findall(r'(?m)^(\*-.*)\n((?:\t.*\n)+)', text))
            for option, described in self.options(verb):
                with self.subTest(verb=verb, option=option):
                    entry = [e for names, e in entries.items() if f'*{option}*' in names]
                    self.assertEqual(len(entry), 1)
                    default = re.search(r'\[([^]]+)\]$', described)
                    if default:
                        words = ' '.join(entry[0].split())
                        self.assertIn(f'Default {default[1]}.', words)

    def options(self, verb):
        """(option, description) as --help has them."""
        lines = self.succeed(verb, '--help').split('Examples:')[0].splitlines()
        found = []
        for line in lines:
            if line.startswith('  -'):
                names, _, text = line.strip().partition('  ')
                found.append([re.findall(r'--[a-z-]+', names), text.strip()])
            elif line.startswith('      ') and found:
                found[-1][1] += ' ' + line.strip()
        self.assertTrue(found)
        return [(name, text.strip()) for names, text in found for name in names]

    def test_lists_every_exit_status_that_the_tests_know(self):
        import program
        statuses = self.section('EXIT STATUS')
        for status in (program.OK, program.USAGE, program.DATA_ERROR, program.NO_INPUT,
                       program.UNAVAILABLE, program.CANNOT_CREATE, program.IO_ERROR,
                       program.NO_SURFACE):
            self.assertIn(f'*{status}*', statuses)


if __name__ == '__main__':
    main()
