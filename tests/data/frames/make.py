# SPDX-License-Identifier: Apache-2.0
"""Makes the files in this folder: one motion of three frames, as writers that are not ours write it.

    python3 make.py        with numpy 1.24 and meshio 5.0 (Debian: python3-numpy, python3-meshio)

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
