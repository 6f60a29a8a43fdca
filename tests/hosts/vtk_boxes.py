"""vtk_boxes.py FILE.vtu [PICTURE.png]: writes the boxes of a balance for ParaView.

Reads them again by VTK: they must fill the box of all points, and each must hold the points of its
part. Draws them as read, if matplotlib is to make a picture.
"""
import sys

import mpi4py.MPI as mpi
import numpy as np
from rrcb_library import Balancer
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

NUM_PARTS = 24
HEXAHEDRON = 12
CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                    (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])


def write_boxes(path, boxes, cell_data):
    """VTK's XML file of hexahedra; `boxes` are (n, 2, 3), lower and upper corners."""

    def array(name, kind, values, width=1):
        text = " ".join(map(repr, np.ravel(values).tolist()))
        return (f'<DataArray Name="{name}" type="{kind}" NumberOfComponents="{width}"'
                f' format="ascii">{text}</DataArray>\n')

    count = len(boxes)
    corners = boxes[:, CORNERS, np.arange(3)]
    cells = (array("connectivity", "Int64", np.arange(8 * count))
             + array("offsets", "Int64", 8 * np.arange(1, count + 1))
             + array("types", "UInt8", np.full(count, HEXAHEDRON)))
    data = "".join(array(name, "Float64", np.asarray(values, float))
                   for name, values in cell_data.items())
    with open(path, "w", encoding="ascii") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">\n'
                   f'<UnstructuredGrid><Piece NumberOfPoints="{8 * count}"'
                   f' NumberOfCells="{count}">\n'
                   f'<Points>\n{array("corners", "Float64", corners, 3)}</Points>\n'
                   f"<Cells>\n{cells}</Cells>\n<CellData>\n{data}</CellData>\n"
                   "</Piece></UnstructuredGrid></VTKFile>\n")


def read_boxes(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    bounds = np.array([grid.GetCell(i).GetBounds() for i in range(grid.GetNumberOfCells())])
    data = grid.GetCellData()
    return bounds.reshape(-1, 3, 2).transpose(0, 2, 1), {
        name: vtk_to_numpy(data.GetArray(name)) for name in ("part", "points")}


def draw(path, boxes, colours):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    axes = pyplot.figure(figsize=(5, 4)).add_subplot(projection="3d")
    faces = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (1, 2, 6, 5), (0, 3, 7, 4)]
    for box, colour in zip(boxes, colours):
        corners = box[CORNERS, np.arange(3)]
        axes.add_collection3d(Poly3DCollection(
            corners[np.array(faces)], facecolor=pyplot.cm.tab20(int(colour) % 20), edgecolor="k",
            linewidth=0.4, alpha=0.8))
    for axis, low, high in zip("xyz", boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)):
        getattr(axes, f"set_{axis}lim")(low, high)
    pyplot.savefig(path, dpi=110)


def main():
    x = np.random.default_rng(1).normal(0, [2, 1, 0.5], (50_000, 3))
    lower, upper = x.min(axis=0), x.max(axis=0)
    balancer = Balancer(mpi.COMM_SELF, num_parts=str(NUM_PARTS))
    parts = balancer.parts_of(x)
    counts = np.bincount(parts, minlength=NUM_PARTS)
    write_boxes(sys.argv[1], balancer.boxes(NUM_PARTS, lower, upper),
                {"part": np.arange(NUM_PARTS), "points": counts})
    boxes, data = read_boxes(sys.argv[1])
    assert np.isclose(np.prod(boxes[:, 1] - boxes[:, 0], axis=1).sum(), np.prod(upper - lower))
    for box, part, count in zip(boxes, data["part"], data["points"]):
        inside = x[parts == part]
        assert len(inside) == count and (inside >= box[0]).all() and (inside <= box[1]).all()
    if len(sys.argv) > 2:
        draw(sys.argv[2], boxes, data["part"])
    print(f"result {len(boxes)} boxes read by VTK hold the points of their parts")


main()
