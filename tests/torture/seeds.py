# SPDX-License-Identifier: GPL-3.0-or-later
"""One small sound file of each kind, which the mutants are made of."""
import base64
import io
import json
import struct
import subprocess
import zipfile

# An octahedron with a waist, so that there are concave places.
POINTS = [(0, 0, 9), (6, 0, 1), (0, 6, 0), (-6, 0, -1), (0, -6, 0), (1, 1, -9), (3, 3, 1)]
FACES = [(0, 1, 6), (1, 2, 6), (0, 6, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (5, 2, 1), (5, 3, 2), (5, 4, 3), (5, 1, 4)]


def obj():
    text = "".join("v %g %g %g\n" % p for p in POINTS) + "vn 0 0 1\nvt 0 0\n"
    text += "".join("f " + " ".join("%d/1/1" % (v + 1) for v in face) + "\n" for face in FACES)
    return (text + "f -1 -2 -3 -4 -5\n").encode()


def stl_text():
    text = "solid a\n"
    for face in FACES:
        text += "facet normal 0 0 1\nouter loop\n" + "".join("vertex %g %g %g\n" % POINTS[v] for v in face)
        text += "endloop\nendfacet\n"
    return (text + "endsolid a\n").encode()


def facet(a, b, c):
    return struct.pack("<12fH", 0, 0, 1, *a, *b, *c, 0)


def stl():
    facets = b"".join(facet(*(POINTS[v] for v in face)) for face in FACES)
    return bytes(80) + struct.pack("<I", len(FACES)) + facets


def ply_head(kind):
    return (f"ply\nformat {kind} 1.0\ncomment a\nelement vertex {len(POINTS)}\nproperty float x\nproperty float y\n"
            f"property float z\nproperty uchar red\nelement face {len(FACES)}\n"
            "property list uchar int vertex_indices\nend_header\n").encode()


def ply_text():
    text = "".join("%g %g %g 7\n" % p for p in POINTS) + "".join("3 %d %d %d\n" % face for face in FACES)
    return ply_head("ascii") + text.encode()


def ply(order="<"):
    """order: that of the bytes, < for little-endian."""
    body = b"".join(struct.pack(order + "3fB", *p, 7) for p in POINTS)
    body += b"".join(struct.pack(order + "B3i", 3, *f) for f in FACES)
    return ply_head("binary_little_endian" if order == "<" else "binary_big_endian") + body


def three_mf():
    mesh = "<mesh><vertices>" + "".join('<vertex x="%g" y="%g" z="%g"/>' % p for p in POINTS) + "</vertices><triangles>"
    mesh += "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % f for f in FACES) + "</triangles></mesh>"
    model = ('<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" '
             'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
             f'<object id="1" type="model">{mesh}</object><object id="2" type="model"><components>'
             '<component objectid="1" transform="1 0 0 0 1 0 0 0 1 20 0 0"/></components></object></resources>'
             '<build><item objectid="1"/><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 9"/></build></model>')
    types = ('<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default '
             'Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
    relations = ('<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/'
                 'relationships"><Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/'
                 '3dmanufacturing/2013/01/3dmodel"/></Relationships>')
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in (("[Content_Types].xml", types), ("_rels/.rels", relations), ("3D/3dmodel.model", model)):
            archive.writestr(zipfile.ZipInfo(name), content, compress_type=zipfile.ZIP_DEFLATED)
    return out.getvalue()


def glb():
    numbers = b"".join(struct.pack("<3f", *(0.001 * x for x in p)) for p in POINTS)
    corners = b"".join(struct.pack("<3H", *f) for f in FACES)
    low, high = ([0.001 * f(p[n] for p in POINTS) for n in range(3)] for f in (min, max))
    scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
             "nodes": [{"children": [1], "translation": [0.01, 0, 0]}, {"mesh": 0, "scale": [1, 2, 1]}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}]}],
             "buffers": [{"byteLength": len(numbers) + len(corners)}],
             "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(numbers)},
                             {"buffer": 0, "byteOffset": len(numbers), "byteLength": len(corners)}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(POINTS), "type": "VEC3", "min": low,
                            "max": high},
                           {"bufferView": 1, "componentType": 5123, "count": 3 * len(FACES), "type": "SCALAR"}]}
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    body = numbers + corners
    body += bytes(-len(body) % 4)
    total = 28 + len(text) + len(body)
    return (struct.pack("<4sIIII", b"glTF", 2, total, len(text), 0x4e4f534a) + text +
            struct.pack("<II", len(body), 0x004e4942) + body)


