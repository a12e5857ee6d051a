#!/usr/bin/env python3
"""Writes a level of more than a million triangles and 100 lamps, for tests of large levels: a dungeon of walled rooms
and corridors, built of the pieces of the KayKit dungeon kit (one .glb a piece). Each piece is one shared mesh. The
result is the same for each run. Beside OUT.gltf it writes OUT.bin. Standard library only.

usage: dungeon.py KIT_FOLDER OUT.gltf
Example: dungeon.py ../shared/scenes/dungeon-kit /tmp/dungeon.gltf"""
import json, math, os, random, sys

sys.dont_write_bytecode = True
from dungeon_kit import Fail, Kit

# One character a cell of 4 x 4 m. Equal letters are one room; small letters are corridors, but f is the part of the
# hall F that is 4 m above its floor. x goes right, z down.
PLAN = """
AAAAAAAAaBBBBBBbCCCCCCcDDDDDDD
AAAAAAAAaBBBBBBbCCCCCCcDDDDDDD
AAAAAAAAaBBBBBBbCCCCCCcDDDDDDD
AAAAAAAAaBBBBBBbCCCCCCcDDDDDDD
AAAAAAAAaBBBBBBbCCCCCCcDDDDDDD
AAAAAAAAaBBBBBBbCCCCCCcDDDDDDD
hhhhhhhhhhhhhhhhhhhhhhhhhhhhhh
EEEEEEEiffffffffffffjGGGGGGGGG
EEEEEEEiffffffffffffjGGGGGGGGG
EEEEEEEiFFFFFFFFFFFFjGGGGGGGGG
EEEEEEEiFFFFFFFFFFFFjGGGGGGGGG
EEEEEEEiFFFFFFFFFFFFjGGGGGGGGG
iiiiiiiiFFFFFFFFFFFFjjjjjjjjjj
IIIIIIIiFFFFFFFFFFFFjJJJJkKKKK
IIIIIIIiFFFFFFFFFFFFjJJJJkKKKK
IIIIIIIiFFFFFFFFFFFFjJJJJkKKKK
IIIIIIIiFFFFFFFFFFFFjJJJJkKKKK
mmmmmmmmmmmmmmmmmmmmmmmmmmmmmm
LLLLLnMMMMMMMMoNNNNNNNpPPPPPPP
LLLLLnMMMMMMMMoNNNNNNNpPPPPPPP
LLLLLnMMMMMMMMoNNNNNNNpPPPPPPP
LLLLLnMMMMMMMMoNNNNNNNpPPPPPPP
LLLLLnMMMMMMMMoNNNNNNNpPPPPPPP
LLLLLnMMMMMMMMoNNNNNNNpPPPPPPP
""".split()
ROOMS = {"A": ("cellar", "store"), "B": ("library", "library"), "C": ("dining room", "dining"),
         "D": ("barracks", "beds"), "E": ("tavern", "tavern"), "F": ("great hall", "hall"),
         "G": ("treasury", "treasure"), "I": ("crypt", "ruin"), "J": ("bedroom", "beds"), "K": ("guest room", "beds"),
         "L": ("mine", "ruin"), "M": ("warehouse", "store"), "N": ("refectory", "dining"), "P": ("archive", "library")}
STAIRS = (10, 17)  # the columns in which stairs lead to the raised part of the hall
LAMPS = 100
CELL, HEIGHT, FACE = 4.0, 4.0, 0.3  # metres; FACE: from the middle of a wall to where things hang
FLOOR = 0.05  # the top of floor pieces

