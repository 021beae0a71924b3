# SPDX-License-Identifier: MIT
"""Part of chart_check.py: the topics that draw a scene, `sampling` and `shadow`, by a ray caster of its own in double precision.

Both CSVs have to be of tests/chart_scene.toml at 160x120, for sampling without the light's shadows:
    mote chart tests/chart_scene.toml --size 160x120 --topic sampling --set light.sun.shadows=false -o sampling.csv
    mote chart tests/chart_scene.toml --size 160x120 --topic shadow -o shadow.csv
What is read of a scene: spheres of one color and a Lambert material, a perspective camera, ambient light, one directional light."""
import csv
import math
import os
import tomllib

from chart_check_float32 import cross, dot, row, scale, sub, unit

WIDTH, HEIGHT = 160, 120


def linear(encoded):
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4


def steps(value):
    """Scene-linear to steps of 255 of the display."""
    value = min(max(value, 0.0), 1.0)
    return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)


def rgb(text):
    return tuple(linear(int(text[k : k + 2], 16) / 255) for k in (1, 3, 5))


def axes_of(camera):
    """Right, down and forward of a view."""
    forward = unit(sub(camera["target"], camera["eye"]))
    right = unit(cross(forward, camera["up"]))
    return right, cross(forward, right), forward


class Scene:
    """Everything in view space: the eye at the origin, x right, y down, z forward."""

    def __init__(self):
        here = os.path.dirname(os.path.abspath(__file__))
        with open(os.path.join(here, "chart_scene.toml"), "rb") as file:
            text = tomllib.load(file)
        data, sun, camera = text["data"][0], text["light"][0], text["camera"]
        with open(os.path.join(here, data["file"]), newline="") as file:
            records = [tuple(float(r[k]) for k in ("x", "y", "z", "radius")) for r in csv.DictReader(file)]
        self.axes = axes_of(camera)
        self.eye = camera["eye"]
        self.spheres = [(self.turned(sub(r[:3], self.eye)), r[3]) for r in records]
        self.outside = [dot(c, c) - r * r for c, r in self.spheres]  # squared tangents from the eye
        self.low = [min(r[k] - r[3] for r in records) for k in range(3)]
        self.high = [max(r[k] + r[3] for r in records) for k in range(3)]
        self.along = unit(sun["direction"])  # world
        self.to_light = scale(self.turned(self.along), -1)
        self.focal = HEIGHT / (2 * math.tan(math.radians(camera["fov_y"]) / 2))
        self.strength, self.ambient = sun["intensity"] * data["material"]["diffuse"], text["ambient"]["intensity"] * data["material"]["ambient"]
        self.color, self.background = rgb(data["color"]), rgb(text["background"])

    def turned(self, v):
        return tuple(dot(axis, v) for axis in self.axes)

    def ray(self, x, y):
        """Of a place on the picture, in pixels from its upper left corner."""
        return (x - WIDTH / 2) / self.focal, (y - HEIGHT / 2) / self.focal, 1.0

    def pixels(self):
        """(x, y, numbers of the spheres that its rays could meet) of each pixel that has any."""
        for y in range(HEIGHT):
            for x in range(WIDTH):
                d = unit(self.ray(x + 0.5, y + 0.5))
                # Other rays of the pixel pass the center by less than distance / focal more closely.
                among = [i for i, (c, r) in enumerate(self.spheres) if dot(c, c) - dot(c, d) ** 2 <= (r + math.hypot(*c) / self.focal) ** 2]
                if among:
                    yield x, y, among

    def hit(self, d, among):
        """Number of the sphere that a ray from the eye meets first, and the point; or None."""
        best, first = math.inf, None
        x, y, z = d
        dd = x * x + y * y + z * z
        for i in among:
            c = self.spheres[i][0]
            b = x * c[0] + y * c[1] + z * c[2]
            square = b * b - dd * self.outside[i]
            if square >= 0 and 0 < (t := (b - math.sqrt(square)) / dd) < best:
                best, first = t, i
        return None if first is None else (first, (x * best, y * best, z * best))

    def cosine(self, number, point):
        """Between the normal and the way to the light."""
        (cx, cy, cz), radius = self.spheres[number]
        x, y, z = self.to_light
        return ((point[0] - cx) * x + (point[1] - cy) * y + (point[2] - cz) * z) / radius

    def normal(self, number, point):
        center, radius = self.spheres[number]
        return scale(sub(point, center), 1 / radius)


# ---- sampling: samples at the centers of k x k cells of a pixel, against 10 x 10 ----


def average(scene, x, y, side, among):
    """Over the pixel; red, green and blue in steps of the display."""
    light, seen = 0.0, 0
    for j in range(side):
        for i in range(side):
            found = scene.hit(scene.ray(x + (i + 0.5) / side, y + (j + 0.5) / side), among)
            if found:
                seen += 1
                light += scene.ambient + scene.strength * max(scene.cosine(*found), 0.0)
    return [steps((light * c + (side * side - seen) * b) / side**2) for c, b in zip(scene.color, scene.background)]


