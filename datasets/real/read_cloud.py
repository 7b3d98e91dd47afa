#!/usr/bin/env python3
"""Prints the points of a cloud in an archive as seen from above: "p X Y" a point, without its height.

    read_cloud.py ARCHIVE MEMBER [PROPERTY=VALUE]

ARCHIVE is a tar file, MEMBER a point cloud in it: .xyz (text, a point a line) or .ply (text or binary, little-endian).
Of a .ply with labels, PROPERTY=VALUE takes only the points whose property has that value. Nothing beyond Python's own
library is needed.
"""

import struct
import sys
import tarfile

CODES = {
    **{"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H"},
    **{"uint16": "H", "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f"},
    **{"double": "d", "float64": "d"},
}


def read_xyz(content):
    """Rows of numbers."""
    for line in content.decode().splitlines():
        if line.strip() and not line.startswith("#"):
            yield [float(word) for word in line.split()]


def read_header(head):
    """The format, the number of vertices, and the names and types of their properties."""
    layout, count, properties, in_vertices = "", 0, [], False
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "format":
            layout = words[1]
        elif words[0] == "element":
            in_vertices = words[1] == "vertex"
            count = int(words[2]) if in_vertices else count
        elif words[0] == "property" and in_vertices:
            properties.append((words[2], words[1]))
    return layout, count, properties


def read_ply(content):
    """The names of the vertices' properties, and a row of numbers a vertex."""
    head, body = content.split(b"end_header\n", 1)
    layout, count, properties = read_header(head)
    names = [name for name, _ in properties]
    if layout == "ascii":
        return names, [[float(word) for word in line.split()] for line in body.decode().splitlines()[:count]]
    if layout != "binary_little_endian":
        sys.exit(f"error: cannot read a .ply in the format {layout}")
    row = struct.Struct("<" + "".join(CODES[kind] for _, kind in properties))
    return names, row.iter_unpack(body[: count * row.size])


def main():
    archive, member, *filters = sys.argv[1:]
    with tarfile.open(archive) as tar:
        content = tar.extractfile(member).read()
    names, rows = read_ply(content) if member.endswith(".ply") else (["x", "y", "z"], read_xyz(content))
    x, y = names.index("x"), names.index("y")
    for condition in filters:
        name, value = condition.split("=")
        at, wanted = names.index(name), float(value)
        rows = [row for row in rows if row[at] == wanted]
    sys.stdout.write("".join(f"p {row[x]!r} {row[y]!r}\n" for row in rows))


if __name__ == "__main__":
    main()
