#!/usr/bin/env python3
"""Writes what docs/user/tutorial.md works with: an empty room, and in props/ what it is furnished with, one mesh each that
stands on y = 0. Run it only to change them. Standard library only."""
import math, os, struct, sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "scenes"))
from generate import Scene  # noqa: E402

OAK, CLOTH, IRON = (0.46, 0.29, 0.15), (0.5, 0.16, 0.12), (0.12, 0.12, 0.13)
GLAZE, PAPER, BLUE, OCHRE = (0.16, 0.34, 0.42), (0.75, 0.7, 0.6), (0.1, 0.2, 0.5), (0.62, 0.42, 0.14)


class Prop:
    """Surfaces by material, written as the primitives of one mesh."""
    def __init__(self, name):
        self.name, self.parts = name, {}

    def surface(self, colour, positions, normals, indices):
        p, n, i = self.parts.setdefault(colour, ([], [], []))
        i += [len(p) + k for k in indices]
        p += positions
        n += normals

    def box(self, colour, size, at):
        """`at`: the middle of its underside."""
        x, y, z = size[0] / 2, size[1], size[2] / 2
        for axis in range(3):
            for sign in (-1, 1):
                normal = [sign * (k == axis) for k in range(3)]
                u, v = (axis + 1) % 3, (axis + 2) % 3
                corners = []
                for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    c = [0, 0, 0]
                    c[axis], c[u], c[v] = sign, a * sign, b
                    corners.append([at[0] + c[0] * x, at[1] + (c[1] + 1) / 2 * y, at[2] + c[2] * z])
                self.surface(colour, corners, [normal] * 4, [0, 1, 2, 0, 2, 3])

    def turned(self, colour, profile, around=32):
        """A surface of revolution about y: (radius, height) from the foot up, outside seen from outside."""
        positions, normals, indices = [], [], []
        for k, (r, y) in enumerate(profile):
            r0, y0 = profile[max(k - 1, 0)]
            r1, y1 = profile[min(k + 1, len(profile) - 1)]
            out, up = y1 - y0, r0 - r1
            l = math.hypot(out, up)
            for j in range(around):
                a = 2 * math.pi * j / around
                positions.append([r * math.cos(a), y, r * math.sin(a)])
                normals.append([out / l * math.cos(a), up / l, out / l * math.sin(a)])
        for k in range(len(profile) - 1):
            for j in range(around):
                a, b = k * around + j, k * around + (j + 1) % around
                indices += [a, a + around, b, b, a + around, b + around]
        self.surface(colour, positions, normals, indices)

    def write(self):
        s = Scene()
        primitives = []
        f = lambda rows: struct.pack("<%df" % (3 * len(rows)), *[c for r in rows for c in r])
        for colour, (p, n, i) in self.parts.items():
            bounds = tuple([g(struct.unpack("<f", struct.pack("<f", q[k]))[0] for q in p) for k in range(3)]
                           for g in (min, max))
            primitives.append({"material": s.material("%s %d" % (self.name, len(primitives) + 1), colour), "attributes": {
                "POSITION": s._accessor(f(p), "VEC3", 5126, 34962, bounds),
                "NORMAL": s._accessor(f(n), "VEC3", 5126, 34962)},
                "indices": s._accessor(struct.pack("<%dH" % len(i), *i), "SCALAR", 5123, 34963)})
        s.meshes.append({"name": self.name, "primitives": primitives})
        s.node(self.name, mesh=0)
        s.write(self.name.replace(" ", "_"), os.path.join(HERE, "props"))


def table():
    p = Prop("table")
    p.box(OAK, (1.6, 0.05, 0.9), (0, 0.7, 0))
    p.box(OAK, (1.4, 0.08, 0.7), (0, 0.62, 0))
    for x in (-0.7, 0.7):
        for z in (-0.36, 0.36):
            p.box(OAK, (0.07, 0.7, 0.07), (x, 0, z))
    return p


def chair():
    """It faces +z."""
    p = Prop("chair")
    for x in (-0.19, 0.19):
        p.box(OAK, (0.04, 0.42, 0.04), (x, 0, 0.19))
        p.box(OAK, (0.04, 0.9, 0.04), (x, 0, -0.19))
    p.box(CLOTH, (0.44, 0.06, 0.44), (0, 0.42, 0))
    for y in (0.58, 0.7, 0.82):
        p.box(OAK, (0.36, 0.06, 0.025), (0, y, -0.19))
    return p


