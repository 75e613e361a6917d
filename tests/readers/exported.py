# SPDX-License-Identifier: Zlib
"""What the tests of exported files share: a scene, the command, and what the command says of the run."""

import json
import os
import shutil
import subprocess
import sys

COMMAND, SOURCE_DIR, WORK_DIR = sys.argv[1:4] if len(sys.argv) > 3 else (None, None, None)


def skip(message):
    print('skipped: ' + message)
    sys.exit(77)


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def near(value, expected, tolerance, what):
    check(abs(value - expected) <= tolerance, '%s is %r, not %r within %g' % (what, value, expected, tolerance))


def prepare():
    shutil.rmtree(WORK_DIR, ignore_errors=True)
    os.makedirs(WORK_DIR)


def path(name):
    return os.path.join(WORK_DIR, name)


def scene(**changes):
    """Writes the small scene of the tests, a cloth of 5 x 4 nodes over a ball; returns its file."""
    with open(os.path.join(SOURCE_DIR, 'tests', 'scenes', 'small.json')) as file:
        content = json.load(file)
    content.update(changes)
    with open(path('scene.json'), 'w') as file:
        json.dump(content, file)
    return path('scene.json')


def wetcloth(*arguments):
    """Runs the command; returns what it says as JSON."""
    done = subprocess.run([COMMAND, *arguments, '--json', '-'], stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout)


def export(scene_file, out_format, name, *more):
    """Returns the path of what was written, and what the command says."""
    return path(name), wetcloth('export', scene_file, '--format', out_format, '--out', path(name), '--fps', '60', *more)
