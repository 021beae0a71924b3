#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the small files of this folder: the same four particles in every format and packing.

Independent of the readers on purpose: only Python's struct, zlib, lzma, base64 and zipfile. Run it in
this folder after a change; the files are kept in the repository. zstd(1) packs the .zst file.
"""
import base64
import gzip
import io
import lzma
import struct
import subprocess
import zipfile
import zlib

LICENCE = "CC0-1.0"
POINTS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 3.25)]
VELOCITY = [(i, 10 * i, -0.5 * i) for i in range(4)]
DENSITY = [1.0, 2.5, -3.0, 1e-3]
ID = [7, 8, 9, 10]


def flat(rows):
    return [v for row in rows for v in row]


def pack(kind, values, order="<"):
    return struct.pack(f"{order}{len(values)}{kind}", *values)


def save(name, content):
    with open(name, "wb") as out:
        out.write(content if isinstance(content, bytes) else content.encode())


# ---- legacy VTK ----
def vtk(binary, version="3.0", new_cells=False):
    def values(kind, numbers):
        if binary:
            return pack(kind, numbers, ">") + b"\n"
        return (" ".join(f"{n:g}" for n in numbers) + "\n").encode()

    out = f"# vtk DataFile Version {version}\n{LICENCE} four particles\n{'BINARY' if binary else 'ASCII'}\n".encode()
    out += b"DATASET UNSTRUCTURED_GRID\nFIELD FieldData 2\nTIME 1 1 double\n" + values("d", [0.25])
    out += b"CYCLE 1 1 int\n" + values("i", [12])
    out += b"POINTS 4 float\n" + values("f", flat(POINTS))
    if new_cells:
        out += b"METADATA\nINFORMATION 0\n\nCELLS 5 4\nOFFSETS vtktypeint64\n" + values("q", range(5))
        out += b"CONNECTIVITY vtktypeint64\n" + values("q", range(4))
    else:
        out += b"CELLS 4 8\n" + values("i", flat((1, i) for i in range(4)))
    out += b"CELL_TYPES 4\n" + values("i", [1] * 4)
    out += b"CELL_DATA 4\nSCALARS left_out int 1\nLOOKUP_TABLE default\n" + values("i", range(4))
    out += b"POINT_DATA 4\nSCALARS density double 1\nLOOKUP_TABLE default\n" + values("d", DENSITY)
    out += b"VECTORS velocity float\n" + values("f", flat(VELOCITY))
    out += b"FIELD FieldData 1\nid 1 4 int\n" + values("i", ID)
    return out


save("four_ascii.vtk", vtk(False))
save("four_binary.vtk", vtk(True))
save("four_binary_5.1.vtk", vtk(True, "5.1", True))


# ---- VTK XML ----
def lz4_literals(data):
    out, rest = b"", len(data)
    out += bytes([min(rest, 15) << 4])
    if rest >= 15:
        rest -= 15
        while rest >= 255:
            out += b"\xff"
            rest -= 255
        out += bytes([rest])
    return out + data


PACKERS = {
    None: None,
    "vtkZLibDataCompressor": zlib.compress,
    "vtkLZ4DataCompressor": lz4_literals,
    "vtkLZMADataCompressor": lambda d: lzma.compress(d, format=lzma.FORMAT_XZ),
}


def encoded(data, order, header, compressor, text):
    """[header][data], packed in blocks of 32 bytes if there is a compressor; base64 if `text`."""
    if compressor is None:
        out = pack(header, [len(data)], order) + data
        return base64.b64encode(out) if text else out
    blocks = [data[i : i + 32] for i in range(0, len(data), 32)]
    last = len(blocks[-1]) % 32
    packed = [PACKERS[compressor](b) for b in blocks]
    head = pack(header, [len(blocks), 32, last] + [len(p) for p in packed], order)
    if text:
        return base64.b64encode(head) + base64.b64encode(b"".join(packed))
    return head + b"".join(packed)


def vtk_xml(mode, order="<", header="I", compressor=None, kind="UnstructuredGrid", pieces=((0, 4),)):
    appended = b""
    rows = []

    def array(kind_word, letter, name, components, values):
        nonlocal appended
        begin = f'        <DataArray type="{kind_word}" Name="{name}" NumberOfComponents="{components}" format='.encode()
        info = b'\n          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">\n            <Value index="0">\n              0\n            </Value>\n          </InformationKey>'
        if mode == "ascii":
            return begin + b'"ascii">\n          ' + " ".join(f"{v:g}" for v in values).encode() + info + b"\n        </DataArray>\n"
        data = encoded(pack(letter, values, order), order, header, compressor, mode != "raw")
        if mode == "inline":
            return begin + b'"binary">\n          ' + data + info + b"\n        </DataArray>\n"
        offset, appended = len(appended), appended + data
        return begin + f'"appended" offset="{offset}">'.encode() + info + b"</DataArray>\n"

    for a, b in pieces:
        cells = "" if kind == "UnstructuredGrid" else ' NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0"'
        cells = f' NumberOfCells="{b - a}"' if kind == "UnstructuredGrid" else cells
        rows.append(f'    <Piece NumberOfPoints="{b - a}"{cells}>\n      <PointData Scalars="density">\n'.encode())
        rows.append(array("Float64", "d", "density", 1, DENSITY[a:b]))
        rows.append(array("Float32", "f", "velocity", 3, flat(VELOCITY[a:b])))
        rows.append(array("Int64", "q", "id", 1, ID[a:b]))
        rows.append(b"      </PointData>\n      <CellData>\n      </CellData>\n      <Points>\n")
        rows.append(array("Float32", "f", "Points", 3, flat(POINTS[a:b])))
        rows.append(b"      </Points>\n")
        if kind == "UnstructuredGrid":
            rows.append(b"      <Cells>\n")
            rows.append(array("Int64", "q", "connectivity", 1, list(range(b - a))))
            rows.append(array("Int64", "q", "offsets", 1, list(range(1, b - a + 1))))
            rows.append(array("UInt8", "B", "types", 1, [1] * (b - a)))
            rows.append(b"      </Cells>\n")
        rows.append(b"    </Piece>\n")
    words = f' byte_order="{"BigEndian" if order == ">" else "LittleEndian"}" header_type="{"UInt64" if header == "Q" else "UInt32"}"'
    words += f' compressor="{compressor}"' if compressor else ""
    out = f'<?xml version="1.0"?>\n<!-- {LICENCE} -->\n<VTKFile type="{kind}" version="1.0"{words}>\n  <{kind}>\n'.encode()
    out += b'    <FieldData>\n      <DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">0.25</DataArray>\n'
    out += b'      <DataArray type="Int32" Name="CYCLE" NumberOfTuples="1" format="ascii">12</DataArray>\n    </FieldData>\n'
    out += b"".join(rows) + f"  </{kind}>\n".encode()
    if mode in ("raw", "base64"):
        out += f'  <AppendedData encoding="{mode}">\n   _'.encode() + appended + b"\n  </AppendedData>\n"
    return out + b"</VTKFile>\n"


save("four_ascii.vtu", vtk_xml("ascii"))
save("four_ascii.vtp", vtk_xml("ascii", kind="PolyData"))
save("four_inline.vtu", vtk_xml("inline"))
save("four_inline_zlib.vtu", vtk_xml("inline", compressor="vtkZLibDataCompressor"))
save("four_base64.vtu", vtk_xml("base64", header="Q"))
save("four_base64_zlib.vtp", vtk_xml("base64", compressor="vtkZLibDataCompressor", kind="PolyData"))
save("four_raw.vtu", vtk_xml("raw", header="Q"))
save("four_raw_big.vtu", vtk_xml("raw", order=">"))
save("four_raw_zlib.vtu", vtk_xml("raw", header="Q", compressor="vtkZLibDataCompressor"))
save("four_raw_lz4.vtp", vtk_xml("raw", compressor="vtkLZ4DataCompressor", kind="PolyData"))
save("four_raw_lzma.vtu", vtk_xml("raw", compressor="vtkLZMADataCompressor"))
save("four_pieces.vtu", vtk_xml("raw", pieces=((0, 1), (1, 4))))


# ---- Houdini ----
def bgeo():
    out = b"BgeoV" + pack("i", [5, 4, 0, 0, 0, 3, 0, 0, 0], ">")
    for name, size, kind in (("id", 1, 1), ("density", 1, 0), ("velocity", 3, 5)):
        out += pack("H", [len(name)], ">") + name.encode() + pack("H", [size], ">") + pack("i", [kind] + [0] * size, ">")
    for i in range(4):
        out += pack("f", POINTS[i] + (1.0,), ">") + pack("i", [ID[i]], ">") + pack("f", (DENSITY[i],) + VELOCITY[i], ">")
    return out + b"\x00\xff"


save("four.bgeo", bgeo())
save("four_gz.bgeo", gzip.compress(bgeo(), mtime=0))


# ---- PLY ----
def ply(form):
    order = ">" if form.endswith("big_endian") else "<"
    out = f"ply\nformat {form} 1.0\ncomment {LICENCE}\nelement vertex 4\n".encode()
    for name in "xyz":
        out += f"property float {name}\n".encode()
    out += b"property float vx\nproperty float vy\nproperty float vz\nproperty double density\nproperty int id\n"
    out += b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    for i in range(4):
        if form == "ascii":
            out += (" ".join(f"{v:g}" for v in POINTS[i] + VELOCITY[i] + (DENSITY[i], ID[i])) + "\n").encode()
        else:
            out += pack("f", POINTS[i] + VELOCITY[i], order) + pack("d", [DENSITY[i]], order) + pack("i", [ID[i]], order)
    return out + (b"3 0 1 2\n" if form == "ascii" else b"\x03" + pack("i", [0, 1, 2], order))


save("four_ascii.ply", ply("ascii"))
save("four_little.ply", ply("binary_little_endian"))
save("four_big.ply", ply("binary_big_endian"))


# ---- NumPy ----
def npy(kind, letter, shape, values, fortran=False):
    head = f"{{'descr': '{kind}', 'fortran_order': {fortran}, 'shape': {shape}, }}".encode()
    head += b" " * (-(len(head) + 11) % 64) + b"\n"
    return b"\x93NUMPY\x01\x00" + pack("H", [len(head)]) + head + pack(letter, values, ">" if kind[0] == ">" else "<")


def npz(method, members):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as archive:
        for name, content in members.items():
            archive.writestr(zipfile.ZipInfo(name + ".npy", (1980, 1, 1, 0, 0, 0)), content, method)
    return out.getvalue()


COLUMNS = {
    "density": npy("<f8", "d", "(4,)", DENSITY),
    "id": npy("<i4", "i", "(4,)", ID),
    "time": npy("<f8", "d", "()", [0.25]),
    "step": npy("<i8", "q", "(1,)", [12]),
}
save("four.npz", npz(zipfile.ZIP_STORED, {"pos": npy("<f4", "f", "(4, 3)", flat(POINTS)), "vel": npy("<f4", "f", "(4, 3)", flat(VELOCITY)), **COLUMNS}))
by_axis = {"x": npy(">f8", "d", "(4,)", [p[0] for p in POINTS]), "y": npy("<f4", "f", "(4,)", [p[1] for p in POINTS]), "z": npy("<f2", "e", "(4,)", [p[2] for p in POINTS])}
turned = [row[k] for k in range(3) for row in VELOCITY]
save("four_deflated.npz", npz(zipfile.ZIP_DEFLATED, {**by_axis, "velocity": npy("<f4", "f", "(4, 3)", turned, True), **COLUMNS, "other": npy("<f8", "d", "(5,)", [0] * 5)}))

# ---- raw ----
records = b"".join(pack("f", POINTS[i] + VELOCITY[i], ">") + pack("d", [DENSITY[i]], ">") + pack("i", [ID[i]], ">") for i in range(4))
save("four.raw", b"HEAD" + records)
save("four_raw.toml", f'''# {LICENCE}
mote_raw = 1
time = 0.25
[[file]]
path = "four.raw"
endian = "big"
header = 4
layout = ["position f4 3 m", "vel f4 3", "density f8", "id i4"]
''')

# ---- whole files packed ----
save("four_ascii.ply.xz", lzma.compress(ply("ascii")))
save("four_ascii.ply.gz", gzip.compress(ply("ascii"), mtime=0))
subprocess.run(["zstd", "-q", "-f", "-19", "four_ascii.ply", "-o", "four_ascii.ply.zst"], check=True)
