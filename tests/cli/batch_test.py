"""facescan replay of many bundles: lists of them, and going on after an interruption."""
import json
import os
import random
import shutil
import subprocess
import time

from program import (FACESCAN, STEPS, STILL, Case, DATA_ERROR, NO_INPUT, NO_SURFACE, OK, USAGE,
                     files_under, main, read, run, write_bundle, write_truncated_bundle)


def identity(*path):
    """What changes when a file is written anew."""
    status = os.stat(os.path.join(*path))
    return status.st_ino, status.st_mtime_ns


class Batch(Case):
    def bundles(self, *names, of=STEPS):
        """Bundles in the folder `scans`, named relative to the test's."""
        for name in names:
            os.makedirs(os.path.dirname(self.path('scans', name)), exist_ok=True)
            os.symlink(of, self.path('scans', name))
        return ['scans/' + name for name in names]

    def replay(self, *arguments, **options):
        return run('replay', '-o', 'out', '--no-preview', *arguments, cwd=self.folder, **options)

    def succeed_in_replay(self, *arguments, **options):
        result = self.replay(*arguments, **options)
        self.assertEqual((result.returncode, result.stderr), (OK, ''))
        return result.stdout


class FromList(Batch):
    def test_a_file_lists_the_bundles(self):
        with open(self.path('list'), 'w') as file:
            file.write('\n'.join(self.bundles('a', 'b')))
        self.succeed_in_replay('--from', 'list')
        self.assertEqual(sorted(os.listdir(self.path('out'))), ['a', 'b'])

    def test_standard_input_may_have_nuls(self):
        self.succeed_in_replay('--from', '-', input='\0'.join(self.bundles('a', 'b\nc')))
        self.assertEqual(sorted(os.listdir(self.path('out'))), ['a', 'b\nc'])

    def test_a_single_one_has_a_folder_of_its_name_like_any_other(self):
        self.succeed_in_replay('--from', '-', input=self.bundles('a')[0])
        self.assertEqual(os.listdir(self.path('out')), ['a'])

    def test_an_empty_list_is_done_at_once(self):
        self.assertEqual(self.succeed_in_replay('--from', '-', input='\n'), '')
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_list_that_is_missing_is_a_missing_input(self):
        result = self.replay('--from', 'missing')
        self.assertEqual(result.returncode, NO_INPUT)
        self.assertIn('cannot read missing', result.stderr)

    def test_bundles_are_named_here_or_there(self):
        for arguments in ([], ['--from', '-', STILL]):
            result = self.replay(*arguments, input=STEPS)
            self.assertEqual(result.returncode, USAGE, result.stderr)
            self.assertEqual(os.listdir(self.folder), [])

    def test_bundles_of_one_name_can_keep_their_paths(self):
        bundles = self.bundles('anna/1', 'bert/1')
        result = self.replay(*bundles)
        self.assertEqual(result.returncode, USAGE)
        self.assertIn('--keep-paths', result.stderr)
        self.succeed_in_replay(*bundles, '--keep-paths')
        self.assertEqual(sorted(os.listdir(self.path('out', 'scans'))), ['anna', 'bert'])
        self.assertIn('mesh.ply', os.listdir(self.path('out', 'scans', 'anna', '1')))

    def test_no_path_leads_out_of_the_output_folder(self):
        for bundle in (STEPS, '../scan'):
            self.assertEqual(self.replay(bundle, '--keep-paths').returncode, USAGE)
        self.assertEqual(os.listdir(self.folder), [])


