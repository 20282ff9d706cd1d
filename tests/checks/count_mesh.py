"""Counts the triangles of mesh files and measures their volume, apart from every reader of this repository.

A polygon of n corners counts as n - 2 triangles. The volume is that of fans, in cubed units of the file. A mesh is closed
if each edge between two places is used as often in one direction as in the other.
"""
import re
import struct


class Unread(Exception):
    """A file that this module cannot read."""


def off(data):
    lines = [re.sub(r"#.*", "", line).split() for line in data.decode("latin-1").splitlines()]
    lines = [words for words in lines if words]
    if lines[0][0].isdigit():
        lines.insert(0, ["OFF"])
    if not re.fullmatch(r"(ST)?C?N?OFF", lines[0][0]):
        raise ValueError(f"header {lines[0][0]}")
    counts = lines[0][1:] or lines[1]
    rows = lines[1:] if lines[0][1:] else lines[2:]
    if "BINARY" in counts:
        raise ValueError("binary OFF")
    vertices, faces = int(counts[0]), int(counts[1])
    if vertices + faces > len(data):
        raise ValueError("more vertices and faces than bytes")
    if len(rows) < vertices + faces:  # numbers without regard to lines
        numbers = [word for row in rows for word in row]
        points = [tuple(map(float, numbers[3 * i : 3 * i + 3])) for i in range(vertices)]
        place, polygons = 3 * vertices, []
        for _ in range(faces):
            end = place + 1 + int(numbers[place])
            polygons.append([int(word) for word in numbers[place + 1 : end]])
            place = end
        return points, polygons
    points = [tuple(map(float, row[:3])) for row in rows[:vertices]]
    return points, [[int(word) for word in row[1 : int(row[0]) + 1]] for row in rows[vertices : vertices + faces]]


def obj(data):
    points, polygons = [], []
    for line in re.sub(r"\\\r?\n", " ", data.decode("latin-1")).splitlines():
        words = line.split("#")[0].split()
        if words and words[0] == "v":
            weight = float(words[4]) if len(words) == 5 else 1.0
            points.append(tuple(float(word) / weight for word in words[1:4]))
        elif words and words[0] == "f":
            indices = [int(word.split("/")[0]) for word in words[1:]]
            polygons.append([i - 1 if i > 0 else len(points) + i for i in indices])
    return points, polygons


def stl(data):
    if len(data) >= 84:
        count = struct.unpack_from("<I", data, 80)[0]
        if len(data) == 84 + 50 * count or b"\0" in data:
            numbers = [struct.unpack_from("<9f", data, 96 + 50 * i) for i in range(count)]
            facets = [[n[0:3], n[3:6], n[6:9]] for n in numbers]
            return soup(facets)
    text = data.decode("latin-1").lower()
    facets = []
    for facet in re.findall(r"facet\b(.*?)endfacet", text, re.S):
        facets.append([tuple(map(float, v.split()[:3])) for v in re.findall(r"vertex([^\n]*)", facet)])
    return soup(facets)


def soup(facets):
    points, polygons = [], []
    for facet in facets:
        polygons.append(list(range(len(points), len(points) + len(facet))))
        points.extend(facet)
    return points, polygons


SIZES = dict(char="b", int8="b", uchar="B", uint8="B", short="h", int16="h", ushort="H", uint16="H", int="i", int32="i",
             uint="I", uint32="I", float="f", float32="f", double="d", float64="d")


def ply(data):
    end = re.search(rb"end_header\r?\n", data).end()
    head = data[:end].decode("latin-1").split("\n")
    order = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}[
        next(line.split()[1] for line in head if line.startswith("format"))]
    words, place = iter(data[end:].split() if not order else []), end

    def number(kind):
        nonlocal place
        if not order:
            return float(next(words))
        value = struct.unpack_from(order + SIZES[kind], data, place)[0]
        place += struct.calcsize(SIZES[kind])
        return value

    elements = []
    for line in head:
        parts = line.split()
        if parts[:1] == ["element"]:
            elements.append((parts[1], int(parts[2]), []))
        elif parts[:1] == ["property"]:
            elements[-1][2].append(parts[1:])
    points, polygons = [], []
    for name, count, properties in elements:
        if count > len(data):
            raise ValueError(f"more entries of {name} than bytes")
        for _ in range(count):
            row = {}
            for parts in properties:
                if parts[0] == "list":
                    length = int(number(parts[1]))
                    if length > len(data):
                        raise ValueError("a list longer than the file")
                    row[parts[3]] = [number(parts[2]) for _ in range(length)]
                else:
                    row[parts[1]] = number(parts[0])
            corners = row.get("vertex_indices", row.get("vertex_index"))
            if name == "vertex":
                points.append((row["x"], row["y"], row["z"]))
            elif name == "face":
                polygons.append([int(i) for i in corners])
            elif name == "tristrips":
                polygons.extend(strips([int(i) for i in corners]))
    return points, polygons


READERS = {"off": off, "obj": obj, "stl": stl, "ply": ply}


def strips(indices):
    strip = []
    for index in indices:
        strip = [] if index < 0 else strip + [index]
        if len(strip) > 2 and len(set(strip[-3:])) == 3:
            a, b, c = strip[-3:]
            yield [a, b, c] if len(strip) % 2 else [b, a, c]


def measure(points, polygons):
    edges, volume, triangles = {}, 0.0, 0
    origin = points[0]
    for polygon in polygons:
        triangles += max(0, len(polygon) - 2)
        corners = [points[i] for i in polygon]
        shifted = [tuple(p - o for p, o in zip(c, origin)) for c in corners]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if len(polygon) > 2 and a != b:
                key, step = ((a, b), 1) if a < b else ((b, a), -1)
                edges[key] = edges.get(key, 0) + step
        for b, c in zip(shifted[1:], shifted[2:]):
            a = shifted[0]
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                       + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6.0
    used = [points[i] for polygon in polygons for i in polygon]
    side = max(max(p[k] for p in used) - min(p[k] for p in used) for k in range(3))
    return triangles, "open" if any(edges.values()) else "closed", volume, side


def count(file):
    """Returns triangles, "closed" or "open", volume and longest side; raises Unread with the reason."""
    try:
        with open(file, "rb") as stream:
            data = stream.read().removeprefix(b"\xef\xbb\xbf")
        return measure(*READERS[file.rsplit(".", 1)[1].lower()](data))
    except (ValueError, IndexError, KeyError, AttributeError, StopIteration, struct.error) as error:
        raise Unread(str(error).replace("\n", " ")) from error
