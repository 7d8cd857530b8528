#!/usr/bin/python3
"""Checks the evaluator with meshes whose score is known: the true surface, as seen by the camera."""
import json
import os
import tempfile
import unittest

import numpy as np

import scaneval

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'data', 'truth')
PIXELS_PER_CELL = 4


def true_grid(name):
    """The true surface on a grid of pixels: points (rows, columns, 3) in mm and texture coordinates.
    Points out of the scanner's range are NaN."""
    with open(f'{DATA}/{name}/truth.json') as f:
        truth = json.load(f)
    maps = np.load(f'{DATA}/{name}/maps.npz')
    near, far = truth['zrange']
    depth = np.where((maps['z0'] >= near) & (maps['z0'] <= far), maps['z0'], np.nan)
    x0, y0, width, height = truth['crop']
    y, x = np.mgrid[y0:y0 + height:PIXELS_PER_CELL, x0:x0 + width:PIXELS_PER_CELL]
    camera = truth['camera']
    xd, yd = (x - camera['cx']) / camera['fx'], (y - camera['cy']) / camera['fy']
    u, v = xd.copy(), yd.copy()
    for _ in range(20):
        r2 = u * u + v * v
        q = 1 + camera['k1'] * r2 + camera['k2'] * r2 * r2
        u, v = xd / q, yd / q
    z = depth[y, x]
    st = np.stack([(x - x0 + 0.5) / width, 1 - (y - y0 + 0.5) / height], -1)
    return np.stack([u * z, v * z, z], -1), st


def grid_mesh(points, st):
    """Two triangles a cell, counter-clockwise seen from the camera, where all four corners are seen."""
    rows, columns = points.shape[:2]
    index = np.arange(rows * columns).reshape(rows, columns)
    corners = [index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]]
    a, b, c, d = (k.ravel() for k in corners)
    faces = np.concatenate([np.stack([a, b, d], 1), np.stack([b, c, d], 1)])
    flat = points.reshape(-1, 3)
    faces = faces[np.isfinite(flat[faces]).all((1, 2))]
    used, faces = np.unique(faces, return_inverse=True)
    return flat[used], st.reshape(-1, 2)[used], faces.reshape(-1, 3)


class Evaluator(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.points, self.st = true_grid('plane_near')

    def score(self, points, name='plane_near', quality=1.0, faces_too=None):
        vertices, st, faces = grid_mesh(points, self.st)
        if faces_too is not None:
            faces = faces_too(faces)
        record = np.zeros(len(vertices), [(k, '<f4') for k in ('x', 'y', 'z', 's', 't', 'quality')])
        for i, k in enumerate('xyz'):
            record[k] = vertices[:, i]
        record['s'], record['t'], record['quality'] = st[:, 0], st[:, 1], quality
        triangle = np.zeros(len(faces), [('n', 'u1'), ('v', '<u4', 3)])
        triangle['n'], triangle['v'] = 3, faces
        properties = '\n'.join(f'property float {k}' for k in record.dtype.names)
        header = (f'ply\nformat binary_little_endian 1.0\ncomment TextureFile texture.png\n'
                  f'element vertex {len(record)}\n{properties}\n'
                  f'element face {len(faces)}\nproperty list uchar uint vertex_indices\nend_header\n')
        path = os.path.join(self.folder.name, 'mesh.ply')
        open(os.path.join(self.folder.name, 'texture.png'), 'wb').close()
        with open(path, 'wb') as f:
            f.write(header.encode() + record.tobytes() + triangle.tobytes())
        return scaneval.evaluate(os.path.join(DATA, name), path)[0]

    def test_the_true_surface_has_no_error_full_coverage_and_no_faults(self):
        score = self.score(self.points)
        self.assertEqual(score['contract'], [])
        self.assertLess(score['vertex_error']['rms'], 0.001)
        self.assertLess(score['normal_error_deg']['p90'], 0.05)
        self.assertGreater(score['coverage']['within_1mm_area'], 0.99)
        self.assertEqual(score['texture']['best'], 'crop')
        topology = score['topology']
        self.assertEqual(topology['ccw_from_camera_share'], 1)
        for fault in ('unused_vertices', 'degenerate_faces', 'duplicate_faces', 'nonmanifold_edges',
                      'nonmanifold_vertices', 'inconsistent_edges'):
            self.assertEqual(topology[fault], 0, fault)

    def test_a_true_face_has_no_error(self):
        self.points, self.st = true_grid('face_still')
        steep = np.abs(np.diff(self.points[..., 2], axis=0, append=np.nan)) > 3
        self.points[steep] = np.nan
        score = self.score(self.points, name='face_still')
        self.assertLess(score['vertex_error']['median_abs'], 0.005)
        self.assertLess(score['vertex_error']['p95'], 0.02)

    def test_an_offset_towards_the_scanner_is_a_positive_error_of_its_size(self):
        normal = np.cross(self.points[5, 0] - self.points[0, 0], self.points[0, 5] - self.points[0, 0])
        normal *= -np.sign(normal[2]) / np.linalg.norm(normal)
        score = self.score(self.points + 0.1 * normal)
        self.assertAlmostEqual(score['vertex_error']['mean'], 0.1, places=3)
        self.assertAlmostEqual(score['vertex_error']['rms'], 0.1, places=3)
        self.assertAlmostEqual(score['plane']['offset_mm'], -0.1, places=3)

    def test_half_of_the_surface_is_half_of_the_coverage(self):
        self.points[:, self.points.shape[1] // 2:] = np.nan
        self.assertAlmostEqual(self.score(self.points)['coverage']['within_1mm_area'], 0.5, places=1)

    def test_filled_vertices_are_scored_apart(self):
        score = self.score(self.points + 0.2, quality=0)
        self.assertIsNone(score['vertex_error'])
        self.assertGreater(score['filled_error']['rms'], 0.1)

    def test_a_hole_inside_is_counted_with_its_size(self):
        self.points[40:42, 40:42] = np.nan
        self.points[80:120, 40:80] = np.nan
        self.assertEqual(self.score(self.points)['holes'], {'up_to_10mm': 1, 'larger': 1})

    def test_a_face_turned_round_and_a_face_twice_are_faults(self):
        turned = self.score(self.points, faces_too=lambda f: np.r_[f[:9, ::-1], f[9:]])
        self.assertGreater(turned['topology']['inconsistent_edges'], 0)
        twice = self.score(self.points, faces_too=lambda f: np.r_[f, f[:1]])
        self.assertEqual(twice['topology']['duplicate_faces'], 1)


if __name__ == '__main__':
    unittest.main(warnings='ignore')
