"""facescan simulate, and what its scans become. Skips where the simulator is not built."""
import json
import os
import unittest

from program import (Case, CANNOT_CREATE, DATA_ERROR, NO_INPUT, UNAVAILABLE, USAGE, files_under,
                     main, read, run)

HAS_SIMULATOR = run('simulate', '/nonexistent/parent/scan').returncode != UNAVAILABLE
HAS_EVALUATOR = os.path.exists(os.path.join(os.environ['SCANEVAL_BIN'], 'meshdist'))

QUICK = ('--size', '240x384', '--samples', 2)


@unittest.skipUnless(HAS_SIMULATOR, 'facescan was built without its simulator')
class Simulate(Case):
    def info(self, name):
        return json.loads(self.succeed('info', self.path(name), '--json'))

    def test_writes_a_sound_bundle_and_its_truth(self):
        self.succeed('simulate', self.path('scan'), '--scene', 'plane', *QUICK)
        self.assertEqual(files_under(self.path('scan')),
                         ['frames.bin', 'scan.xml', 'truth', 'truth/maps.npz', 'truth/surface.npz',
                          'truth/truth.json'])
        self.assertTrue(self.info('scan')['sound'])

    def test_the_same_options_give_the_same_bytes(self):
        for name, threads in (('a', 1), ('b', 3)):
            self.succeed('simulate', self.path(name), '--scene', 'sphere', '--tremor-mm',
                         '0.2,0.2,0.2', '--seed', 3, '--threads', threads, '--no-truth', *QUICK)
        for name in ('frames.bin', 'scan.xml'):
            self.assertEqual(read(self.path('a', name)), read(self.path('b', name)))

    def test_device_and_pattern_are_as_asked_for(self):
        self.succeed('simulate', self.path('scan'), '--scene', 'plane', '--axis', 'x', '--bits', 7,
                     '--order', 'grouped', '--degree', 4, '--no-truth', *QUICK)
        info = self.info('scan')
        self.assertEqual((info['frames']['width'], info['frames']['height']), (384, 240))
        self.assertEqual(info['pattern'],
                         {'type': 'gray', 'bits': 7, 'axis': 'x', 'order': 'grouped'})
        self.assertEqual(info['calibration']['degree'], 4)

    def test_truth_can_go_elsewhere(self):
        self.succeed('simulate', self.path('scan'), '--scene', 'plane', '--truth',
                     self.path('truth', 'scan'), *QUICK)
        self.assertEqual(files_under(self.path('scan')), ['frames.bin', 'scan.xml'])
        self.assertIn('truth.json', os.listdir(self.path('truth', 'scan')))

    def test_does_not_write_over_another_scan(self):
        os.mkdir(self.path('scan'))
        open(self.path('scan', 'scan.xml'), 'w').close()
        self.fail_with(CANNOT_CREATE, 'simulate', self.path('scan'), '--scene', 'plane', *QUICK)
        self.assertEqual(files_under(self.folder), ['scan', 'scan/scan.xml'])

    def test_misuse_is_one_line(self):
        with open(self.path('empty.ply'), 'w') as file:
            file.write('no mesh')
        for options, status in ((['--size', '480'], USAGE), (['--size', '8x8'], USAGE),
                                (['--scene', 'tree'], USAGE), (['--bits', 3], USAGE),
                                (['--drift-mm', '1,2'], USAGE),
                                (['--mesh', self.path('none.ply')], NO_INPUT),
                                (['--mesh', self.path('empty.ply')], DATA_ERROR)):
            with self.subTest(options=options):
                self.fail_with(status, 'simulate', self.path('scan'), *options)
                self.assertEqual(os.listdir(self.folder), ['empty.ply'])

    @unittest.skipUnless(HAS_EVALUATOR, 'the evaluator was not built')
    def test_a_simulated_face_is_reconstructed_where_it_was(self):
        """A third of a millimetre is coarse even for a quarter of the usual pixels: what fails here
        is a frame, a sign or a unit."""
        from scaneval import evaluate
        self.succeed('simulate', self.path('scan'), '--face', 7, *QUICK)
        self.succeed('replay', self.path('scan'), '-o', self.path('out'), '--no-preview')
        scores, _ = evaluate(self.path('scan', 'truth'), self.path('out', 'mesh.ply'))
        self.assertEqual(scores['contract'], [])
        self.assertLess(scores['vertex_error']['median_abs'], 0.33)
        self.assertGreater(scores['coverage']['within_1mm_area'], 0.7)

    def test_a_head_from_a_file_is_scanned(self):
        self.succeed('simulate', self.path('sphere'), '--scene', 'sphere', *QUICK)
        self.succeed('replay', self.path('sphere'), '-o', self.path('mesh'), '--no-preview')
        self.succeed('simulate', self.path('again'), '--mesh', self.path('mesh', 'mesh.ply'),
                     '--mesh-as-is', *QUICK)
        self.assertTrue(self.info('again')['sound'])


if __name__ == '__main__':
    main()
