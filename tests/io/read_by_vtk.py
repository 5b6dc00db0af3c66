# SPDX-License-Identifier: GPL-3.0-or-later
# Reads the snapshots and images of a run with VTK's own readers and says what it finds:
# read_by_vtk.py <problem executable> <work folder>. Exit status 77: VTK is not installed.
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree

try:
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader
except ImportError:
    print("python3-vtk9 is not installed")
    sys.exit(77)


def opened(reader, file):
    reader.SetFileName(str(file))
    reader.Update()
    assert reader.GetErrorCode() == 0, file
    return reader.GetOutput()


def values(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def about(data, name):
    array = data.GetFieldData().GetArray(name)
    assert array is not None, name + " is missing"
    return [number for one in values(array) for number in one]


def check_about(data, t, side):
    assert about(data, "TimeValue") == [t], (about(data, "TimeValue"), t)
    assert about(data, "box_low") == [0, 0, 0]
    assert about(data, "box_high") == [side, side, 0]
    assert about(data, "periodic") == [1, 1, 0]


def listed(file):
    for data_set in xml.etree.ElementTree.parse(file).getroot().iter("DataSet"):
        yield float(data_set.get("timestep")), file.parent / data_set.get("file")


program, work = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(work, ignore_errors=True)
cells, side = 12, 24.0
subprocess.run([program, "--cells", str(cells), "--t-end", "20", "--snapshot-every", "5", "--quiet",
                "--no-plots", "--out", str(work)], check=True)

snapshots = list(listed(work / "snapshots.pvd"))
assert [t for t, _ in snapshots] == [0, 5, 10, 15, 20]
for t, file in snapshots:
    data = opened(vtkXMLPolyDataReader(), file)
    check_about(data, t, side)
    n = cells * cells
    assert data.GetNumberOfPoints() == n and data.GetNumberOfVerts() == n
    for x, y, z in values(data.GetPoints().GetData()):
        assert 0 <= x < side and 0 <= y < side and z == 0, (x, y, z)
    assert sorted(values(data.GetPointData().GetArray("id"))) == [(k,) for k in range(n)]
    for name, components in {"mass": 1, "velocity": 3, "density": 1, "energy": 1}.items():
        array = data.GetPointData().GetArray(name)
        assert array.GetNumberOfComponents() == components and array.GetNumberOfTuples() == n

images = list(listed(work / "fields.pvd"))
assert len(images) == len(snapshots)
for t, file in images:
    data = opened(vtkXMLImageDataReader(), file)
    check_about(data, t, side)
    nodes = data.GetNumberOfPoints()
    rho = values(data.GetPointData().GetArray("density"))
    assert len(rho) == nodes
    volume = data.GetSpacing()[0] * data.GetSpacing()[1]
    assert abs(sum(one[0] for one in rho) * volume / (cells * cells) - 1) < 0.02, "mass of the density"
    assert all(one[0] >= 0 for one in values(data.GetPointData().GetArray("velocity_fluctuation")))
print(len(snapshots), "snapshots and", len(images), "images")
