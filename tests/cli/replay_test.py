"""facescan replay, run from outside."""
import json
import os
import pty
import zlib

from program import (DATA, STEPS, STILL, Case, DATA_ERROR, NO_INPUT, USAGE, files_under, png_header,
                     main, read, run, write_truncated_bundle)
from scaneval import read_ply

STAGES = ['preprocess', 'decode', 'texture', 'filter', 'motion', 'smooth', 'calibrate', 'fill',
          'tessellate', 'normals', 'mesh', 'quality']


class OneScan(Case):
    def replay(self, *options, bundle=STILL):
        return self.succeed('replay', bundle, '-o', self.path('out'), *options)

    def report(self):
        return json.loads(read(self.path('out', 'report.json')))

    def test_leaves_mesh_texture_picture_and_report_in_the_folder_itself(self):
        self.replay()
        self.assertEqual(files_under(self.path('out')),
                         ['mesh.ply', 'preview.png', 'report.json', 'texture.png'])

    def test_mesh_keeps_to_the_format(self):
        self.replay('--no-preview')
        vertices, triangles, complaints = read_ply(self.path('out', 'mesh.ply'))
        self.assertEqual(complaints, [])
        self.assertGreater(len(vertices), 10000)
        self.assertGreater(len(triangles), len(vertices))

    def test_texture_covers_the_image_rectangle_in_grey(self):
        self.replay('--no-preview')
        self.assertEqual(png_header(self.path('out', 'texture.png')), (480, 754, 8, 0))

    def test_picture_is_in_colour(self):
        self.replay()
        self.assertEqual(png_header(self.path('out', 'preview.png'))[2:], (8, 2))

    def test_no_preview_leaves_the_picture_out(self):
        self.replay('--no-preview')
        self.assertNotIn('preview.png', files_under(self.path('out')))

    def test_report_has_version_options_counts_times_and_quality(self):
        self.replay('--no-preview')
        report = self.report()
        self.assertEqual(list(report), ['version', 'bundle', 'input', 'options', 'formats',
                                        'preview', 'counts', 'milliseconds', 'quality', 'files',
                                        'bytes'])
        self.assertEqual(report['version'], self.succeed('--version').split()[1])
        self.assertEqual(report['bundle'], STILL)
        self.assertEqual(list(report['milliseconds']),
                         ['read', *STAGES, 'reconstruct', 'preview'])
        self.assertGreater(report['counts']['decode']['edges_decoded'], 10000)
        quality = report['quality']
        for key in ('coverage', 'holes_found', 'holes_filled', 'noise_mm', 'motion_max_px'):
            self.assertIsInstance(quality[key], (int, float), key)
        self.assertEqual([pair['pair'] for pair in quality['motion']], list(range(8)))
        self.assertIn(' ', quality['verdict'])
        self.assertEqual(report['files'], ['texture.png', 'mesh.ply', 'report.json'])
        self.assertEqual(report['bytes'], {name: os.path.getsize(self.path('out', name))
                                           for name in ('texture.png', 'mesh.ply')})

    def test_report_names_its_input_by_checksums(self):
        self.replay('--no-preview')
        document = zlib.crc32(read(STILL, 'scan.xml'))
        header = zlib.crc32(read(STILL, 'frames.bin')[:60])
        self.assertEqual(self.report()['input'], {'scan_xml_crc32': f'0x{document:08x}',
                                                  'frames_header_crc32': f'0x{header:08x}'})

    def test_table_names_stages_verdict_mesh_and_picture(self):
        table = self.replay()
        for stage in STAGES:
            self.assertRegex(table, rf'(?m)^{stage} +[0-9.]+ ms$')
        self.assertIn(self.path('out', 'mesh.ply'), table)
        self.assertIn(self.path('out', 'preview.png'), table)
        self.assertIn(self.report()['quality']['verdict'], table)

    def test_json_is_the_report_with_folder_and_status(self):
        document = json.loads(self.replay('--no-preview', '--json'))
        self.assertEqual(document, {**self.report(), 'folder': self.path('out'), 'status': 0})

    def test_writes_the_other_formats_when_asked(self):
        self.replay('--format', 'obj,stl,glb', '--no-preview')
        self.assertEqual(files_under(self.path('out')),
                         ['mesh.glb', 'mesh.mtl', 'mesh.obj', 'mesh.ply', 'mesh.stl',
                          'report.json', 'texture.png'])
        self.assertEqual(read(self.path('out', 'mesh.glb'))[:4], b'glTF')
        self.assertIn(b'map_Kd texture.png', read(self.path('out', 'mesh.mtl')))
        vertices, triangles, _ = read_ply(self.path('out', 'mesh.ply'))
        self.assertEqual(len(read(self.path('out', 'mesh.stl'))), 84 + 50 * len(triangles))
        lines = read(self.path('out', 'mesh.obj')).split(b'\n')
        self.assertEqual(sum(line.startswith(b'v ') for line in lines), len(vertices))

    def test_format_takes_no_bundle_for_a_format(self):
        self.succeed('replay', '--no-preview', '-o', self.path('out'), '--format', 'stl', STILL)
        self.assertIn('mesh.stl', files_under(self.path('out')))

    def test_results_of_an_earlier_scan_do_not_stay(self):
        self.replay('--format', 'obj,stl,glb')
        self.replay('--no-preview', bundle=STEPS)
        self.assertEqual(files_under(self.path('out')), ['mesh.ply', 'report.json', 'texture.png'])

    def test_other_files_of_the_folder_stay(self):
        os.makedirs(self.path('out', 'mesh'))
        open(self.path('out', 'notes.txt'), 'w').close()
        self.replay('--no-preview')
        self.assertIn('notes.txt', files_under(self.path('out')))
        self.assertIn('mesh', files_under(self.path('out')))

    def test_options_reach_the_stages_and_the_report(self):
        self.replay('--no-preview')
        with_holes_filled = self.report()
        self.replay('--no-preview', '--no-fill-holes', '--min-modulation', '40')
        without = self.report()
        self.assertGreater(with_holes_filled['counts']['fill']['holes_filled'], 0)
        self.assertEqual(without['counts']['fill']['holes_filled'], 0)
        self.assertLess(without['counts']['decode']['edges_found'],
                        with_holes_filled['counts']['decode']['edges_found'])
        self.assertEqual((without['options']['fill_holes'], without['options']['min_modulation']),
                         (False, 40))


