# SPDX-License-Identifier: Zlib
"""OBJ with its PC2 point cache, played by Blender's modifier Mesh Cache."""

import shutil
import subprocess

from exported import check, export, path, prepare, scene, skip

IN_BLENDER = '''
import struct, sys
import bpy
obj, cache = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=obj)
cloth = bpy.context.selected_objects[0]
modifier = cloth.modifiers.new('cache', 'MESH_CACHE')
modifier.cache_format = 'PC2'
modifier.filepath = cache
data = open(cache, 'rb').read()
points, frames = struct.unpack_from('<i', data, 16)[0], struct.unpack_from('<i', data, 28)[0]
assert len(cloth.data.vertices) == points, len(cloth.data.vertices)
assert len(data) == 32 + 12 * points * frames
assert len(cloth.data.uv_layers) == 1
for frame in (0, frames // 2, frames - 1):
    bpy.context.scene.frame_set(frame)
    mesh = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    seen = [x for vertex in mesh.vertices for x in vertex.co]
    expected = struct.unpack_from('<%df' % (3 * points), data, 32 + 12 * points * frame)
    assert max(abs(a - b) for a, b in zip(seen, expected)) < 1e-6, frame
assert any(a != b for a, b in zip(struct.unpack_from('<3f', data, 32), expected))
print('all frames agree')
'''

if not shutil.which('blender'):
    skip('Blender is not installed (Debian: apt install blender)')
prepare()
folder, _ = export(scene(duration_s=0.5), 'obj_pc2', 'obj')
with open(path('check.py'), 'w') as file:
    file.write(IN_BLENDER)
done = subprocess.run(['blender', '-b', '--factory-startup', '--python-exit-code', '1', '--python', path('check.py'), '--',
                       folder + '/cloth.obj', folder + '/cloth.pc2'], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
text = done.stdout.decode()
if 'obj_import" error, could not be found' in text:
    skip('this Blender is older than 3.3, which reads OBJ by another name')
check(done.returncode == 0 and 'all frames agree' in text, text)
