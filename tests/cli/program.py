"""What the tests of the built program share: running it, and making scans for it."""
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
DATA = os.path.join(ROOT, 'tests', 'data')
FACESCAN = os.path.join(os.environ['SCANEVAL_BIN'], 'facescan')
STILL = os.path.join(DATA, 'face_still')
STEPS = os.path.join(DATA, 'steps')

sys.path.insert(0, os.path.join(ROOT, 'tests', 'evaluator'))

# sysexits.h
OK, USAGE, DATA_ERROR, NO_INPUT, UNAVAILABLE = 0, 64, 65, 66, 69
CANNOT_CREATE, IO_ERROR, NO_SURFACE = 73, 74, 75


def leak_check(arguments):
    """ASAN_OPTIONS of a run: leaks are looked for where Mesa has no part in it."""
    draws = 'replay' in arguments and '--no-preview' not in arguments
    return f'detect_leaks={int(not draws)}'


def run(*arguments, env=None, max_file_bytes=None, **options):
    """Runs facescan and returns its status, standard output and standard error, as text."""
    def limit():
        if max_file_bytes is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (max_file_bytes, max_file_bytes))
    options = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, **options}
    return subprocess.run([FACESCAN, *map(str, arguments)], text=True, preexec_fn=limit,
                          env={**os.environ, 'ASAN_OPTIONS': leak_check(arguments), **(env or {})},
                          **options)


def read(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


def png_header(*path):
    """(width, height, bits a channel, colour type: 0 grey, 2 RGB)"""
    data = read(*path)
    assert data[:8] == b'\x89PNG\r\n\x1a\n' and data[-8:-4] == b'IEND', 'no whole PNG file'
    return struct.unpack('>IIBB', data[16:26])


def write_bundle(folder, pixels, width=480, height=768, frames=16):
    """A bundle with the description of face_still and other pixels."""
    header = struct.pack('<8sHHIIIIIQQI8x', b'FSCANBIN', 1, 64, 0x59455247, frames, width, height,
                         width, 0, 0, zlib.crc32(pixels))
    os.makedirs(folder)
    shutil.copy(os.path.join(STILL, 'scan.xml'), folder)
    with open(os.path.join(folder, 'frames.bin'), 'wb') as file:
        file.write(header + struct.pack('<I', zlib.crc32(header)) + pixels)
    return folder


def write_truncated_bundle(folder):
    """A bundle whose frames end too early."""
    shutil.copytree(STILL, folder)
    frames = os.path.join(folder, 'frames.bin')
    os.chmod(frames, 0o644)
    os.truncate(frames, 1000)
    return folder


def files_under(folder):
    """Every file and folder below, relative to it."""
    return sorted(os.path.relpath(os.path.join(at, name), folder)
                  for at, folders, files in os.walk(folder) for name in folders + files)


class Case(unittest.TestCase):
    """A test with a folder of its own, `self.folder`, that goes afterwards."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def succeed(self, *arguments, **options):
        """Runs facescan, which must end with status 0 and print no error; returns its output."""
        result = run(*arguments, **options)
        self.assertEqual((result.returncode, result.stderr), (OK, ''))
        return result.stdout

    def fail_with(self, status, *arguments, **options):
        """Runs facescan, which must end with the status and one line on standard error, which is
        returned."""
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertRegex(result.stderr, r'\Afacescan: [^\n]+\n\Z')
        return result.stderr


def main():
    unittest.main(verbosity=2, warnings='ignore')  # the evaluator leaves files to be closed by Python
