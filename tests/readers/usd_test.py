# SPDX-License-Identifier: Zlib
"""USD as text, read by Pixar's library."""

from exported import check, export, near, prepare, scene, skip, wetcloth

try:
    from pxr import Usd, UsdGeom
except ImportError:
    skip("Pixar's USD for Python is not installed (pip install usd-core)")

prepare()
small = scene(duration_s=0.5)
run = wetcloth('run', small)
file, said = export(small, 'usda', 'run.usda')
stage = Usd.Stage.Open(file)
check(UsdGeom.GetStageUpAxis(stage) == 'Y', 'up axis')
near(UsdGeom.GetStageMetersPerUnit(stage), 1, 0, 'metres per unit')
near(stage.GetTimeCodesPerSecond(), 60, 1e-6, 'time codes per second')
near(stage.GetEndTimeCode(), said['frames'] - 1, 0, 'last time code')
meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
check(len(meshes) == 2, 'a cloth and a ball, not %d meshes' % len(meshes))
cloth = meshes[0]
last = stage.GetEndTimeCode()
points = cloth.GetPointsAttr().Get(last)
check(len(points) == run['nodes'], 'points: %d' % len(points))
check(points != cloth.GetPointsAttr().Get(0), 'the points do not move')
wetness = UsdGeom.PrimvarsAPI(cloth).GetPrimvar('wetness')
check(wetness.GetInterpolation() == 'vertex', wetness.GetInterpolation())
near(max(wetness.Get(last)), run['saturation']['max'], 1e-6, 'greatest wetness')
check(len(cloth.GetNormalsAttr().Get(last)) == run['nodes'], 'normals')
check(len(cloth.GetFaceVertexIndicesAttr().Get()) == 3 * 24, 'corners of triangles')
