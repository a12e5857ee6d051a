"""Pieces of the KayKit dungeon kit as meshes of one glTF document. For dungeon.py; standard library only."""
import json, math, os, struct


class Fail(Exception):
    pass


class Kit:
    """The pieces, as meshes and nodes of one document."""

    def __init__(self, folder):
        self.folder, self.buffer, self.pieces, self.triangles = folder, bytearray(), {}, []
        self.doc = {"accessors": [], "bufferViews": [], "images": [], "textures": [], "materials": [], "meshes": []}

    def add(self, data, **fields):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data), **fields}
        self.buffer += data
        self.doc["bufferViews"].append(view)
        return len(self.doc["bufferViews"]) - 1

    def once(self, kind, value):
        """The index of value among those of its kind, to which it is added if it is not there."""
        values = self.doc[kind]
        if value not in values:
            values.append(value)
        return values.index(value)

    def piece(self, name):
        """The nodes of the piece as (mesh, name, translation, parent's index or None), parents first; lowest and
        highest corner."""
        if name not in self.pieces:
            path = os.path.join(self.folder, name + ".glb")
            try:
                with open(path, "rb") as f:
                    data = f.read()
            except OSError as e:
                raise Fail("cannot read %s: %s" % (path, e.strerror))
            try:
                self.pieces[name] = self.read(data)
            except (ValueError, KeyError, IndexError, TypeError, struct.error):
                raise Fail("%s is not a piece of the kit" % path)
        return self.pieces[name]

    def read(self, data):
        magic, _, _, length, _ = struct.unpack_from("<5I", data)
        if magic != 0x46546C67:
            raise ValueError
        doc, body = json.loads(data[20:20 + length]), data[28 + length:]

        def bytes_of(view):
            view = doc["bufferViews"][view]
            start, length = view.get("byteOffset", 0), view["byteLength"]
            if start + length > len(body):
                raise ValueError
            return body[start:start + length]

        def accessor(index, target):
            a = dict(doc["accessors"][index])
            a["bufferView"] = self.add(bytes_of(a["bufferView"]), target=target)
            self.doc["accessors"].append(a)
            return len(self.doc["accessors"]) - 1

        def material(index):
            m = json.loads(json.dumps(doc["materials"][index]))
            ref = m["pbrMetallicRoughness"].get("baseColorTexture")
            if ref:
                image = doc["images"][doc["textures"][ref["index"]]["source"]]
                ref["index"] = self.texture(bytes_of(image["bufferView"]), image["mimeType"])
            return self.once("materials", m)

        parts, lo, hi = [], [math.inf] * 3, [-math.inf] * 3
        parents = {c: i for i, n in enumerate(doc["nodes"]) for c in n.get("children", [])}
        order = sorted(range(len(doc["nodes"])), key=lambda i: i in parents)  # two levels at most
        for i in order:
            node = doc["nodes"][i]
            at = node.get("translation", [0, 0, 0])
            primitives, triangles = [], 0
            for p in doc["meshes"][node["mesh"]]["primitives"]:
                bounds = doc["accessors"][p["attributes"]["POSITION"]]
                lo = [min(lo[k], bounds["min"][k] + at[k]) for k in range(3)]
                hi = [max(hi[k], bounds["max"][k] + at[k]) for k in range(3)]
                triangles += doc["accessors"][p["indices"]]["count"] // 3
                primitives.append({"attributes": {a: accessor(p["attributes"][a], 34962) for a in
                                                  ("POSITION", "NORMAL", "TEXCOORD_0")},
                                   "indices": accessor(p["indices"], 34963), "material": material(p["material"])})
            self.doc["meshes"].append({"name": node["name"], "primitives": primitives})
            self.triangles.append(triangles)
            above = order.index(parents[i]) if i in parents else None
            parts.append((len(self.doc["meshes"]) - 1, node["name"], at, above))
        return parts, lo, hi

    def texture(self, data, mime):
        for i, image in enumerate(self.doc["images"]):
            view = self.doc["bufferViews"][image["bufferView"]]
            if self.buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]] == data:
                return i
        self.doc["images"].append({"bufferView": self.add(data), "mimeType": mime, "name": "dungeon texture"})
        self.doc["textures"].append({"source": len(self.doc["images"]) - 1})
        return len(self.doc["textures"]) - 1

    def quads(self, name, quads, color):
        """A mesh of rectangles, each a corner and two sides; the normal is their cross product."""
        points, normals, indices = [], [], []
        for c, u, v in quads:
            n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            length = math.sqrt(sum(x * x for x in n))
            indices += [len(points) + i for i in (0, 1, 2, 0, 2, 3)]
            points += [[c[k] + a * u[k] + b * v[k] for k in range(3)] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            normals += [[x / length for x in n]] * 4

        def accessor(data, component, kind, target, **more):
            count = len(data) // (2 if kind == "SCALAR" else 12)
            self.doc["accessors"].append({"bufferView": self.add(data, target=target), "componentType": component,
                                          "count": count, "type": kind, **more})
            return len(self.doc["accessors"]) - 1

        floats = lambda rows: struct.pack("<%df" % (3 * len(rows)), *[c for r in rows for c in r])
        single = lambda c: struct.unpack("<f", struct.pack("<f", c))[0]
        bounds = {m: [single(f(p[k] for p in points)) for k in range(3)] for m, f in (("min", min), ("max", max))}
        attributes = {"POSITION": accessor(floats(points), 5126, "VEC3", 34962, **bounds),
                      "NORMAL": accessor(floats(normals), 5126, "VEC3", 34962)}
        order = accessor(struct.pack("<%dH" % len(indices), *indices), 5123, "SCALAR", 34963)
        material = self.once("materials", {"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1}})
        self.doc["meshes"].append({"name": name, "primitives": [
            {"attributes": attributes, "indices": order, "material": material}]})
        self.triangles.append(2 * len(quads))
        return len(self.doc["meshes"]) - 1