def check_sampling(rows, check):
    scene, sides = Scene(), (1, 2, 3, 4)
    squares = dict.fromkeys(sides, 0.0)
    for x, y, among in scene.pixels():
        wanted = average(scene, x, y, 10, among)
        for side in sides:
            squares[side] += sum((a - b) ** 2 for a, b in zip(average(scene, x, y, side, among), wanted))
    for side in sides:
        check(row(rows, "regular", parameter="n = %d" % side**2), math.sqrt(squares[side] / (3 * WIDTH * HEIGHT)))


# ---- shadow: depths at the centers of texels, seen along the light, against shadow rays ----


class Map:
    """Depths along the light on a square of `size` texels, as large as the scene's box needs: four texels stay free at each side, and of
    32 angles about the light the one with the smallest texels is taken, so that the texels lie as in mote's map: outlines of shadows
    in maps with offset are some dozen pixels, which another grid would change by more than 10 %. A depth is had when it is asked for."""

    def __init__(self, scene, size):
        self.size, self.depths = size, {}
        other = (0, 0, 1) if abs(scene.along[2]) < 0.9 else (1, 0, 0)
        right = unit(cross(scene.along, other))
        down = cross(scene.along, right)
        corners = [[(scene.high if i >> k & 1 else scene.low)[k] - scene.eye[k] for k in range(3)] for i in range(8)]
        self.texel = math.inf
        for turn in range(32):
            c, s = math.cos(turn * math.pi / 64), math.sin(turn * math.pi / 64)
            frame = [tuple(c * a + s * b for a, b in zip(right, down)), tuple(c * b - s * a for a, b in zip(right, down))]
            spans = [(min(dot(axis, p) for p in corners), max(dot(axis, p) for p in corners)) for axis in frame]
            texel = max(high - low for low, high in spans) / (size - 8)
            if texel < self.texel:
                self.texel, self.middle = texel, [(low + high) / 2 for low, high in spans]
                self.axes = [scene.turned(axis) for axis in frame]
        self.axes.append(scene.turned(scene.along))
        self.spheres = [(self.seen(center), radius) for center, radius in scene.spheres]

    def seen(self, p):
        """Texels from the corner, texels from the corner, depth."""
        u, v = (dot(axis, p) - m for axis, m in zip(self.axes, self.middle))
        return u / self.texel + self.size / 2, v / self.texel + self.size / 2, dot(self.axes[2], p)

    def depth(self, i, j):
        if (i, j) not in self.depths:
            nearest = math.inf
            for (u, v, z), radius in self.spheres:
                square = radius * radius - self.texel**2 * ((i + 0.5 - u) ** 2 + (j + 0.5 - v) ** 2)
                if square >= 0:
                    nearest = min(nearest, z - math.sqrt(square))
            self.depths[i, j] = nearest
        return self.depths[i, j]

    def lit(self, point, normal, to_light, offset, reach):
        """Most of the (2 reach + 1)^2 texels about the point, moved `offset` x texels along its normal, have nothing nearer to the light."""
        sine = math.sqrt(max(1 - dot(normal, to_light) ** 2, 0.0))
        moved = tuple(p + n * offset * self.texel * sine for p, n in zip(point, normal))
        u, v, z = self.seen(moved)
        around = range(-reach, reach + 1)
        return sum(self.depth(math.floor(u) + i, math.floor(v) + j) >= z for i in around for j in around) > (2 * reach + 1) ** 2 / 2


def blocked(scene, number, point):
    """A shadow ray meets any other sphere."""
    for i, (center, radius) in enumerate(scene.spheres):
        way = sub(center, point)
        ahead = dot(way, scene.to_light)
        off = sub(way, scale(scene.to_light, ahead))
        if i != number and ahead > 0 and dot(off, off) <= radius * radius:
            return True
    return False


def facing_points(scene):
    """(point, normal, blocked) of each pixel whose surface the light could brighten by 0.004 of green, if a thousandth of a pixel aside
    is the same sphere."""
    out = []
    for x, y, among in scene.pixels():
        found = scene.hit(scene.ray(x + 0.5, y + 0.5), among)
        if not found or scene.color[1] * scene.strength * scene.cosine(*found) < 4e-3:
            continue
        aside = [scene.hit(scene.ray(x + 0.5 + dx, y + 0.5 + dy), among) for dx, dy in ((1e-3, 0), (-1e-3, 0), (0, 1e-3), (0, -1e-3))]
        if all(f and f[0] == found[0] for f in aside):
            out.append((found[1], scene.normal(*found), blocked(scene, *found)))
    return out


def check_shadow(rows, check):
    scene = Scene()
    points = facing_points(scene)
    half_diagonal = math.sqrt(0.5)
    for method, offset, reach, sizes in (
        ("depths, no offset", 0.0, 0, (256, 512, 1024, 2048)),
        ("depths, normal offset, 1 texel", half_diagonal, 0, (256,)),
        ("depths, normal offset, 3x3", half_diagonal + 1, 1, (256, 512)),
    ):
        for size in sizes:
            depths = Map(scene, size)
            wrong = sum(depths.lit(point, normal, scene.to_light, offset, reach) == dark for point, normal, dark in points)
            check(row(rows, method, parameter="%d" % size), 100 * wrong / len(points))