# Groups of pieces that stand together: piece, x, y, z, turn in degrees.
GROUPS = {
    "long table": [("table_long_decorated_A", 0, 0, 0, 0)]
                  + [("chair", s * 1.35, 0, z, 90 - s * 90) for s in (-1, 1) for z in (-1.4, -0.5, 0.5, 1.4)],
    "small table": [("table_small_decorated_A", 0, 0, 0, 0), ("chair", 0, 0, 1.0, -90), ("chair", 0, 0, -1.0, 90)],
    "tavern table": [("table_medium_tablecloth", 0, 0, 0, 0), ("plate_food_A", 0.3, 1.0, -0.3, 20),
                     ("bottle_A_green", -0.5, 1.0, 0.3, 0), ("bottle_A_green", -0.2, 1.0, 0.6, 70)]
                    + [("stool", 1.5 * x, 0, 1.5 * z, 0) for x, z in ((1, 0), (-1, 0), (0, 1), (0, -1))],
    "treasure": [("coin_stack_large", 0, 0, 0, 0), ("chest_gold", 1.9, 0, 0.1, 10),
                 ("coin_stack_large", 3.7, 0, 0.1, 130)],
    "bed": [("bed_decorated", 0, 0, 0, 0), ("trunk_large_A", -0.05, 0, 2.3, 0)],
    "candle table": [("table_medium_tablecloth", 0, 0, 0, 0), ("candle_triple", 0, 1.0, 0, 0), ("stool", 1.4, 0, 0, 0),
                     ("bottle_A_green", -0.6, 1.0, 0.4, 0), ("stool", 0, 0, -1.5, 0)],
    "candle barrel": [("barrel_large", 0, 0, 0, 0), ("candle_triple", 0, 1.95, 0, 0), ("box_stacked", 2.8, 0, 0, 90)],
    "small tiles": [("floor_tile_small", -1, 0, -1, 0), ("floor_tile_small", 1, 0, -1, 90),
                    ("floor_tile_small", 1, 0, 1, 0), ("floor_tile_small_broken_A", -1, 0, 1, 180)],
    "barrels": [("barrel_large", 0, 0, 0, 0), ("barrel_large", 1.9, 0, 0.1, 60),
                ("barrel_small_stack", 0.9, 0, 1.5, 0)],
}
# A kind of room: its floor pieces, its wall pieces, what stands at its walls and what anywhere, and how many pieces of
# furniture it has a cell.
KINDS = {
    "store": (["floor_wood_large"], ["wall", "wall", "wall_shelves", "wall_pillar"],
              ["box_stacked", "crates_stacked", "keg_decorated", "shelves"],
              ["box_stacked", "crates_stacked", "barrels"], 0.75),
    "library": (["floor_wood_large"], ["wall_shelves", "wall_shelves", "wall_pillar"],
                ["shelves", "trunk_large_A", "chest_gold"], ["small table", "long table"], 0.5),
    "dining": (["floor_tile_large", "floor_wood_large"], ["wall", "wall_arched"],
               ["keg_decorated", "banner_red", "barrel_small_stack"], ["long table"], 0.6),
    "beds": (["floor_wood_large"], ["wall", "wall_shelves", "wall_pillar"],
             ["chest_gold", "trunk_large_A", "shelves"], ["bed", "bed", "small table"], 0.7),
    "tavern": (["floor_wood_large"], ["wall", "wall_shelves", "wall_arched"],
               ["keg_decorated", "keg_decorated", "barrel_small_stack"], ["tavern table", "small table"], 0.7),
    "hall": (["floor_tile_large"], ["wall", "wall_pillar", "wall_arched"], ["banner_red", "keg_decorated"],
             ["long table", "long table", "tavern table"], 0.45),
    "treasure": (["floor_tile_large"], ["wall", "wall_pillar"], ["chest_gold", "banner_red", "trunk_large_A"],
                 ["treasure", "coin_stack_large", "chest_gold"], 0.8),
    "ruin": (["floor_dirt_large", "floor_dirt_large", "small tiles"], ["wall", "wall_pillar", "wall_arched"],
             ["crates_stacked"], ["rubble_large", "barrels", "barrels", "crates_stacked"], 0.55),
    "corridor": (["floor_tile_large", "small tiles"], ["wall", "wall", "wall_pillar", "wall_arched"],
                 ["banner_red"], [], 0.2),
}
CAMERAS = [  # name, eye, target
    ("great hall", (57.0, 6.4, 34.2), (50.0, 1.0, 54.0)), ("stairs", (51.0, 1.9, 43.2), (41.5, 2.6, 37.0)),
    ("long corridor", (6.0, 1.8, 26.0), (60.0, 1.4, 26.0)), ("library", (38.5, 1.8, 21.5), (55.0, 1.2, 4.0)),
    ("dining room", (86.0, 1.8, 21.5), (68.0, 1.0, 6.0)), ("treasury", (86.5, 2.2, 29.5), (108.0, 0.6, 44.0)),
    ("barracks", (93.5, 2.0, 22.0), (112.0, 0.8, 4.0)), ("mine", (17.5, 1.9, 93.5), (4.0, 1.3, 76.0)),
]


