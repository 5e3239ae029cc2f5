"""Snapshots opened as ParaView opens them (vtkHDFReader) and as a script does (h5py).

The numbers are the formulas of test_snapshot.cpp, written by its hidden test case.
"""
import h5py
import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

COUNT = 7
VTK_VERTEX = 1


def expected(dimensions, count=COUNT):
    i = np.arange(count)[:, None]
    d = np.arange(3)[None, :]
    inside = d < dimensions
    row, column = np.divmod(np.arange(9), 3)
    return {
        "points": np.where(inside, 0.5 * i + 0.01 * d, 0.0),
        "velocity": np.where(inside, -1.0 * i + d, 0.0),
        "density": 7850.0 + i[:, 0],
        "stress": 1e6 * i + 10 * (row + column) + row * column,
    }


FILES = [("plane", 2, COUNT), ("space", 3, COUNT), ("empty", 3, 0)]


@pytest.mark.parametrize("name, dimensions, count", FILES)
def test_vtk_reads_points_cells_and_fields(folder, name, dimensions, count):
    file = str(folder / f"{name}.vtkhdf")
    reader = vtkHDFReader()
    assert reader.CanReadFile(file)
    reader.SetFileName(file)
    reader.Update()
    assert reader.GetErrorCode() == 0
    grid = reader.GetOutputDataObject(0)
    assert grid.GetClassName() == "vtkUnstructuredGrid"
    assert grid.GetNumberOfPoints() == grid.GetNumberOfCells() == count
    if count == 0:
        return

    truth = expected(dimensions, count)
    np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), truth["points"])
    data = grid.GetPointData()
    assert data.GetNumberOfArrays() == 3
    for field in ("density", "velocity", "stress"):
        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray(field)), truth[field])
    for cell in range(count):
        assert grid.GetCellType(cell) == VTK_VERTEX
        assert grid.GetCell(cell).GetPointIds().GetNumberOfIds() == 1
        assert grid.GetCell(cell).GetPointId(0) == cell
    np.testing.assert_array_equal(vtk_to_numpy(grid.GetFieldData().GetArray("time")), [0.125])


@pytest.mark.parametrize("name, dimensions, count", FILES)
def test_h5py_reads_the_same_with_units(folder, name, dimensions, count):
    truth = expected(dimensions, count)
    units = {"density": ("kg/m3", "rho"), "velocity": ("m/s", "v"), "stress": ("Pa", "sigma")}
    with h5py.File(folder / f"{name}.vtkhdf") as file:
        grid = file["VTKHDF"]
        assert list(grid.attrs["Version"]) == [1, 0]
        assert grid.attrs["Type"] == b"UnstructuredGrid"
        np.testing.assert_array_equal(grid["Points"], truth["points"])
        assert grid["Points"].attrs["unit"] == b"m"
        assert set(grid["PointData"]) == set(units)
        for field, (unit, symbol) in units.items():
            np.testing.assert_array_equal(grid["PointData"][field], truth[field])
            assert grid["PointData"][field].attrs["unit"] == unit.encode()
            assert grid["PointData"][field].attrs["symbol"] == symbol.encode()
            assert grid["PointData"][field].attrs["description"]
        np.testing.assert_array_equal(grid["FieldData/time"], [0.125])
        assert grid["FieldData/time"].attrs["unit"] == b"s"
