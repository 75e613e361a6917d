# SPDX-License-Identifier: Zlib
"""VTK PolyData with its .pvd, and PLY, read by VTK, against what `wetcloth run` says of the last state."""

import os
import xml.etree.ElementTree

from exported import check, export, near, prepare, scene, skip, wetcloth

try:
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    skip('VTK for Python is not installed (Debian: apt install python3-vtk9)')


def read(reader, file):
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def corners(mesh, polygon):
    points = mesh.GetCell(polygon).GetPoints()
    check(points.GetNumberOfPoints() == 3, 'polygon %d is not a triangle' % polygon)
    return [points.GetPoint(i) for i in range(3)]


def centre_of_mass(mesh):
    """Of a cloth that is equally heavy everywhere at rest, where all its triangles have the same area."""
    count = mesh.GetNumberOfPolys()
    return [sum(sum(corner[axis] for corner in corners(mesh, i)) for i in range(count)) / (3 * count)
            for axis in range(3)]


def test_collection(folder, said):
    sets = xml.etree.ElementTree.parse(os.path.join(folder, 'run.pvd')).getroot().findall('./Collection/DataSet')
    check(len(sets) == said['frames'], 'run.pvd lists %d frames, not %d' % (len(sets), said['frames']))
    for i, data_set in enumerate(sets):
        near(float(data_set.get('timestep')), i / 60, 1e-9, 'time of frame %d' % i)
        check(os.path.exists(os.path.join(folder, data_set.get('file'))), data_set.get('file') + ' is missing')
    return [os.path.join(folder, data_set.get('file')) for data_set in sets]


def test_poly_data(file, run):
    mesh = read(vtkXMLPolyDataReader(), file)
    check(mesh.GetNumberOfPoints() == run['nodes'], 'points: %d' % mesh.GetNumberOfPoints())
    check(mesh.GetNumberOfPolys() == 2 * 4 * 3, 'polygons: %d' % mesh.GetNumberOfPolys())
    data = mesh.GetPointData()
    low, high = data.GetArray('wetness').GetRange()
    near(low, run['saturation']['min'], 1e-6, 'least wetness')
    near(high, run['saturation']['max'], 1e-6, 'greatest wetness')
    near(data.GetArray('speed').GetRange()[1], run['max_speed'], 1e-5 * run['max_speed'], 'greatest speed')
    near(data.GetArray('stretch').GetRange()[1], run['max_stretch'], 1e-5, 'greatest stretch')
    for value, expected in zip(centre_of_mass(mesh), run['centre_of_mass']):
        near(value, expected, 1e-5, 'centre of mass')
    near(mesh.GetFieldData().GetArray('TimeValue').GetValue(0), run['steps'] / 60, 1e-9, 'time')
    for i in range(run['nodes']):
        near(sum(x * x for x in data.GetNormals().GetTuple(i)), 1, 1e-5, 'length of a normal, squared')
    return mesh


def test_ply(file, expected):
    mesh = read(vtkPLYReader(), file)
    check(mesh.GetNumberOfPoints() == expected.GetNumberOfPoints(), 'points: %d' % mesh.GetNumberOfPoints())
    check(mesh.GetNumberOfPolys() == expected.GetNumberOfPolys(), 'polygons: %d' % mesh.GetNumberOfPolys())
    colours = expected.GetPointData().GetArray('colour')
    for i in range(mesh.GetNumberOfPoints()):
        check(mesh.GetPoint(i) == expected.GetPoint(i), 'point %d differs' % i)
        check(mesh.GetPointData().GetArray('RGB').GetTuple(i) == colours.GetTuple(i), 'colour %d differs' % i)
    for i in range(mesh.GetNumberOfPolys()):
        check(corners(mesh, i) == corners(expected, i), 'triangle %d differs' % i)


prepare()
small = scene(duration_s=0.5)
run = wetcloth('run', small)
folder, said = export(small, 'vtk', 'vtk')
files = test_collection(folder, said)
last = test_poly_data(files[-1], run)
folder, said = export(small, 'ply', 'ply')
test_ply(said['files'][-1]['file'], last)
