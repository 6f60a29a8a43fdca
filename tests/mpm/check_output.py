"""Checks what rrcb_mpm wrote: check_output.py FOLDER POINTS [--with-vtk]

history.csv must hold that many points in every row; the VTK files must be XML whose arrays have the
length they claim. With VTK its own readers must find the points, too."""
import base64
import csv
import pathlib
import struct
import sys
import xml.etree.ElementTree as xml

BYTES = {"Float64": 8, "Int64": 8, "Int32": 4, "UInt8": 1}


def check_array(array, count):
    data = base64.b64decode(array.text.strip(), validate=True)
    (length,) = struct.unpack_from("<Q", data)
    expected = count * int(array.get("NumberOfComponents")) * BYTES[array.get("type")]
    assert length == len(data) - 8 == expected, (array.get("Name"), length, expected)


def points_in(piece):
    count = int(piece.get("NumberOfPoints"))
    for part in ("PointData", "Points"):
        for array in piece.find(part) or ():
            check_array(array, count)
    return count


def frames(folder, name):
    """The files of each time."""
    times = {}
    for entry in xml.parse(folder / f"{name}.pvd").getroot().iter("DataSet"):
        times.setdefault(entry.get("timestep"), []).append(folder / entry.get("file"))
    assert len(times) >= 2, "a start and an end"
    return list(times.values())


def check_points(files):
    total = 0
    for file in files:
        piece = next(xml.parse(file).getroot().iter("Piece"))
        names = [array.get("Name") for array in piece.find("PointData")]
        assert {"part", "velocity", "pressure"} <= set(names), names
        total += points_in(piece)
    return total


def check_with_vtk(points, boxes, num_points):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

    def read(reader, file):
        reader.SetFileName(str(file))
        reader.Update()
        return reader.GetOutput()

    pieces = [read(vtkXMLPolyDataReader(), file) for file in points]
    assert sum(piece.GetNumberOfPoints() for piece in pieces) == num_points
    assert sum(piece.GetNumberOfCells() for piece in pieces) == num_points
    assert read(vtkXMLUnstructuredGridReader(), boxes[0]).GetNumberOfCells() > 0


def main():
    folder, num_points = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) >= 2
    assert all(int(row["points"]) == num_points for row in rows)
    points, boxes = frames(folder, "points"), frames(folder, "boxes")
    for files in points:
        assert check_points(files) == num_points, files
    for files in boxes:
        points_in(next(xml.parse(files[0]).getroot().iter("Piece")))
    if "--with-vtk" in sys.argv:
        check_with_vtk(points[-1], boxes[-1], num_points)


main()
