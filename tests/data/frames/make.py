# SPDX-License-Identifier: Apache-2.0
"""Makes the files in this folder: one motion of three frames, as writers that are not ours write it.

    python3 make.py        with numpy 1.24, meshio 5.0, VTK 9.1, h5py 3.7 (Debian: python3-numpy, -meshio, -vtk9, -h5py)

A triangle sinks towards another one; coordinates are multiples of 1/64, so that float32 has them exactly."""
import io, zipfile
import meshio, numpy as np

faces = np.array([[0, 1, 2], [3, 4, 5]])
frames = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0], [0.25, 0.25, z], [0.75, 0.25, z], [0.25, 0.75, z + 1 / 64]]
                   for z in (1, 0.5, 0.25)])

np.savez("numpy.npz", vertices_seq=frames, faces=faces)
np.savez_compressed("deflated.npz", vertices_seq=frames.astype(np.float32), faces=faces.astype(">i2"))
np.savez("fortran.npz", vertices_seq=np.asfortranarray(frames.astype(">f8")), faces=np.asfortranarray(faces))
np.save("positions.npy", frames)
np.save("faces.npy", faces.astype(np.uint8))
with zipfile.ZipFile("zip64.npz", "w") as archive:  # as for members of more than 4 GB
    for name, array in (("vertices_seq", frames), ("faces", faces)):
        bytes_ = io.BytesIO()
        np.lib.format.write_array(bytes_, array, version=(2, 0))
        with archive.open(name + ".npy", "w", force_zip64=True) as member: member.write(bytes_.getvalue())
with open("stream.bin", "wb") as stream:
    np.save(stream, faces)
    for x in frames: np.save(stream, x)
for k, x in enumerate(frames):
    meshio.Mesh(x, [("triangle", faces.astype(np.int32))]).write(f"meshio_{k}.ply")

# VTK's own writers: text, base64 and raw; compressed or not; lengths of 32 and 64 bits; either byte order; both kinds.
import vtk
from vtk.util.numpy_support import numpy_to_vtk

def vtk_mesh(kind, x):
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(x, deep=True))
    for face in faces: cells.InsertNextCell(3, face)
    if kind == "vtp":
        mesh = vtk.vtkPolyData()
        mesh.SetPolys(cells)
    else:
        mesh = vtk.vtkUnstructuredGrid()
        mesh.SetCells(vtk.VTK_TRIANGLE, cells)
    mesh.SetPoints(points)
    return mesh

def write_vtk(name, k, mode, encoded=True, compressed=False, bits=32, big=False):
    kind = name[-3:]
    writer = vtk.vtkXMLPolyDataWriter() if kind == "vtp" else vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(name)
    writer.SetInputData(vtk_mesh(kind, frames[k].astype(np.float32) if name.startswith("single") else frames[k]))
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary, "appended": writer.SetDataModeToAppended}[mode]()
    if not encoded: writer.EncodeAppendedDataOff()
    if not compressed: writer.SetCompressorTypeToNone()
    if bits == 64: writer.SetHeaderTypeToUInt64()
    if big: writer.SetByteOrderToBigEndian()
    writer.Write()

for k in range(3):
    write_vtk(f"text_{k}.vtu", k, "ascii")
    write_vtk(f"base64_{k}.vtp", k, "binary", bits=64, big=True)
    write_vtk(f"zlib_{k}.vtu", k, "binary", compressed=True)
    write_vtk(f"appended_{k}.vtu", k, "appended", compressed=True, bits=64)
    write_vtk(f"raw_{k}.vtp", k, "appended", encoded=False)
    write_vtk(f"single_{k}.vtu", k, "appended", encoded=False, compressed=True)
    meshio.Mesh(frames[k], [("triangle", faces)]).write(f"meshio_{k}.vtu")

# VTKHDF by its specification, version 2 (VTK 9.1 writes none): cells once for all steps, or again with each step; one
# part or two; either byte order; whole or in packed chunks.
import h5py

def write_vtkhdf(name, kind, type_, integer, parts, cells_once, steps=3, **packed):
    with h5py.File(name, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([2, 2], dtype=integer)
        root.attrs.create("Type", np.bytes_(kind))
        put = lambda group, name, values, dtype=integer, **how: group.create_dataset(name, data=np.array(values, dtype=dtype), **how)
        per_part, times = 2 // parts, 1 if cells_once else steps
        put(root, "Points", np.concatenate(frames[:steps]), type_, **packed)
        put(root, "NumberOfPoints", [6 // parts] * (parts * (steps if not cells_once else 1)))
        def topology(group, count):
            part_faces = [[[v - 3 * p if parts == 2 else v for v in face] for face in faces[p * per_part:(p + 1) * per_part]]
                          for p in range(parts)] if count else [[]] * parts
            put(group, "NumberOfCells", [len(f) for f in part_faces] * times)
            put(group, "NumberOfConnectivityIds", [3 * len(f) for f in part_faces] * times)
            put(group, "Connectivity", [v for f in part_faces * times for face in f for v in face])
            put(group, "Offsets", [3 * i for f in part_faces * times for i in range(len(f) + 1)])
        if kind == "PolyData":
            for group in ("Vertices", "Lines", "Polygons", "Strips"): topology(root.create_group(group), group == "Polygons")
            columns = (0, 0, 1, 0)
        else:
            topology(root, True)
            put(root, "Types", [5] * (2 * times), np.uint8)
            columns = (1,)
        if steps == 1: return
        by_step = root.create_group("Steps")
        by_step.attrs["NSteps"] = np.array(steps, dtype=integer)
        put(by_step, "Values", range(steps), np.float64)
        put(by_step, "NumberOfParts", [parts] * steps)
        put(by_step, "PartOffsets", [0 if cells_once else k * parts for k in range(steps)])
        put(by_step, "PointOffsets", [6 * k for k in range(steps)])
        put(by_step, "CellOffsets", [[0 if cells_once else 2 * k * c for c in columns] for k in range(steps)])
        put(by_step, "ConnectivityIdOffsets", [[0 if cells_once else 6 * k * c for c in columns] for k in range(steps)])

write_vtkhdf("once.vtkhdf", "PolyData", "<f8", "<i8", 1, True)
write_vtkhdf("again.vtkhdf", "PolyData", ">f8", ">i4", 1, False)
write_vtkhdf("parts.vtkhdf", "UnstructuredGrid", "<f4", "<i8", 2, False, chunks=(4, 3), compression="gzip", shuffle=True)
write_vtkhdf("grid.hdf", "UnstructuredGrid", "<f8", "<u4", 1, True)
