"""The recipes of docs/batch.md, run as they stand there: GNU parallel over two hosts, which are two
loopback addresses of an ssh server of the test's own; a share of a Slurm array; the table."""
import contextlib
import csv
import os
import re
import shutil
import signal
import socket
import subprocess
import time
import unittest

from program import (FACESCAN, ROOT, STEPS, DATA_ERROR, OK, Case, files_under, main, read, run,
                     write_truncated_bundle)

SSHD = shutil.which('sshd', path='/usr/sbin:/usr/local/sbin:' + os.environ['PATH'])
MISSING = [name for name, found in (('parallel', shutil.which('parallel')),
                                    ('openssh-server', SSHD),
                                    ('openssh-client', shutil.which('ssh-keygen')))
           if not found]
PATH = os.path.dirname(FACESCAN) + ':' + os.environ['PATH']
# Of a host. While there is a file `hold`, the first two shares are done and the others wait.
HOLDING_FACESCAN = f'''#!/bin/sh
mkdir share1 2> /dev/null || mkdir share2 2> /dev/null || while [ -e hold ]; do sleep 0.05; done
exec {FACESCAN} "$@"
'''
PRIVILEGE_FOLDER = '/run/sshd'  # sshd wants it where it runs as root; its package makes it at boot


def recipe(heading, **replacements):
    """The shell commands below a heading of docs/batch.md."""
    text = read(ROOT, 'docs', 'batch.md').decode()
    commands = re.search(rf'\n## {re.escape(heading)}\n.*?```sh\n(.*?)```', text, re.DOTALL)[1]
    for old, new in replacements.values():
        assert old in commands, old
        commands = commands.replace(old, new)
    return commands


class Recipes(Case):
    SCANS = 9

    def setUp(self):
        super().setUp()
        for k in range(self.SCANS):
            os.makedirs(self.path('scans', f'person{k}'))
            os.symlink(STEPS, self.path('scans', f'person{k}', 'scan'))
        self.names = [f'scans/person{k}/scan' for k in range(self.SCANS)]
        with open(self.path('scans.txt'), 'w') as file:
            file.write('\n'.join(self.names) + '\n')

    def shell(self, commands, **env):
        return subprocess.run(['bash', '-c', commands], cwd=self.folder, text=True, timeout=600,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env={**os.environ, 'PATH': PATH, **env})

    def done(self):
        """{name: what changes when its files are written anew} of finished scans"""
        found = {}
        for name in self.names:
            folder = self.path('meshes', name)
            if os.path.exists(os.path.join(folder, 'report.json')):
                status = [os.stat(os.path.join(folder, file)) for file in sorted(os.listdir(folder))
                          if not file.startswith('.')]
                found[name] = [(s.st_ino, s.st_mtime_ns) for s in status]
        return found

    def expect_all_done(self):
        self.assertEqual(list(self.done()), self.names)
        run('replay', STEPS, '-o', self.path('reference'), '--no-preview')
        for name in self.names:
            self.assertEqual(files_under(self.path('meshes', name)),
                             ['mesh.ply', 'report.json', 'texture.png'])
            for file in ('mesh.ply', 'texture.png'):
                self.assertEqual(read(self.path('meshes', name, file)),
                                 read(self.path('reference', file)))