class Resume(Batch):
    def identities(self):
        return {name: identity(self.path('out', name)) for name in files_under(self.path('out'))}

    def test_leaves_alone_what_is_done(self):
        bundles = self.bundles('a', 'b')
        self.succeed_in_replay(*bundles)
        before = self.identities()
        more = self.bundles('c')
        self.assertEqual(self.succeed_in_replay(*bundles, *more, '--resume').splitlines()[-1],
                         '2 of 3 done before')
        after = self.identities()
        self.assertEqual({name: after[name] for name in before if '/' in name},
                         {name: before[name] for name in before if '/' in name})
        self.assertIn('c/mesh.ply', after)

    def test_without_it_all_is_made_anew(self):
        bundles = self.bundles('a', 'b')
        self.succeed_in_replay(*bundles)
        before = self.identities()
        self.succeed_in_replay(*bundles)
        self.assertNotEqual(self.identities()['a/mesh.ply'], before['a/mesh.ply'])

    def test_json_has_the_same_lines_again(self):
        bundles = self.bundles('a', 'b')
        first = self.succeed_in_replay(*bundles, '--json')
        self.assertEqual(self.succeed_in_replay(*bundles, '--json', '--resume'), first)

    def expect_anew(self, *options):
        """Resumes, which must make the results again, as a replay into an empty folder does."""
        before = identity(self.path('out', 'report.json')) if os.path.exists(
            self.path('out', 'report.json')) else None
        self.succeed_in_replay('bundle', '--resume', *options)
        self.assertNotEqual(identity(self.path('out', 'report.json')), before)
        run('replay', 'bundle', '-o', 'fresh', '--no-preview', *options, cwd=self.folder)
        self.assertEqual(files_under(self.path('out')), files_under(self.path('fresh')))
        for name in ('mesh.ply', 'texture.png'):
            self.assertEqual(read(self.path('out', name)), read(self.path('fresh', name)))

    def test_makes_anew_what_is_not_whole_or_not_of_this_bundle_and_these_options(self):
        shutil.copytree(STEPS, self.path('bundle'))
        for file in os.listdir(self.path('bundle')):
            os.chmod(self.path('bundle', file), 0o644)

        def other_calibration():
            document = read(self.path('bundle', 'scan.xml')).decode()
            with open(self.path('bundle', 'scan.xml'), 'w') as file:
                file.write(document.replace('<range min="300"', '<range min="301"'))

        def other_version():
            report = read(self.path('out', 'report.json')).decode()
            with open(self.path('out', 'report.json'), 'w') as file:
                file.write(report.replace('"version": "', '"version": "0'))

        def other_pixels():
            shutil.copy(os.path.join(STILL, 'frames.bin'), self.path('bundle', 'frames.bin'))

        for spoil, options in (
                (lambda: os.remove(self.path('out', 'mesh.ply')), []),
                (lambda: os.truncate(self.path('out', 'mesh.ply'), 1000), []),
                (lambda: os.truncate(self.path('out', 'texture.png'), 0), []),
                (lambda: os.truncate(self.path('out', 'report.json'), 500), []),
                (lambda: os.truncate(self.path('out', 'report.json'), 0), []),
                (lambda: os.remove(self.path('out', 'report.json')), []),
                (other_version, []), (other_calibration, []), (other_pixels, []),
                (lambda: None, ['--no-smooth']), (lambda: None, ['--format', 'stl'])):
            with self.subTest(spoil=spoil, options=options):
                self.succeed_in_replay('bundle')
                spoil()
                self.expect_anew(*options)

    def test_a_scan_without_a_surface_is_done_too(self):
        bundle = write_bundle(self.path('black'), bytes(16 * 480 * 768))
        first = self.replay(bundle)
        before = self.identities()
        again = self.replay(bundle, '--resume')
        self.assertEqual((again.returncode, again.stderr), (NO_SURFACE, first.stderr))
        self.assertEqual(self.identities(), before)

    def test_a_bad_bundle_is_told_again(self):
        bad = write_truncated_bundle(self.path('bad'))
        first = self.replay(STEPS, bad)
        again = self.replay(STEPS, bad, '--resume')
        self.assertEqual((again.returncode, again.stderr), (DATA_ERROR, first.stderr))
        self.assertEqual(again.stdout, '1 of 2 done before\n')

    def test_what_a_killed_replay_left_goes(self):
        os.mkdir(self.path('out'))
        for name in ('.facescan-1-0.tmp', 'notes.tmp'):
            open(self.path('out', name), 'w').close()
        self.succeed_in_replay(STEPS, '--resume')
        self.assertEqual(files_under(self.path('out')),
                         ['mesh.ply', 'notes.tmp', 'report.json', 'texture.png'])

    def test_killed_at_any_moment_a_report_stands_beside_its_own_mesh_only(self):
        bundles = self.bundles('a', 'b', 'c', 'd')
        settings = {True: ['--smooth'], False: ['--no-smooth', '--gamma', '1']}
        expected = {}
        for smooth, options in settings.items():
            began = time.monotonic()
            self.succeed_in_replay(*bundles, *options)
            duration = time.monotonic() - began
            expected[smooth] = [read(self.path('out', 'a', n)) for n in ('mesh.ply', 'texture.png')]

        chance = random.Random(1)
        for k in range(16):
            smooth = k % 2 == 0
            replay = subprocess.Popen(
                [FACESCAN, 'replay', *bundles, '-o', 'out', '--no-preview', '--resume', '--threads',
                 '2', *settings[smooth]], cwd=self.folder, stdout=subprocess.DEVNULL)
            time.sleep(chance.uniform(0.2, 1) * duration)
            replay.kill()
            replay.wait()
            for name in 'abcd':
                if not os.path.exists(self.path('out', name, 'report.json')):
                    continue
                report = json.loads(read(self.path('out', name, 'report.json')))
                self.assertEqual([read(self.path('out', name, n))
                                  for n in ('mesh.ply', 'texture.png')],
                                 expected[report['options']['smooth']])
        self.succeed_in_replay(*bundles, '--resume', *settings[True])
        for name in 'abcd':
            self.assertEqual(files_under(self.path('out', name)),
                             ['mesh.ply', 'report.json', 'texture.png'])
            self.assertEqual(read(self.path('out', name, 'mesh.ply')), expected[True][0])


if __name__ == '__main__':
    main()
