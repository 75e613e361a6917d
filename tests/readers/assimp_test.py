# SPDX-License-Identifier: Zlib
"""OBJ and PLY, read by the Open Asset Import Library."""

import re
import shutil
import subprocess

from exported import check, export, prepare, scene, skip

if not shutil.which('assimp'):
    skip('assimp is not installed (Debian: apt install assimp-utils)')


def info(file):
    done = subprocess.run(['assimp', 'info', file], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=True)
    text = done.stdout.decode()
    number = {name: int(re.search(name + r':\s+(\d+)', text).group(1)) for name in ('Meshes', 'Vertices', 'Faces')}
    return number, text


prepare()
small = scene()
folder, _ = export(small, 'obj_pc2', 'obj')
cloth, text = info(folder + '/cloth.obj')
check(cloth == {'Meshes': 1, 'Vertices': 20, 'Faces': 24}, text)
check('triangles' in text and 'lines' not in text, text)
scenery, text = info(folder + '/scenery.obj')
check(scenery['Meshes'] == 1 and scenery['Faces'] > 100, text)
check('lines' not in text, text)  # a sphere's poles have no triangles without area
folder, said = export(small, 'ply', 'ply')
for file in said['files']:
    check(info(file['file'])[0] == {'Meshes': 1, 'Vertices': 20, 'Faces': 24}, file['file'])