class OnOneMachine(Recipes):
    def test_a_list_made_by_find_is_replayed(self):
        os.remove(self.path('scans.txt'))
        result = self.shell(recipe('One machine', follow=('find scans', 'find -L scans')))
        self.assertEqual((result.returncode, result.stderr), (OK, ''))
        self.expect_all_done()

    def test_a_last_run_tells_what_failed(self):
        write_truncated_bundle(self.path('scans', 'bad'))
        with open(self.path('scans.txt'), 'a') as file:
            file.write('scans/bad\n')
        self.shell(recipe('One machine', follow=('find scans', 'find -L scans')))
        before = self.done()
        result = self.shell(recipe('Going on after an interruption'))
        self.assertEqual(result.returncode, DATA_ERROR)
        self.assertRegex(read(self.path('failed.txt')).decode(),
                         r'\Afacescan: scans/bad/frames.bin: [^\n]+\n\Z')
        self.assertEqual(read(self.path('done.txt')).decode(), f'{self.SCANS} of {self.SCANS + 1} done before\n')
        self.assertEqual(self.done(), before)

    def test_shares_of_a_slurm_array_make_up_the_whole(self):
        scans = 0
        for share in range(3):
            result = self.shell(recipe('Several machines with Slurm'), SLURM_ARRAY_TASK_COUNT='3',
                                SLURM_ARRAY_TASK_ID=str(share), SLURM_CPUS_PER_TASK='2')
            self.assertEqual((result.returncode, result.stderr), (OK, ''))
            self.assertIn(len(result.stdout.splitlines()), (self.SCANS // 3, self.SCANS // 3 + 1))
            scans += len(result.stdout.splitlines())
        self.assertEqual(scans, self.SCANS)
        self.expect_all_done()

    @unittest.skipUnless(shutil.which('jq'), 'no jq: install the package of this name')
    def test_reports_become_a_table(self):
        run('replay', '--from', 'scans.txt', '--keep-paths', '-o', 'meshes', '--no-preview',
            cwd=self.folder)
        result = self.shell(recipe('One table of all reports'))
        self.assertEqual((result.returncode, result.stderr), (OK, ''))
        with open(self.path('table.csv'), newline='') as file:
            rows = sorted(csv.reader(file))
        self.assertEqual([row[0] for row in rows], sorted(self.names))
        for row in rows:
            self.assertIn(row[1], ('good', 'usable', 'repeat'))
            self.assertGreater(int(row[6]), 1000)


@unittest.skipIf(MISSING, 'install ' + ' '.join(MISSING))
class OnTwoHosts(Recipes):
    """Nothing of the system's ssh is touched: keys, configuration and port are the test's own."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path('bin'))
        with open(self.path('bin', 'facescan'), 'w') as file:
            file.write(HOLDING_FACESCAN)
        os.chmod(self.path('bin', 'facescan'), 0o755)
        self.start_server()
        with open(self.path('hosts.txt'), 'w') as file:
            file.write('host1\nhost2\n')
        self.env = {**os.environ, 'PARALLEL_SSH': 'ssh -F ' + self.path('ssh_config'),
                    'PARALLEL_HOME': self.path('parallel'), 'PATH': PATH}
        self.recipe = recipe('Several machines with GNU parallel', share=('-N 500', '-N 2'))

    def start_server(self):
        if os.geteuid() == 0 and not os.path.isdir(PRIVILEGE_FOLDER):
            os.mkdir(PRIVILEGE_FOLDER, 0o755)
            self.addCleanup(os.rmdir, PRIVILEGE_FOLDER)
        for key in ('key', 'host_key'):
            subprocess.run(['ssh-keygen', '-q', '-t', 'ed25519', '-N', '', '-f', self.path(key)],
                           check=True)
        with socket.socket() as free:
            free.bind(('127.0.0.1', 0))
            port = free.getsockname()[1]
        with open(self.path('sshd_config'), 'w') as file:
            file.write(f'Port {port}\nListenAddress 127.0.0.1\nListenAddress 127.0.0.2\n'
                       f'HostKey {self.path("host_key")}\nPidFile none\nUsePAM no\n'
                       f'AuthorizedKeysFile {self.path("key.pub")}\nStrictModes no\n'
                       f'PasswordAuthentication no\nLogLevel FATAL\nSetEnv PATH={self.path("bin")}:{PATH}\n')
        with open(self.path('ssh_config'), 'w') as file:
            file.write('Host host1\n HostName 127.0.0.1\nHost host2\n HostName 127.0.0.2\n'
                       f'Host *\n Port {port}\n IdentityFile {self.path("key")}\n'
                       ' IdentitiesOnly yes\n BatchMode yes\n UserKnownHostsFile /dev/null\n'
                       ' StrictHostKeyChecking no\n LogLevel ERROR\n')
        server = subprocess.Popen([SSHD, '-D', '-e', '-f', self.path('sshd_config')])
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        self.wait_for(lambda: self.accepts(port))

    @staticmethod
    def accepts(port):
        with contextlib.suppress(OSError), socket.create_connection(('127.0.0.2', port)):
            return True
        return False

    def wait_for(self, condition):
        deadline = time.monotonic() + 300
        while not condition():
            self.assertLess(time.monotonic(), deadline, 'waited in vain')
            time.sleep(0.02)

    def start(self):
        return subprocess.Popen(['bash', '-c', 'exec ' + self.recipe], cwd=self.folder,
                                env=self.env, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True)

    def hosts_work(self):
        """Whether any process is left in this test's folder."""
        for process in filter(str.isdigit, os.listdir('/proc')):
            with contextlib.suppress(OSError):
                if os.readlink(f'/proc/{process}/cwd') == os.path.realpath(self.folder):
                    return True
        return False

    def shares(self):
        """(host, exit status) of each share in the log."""
        lines = read(self.path('batch.log')).decode().splitlines()[1:]
        return [(line.split('\t')[1], int(line.split('\t')[6])) for line in lines]

    def test_both_hosts_do_their_shares(self):
        parallel = self.start()
        _, errors = parallel.communicate(timeout=600)
        self.assertEqual((parallel.returncode, errors), (OK, ''))
        self.expect_all_done()
        shares = self.shares()
        self.assertEqual(len(shares), -(-self.SCANS // 2))
        self.assertEqual(set(shares), {('host1', OK), ('host2', OK)})

    def test_the_status_of_a_share_is_in_the_log(self):
        write_truncated_bundle(self.path('scans', 'bad'))
        with open(self.path('scans.txt'), 'w') as file:
            file.write('scans/person0/scan\nscans/person1/scan\nscans/bad\n')
        parallel = self.start()
        parallel.communicate(timeout=600)
        self.assertEqual(parallel.returncode, 1)  # so many shares failed
        self.assertEqual(sorted(status for _, status in self.shares()), [OK, DATA_ERROR])

    def test_an_interrupted_batch_goes_on_and_does_no_scan_twice(self):
        for stop in (signal.SIGTERM, signal.SIGKILL):
            with self.subTest(signal=stop):
                for folder in ('meshes', 'share1', 'share2'):
                    shutil.rmtree(self.path(folder), ignore_errors=True)
                open(self.path('hold'), 'w').close()
                parallel = self.start()
                self.wait_for(lambda: len(self.done()) >= 4)
                parallel.send_signal(stop)
                parallel.wait(timeout=600)
                os.remove(self.path('hold'))
                parallel.communicate(timeout=600)
                self.wait_for(lambda: not self.hosts_work())
                before = self.done()
                self.assertGreaterEqual(len(before), 4)
                self.assertLess(len(before), self.SCANS)

                parallel = self.start()
                _, errors = parallel.communicate(timeout=600)
                self.assertEqual((parallel.returncode, errors), (OK, ''))
                after = self.done()
                self.assertEqual({name: after[name] for name in before}, before)
                self.expect_all_done()


if __name__ == '__main__':
    main()
