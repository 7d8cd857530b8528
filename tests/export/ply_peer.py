#!/usr/bin/python3
"""ply_peer.py MESH: reads a mesh.ply by what the bundle format says, without any code of facescan,
and prints it as text: the comments, a line of vertex properties, the vertices, the triangles."""
import struct
import sys

CODES = {"uchar": "B", "uint": "I", "float": "f"}

data = open(sys.argv[1], "rb").read()
end = data.index(b"end_header\n") + len(b"end_header\n")
lines = data[:end].decode("ascii").split("\n")
assert lines[0] == "ply" and lines[1] == "format binary_little_endian 1.0"

elements = []
for words in map(str.split, lines):
    if words[:1] == ["comment"]:
        print(*words)
    elif words[:1] == ["element"]:
        elements.append((words[1], int(words[2]), []))
    elif words[:1] == ["property"]:
        elements[-1][2].append(words[1:])
(vertex, vertices, properties), (face, faces, lists) = elements
assert vertex == "vertex" and face == "face"
assert lists == [["list", "uchar", "uint", "vertex_indices"]]

vertex_layout = "<" + "".join(CODES[kind] for kind, _ in properties)
faces_begin = end + vertices * struct.calcsize(vertex_layout)
assert faces_begin + faces * 13 == len(data), "bytes after the last element"

print(*(kind + " " + name for kind, name in properties), sep=", ")
for numbers in struct.iter_unpack(vertex_layout, data[end:faces_begin]):
    print(*("%.9g" % number for number in numbers))
for corners, *indices in struct.iter_unpack("<B3I", data[faces_begin:]):
    assert corners == 3
    print(*indices)