def bookcase():
    """Its back is at z = -0.15."""
    p = Prop("bookcase")
    p.box(OAK, (1.1, 1.9, 0.02), (0, 0, -0.14))
    for x in (-0.54, 0.54):
        p.box(OAK, (0.03, 1.9, 0.3), (x, 0, 0))
    shelves = (0.06, 0.5, 0.9, 1.3, 1.87)
    for y in shelves:
        p.box(OAK, (1.06, 0.03, 0.28), (0, y, 0))
    colours, number = (CLOTH, BLUE, OCHRE, PAPER, GLAZE), 7
    for y in shelves[:4]:
        x = -0.5
        while x < 0.42:
            number = (number * 37 + 11) % 101
            wide, high = 0.03 + 0.0003 * number, 0.22 + 0.0011 * ((number * 7) % 100)
            if number % 9 == 0:
                x += 0.09
            p.box(colours[number % 5], (wide - 0.003, high, 0.17 + 0.0004 * number), (x + wide / 2, y + 0.03, 0))
            x += wide
    return p


def rug():
    p = Prop("rug")
    p.box(CLOTH, (2.6, 0.012, 1.8), (0, 0, 0))
    p.box(PAPER, (2.3, 0.004, 1.5), (0, 0.012, 0))
    p.box(BLUE, (2.2, 0.004, 1.4), (0, 0.016, 0))
    return p


def vase():
    p = Prop("vase")
    outside = [(0.002, 0.0), (0.06, 0.0), (0.075, 0.02), (0.105, 0.08), (0.115, 0.14), (0.1, 0.2), (0.06, 0.26),
               (0.045, 0.3), (0.05, 0.34), (0.065, 0.37)]
    inside = [(0.055, 0.37), (0.038, 0.33), (0.035, 0.3), (0.05, 0.25), (0.002, 0.24)]
    p.turned(GLAZE, outside + inside)
    return p


def floor_lamp():
    """A stand and an open shade; the light is to be put into it, 1.45 m up."""
    p = Prop("floor lamp")
    p.turned(IRON, [(0.002, 0.0), (0.16, 0.0), (0.16, 0.02), (0.012, 0.035), (0.012, 1.38), (0.002, 1.385)])
    p.turned(PAPER, [(0.24, 1.3), (0.15, 1.62)])
    p.turned(PAPER, [(0.148, 1.62), (0.238, 1.3)])
    return p


def walls(s, name, material, boxes):
    """Boxes as one object: (from, to) corners."""
    quads = []
    for a, b in boxes:
        X, Y, Z = [b[0] - a[0], 0, 0], [0, b[1] - a[1], 0], [0, 0, b[2] - a[2]]
        neg = lambda v: [-c for c in v]
        quads += [([a[0], b[1], b[2]], X, neg(Z)), (list(a), X, Z), ([a[0], a[1], b[2]], X, Y),
                  ([b[0], a[1], a[2]], neg(X), Y), (list(b[:1]) + [a[1], b[2]], neg(Z), Y), (list(a), Z, Y)]
    s.quads(name, quads, material)


def empty_room():
    """Where the tutorial begins: a room with a window to the right, and no light."""
    s = Scene()
    plaster, sage = s.material("plaster", (0.76, 0.73, 0.68)), s.material("sage", (0.4, 0.48, 0.34))
    boards, paint = s.material("boards", (0.42, 0.27, 0.16)), s.material("paint", (0.8, 0.79, 0.76))
    # 6 x 2.8 x 5 m inside, walls 0.3 m thick; the window is 2.2 m wide and 1.6 m high, its sill at 0.7 m.
    walls(s, "floor", boards, [((-3.3, -0.3, -2.8), (3.3, 0, 2.8))])
    walls(s, "ceiling", plaster, [((-3.3, 2.8, -2.8), (3.3, 3.1, 2.8))])
    walls(s, "left wall", plaster, [((-3.3, 0, -2.5), (-3, 2.8, 2.5))])
    walls(s, "back wall", sage, [((-3.3, 0, -2.8), (3.3, 2.8, -2.5))])
    walls(s, "front wall", plaster, [((-3.3, 0, 2.5), (3.3, 2.8, 2.8))])
    walls(s, "right wall", plaster, [((3, 0, -2.5), (3.3, 0.7, 2.5)), ((3, 2.3, -2.5), (3.3, 2.8, 2.5)),
                                     ((3, 0.7, -2.5), (3.3, 2.3, -1.7)), ((3, 0.7, 0.5), (3.3, 2.3, 2.5))])
    walls(s, "window frame", paint, [((3.2, 0.7, -0.63), (3.26, 2.3, -0.57)), ((3.2, 1.72, -1.7), (3.26, 1.78, 0.5))])
    walls(s, "skirting", paint, [((-3, 0, -2.5), (3, 0.12, -2.47)), ((2.97, 0, -2.47), (3, 0.12, 2.5))])
    s.camera("door", (-2.6, 1.65, 2.3), (0.15, 1.0, -1.0), 1.2)
    s.write("empty_room", HERE)


if __name__ == "__main__":
    for make in (table, chair, bookcase, rug, vase, floor_lamp):
        make().write()
    empty_room()