WINDOWS = ("wall_archedwindow_open", "wall_window_open", "wall_broken")
HANGING = ("banner_red", "shelves")  # their origin is in the middle of the wall


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def about_y(degrees):
    a = math.radians(degrees) / 2
    return [0, round(math.sin(a), 6), 0, round(math.cos(a), 6)]


def turned(x, z, degrees):
    """A piece's x and z after a turn; its front, +z, looks along (sin, cos)."""
    a = math.radians(degrees)
    return x * math.cos(a) + z * math.sin(a), z * math.cos(a) - x * math.sin(a)


class Dungeon:
    def __init__(self, folder):
        self.kit, self.random = Kit(folder), random.Random(33).random  # the same numbers in all versions of Python
        self.width, self.depth = len(PLAN[0]), len(PLAN)
        self.nodes, self.lights, self.cameras, self.roots = [], [], [], []
        self.rooms, self.taken = {}, {}
        self.triangles = self.instances = 0

    # The plan.

    def cell(self, i, j):
        return PLAN[j][i] if 0 <= i < self.width and 0 <= j < self.depth else ""

    def room(self, i, j):
        return self.cell(i, j).replace("f", "F")

    def cells(self, room):
        return [(i, j) for j in range(self.depth) for i in range(self.width) if self.room(i, j) == room]

    def kind(self, room):
        return KINDS[ROOMS[room][1] if room in ROOMS else "corridor"]

    def ground(self, i, j):
        return HEIGHT if self.cell(i, j) == "f" else 0.0

    def edges(self):
        """All sides of cells once: x and z of the middle, the turn of a wall there, and the cells before and behind."""
        for j in range(self.depth + 1):
            for i in range(self.width + 1):
                if i < self.width:
                    yield CELL * (i + 0.5), CELL * j, 0, (i, j), (i, j - 1)
                if j < self.depth:
                    yield CELL * i, CELL * (j + 0.5), 90, (i, j), (i - 1, j)

    def pick(self, values):
        return values[int(self.random() * len(values))]

    # Nodes.

    def node(self, parent, **fields):
        self.nodes.append(fields)
        if parent is None:
            self.roots.append(len(self.nodes) - 1)
        else:
            self.nodes[parent].setdefault("children", []).append(len(self.nodes) - 1)
        return len(self.nodes) - 1

    def parent(self, room):
        if room not in self.rooms:
            self.rooms[room] = self.node(None, name=ROOMS[room][0] if room in ROOMS else "corridor " + room)
        return self.rooms[room]

    def place(self, room, name, x, y, z, turn, rotation=None, leaf=None):
        """An instance of a piece. leaf: the turn of its second node; False leaves that out."""
        parts, _, _ = self.kit.piece(name)
        made = []
        for mesh, title, at, above in parts:
            fields = {"name": title, "mesh": mesh}
            if above is None:
                fields.update(translation=[round(c, 4) for c in (x, y, z)], rotation=rotation or about_y(turn))
                made.append(self.node(self.parent(room), **fields))
            elif leaf is not False:
                fields.update(translation=[round(c, 4) for c in at], rotation=about_y(leaf or 0))
                made.append(self.node(made[above], **fields))
            else:
                continue
            self.triangles += self.kit.triangles[mesh]
            self.instances += 1
        return made[0]

    def members(self, name):
        return GROUPS.get(name, [(name, 0, 0, 0, 0)])

    def group(self, room, name, x, y, z, turn, rotation=None):
        for piece, dx, dy, dz, more in self.members(name):
            ox, oz = turned(dx, dz, turn)
            node = self.place(room, piece, x + ox, y + dy, z + oz, turn + more, rotation)
            if piece == "candle_triple":
                self.lamp(node, "candle", 14.0, (1.0, 0.7, 0.4), [0.08, 1.05, 0.03])

    def lamp(self, parent, name, candela, color, at):
        number = len(self.lights) + 1
        self.lights.append({"type": "point", "name": "%s %d" % (name, number), "color": list(color),
                            "intensity": round(candela * (0.85 + 0.3 * self.random()), 2)})
        self.nodes[parent]["name"] = "%s %d" % (name, number)
        self.node(parent, name="light %d" % number, translation=at,
                  extensions={"KHR_lights_punctual": {"light": number - 1}})

    # Free space.

    def footprint(self, name, x, z, turn):
        xs, zs = [], []
        for piece, dx, _, dz, more in self.members(name):
            _, lo, hi = self.kit.piece(piece)
            for px in (lo[0], hi[0]):
                for pz in (lo[2], hi[2]):
                    qx, qz = turned(px, pz, more)
                    qx, qz = turned(qx + dx, qz + dz, turn)
                    xs.append(x + qx)
                    zs.append(z + qz)
        return min(xs), min(zs), max(xs), max(zs)

    def take(self, cell, box):
        self.taken.setdefault(cell, []).append(box)

    def take_round(self, x, z, half_x, half_z):
        """Keeps a box free in all rooms that it touches."""
        for cell in {self.cell(int((x + a * half_x) // CELL), int((z + b * half_z) // CELL))
                     for a in (-1, 0, 1) for b in (-1, 0, 1)}:
            self.take(cell, (x - half_x, z - half_z, x + half_x, z + half_z))

    def is_free(self, cell, box, margin):
        """Whether a box, and a margin about it, is in cells of this letter alone, and the box touches nothing."""
        i0, j0, i1, j1 = (int((c + m) // CELL) for c, m in zip(box, (-margin, -margin, margin, margin)))
        if any(self.cell(i, j) != cell for i in range(i0, i1 + 1) for j in range(j0, j1 + 1)):
            return False
        return not any(overlap(box, other) for other in self.taken.get(cell, []))

    def put(self, room, name, tries=40):
        """A group somewhere in the room; False if no place was found."""
        cells = self.cells(room)
        for _ in range(tries):
            i, j = self.pick(cells)
            x, z = CELL * (i + self.random()), CELL * (j + self.random())
            turn = 90 * int(4 * self.random()) + 16 * (self.random() - 0.5)
            box = self.footprint(name, x, z, turn)
            if self.is_free(self.cell(i, j), box, 0.8):
                self.take(self.cell(i, j), box)
                self.group(room, name, x, self.ground(i, j) + FLOOR, z, turn)
                return True
        return False

    # What the level is made of.

    def floors_and_ceilings(self):
        for j in range(self.depth):
            for i in range(self.width):
                room = self.room(i, j)
                x, z, floors = CELL * (i + 0.5), CELL * (j + 0.5), self.kind(room)[0]
                top = 2 * HEIGHT if room == "F" else HEIGHT
                above = floors[0] if floors[0] != "floor_dirt_large" else "floor_tile_large"  # no pebbles above
                self.group(room, self.pick(floors), x, self.ground(i, j), z, 90 * int(4 * self.random()))
                self.group(room, above, x, top - 0.03, z, 0, rotation=[1, 0, 0, 0])

    def openings(self):
        """Chooses the sides of cells that are doors and windows: between each two rooms side by side, at least one."""
        shared = {}
        for x, z, turn, a, b in self.edges():
            rooms = sorted((self.room(*a), self.room(*b)))
            if rooms[0] and rooms[0] != rooms[1] and self.ground(*a) == self.ground(*b) == 0:
                shared.setdefault(tuple(rooms), []).append((x, z))
        self.doors, self.windows = set(), set()
        for rooms in sorted(shared):
            sides = shared[rooms]
            inner = sides[1:-1] or sides
            self.doors.add(self.pick(inner))
            rest = [s for s in inner if s not in self.doors]
            if len(rest) > 3:
                self.windows.add(self.pick(rest))
        for x, z, turn, _, _ in self.edges():
            if (x, z) in self.doors:
                along, across = turned(1.3, 2.3, turn)
                self.take_round(x, z, abs(along), abs(across))

    def choose_lamps(self):
        """Candles at free places, and torches far from each other at walls; by the sizes of the rooms, 100 in all."""
        names = sorted({self.room(i, j) for j in range(self.depth) for i in range(self.width)})
        weights = {r: len(self.cells(r)) * (1 if r in ROOMS else 1.6) for r in names}
        exact = {r: LAMPS * w / sum(weights.values()) for r, w in weights.items()}
        counts = {r: int(e) for r, e in exact.items()}
        for r in sorted(names, key=lambda r: counts[r] - exact[r])[:LAMPS - sum(counts.values())]:
            counts[r] += 1
        self.torches, faces = {}, {}
        for x, z, turn, a, b in self.edges():
            for cell, toward in ((a, turn), (b, turn + 180)):
                if self.wall_rooms(a, b) and self.room(*cell) and (x, z) not in self.doors | self.windows:
                    faces.setdefault(self.room(*cell), []).append((x, z, toward, cell))
        self.faces = faces
        for room in names:
            candles = 0
            if room in ROOMS:
                for _ in range(int(0.3 * counts[room])):
                    candles += self.put(room, self.pick(["candle table", "candle barrel"]))
            free = list(faces[room])
            chosen = [self.pick(free)]
            while len(chosen) < counts[room] - candles:
                chosen.append(max(free, key=lambda f: min((f[0] - c[0]) ** 2 + (f[1] - c[1]) ** 2 for c in chosen)))
            for x, z, toward, cell in chosen:
                self.torches.setdefault((x, z), []).append(toward)
                dx, dz = turned(0, FACE, toward)
                node = self.place(room, "torch_mounted", x + dx, self.ground(*cell) + 2.2, z + dz, toward)
                self.lamp(node, "torch", 45.0, (1.0, 0.6, 0.3), [0, 0.9, 0.5])
                dx, dz = turned(0, 0.8, toward)
                self.take_round(x + dx, z + dz, 0.7, 0.7)

    def wall_rooms(self, a, b):
        """The rooms at a wall between two cells, of which the first chooses its pieces; none: there is no wall."""
        rooms = [r for r in (self.room(*a), self.room(*b)) if r]
        if len(set(rooms)) == 1 and len(rooms) == 2 and self.ground(*a) == self.ground(*b):
            return []
        return sorted(rooms, key=lambda r: r not in ROOMS)

    def walls(self):
        """Walls, with the pillars at their ends and corners; the hall's are two walls high."""
        ends = {}
        for x, z, turn, a, b in self.edges():
            rooms = self.wall_rooms(a, b)
            if not rooms:
                continue
            room = rooms[0]
            front = turn if self.room(*a) == room else turn + 180  # shelves are on the front
            if self.ground(*a) != self.ground(*b) and set(rooms) == {"F"}:
                front = turn if self.ground(*a) == 0 else turn + 180
                pieces = ["wall"]
            elif (x, z) in self.torches:
                pieces = ["wall"]
            else:
                pieces = self.kind(room)[1]
            if (x, z) in self.doors:
                leaf = 100 + 40 * self.random() if room in ROOMS else False
                self.place(room, "wall_doorway", x, 0, z, front, leaf=leaf)
            elif (x, z) in self.windows:
                self.place(room, self.pick(WINDOWS), x, 0, z, front)
            else:
                piece = self.pick(pieces)
                self.place(room, piece, x, 0, z, front)
                if piece not in ("wall", "wall_arched"):
                    for r in set(rooms):
                        self.faces[r] = [f for f in self.faces[r] if f[:2] != (x, z)]
            levels = [0.0]
            if "F" in rooms and set(rooms) != {"F"} or rooms == ["F"]:
                self.place("F", self.pick(["wall", "wall_arched"]), x, HEIGHT, z, front)
                levels.append(HEIGHT)
            for side in (-1, 1):
                dx, dz = turned(side * CELL / 2, 0, turn)
                for y in levels:
                    ends.setdefault((round(x + dx), y, round(z + dz)), []).append((turn, room))
        for (x, y, z), walls in sorted(ends.items()):
            if len(walls) != 2 or walls[0][0] != walls[1][0]:
                self.place(walls[0][1], "pillar", x, y, z, 0)

    def hall(self):
        """What stands fast in the hall: stairs, posts along the edge of its raised part, and pillars."""
        row = next(j for j in range(self.depth) if "F" in PLAN[j])
        edge, left, right = CELL * row, CELL * PLAN[row].index("F"), CELL * (PLAN[row].rindex("F") + 1)
        for i in STAIRS:
            self.place("F", "stairs", CELL * (i + 0.5), 0, edge, 0)
            self.take_round(CELL * (i + 0.5), edge + 3, 2.7, 2.9)
        for k in range(int(right - left) // 2 - 1):
            x = left + 2 * (k + 1)
            if all(abs(x - CELL * (i + 0.5)) > 2.6 for i in STAIRS):
                self.place("F", "column", x, HEIGHT + FLOOR, edge - 0.3, 0)
                self.take("f", (x - 0.5, edge - 0.8, x + 0.5, edge + 0.2))
        for x in range(int(left) + 8, int(right), 8):
            for z in (46, 58):
                self.take_round(x, z, 0.9, 0.9)
                for y in (0, HEIGHT):
                    self.place("F", "pillar", x, y + (0 if y else FLOOR), z, 0)

    def rock(self):
        """Plain rectangles behind floors, walls and ceilings: no light and no view between pieces."""
        cells = self.cells("F")
        low, high, gap = HEIGHT + 0.07, 2 * HEIGHT + 0.07, 0.6
        x, z = ([-1.0, CELL * min(c) - gap, CELL * (max(c) + 1) + gap, CELL * count + 1]
                for c, count in zip(zip(*cells), (self.width, self.depth)))
        flat = lambda a, b, c, d, y, up: (([a, y, d], [b - a, 0, 0], [0, 0, c - d]) if up else
                                          ([a, y, c], [b - a, 0, 0], [0, 0, d - c]))
        around = lambda a, b, c, d, y, h: [([a, y, d], [0, 0, c - d], [0, h, 0]), ([b, y, c], [0, 0, d - c], [0, h, 0]),
                                           ([a, y, c], [b - a, 0, 0], [0, h, 0]), ([b, y, d], [a - b, 0, 0], [0, h, 0])]
        quads = [flat(x[0], x[3], z[0], z[3], 0, True), flat(x[1], x[2], z[1], z[2], high, False),
                 flat(x[0], x[3], z[0], z[1], low, False), flat(x[0], x[3], z[2], z[3], low, False),
                 flat(x[0], x[1], z[1], z[2], low, False), flat(x[2], x[3], z[1], z[2], low, False),
                 *around(x[0], x[3], z[0], z[3], 0, low), *around(x[1], x[2], z[1], z[2], low, high - low)]
        mesh = self.kit.quads("rock", quads, (0.2, 0.19, 0.18))
        self.node(None, name="rock", mesh=mesh)
        self.triangles += self.kit.triangles[mesh]
        self.instances += 1

    def put_at_wall(self, room, name):
        """A piece with its back to some wall of the room; nothing if that place is taken."""
        x, z, toward, cell = self.pick(self.faces[room])
        _, lo, hi = self.kit.piece(name)
        hangs = name in HANGING
        slack = max(0, 1.2 - max(hi[0], -lo[0]))
        dx, dz = turned(slack * (2 * self.random() - 1), 0 if hangs else 0.52 - lo[2], toward)
        box = self.footprint(name, x + dx, z + dz, toward)
        letter = self.cell(*cell)
        if not any(overlap(box, other) for other in self.taken.get(letter, [])):
            self.take(letter, box)
            self.place(room, name, x + dx, self.ground(*cell) + (0 if hangs else FLOOR), z + dz, toward)

    def furnish(self):
        for room in sorted(self.rooms):
            _, _, at_walls, anywhere, density = self.kind(room)
            for k in range(int(density * len(self.cells(room)))):
                if anywhere and k % 3:
                    self.put(room, self.pick(anywhere))
                else:
                    self.put_at_wall(room, self.pick(at_walls))

    def look(self, name, eye, target):
        b = [eye[k] - target[k] for k in range(3)]
        turn, tilt = math.atan2(b[0], b[2]), -math.asin(b[1] / math.sqrt(sum(c * c for c in b)))
        sy, cy, sx, cx = math.sin(turn / 2), math.cos(turn / 2), math.sin(tilt / 2), math.cos(tilt / 2)
        self.cameras.append({"name": name, "type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.05}})
        self.node(None, name=name, camera=len(self.cameras) - 1, translation=list(eye),
                  rotation=[round(c, 6) for c in (cy * sx, sy * cx, -sy * sx, cy * cx)])

    def build(self):
        for name, eye, target in CAMERAS:
            self.look(name, eye, target)
            d = math.hypot(target[0] - eye[0], target[2] - eye[2])
            dx, dz = (target[0] - eye[0]) / d, (target[2] - eye[2]) / d
            for ahead in (0, 1.5, 3, 4.5):
                self.take_round(eye[0] + ahead * dx, eye[2] + ahead * dz, 1, 1)
        self.floors_and_ceilings()
        self.openings()
        self.hall()
        self.choose_lamps()
        self.walls()
        self.furnish()
        self.rock()

    def write(self, path):
        binary = os.path.splitext(path)[0] + ".bin"
        doc = {"asset": {"version": "2.0", "generator": "Lamplighter tests/tools/dungeon.py",
                         "copyright": "pieces: KayKit Dungeon Remastered by Kay Lousberg, CC0 1.0"},
               "extensionsUsed": ["KHR_lights_punctual"],
               "extensions": {"KHR_lights_punctual": {"lights": self.lights}},
               "scene": 0, "scenes": [{"name": "dungeon", "nodes": self.roots}], "nodes": self.nodes,
               "cameras": self.cameras, **self.kit.doc,
               "buffers": [{"byteLength": len(self.kit.buffer), "uri": os.path.basename(binary)}]}
        try:
            with open(binary, "wb") as f:
                f.write(self.kit.buffer)
            with open(path, "w") as f:
                json.dump(doc, f, separators=(",", ":"))
                f.write("\n")
        except OSError as e:
            raise Fail("cannot write %s: %s" % (e.filename, e.strerror))


def main(arguments):
    if arguments in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    try:
        if len(arguments) != 2:
            raise Fail("needs KIT_FOLDER and OUT.gltf; see --help")
        if not arguments[1].endswith(".gltf"):
            raise Fail("%s: the name must end in .gltf" % arguments[1])
        dungeon = Dungeon(arguments[0])
        dungeon.build()
        dungeon.write(arguments[1])
    except Fail as e:
        print("dungeon.py: %s" % e, file=sys.stderr)
        return 2
    print("%s: %d triangles in %d instances of %d meshes, %d lamps, %d cameras" %
          (arguments[1], dungeon.triangles, dungeon.instances, len(dungeon.kit.doc["meshes"]), len(dungeon.lights),
           len(dungeon.cameras)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
