#!/usr/bin/env python3
"""Writes the scenes of this folder as glTF with embedded buffers. Run it only to change them: the
results are committed, and nothing needs Python to build or run. Standard library only.

Metres, Y up; materials are Lambertian unless they have a roughness; lights are EXT_lights_area (radiance in intensity x color)."""
import base64, json, math, os, struct

HERE = os.path.dirname(os.path.abspath(__file__))
X, Y, Z = [1, 0, 0], [0, 1, 0], [0, 0, 1]


def v(d, k):
    return [c * k for c in d]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(c * c for c in a))
    return [c / length for c in a]


class Scene:
    def __init__(self):
        self.buffer, self.views, self.accessors = bytearray(), [], []
        self.meshes, self.materials, self.nodes, self.lights, self.cameras = [], [], [], [], []
        self.punctuals = []

    def _accessor(self, data, kind, component, target, bounds=None):
        while len(self.buffer) % 4:
            self.buffer.append(0)
        self.views.append({"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data), "target": target})
        self.buffer += data
        size = {"SCALAR": 1, "VEC3": 3}[kind] * {5123: 2, 5126: 4}[component]
        a = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(data) // size, "type": kind}
        if bounds:
            a["min"], a["max"] = bounds
        self.accessors.append(a)
        return len(self.accessors) - 1

    def material(self, name, rgb, metallic=0.0, roughness=1.0):
        self.materials.append({"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*rgb, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}})
        return len(self.materials) - 1

    def mesh(self, name, positions, normals, indices, material):
        f = lambda rows: struct.pack("<%df" % (3 * len(rows)), *[c for r in rows for c in r])
        lo = [min(struct.unpack("<f", struct.pack("<f", p[i]))[0] for p in positions) for i in range(3)]
        hi = [max(struct.unpack("<f", struct.pack("<f", p[i]))[0] for p in positions) for i in range(3)]
        self.meshes.append({"name": name, "primitives": [{"material": material, "attributes": {
            "POSITION": self._accessor(f(positions), "VEC3", 5126, 34962, (lo, hi)),
            "NORMAL": self._accessor(f(normals), "VEC3", 5126, 34962)},
            "indices": self._accessor(struct.pack("<%dH" % len(indices), *indices), "SCALAR", 5123, 34963)}]})
        return len(self.meshes) - 1

    def node(self, name, **fields):
        self.nodes.append({"name": name, **fields})
        return len(self.nodes) - 1

    def quads(self, name, quads, material, **fields):
        """quads: (corner, u, v); the normal is u x v."""
        p, n, i = [], [], []
        for c, u, v in quads:
            k = len(p)
            normal = unit(cross(u, v))
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p.append([c[j] + a * u[j] + b * v[j] for j in range(3)])
                n.append(normal)
            i += [k, k + 1, k + 2, k, k + 2, k + 3]
        return self.node(name, mesh=self.mesh(name, p, n, i, material), **fields)

    def box(self, name, size, material, **fields):
        x, y, z = (s / 2 for s in size)
        X, Y, Z = [2 * x, 0, 0], [0, 2 * y, 0], [0, 0, 2 * z]
        neg = lambda v: [-c for c in v]
        return self.quads(name, [([-x, y, z], X, neg(Z)), ([-x, -y, -z], X, Z), ([-x, -y, z], X, Y),
                                 ([x, -y, -z], neg(X), Y), ([x, -y, z], neg(Z), Y), ([-x, -y, -z], Z, Y)],
                          material, **fields)

    def room(self, size, floor, ceiling, left, right, back, front):
        """An axis-aligned room on y = 0, normals inwards, one object a wall."""
        x, h, z = size[0] / 2, size[1], size[2] / 2
        X, Y, Z = [2 * x, 0, 0], [0, h, 0], [0, 0, 2 * z]
        neg = lambda v: [-c for c in v]
        self.quads("floor", [([-x, 0, z], X, neg(Z))], floor)
        self.quads("ceiling", [([-x, h, -z], X, Z)], ceiling)
        self.quads("left wall", [([-x, 0, z], neg(Z), Y)], left)
        self.quads("right wall", [([x, 0, -z], Z, Y)], right)
        self.quads("back wall", [([-x, 0, -z], X, Y)], back)
        if front is not None:
            self.quads("front wall", [([x, 0, z], neg(X), Y)], front)

    def light(self, name, size, radiance, translation, rotation):
        top = max(radiance)
        self.lights.append({"type": "rect", "name": name, "intensity": top, "color": [c / top for c in radiance],
                            "size": size[1], "rect": {"aspect": size[0] / size[1]}})
        return self.node(name, translation=translation, rotation=rotation,
                         extensions={"EXT_lights_area": {"light": len(self.lights) - 1}})

    def spot(self, name, intensity, cone, translation, rotation):
        """Candela, and the outer cone's half angle in degrees; soft over its outer fifth."""
        top = max(intensity)
        self.punctuals.append({"type": "spot", "name": name, "intensity": top, "color": [c / top for c in intensity],
                               "spot": {"innerConeAngle": math.radians(0.8 * cone), "outerConeAngle": math.radians(cone)}})
        return self.node(name, translation=translation, rotation=rotation,
                         extensions={"KHR_lights_punctual": {"light": len(self.punctuals) - 1}})

    def camera(self, name, eye, target, yfov):
        b = [eye[i] - target[i] for i in range(3)]
        l = math.sqrt(sum(c * c for c in b))
        b = [c / l for c in b]
        r = [b[2], 0.0, -b[0]]
        l = math.sqrt(r[0] ** 2 + r[2] ** 2)
        r = [c / l for c in r]
        u = [b[1] * r[2] - b[2] * r[1], b[2] * r[0] - b[0] * r[2], b[0] * r[1] - b[1] * r[0]]
        self.cameras.append({"name": name, "type": "perspective", "perspective": {"yfov": yfov, "znear": 0.05}})
        self.node(name, camera=len(self.cameras) - 1, translation=list(eye), rotation=quaternion(r, u, b))

    def write(self, name, folder=HERE):
        extensions = {}
        if self.lights:
            extensions["EXT_lights_area"] = {"lights": self.lights}
        if self.punctuals:
            extensions["KHR_lights_punctual"] = {"lights": self.punctuals}
        doc = {"asset": {"version": "2.0", "generator": "Lamplighter assets/scenes/generate.py"},
               "extensionsUsed": list(extensions), "extensions": extensions,
               "scene": 0, "scenes": [{"name": name, "nodes": list(range(len(self.nodes)))}], "nodes": self.nodes,
               "meshes": self.meshes, "materials": self.materials, "cameras": self.cameras,
               "accessors": self.accessors, "bufferViews": self.views,
               "buffers": [{"byteLength": len(self.buffer), "uri": "data:application/octet-stream;base64,"
                            + base64.b64encode(bytes(self.buffer)).decode()}]}
        with open(os.path.join(folder, name + ".gltf"), "w") as f:
            json.dump(rounded(doc), f, indent=1)
            f.write("\n")


def rounded(x):
    if isinstance(x, float):
        return float("%.9g" % x)
    if isinstance(x, dict):
        return {k: rounded(v) for k, v in x.items()}
    return [rounded(v) for v in x] if isinstance(x, list) else x


def quaternion(r, u, b):
    """The rotation whose columns are r, u, b, as x y z w."""
    m = [[r[0], u[0], b[0]], [r[1], u[1], b[1]], [r[2], u[2], b[2]]]
    t = m[0][0] + m[1][1] + m[2][2]
    if t > 0:
        s = math.sqrt(t + 1) * 2
        q = [(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4]
    else:
        i = max(range(3), key=lambda k: m[k][k])
        j, k = (i + 1) % 3, (i + 2) % 3
        s = math.sqrt(1 + m[i][i] - m[j][j] - m[k][k]) * 2
        q = [0, 0, 0, (m[k][j] - m[j][k]) / s]
        q[i], q[j], q[k] = s / 4, (m[j][i] + m[i][j]) / s, (m[k][i] + m[i][k]) / s
    return q


DOWN = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]  # the light's -Z becomes -Y


def turned(axis, degrees):
    a = math.radians(degrees) / 2
    return [axis[0] * math.sin(a), axis[1] * math.sin(a), axis[2] * math.sin(a), math.cos(a)]


def knot(scene, name, material, p, q, radius, tube, around, along, **fields):
    """A (p, q) torus knot as a closed tube with smooth normals, about y: around x along vertices."""
    def centre(t):
        r = radius * (1 + 0.4 * math.cos(q * t))
        return (r * math.cos(p * t), 0.4 * radius * math.sin(q * t), r * math.sin(p * t))
    pos, nor, idx = [], [], []
    for i in range(along):
        t = 2 * math.pi * i / along
        c, d = centre(t), centre(t + 1e-3)
        tangent = unit([d[k] - c[k] for k in range(3)])
        side = unit(cross(tangent, [c[0] + d[0], c[1] + d[1], c[2] + d[2]]))
        other = cross(side, tangent)
        for j in range(around):
            a = 2 * math.pi * j / around
            n = [math.cos(a) * side[k] + math.sin(a) * other[k] for k in range(3)]
            nor.append(n)
            pos.append([c[k] + tube * n[k] for k in range(3)])
            i2, j2 = (i + 1) % along, (j + 1) % around
            A, B, C, D = i * around + j, i2 * around + j, i2 * around + j2, i * around + j2
            idx += [A, C, B, A, D, C]
    # Front faces out: turn the triangles when the first one does not.
    a, b, c = (pos[idx[k]] for k in range(3))
    face = cross([b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)])
    if sum(face[k] * nor[idx[0]][k] for k in range(3)) < 0:
        for k in range(0, len(idx), 3):
            idx[k + 1], idx[k + 2] = idx[k + 2], idx[k + 1]
    return scene.node(name, mesh=scene.mesh(name, pos, nor, idx, material), **fields)


def mover(scene, material, translation):
    """The moving object of the paper's tests: 3,000 vertices."""
    return knot(scene, "mover", material, 2, 3, 0.32, 0.11, 20, 150, translation=translation)


def area_light_room():
    """Figure 5-1, left: a room with two large area lights."""
    s = Scene()
    white = s.material("white", (0.72, 0.71, 0.69))
    blue, ochre = s.material("blue", (0.18, 0.3, 0.55)), s.material("ochre", (0.62, 0.45, 0.2))
    grey = s.material("grey", (0.5, 0.5, 0.5))
    s.room((8, 3.2, 6), white, white, blue, ochre, white, white)
    s.light("left light", (1.8, 3.0), (3.8, 3.5, 3.1), [-2.0, 3.19, 0], DOWN)
    s.light("right light", (1.8, 3.0), (3.1, 3.5, 3.8), [2.0, 3.19, 0], DOWN)
    s.box("crate", (0.9, 0.9, 0.9), grey, translation=[-1.7, 0.45, -0.9], rotation=turned((0, 1, 0), 25))
    s.box("plinth", (0.7, 1.6, 0.7), grey, translation=[1.9, 0.8, -1.3], rotation=turned((0, 1, 0), -15))
    mover(s, s.material("mover", (0.75, 0.4, 0.3)), [0.2, 0.75, 0.4])
    s.camera("camera", (0.4, 1.7, 2.85), (-0.1, 0.95, -1.0), 1.05)
    s.write("area_light_room")


def table(s, wood, x, z):
    s.box("table top", (1.8, 0.06, 1.1), wood, translation=[x, 0.77, z])
    for i, (dx, dz) in enumerate(((-0.8, -0.45), (0.8, -0.45), (-0.8, 0.45), (0.8, 0.45))):
        s.box("leg %d" % (i + 1), (0.08, 0.74, 0.08), wood, translation=[x + dx, 0.37, z + dz])


def table_room():
    """Figure 5-1, middle: a room with a table; strong colour bleeding from its walls."""
    s = Scene()
    white, wood = s.material("white", (0.74, 0.73, 0.7)), s.material("wood", (0.45, 0.28, 0.14))
    s.room((5, 2.8, 5), white, white, s.material("red", (0.65, 0.1, 0.08)), s.material("green", (0.12, 0.5, 0.15)), white, white)
    s.light("ceiling light", (1.4, 1.4), (14.0, 13.0, 11.0), [0, 2.79, 0], DOWN)
    table(s, wood, 0, -0.2)
    mover(s, s.material("mover", (0.75, 0.68, 0.5)), [0.1, 1.05, -0.2])
    s.camera("camera", (1.3, 1.65, 2.4), (-0.15, 0.75, -0.5), 1.05)
    s.write("table_room")


def pillar_room():
    """Figure 5-1, right: a room with four pillars."""
    s = Scene()
    white, stone = s.material("white", (0.72, 0.71, 0.68)), s.material("stone", (0.6, 0.56, 0.5))
    s.room((9, 3.6, 9), white, white, s.material("green", (0.15, 0.45, 0.2)), s.material("sand", (0.65, 0.55, 0.38)), white, white)
    s.light("ceiling light", (2.0, 2.0), (16.0, 15.0, 13.0), [0, 3.59, 0], DOWN)
    for i, (x, z) in enumerate(((-2, -2), (2, -2), (-2, 2), (2, 2))):
        s.box("pillar %d" % (i + 1), (0.6, 3.6, 0.6), stone, translation=[x, 1.8, z])
    mover(s, s.material("mover", (0.7, 0.35, 0.25)), [0.4, 0.6, 0.6])
    s.camera("camera", (0.9, 1.75, 4.3), (0.1, 1.0, -0.5), 1.1)
    s.write("pillar_room")


def cornell_style():
    """A small box for tests: a few dozen triangles, one light, coloured walls."""
    s = Scene()
    white = s.material("white", (0.72, 0.72, 0.72))
    s.room((2, 2, 2), white, white, s.material("red", (0.6, 0.08, 0.06)), s.material("green", (0.12, 0.45, 0.1)), white, None)
    s.light("lamp", (0.5, 0.5), (15.0, 13.0, 9.0), [0, 1.98, 0], DOWN)
    s.box("tall", (0.55, 1.1, 0.55), white, translation=[-0.4, 0.55, -0.35], rotation=turned((0, 1, 0), 18))
    s.box("short", (0.55, 0.55, 0.55), white, translation=[0.4, 0.275, 0.3], rotation=turned((0, 1, 0), -17))
    s.camera("camera", (0, 1.0, 3.4), (0, 0.95, 0), 0.7)
    s.write("cornell_style")


def cornell_specular():
    """Figure 8 of the paper on the virtual light field: a Cornell box with a tall metal box, which throws caustics on
    the floor and on the ceiling."""
    s = Scene()
    white = s.material("white", (0.72, 0.72, 0.72))
    s.room((2, 2, 2), white, white, s.material("red", (0.6, 0.08, 0.06)), s.material("green", (0.12, 0.45, 0.1)), white, None)
    s.light("lamp", (0.6, 0.6), (11.0, 9.6, 7.0), [0.1, 1.98, 0], DOWN)
    s.box("tall", (0.55, 1.15, 0.55), s.material("metal", (0.93, 0.91, 0.88), 1.0, 0.1), translation=[-0.35, 0.575, -0.3],
          rotation=turned((0, 1, 0), 40))
    s.box("short", (0.5, 0.5, 0.5), white, translation=[0.5, 0.25, 0.35], rotation=turned((0, 1, 0), -17))
    s.camera("camera", (0, 1.0, 3.4), (0, 0.95, 0), 0.7)
    s.write("cornell_specular")


def default():
    """What the editor opens first: a vaulted hall corner with an alcove, steps, pillars and a table."""
    s = Scene()
    plaster, stone = s.material("plaster", (0.74, 0.7, 0.63)), s.material("stone", (0.45, 0.43, 0.41))
    floor, wood = s.material("floor", (0.4, 0.3, 0.22)), s.material("wood", (0.36, 0.2, 0.1))
    teal, brick = s.material("teal", (0.1, 0.36, 0.38)), s.material("brick", (0.55, 0.2, 0.13))
    # The hall, 8 x 3.4 x 7 m, with an alcove 2.6 m wide, 2.2 m deep and 2.4 m high in its back wall.
    s.quads("floor", [([-4, 0, 3.5], v(X, 8), v(Z, -7)), ([-1.3, 0, -3.5], v(X, 2.6), v(Z, -2.2))], floor)
    s.quads("ceiling", [([-4, 3.4, -3.5], v(X, 8), v(Z, 7))], plaster)
    s.quads("left wall", [([-4, 0, 3.5], v(Z, -7), v(Y, 3.4))], brick)
    s.quads("right wall", [([4, 0, -3.5], v(Z, 7), v(Y, 3.4))], plaster)
    s.quads("front wall", [([4, 0, 3.5], v(X, -8), v(Y, 3.4))], plaster)
    s.quads("back wall", [([-4, 0, -3.5], v(X, 2.7), v(Y, 3.4)), ([1.3, 0, -3.5], v(X, 2.7), v(Y, 3.4)),
                          ([-1.3, 2.4, -3.5], v(X, 2.6), v(Y, 1.0))], plaster)
    s.quads("alcove", [([-1.3, 0, -5.7], v(X, 2.6), v(Y, 2.4)), ([-1.3, 0, -3.5], v(Z, -2.2), v(Y, 2.4)),
                       ([1.3, 0, -5.7], v(Z, 2.2), v(Y, 2.4)), ([-1.3, 2.4, -5.7], v(X, 2.6), v(Z, 2.2))], teal)
    for i, x in enumerate((-1.75, 1.75)):
        s.box("pillar %d" % (i + 1), (0.5, 3.4, 0.5), stone, translation=[x, 1.7, -2.6])
    for i in range(3):
        s.box("step %d" % (i + 1), (2.4, 0.16 * (i + 1), 0.35), stone, translation=[-2.7, 0.08 * (i + 1), -1.2 - 0.35 * i])
    table(s, wood, 1.4, 0.4)
    s.box("bench", (1.5, 0.45, 0.4), wood, translation=[1.4, 0.225, 1.35])
    s.box("crate", (0.7, 0.7, 0.7), wood, translation=[-3.2, 0.35, 0.9], rotation=turned((0, 1, 0), 20))
    knot(s, "sculpture", s.material("bronze", (0.6, 0.42, 0.24)), 2, 3, 0.26, 0.09, 16, 96, translation=[1.5, 1.05, 0.35])
    s.light("warm ceiling light", (1.6, 1.0), (21.0, 15.5, 9.5), [1.2, 3.38, 0.4], DOWN)
    s.light("alcove light", (1.2, 0.3), (10.0, 19.0, 24.0), [0, 2.38, -4.9], DOWN)
    s.camera("camera", (-1.9, 1.75, 3.1), (0.45, 1.1, -1.6), 1.0)
    s.write("default")


def narrow_gap():
    """Figure 6-1: a lit room, and a dark one that light enters only by a gap in the wall between."""
    s = Scene()
    white, grey = s.material("white", (0.72, 0.71, 0.68)), s.material("grey", (0.55, 0.55, 0.57))
    red, blue = s.material("red", (0.62, 0.2, 0.15)), s.material("blue", (0.2, 0.32, 0.58))
    # Both rooms are 4 m square and 3 m high; the lit one is left of the wall at x = 0, the dark one right.
    s.quads("floor", [([-4, 0, 2], v(X, 8), v(Z, -4))], white)
    s.quads("ceiling", [([-4, 3, -2], v(X, 8), v(Z, 4))], white)
    s.quads("left wall", [([-4, 0, 2], v(Z, -4), v(Y, 3))], red)
    s.quads("right wall", [([4, 0, -2], v(Z, 4), v(Y, 3))], blue)
    s.quads("back wall", [([-4, 0, -2], v(X, 8), v(Y, 3))], white)
    s.quads("front wall", [([4, 0, 2], v(X, -8), v(Y, 3))], white)
    # The wall between is 0.1 m thick; its gap 0.3 m wide and 2.1 m high.
    for name, size, at in (("wall behind the gap", (0.1, 3, 1.85), (0, 1.5, -1.075)),
                           ("wall before the gap", (0.1, 3, 1.85), (0, 1.5, 1.075)),
                           ("lintel", (0.1, 0.9, 0.3), (0, 2.55, 0))):
        s.box(name, size, grey, translation=list(at))
    s.light("lamp", (1.2, 1.2), (250.0, 235.0, 205.0), [-1.8, 2.99, 1.2], DOWN)
    knot(s, "knot", s.material("clay", (0.7, 0.45, 0.3)), 2, 3, 0.34, 0.12, 20, 150, translation=[1.6, 0.75, -0.4])
    s.box("plinth", (0.6, 0.3, 0.6), grey, translation=[1.6, 0.15, -0.4])
    s.camera("camera", (0.3, 1.7, 1.8), (2.75, 0.95, -0.75), 1.1)
    s.write("narrow_gap")


def close_light():
    """Figure 6-2: a floor lit by a spot alone, and an object close above it, so that some samples of the bounced
    light lie right beside the object and throw its silhouette on the far walls."""
    s = Scene()
    white, grey = s.material("white", (0.74, 0.73, 0.7)), s.material("grey", (0.5, 0.5, 0.5))
    s.room((6, 3, 5), white, white, s.material("sand", (0.65, 0.55, 0.38)), s.material("teal", (0.25, 0.5, 0.5)), white, white)
    s.spot("spot", (240.0, 226.0, 202.0), 24, [-0.6, 2.95, 0.2], DOWN)
    knot(s, "knot", s.material("clay", (0.7, 0.4, 0.3)), 2, 3, 0.34, 0.12, 20, 150, translation=[-0.15, 0.34, -0.3])
    s.box("crate", (0.6, 0.6, 0.6), grey, translation=[1.7, 0.3, -1.2], rotation=turned((0, 1, 0), 30))
    s.camera("camera", (0.3, 1.6, 2.35), (0.0, 1.05, -1.5), 1.1)
    s.write("close_light")


def corridor():
    """A corridor that turns, and a lamp behind its corner: what the camera sees has bounced light alone."""
    s = Scene()
    white, blue = s.material("white", (0.75, 0.75, 0.75)), s.material("blue", (0.3, 0.4, 0.7))
    # Two arms, 2 m wide and 3 m high: one along Z at x < -1, one along X at z < -1.
    for name, y, side in (("floor", 0, 1), ("ceiling", 3, -1)):
        s.quads(name, [([-3 if side > 0 else -1, y, 3], v(X, 2 * side), v(Z, -6)),
                       ([-1 if side > 0 else 3, y, -1], v(X, 4 * side), v(Z, -2))], white)
    s.quads("outer walls", [([-3, 0, 3], v(Z, -6), v(Y, 3)), ([-3, 0, -3], v(X, 6), v(Y, 3)),
                            ([3, 0, -3], v(Z, 2), v(Y, 3)), ([-1, 0, 3], v(X, -2), v(Y, 3))], white)
    s.quads("inner walls", [([-1, 0, -1], v(Z, 4), v(Y, 3)), ([3, 0, -1], v(X, -4), v(Y, 3))], blue)
    s.box("crate", (0.5, 0.5, 0.5), white, translation=[-2.5, 0.25, -0.6], rotation=turned((0, 1, 0), 20))
    s.light("lamp", (0.8, 0.8), (44.0, 40.0, 34.0), [2.2, 2.9, -2.0], DOWN)
    s.camera("camera", (-2.0, 1.6, 2.6), (-2.0, 1.2, -2.0), 0.9)
    s.write("corridor")


def door_ajar():
    """A dark room that light enters by a door ajar alone, seen from its dark side."""
    s = Scene()
    white, wood = s.material("white", (0.75, 0.75, 0.75)), s.material("wood", (0.5, 0.3, 0.2))
    s.room((6, 3, 6), white, white, white, s.material("sage", (0.4, 0.55, 0.4)), white, white)
    for name, size, at in (("wall left of the door", (3.2, 3, 0.1), (-1.4, 1.5, 0)),
                           ("wall right of the door", (2.0, 3, 0.1), (2.0, 1.5, 0)),
                           ("lintel", (0.8, 0.95, 0.1), (0.6, 2.525, 0))):
        s.box(name, size, white, translation=list(at))
    # The hinge is at x = 0.2; the door opens into the dark room by 40 degrees.
    a = math.radians(40)
    s.box("door", (0.76, 2.03, 0.04), wood, translation=[0.2 + 0.38 * math.cos(a), 1.02, -0.38 * math.sin(a)],
          rotation=turned((0, 1, 0), 40))
    s.box("chest", (0.9, 0.5, 0.5), wood, translation=[-1.2, 0.25, -0.6])
    s.light("lamp", (1.0, 1.0), (66.0, 60.0, 50.0), [0.4, 2.9, 1.6], DOWN)
    s.camera("camera", (-1.8, 1.7, -2.7), (0.6, 0.9, 0.0), 0.9)
    s.write("door_ajar")


def u_corridor():
    """Figure 10 of the paper on view-adaptive imperfect shadow maps: a corridor in the shape of a U. The camera faces
    the back of its right leg, the lamp is at the end of the left one: few points that the lamp lights are seen from
    what the camera sees."""
    s = Scene()
    white, stone = s.material("white", (0.75, 0.74, 0.72)), s.material("stone", (0.6, 0.57, 0.52))
    red, blue = s.material("red", (0.62, 0.16, 0.12)), s.material("blue", (0.2, 0.32, 0.6))
    # 3 m wide and 2.7 m high: legs along Z at x < -1 and x > 1, joined at z < -3. Between them is solid wall.
    h = 2.7
    for name, y, side in (("floor", 0, 1), ("ceiling", h, -1)):
        start = lambda x, width: x if side > 0 else x + width
        s.quads(name, [([start(x, 3), y, 4.5], v(X, 3 * side), v(Z, -10.5)) for x in (-4, 1)]
                + [([start(-1, 2), y, -3], v(X, 2 * side), v(Z, -3))], white)
    s.quads("left wall", [([-4, 0, 4.5], v(Z, -10.5), v(Y, h))], white)
    s.quads("right wall", [([4, 0, -6], v(Z, 10.5), v(Y, h))], blue)
    s.quads("front wall", [([-4, 0, -6], v(X, 8), v(Y, h))], white)
    s.quads("end of the left leg", [([-1, 0, 4.5], v(X, -3), v(Y, h))], red)
    s.quads("end of the right leg", [([4, 0, 4.5], v(X, -3), v(Y, h))], white)
    s.quads("inner walls", [([-1, 0, -3], v(Z, 7.5), v(Y, h)), ([1, 0, -3], v(X, -2), v(Y, h)),
                            ([1, 0, 4.5], v(Z, -7.5), v(Y, h))], white)
    for i, (x, z) in enumerate(((-2.5, -2.4), (1.9, -1.6), (3.1, -1.6), (2.3, 2.0))):
        s.box("pillar %d" % (i + 1), (0.24, h, 0.24), stone, translation=[x, h / 2, z])
    s.box("crate", (0.6, 0.6, 0.6), stone, translation=[3.3, 0.3, 3.2], rotation=turned((0, 1, 0), 25))
    s.light("lamp", (1.4, 1.4), (420.0, 385.0, 330.0), [-2.5, h - 0.02, 3.3], DOWN)
    s.camera("camera", (2.2, 1.6, -5.6), (2.6, 1.15, 3.0), 0.95)
    s.camera("towards the turn", (3.4, 1.6, 4.1), (1.8, 1.2, -5.0), 0.95)
    s.camera("lit leg", (-3.5, 1.6, -5.6), (-2.3, 1.2, 5.0), 0.95)
    s.write("u_corridor")


def skin(parts):
    """Positions, smooth normals and indices of closed surfaces. A part is a list of rings; a ring has the same number
    of points as the others of its part, or is one point."""
    pos, nor, idx = [], [], []
    for rings in parts:
        first, triangles, starts = len(pos), [], []
        for ring in rings:
            starts.append(len(pos))
            pos += [list(p) for p in ring]
        nor += [[0.0, 0.0, 0.0] for _ in pos[first:]]
        for i in range(len(rings) - 1):
            n, m = len(rings[i]), len(rings[i + 1])
            for j in range(max(n, m)):
                a, b = starts[i] + j % n, starts[i] + (j + 1) % n
                c, d = starts[i + 1] + j % m, starts[i + 1] + (j + 1) % m
                triangles += [t for t in ((a, c, b), (b, c, d)) if len(set(t)) == 3]
        volume = 0.0
        for a, b, c in triangles:
            face = cross([pos[b][k] - pos[a][k] for k in range(3)], [pos[c][k] - pos[a][k] for k in range(3)])
            volume += sum(face[k] * (pos[a][k] - pos[first][k]) for k in range(3))
            for t in (a, b, c):
                for k in range(3):
                    nor[t][k] += face[k]
        out = 1 if volume > 0 else -1
        nor[first:] = [unit([out * c for c in n]) for n in nor[first:]]
        idx += [t[k] for t in triangles for k in ((0, 1, 2) if out > 0 else (0, 2, 1))]
    return pos, nor, idx


def lathe(profile, around, along, folds=0, depth=0.0, turn=0.0):
    """Rings about y. profile(t): radius and height, t from 0 to 1; folds of a relative depth, turned by turn radians."""
    def point(t, a):
        r, y = profile(t)
        r *= 1 + depth * (1 - t) * math.cos(folds * (a + turn * t))
        return r * math.cos(a), y, r * math.sin(a)
    around = [2 * math.pi * j / around for j in range(around)]
    return [[point(t, a) for a in (around if profile(t)[0] > 1e-9 else (0,))]
            for t in (i / along for i in range(along + 1))]


def bent(path, radius, around, along, across=Z, closed=False):
    """Rings of a tube along path(t), which nowhere goes along across; closed by end points, or joined to a loop."""
    rings = []
    for i in range(along + 1):
        t = (i % along if closed else i) / along
        c, d, e = path(t), path(t - 1e-3), path(t + 1e-3)
        tangent = unit([e[k] - d[k] for k in range(3)])
        side = unit(cross(tangent, across))
        other = cross(side, tangent)
        rings.append([[c[k] + radius(t) * (math.cos(a) * side[k] + math.sin(a) * other[k]) for k in range(3)]
                      for a in (2 * math.pi * j / around for j in range(around))])
    return rings if closed else [[path(0.0)], *rings, [path(1.0)]]


def statue(scene, material, **fields):
    """A robed figure 1.75 m tall, with raised arms, a staff, and a ring above its head."""
    def smooth(knots):
        def at(t):
            x = t * (len(knots) - 1)
            i = min(int(x), len(knots) - 2)
            f = (1 - math.cos(math.pi * (x - i))) / 2
            return tuple(p + (q - p) * f for p, q in zip(knots[i], knots[i + 1]))
        return at
    robe = smooth(((0, 0), (0.32, 0), (0.31, 0.12), (0.24, 0.55), (0.155, 0.95), (0.2, 1.2), (0.2, 1.32), (0.06, 1.4),
                   (0, 1.42)))
    head = lambda t: (0.1 * math.sin(math.pi * t) if 0 < t < 1 else 0.0, 1.52 - 0.135 * math.cos(math.pi * t))
    mix = lambda points: lambda t: [sum(w * p[k] for w, p in zip(
        ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3), points)) for k in range(3)]
    arm = lambda t: 0.055 - 0.025 * t
    circle = lambda t: [0.2 * math.cos(2 * math.pi * t), 1.74, 0.2 * math.sin(2 * math.pi * t)]
    left = ((-0.15, 1.3, 0), (-0.5, 1.22, 0.1), (-0.42, 1.5, 0.25), (-0.5, 1.72, 0.2))
    right = ((0.15, 1.3, 0), (0.48, 1.15, 0), (0.4, 1.0, 0.3), (0.45, 1.18, 0.32))
    parts = [lathe(robe, 64, 56, 9, 0.16, 1.1), lathe(head, 24, 16),
             bent(mix(left), arm, 14, 20), bent(mix(right), arm, 14, 20),
             bent(lambda t: [0.45, 0.02 + 1.7 * t, 0.32], lambda t: 0.016, 10, 4),
             bent(circle, lambda t: 0.014, 8, 40, Y, True)]
    return scene.node("statue", mesh=scene.mesh("statue", *skin(parts), material), **fields)


def corridor_statue():
    """Figure 7 of the paper on view-adaptive imperfect shadow maps: a lamp is pointed at the wall at one end of a long
    corridor; the statue that the camera looks at, near the other end, has bounced light alone."""
    s = Scene()
    white, grey = s.material("white", (0.76, 0.75, 0.72)), s.material("grey", (0.5, 0.5, 0.5))
    s.room((3, 2.7, 16), s.material("floor", (0.5, 0.42, 0.34)), white, s.material("green", (0.25, 0.46, 0.28)), white,
           s.material("blue", (0.3, 0.38, 0.6)), s.material("ochre", (0.72, 0.56, 0.3)))
    # The lamp faces the wall at z = 8; nothing on its other side has its direct light.
    s.box("lamp housing", (1.3, 0.5, 0.1), grey, translation=[0, 2.45, 5.94])
    s.light("lamp", (1.2, 0.4), (900.0, 820.0, 690.0), [0, 2.45, 6.0], turned((0, 1, 0), 180))
    s.box("plinth", (0.9, 0.1, 0.9), grey, translation=[0.1, 0.05, -6.2])
    s.box("pedestal", (0.7, 0.4, 0.7), grey, translation=[0.1, 0.3, -6.2])
    statue(s, s.material("marble", (0.78, 0.75, 0.7)), translation=[0.1, 0.5, -6.2], rotation=turned((0, 1, 0), -20))
    s.camera("camera", (-0.75, 1.6, -2.6), (0.1, 1.25, -6.4), 0.9)
    s.camera("behind the statue", (-1.1, 1.7, -7.6), (0.3, 1.3, 0.0), 0.95)
    s.camera("corridor", (1.0, 1.7, 4.5), (-0.1, 1.2, -6.0), 0.9)
    s.write("corridor_statue")


if __name__ == "__main__":
    for make in (area_light_room, table_room, pillar_room, cornell_style, cornell_specular, default, narrow_gap,
                 close_light, corridor, door_ajar, u_corridor, corridor_statue):
        make()
