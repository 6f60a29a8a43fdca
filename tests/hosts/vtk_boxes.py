"""vtk_boxes.py FILE.vtk: writes the boxes of a balance for ParaView, and reads them again by VTK.

They must fill the box of all points, and each must hold the points of its part.
"""
import sys

import numpy as np
import rrcb
from mpi4py import MPI
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader

NUM_PARTS = 24

x = np.random.default_rng(1).normal(0, [2, 1, 0.5], (50_000, 3))
corners = x.min(axis=0), x.max(axis=0)
balance = rrcb.balance(x, comm=MPI.COMM_SELF, num_parts=NUM_PARTS)
balance.cuts.to_vtk(sys.argv[1], within=corners)
reader = vtkUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
bounds = np.array([grid.GetCell(i).GetBounds() for i in range(grid.GetNumberOfCells())])
boxes = bounds.reshape(-1, 3, 2).transpose(0, 2, 1)
parts = vtk_to_numpy(grid.GetCellData().GetArray("part"))
assert np.isclose(np.prod(boxes[:, 1] - boxes[:, 0], axis=1).sum(), np.prod(np.subtract(*corners[::-1])))
for (lower, upper), part in zip(boxes, parts):
    inside = x[balance.parts == part]
    assert len(inside) and (inside >= lower).all() and (inside <= upper).all()
print(f"result {len(boxes)} boxes read by VTK hold the points of their parts")