def ply_strips():
    body = b"".join(struct.pack("<3f", *p) for p in POINTS)
    strip = [v for face in FACES for v in (*face, -1)]
    body += struct.pack(f"<{1 + len(strip)}i", len(strip), *strip)
    return ("ply\nCreated by a program\nformat binary_little_endian 1.0\nobj_info a\nelement vertex %d\n"
            "property float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
            "property list int int vertex_indices\nend_header\n" % len(POINTS)).encode() + body


def gltf():
    """A skin, a morph target and a sparse list, with its buffer in the text."""
    numbers = b"".join(struct.pack("<3f", *(0.001 * x for x in p)) for p in POINTS)
    parts = [numbers, b"".join(struct.pack("<3H", *f) for f in FACES), bytes((0, 1, 0, 0)) * len(POINTS),
             bytes((100, 155, 0, 0)) * len(POINTS), struct.pack("<32f", *2 * (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)),
             bytes((1, 3)), struct.pack("<6f", 0, 0.001, 0, 0.001, 0, 0)]
    body, views = b"", []
    for part in parts:
        views.append({"buffer": 0, "byteOffset": len(body), "byteLength": len(part)})
        body += part + bytes(-len(part) % 4)
    sparse = {"count": 2, "indices": {"bufferView": 5, "componentType": 5121}, "values": {"bufferView": 6}}
    attributes = {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}
    scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "extensionsUsed": ["KHR_materials_unlit"],
             "nodes": [{"children": [1], "translation": [0.01, 0, 0], "mesh": 0, "skin": 0}, {"scale": [1, 2, 1]}],
             "skins": [{"joints": [0, 1], "inverseBindMatrices": 4}],
             "meshes": [{"primitives": [{"attributes": attributes, "indices": 1, "targets": [{"POSITION": 5}]}], "weights": [0.5]}],
             "buffers": [{"byteLength": len(body), "uri": "data:;base64," + base64.b64encode(body).decode()}],
             "bufferViews": views,
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(POINTS), "type": "VEC3", "sparse": sparse},
                           {"bufferView": 1, "componentType": 5123, "count": 3 * len(FACES), "type": "SCALAR"},
                           {"bufferView": 2, "componentType": 5121, "count": len(POINTS), "type": "VEC4"},
                           {"bufferView": 3, "componentType": 5121, "count": len(POINTS), "type": "VEC4", "normalized": True},
                           {"bufferView": 4, "componentType": 5126, "count": 2, "type": "MAT4"},
                           {"componentType": 5126, "count": len(POINTS), "type": "VEC3", "sparse": sparse}]}
    return json.dumps(scene, indent=1).encode()


def strokes():
    start = {"argil_strokes": 1, "units": "mm", "start": {"shape": "ball", "radius_mm": 8, "voxel_mm": 0.8}}
    lines = [start]
    for tool in ("add", "carve", "smooth", "grab"):
        lines.append({"tool": tool, "shape": "ball", "radius_mm": 2.5,
                      "poses": [[0, 3, -7, 1], [0.2, 5, -6, 2], [0.4, 5, -5, 3]]})
    lines.append({"operation": "offset", "distance_mm": 0.5})
    lines.append({"operation": "cut", "point_mm": [0, 0, -6], "normal": [0, 0, -1]})
    return "".join(json.dumps(line) + "\n" for line in lines).encode()


def path():
    lines = ["# a path, mm"] + ["%g %g %g" % point for point in POINTS] + ["", "1, 2, 3"]
    return "".join(line + "\n" for line in lines).encode()


def made_by(argil, folder):
    """What the program itself writes: a project with a mask, and a recording."""
    script = folder / "seed.strokes.jsonl"
    script.write_text(json.dumps({"argil_strokes": 1, "units": "mm",
                                  "start": {"shape": "ball", "radius_mm": 6, "voxel_mm": 0.6}}) + "\n" +
                      json.dumps({"tool": "add", "shape": "ball", "radius_mm": 1.2, "poses": [[0, 3, -5, 1]]}) + "\n" +
                      json.dumps({"tool": "mask", "shape": "ball", "radius_mm": 2, "poses": [[0, 0, 6, 0]]}) + "\n")
    project, run = folder / "seed.vdb", folder / "seed.csv"
    subprocess.run([argil, "sculpt", "--strokes", script, "-o", project, "--quiet"], check=True)
    subprocess.run([argil, "lab", "wall-linear", "--seconds", "2", "-o", run, "--quiet"], check=True)
    lines = run.read_bytes().split(b"\n")
    return project.read_bytes(), b"\n".join(lines[:60]) + b"\n"
