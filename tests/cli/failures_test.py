"""What facescan does where something is wrong: its statuses, its one line, and what it leaves."""
import json
import os
import random
import signal
import subprocess
import time

from program import (FACESCAN, STEPS, STILL, Case, CANNOT_CREATE, DATA_ERROR, IO_ERROR, NO_INPUT,
                     NO_SURFACE, OK, USAGE, files_under, main, read, run, write_bundle,
                     write_truncated_bundle)


class CommandLine(Case):
    def test_misuse_is_one_line_and_nothing_is_written(self):
        output = ('-o', self.path('out'))
        for arguments in ([], ['nonsense'], ['replay'], ['replay', STILL], ['replay', *output],
                          ['replay', STILL, *output, '--unknown'],
                          ['replay', STILL, *output, '--format', 'dxf'],
                          ['replay', STILL, *output, '--threads', '0'],
                          ['replay', STILL, *output, '--threads', 'many'],
                          ['replay', STILL, *output, '--gamma', 'nan'],
                          ['replay', STILL, *output, '--gamma', '1e999'],
                          ['replay', STILL, *output, '--min-component', '2.5'],
                          ['replay', STILL, *output, '--max-hole-mm', '-1'],
                          ['bench', STILL, '--repeat', '0'], ['info'],
                          ['convert', 'mesh.ply', 'mesh.dxf'], ['convert', 'mesh.ply', 'mesh']):
            with self.subTest(arguments=arguments):
                self.fail_with(USAGE, *arguments)
                self.assertEqual(files_under(self.folder), [])

    def test_a_missing_input_has_its_own_status(self):
        missing = self.path('missing')
        for arguments in (['replay', missing, '-o', self.path('out')], ['info', missing],
                          ['bench', missing], ['convert', missing, self.path('a.stl')]):
            with self.subTest(arguments=arguments):
                self.assertIn(missing, self.fail_with(NO_INPUT, *arguments))
                self.assertEqual(files_under(self.folder), [])

    def test_a_bundle_that_breaks_a_rule_is_an_error_of_data(self):
        bad = write_truncated_bundle(self.path('bad'))
        for arguments in (['replay', bad, '-o', self.path('out')], ['info', bad], ['bench', bad]):
            with self.subTest(arguments=arguments):
                self.assertIn('frames.bin', self.fail_with(DATA_ERROR, *arguments))
                self.assertEqual(os.listdir(self.folder), ['bad'])

    def test_control_characters_of_a_path_stay_out_of_the_line(self):
        self.fail_with(NO_INPUT, 'info', self.path('two\nlines\x1b[31m'))

    def test_standard_output_that_is_full_is_an_error(self):
        with open('/dev/full', 'w') as full:
            result = run('info', STILL, stdout=full)
        self.assertEqual(result.returncode, IO_ERROR)
        self.assertEqual(result.stderr, 'facescan: cannot write to standard output\n')

    def test_a_reader_that_goes_away_does_not_stop_a_batch(self):
        process = subprocess.Popen([FACESCAN, 'replay', STILL, STEPS, '-o', self.path('out'),
                                    '--no-preview'], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.close()
        process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(), IO_ERROR)
        self.assertEqual(sorted(os.listdir(self.path('out'))), ['face_still', 'steps'])