class SeveralScans(Case):
    NAMES = ['face_flipped', 'face_still', 'face_tremor', 'steps']

    def bundles(self):
        return [os.path.join(DATA, name) for name in self.NAMES]

    def results(self, folder):
        """Every file's bytes; of the reports, all but the times."""
        results = {}
        for name in files_under(folder):
            if os.path.isdir(os.path.join(folder, name)):
                continue
            results[name] = read(folder, name)
            if name.endswith('report.json'):
                results[name] = {**json.loads(results[name]), 'milliseconds': None}
        return results

    def test_each_has_a_folder_named_as_its_bundle(self):
        self.succeed('replay', *self.bundles(), '-o', self.path('out'), '--no-preview')
        self.assertEqual(sorted(os.listdir(self.path('out'))), self.NAMES)

    def test_slashes_and_dots_are_no_part_of_a_name(self):
        os.symlink(STILL, self.path('anna'))
        self.succeed('replay', self.path('anna') + '//', '.', '-o', self.path('out'),
                     '--no-preview', cwd=STEPS)
        self.assertEqual(sorted(os.listdir(self.path('out'))), ['anna', 'steps'])

    def test_files_are_the_same_on_one_thread_on_four_and_again(self):
        for k, threads in enumerate((1, 4, 4)):
            self.succeed('replay', *self.bundles(), '-o', self.path(str(k)), '--threads', threads)
        first = self.results(self.path('0'))
        self.assertEqual(len(first), 4 * len(self.NAMES))
        self.assertEqual(first, self.results(self.path('1')))
        self.assertEqual(first, self.results(self.path('2')))

    def test_a_scan_is_the_same_alone_and_after_others(self):
        self.succeed('replay', *self.bundles(), '-o', self.path('out'), '--threads', 1)
        self.succeed('replay', STEPS, '-o', self.path('alone'))
        for name in ('mesh.ply', 'texture.png', 'preview.png'):
            self.assertEqual(read(self.path('alone', name)), read(self.path('out', 'steps', name)))

    def test_json_has_a_line_for_each_in_the_order_of_the_bundles(self):
        bundles = self.bundles()[::-1]
        lines = self.succeed('replay', *bundles, '-o', self.path('out'), '--json', '--no-preview',
                             '--threads', 4).splitlines()
        self.assertEqual([json.loads(line)['bundle'] for line in lines], bundles)

    def test_a_terminal_has_a_progress_bar_that_goes_away(self):
        ours, theirs = pty.openpty()
        self.assertEqual(run('replay', STILL, STEPS, '-o', self.path('out'), '--no-preview',
                             stderr=theirs).returncode, 0)
        os.close(theirs)
        shown = os.read(ours, 10000).decode()
        os.close(ours)
        self.assertRegex(shown, r'\[=+ *\] 1/2')
        self.assertTrue(shown.endswith('\r\x1b[K'))

    def test_no_progress_bar_without_a_terminal(self):
        self.assertEqual(len(self.succeed('replay', *self.bundles(), '-o', self.path('out'),
                                          '--no-preview').splitlines()), len(self.NAMES))

    def test_a_bad_bundle_is_one_line_and_does_not_stop_the_others(self):
        bad = write_truncated_bundle(self.path('bad'))
        result = run('replay', STILL, bad, STEPS, '-o', self.path('out'), '--no-preview', '--json')
        self.assertEqual(result.returncode, DATA_ERROR)
        self.assertRegex(result.stderr, rf'\Afacescan: {bad}/frames.bin: [^\n]+\n\Z')
        self.assertEqual(sorted(os.listdir(self.path('out'))), ['face_still', 'steps'])
        documents = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([document['status'] for document in documents], [0, DATA_ERROR, 0])
        self.assertEqual('facescan: ' + documents[1]['error'] + '\n', result.stderr)

    def test_the_first_error_decides_the_status(self):
        bad = write_truncated_bundle(self.path('bad'))
        missing = self.path('missing')
        for bundles, status in (((missing, bad), NO_INPUT), ((bad, missing), DATA_ERROR)):
            result = run('replay', STILL, *bundles, '-o', self.path('out'), '--no-preview',
                         '--threads', 3)
            self.assertEqual(result.returncode, status)
            self.assertEqual(len(result.stderr.splitlines()), 2)

    def test_two_of_one_name_are_refused_before_anything_is_written(self):
        os.symlink(STEPS, self.path('face_still'))
        line = self.fail_with(USAGE, 'replay', STILL, self.path('face_still'), '-o',
                              self.path('out'))
        self.assertIn('same name, face_still', line)
        self.assertFalse(os.path.exists(self.path('out')))


if __name__ == '__main__':
    main()
