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
    root = xml.parse(folder / f"{name}.pvd").getroot()
    files = [entry.get("file") for entry in root.iter("DataSet")]
    assert len(files) >= 2, "a start and an end"
    return files


def check_points(folder, file):
    root = xml.parse(folder / file).getroot()
    names = [array.get("Name") for array in root.iter("PDataArray")]
    assert "part" in names and "velocity" in names, names
    total = 0
    for piece in root.iter("Piece"):
        total += points_in(next(xml.parse(folder / piece.get("Source")).getroot().iter("Piece")))
    return total


def check_with_vtk(folder, points, boxes, num_points):
    from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader, vtkXMLUnstructuredGridReader

    for reader, file, count in (
        (vtkXMLPPolyDataReader(), points, num_points),
        (vtkXMLUnstructuredGridReader(), boxes, None),
    ):
        reader.SetFileName(str(folder / file))
        reader.Update()
        data = reader.GetOutput()
        assert count is None or data.GetNumberOfPoints() == count, data.GetNumberOfPoints()
        assert data.GetNumberOfCells() > 0


def main():
    folder, num_points = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) >= 2
    assert all(int(row["points"]) == num_points for row in rows)
    points, boxes = frames(folder, "points"), frames(folder, "boxes")
    for file in points:
        assert check_points(folder, file) == num_points, file
    for file in boxes:
        points_in(next(xml.parse(folder / file).getroot().iter("Piece")))
    if "--with-vtk" in sys.argv:
        check_with_vtk(folder, points[-1], boxes[-1], num_points)


main()