class Writing(Case):
    def test_a_folder_that_cannot_be_made_is_an_error_of_writing(self):
        open(self.path('file'), 'w').close()
        self.fail_with(CANNOT_CREATE, 'replay', STILL, '-o', self.path('file', 'out'),
                       '--no-preview')
        self.assertEqual(os.listdir(self.folder), ['file'])

    def test_a_full_disk_leaves_not_even_an_empty_folder(self):
        self.fail_with(CANNOT_CREATE, 'replay', STILL, '-o', self.path('new', 'out'),
                       '--no-preview', max_file_bytes=1 << 20)
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_full_disk_fails_each_scan_of_a_batch_and_leaves_nothing(self):
        result = run('replay', STILL, STEPS, '-o', self.path('out'), '--no-preview',
                     max_file_bytes=1 << 20)
        self.assertEqual(result.returncode, CANNOT_CREATE)
        self.assertEqual(len(result.stderr.splitlines()), 2)
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_full_disk_leaves_earlier_results_as_they_were(self):
        self.succeed('replay', STEPS, '-o', self.path('out'), '--no-preview')
        before = {name: read(self.path('out', name)) for name in files_under(self.path('out'))}
        self.fail_with(CANNOT_CREATE, 'replay', STILL, '-o', self.path('out'), '--no-preview',
                       max_file_bytes=1 << 20)
        after = {name: read(self.path('out', name)) for name in files_under(self.path('out'))}
        self.assertEqual(before, after)

    def test_an_interrupted_batch_leaves_whole_results_only(self):
        bundles = [self.path(f'scan{k}') for k in range(40)]
        for bundle in bundles:
            os.symlink(STILL, bundle)
        process = subprocess.Popen([FACESCAN, 'replay', *bundles, '-o', self.path('out'),
                                    '--threads', '2'],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not os.path.exists(self.path('out')):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), -signal.SIGINT)
        done = os.listdir(self.path('out'))
        self.assertLess(len(done), len(bundles))
        for name in done:
            self.assertEqual(files_under(self.path('out', name)),
                             ['mesh.ply', 'preview.png', 'report.json', 'texture.png'])


class WithoutOpenGl(Case):
    ENV = {'__EGL_VENDOR_LIBRARY_DIRS': '/nonexistent'}

    def test_the_mesh_is_written_and_one_line_says_what_is_missing(self):
        self.succeed('replay', STEPS, '-o', self.path('out'))
        result = run('replay', STILL, '-o', self.path('out'), env=self.ENV)
        self.assertEqual(result.returncode, OK)
        self.assertRegex(result.stderr, r'\Afacescan: no preview: EGL[^\n]+: install [^\n]+\n\Z')
        self.assertEqual(files_under(self.path('out')), ['mesh.ply', 'report.json', 'texture.png'])

    def test_a_batch_says_it_once(self):
        result = run('replay', STILL, STEPS, '-o', self.path('out'), '--threads', 2, env=self.ENV)
        self.assertEqual(result.returncode, OK)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertEqual(sorted(os.listdir(self.path('out'))), ['face_still', 'steps'])


class NoSurface(Case):
    """Frames that show no face: a verdict in words, and no mesh that pretends to be one."""
    BYTES = 16 * 480 * 768

    def expect_no_mesh(self, pixels):
        bundle = write_bundle(self.path('bundle'), pixels)
        self.succeed('replay', STEPS, '-o', self.path('out'), '--no-preview')
        line = self.fail_with(NO_SURFACE, 'replay', bundle, '-o', self.path('out'))
        self.assertEqual(files_under(self.path('out')), ['report.json', 'texture.png'])
        quality = json.loads(read(self.path('out', 'report.json')))['quality']
        self.assertEqual(quality['grade'], 'repeat')
        self.assertGreater(len(quality['verdict'].split()), 3)
        self.assertIn(quality['verdict'], line)

    def test_black_frames(self):
        self.expect_no_mesh(bytes(self.BYTES))

    def test_white_frames(self):
        self.expect_no_mesh(b'\xff' * self.BYTES)

    def test_nothing_but_noise(self):
        self.expect_no_mesh(random.Random(1).randbytes(self.BYTES))

    def test_a_bad_bundle_of_the_same_batch_decides_the_status(self):
        black = write_bundle(self.path('black'), bytes(self.BYTES))
        bad = write_truncated_bundle(self.path('bad'))
        result = run('replay', black, bad, '-o', self.path('out'))
        self.assertEqual(result.returncode, DATA_ERROR)
        self.assertEqual(os.listdir(self.path('out')), ['black'])


if __name__ == '__main__':
    main()
