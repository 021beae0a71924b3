#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Points of charts recomputed by an independent program: tests/chart_check.py FOLDER

FOLDER holds TOPIC.csv as `mote chart --topic TOPIC -o TOPIC.csv` wrote them. Three points or more of each topic are computed anew from
what their rows say (method, parameter, x), with formulas of the literature, numbers of its own and float32 by rounding each
operation; they must agree within 10 %. Errors, not times: times do not come again. Standard library of Python 3.11 only. All ten topics
are here; sampling and shadow have to be of tests/chart_scene.toml, which chart_check_scenes.py casts rays into (the commands stand
there), and of mesh the depth of faces is recomputed, not the wrong pixels of its pictures. A topic without a file is skipped.
Ends with 1 where a point differs."""
import csv
import math
import os
import sys

sys.dont_write_bytecode = True  # no folders beside the sources

from chart_check_float32 import check_depth, check_placement, check_sphere, cross, dot, number, rms, rng, row, sub, unit
from chart_check_scenes import check_sampling, check_shadow


# ---- color models ----


def hsv(c):
    high, low = max(c), min(c)
    if high == low:
        return [0.0, 0.0, high]
    r, g, b = c
    h = (g - b) / (high - low) if high == r else (b - r) / (high - low) + 2 if high == g else (r - g) / (high - low) + 4
    return [h % 6 / 6, (high - low) / high, high]


def from_hsv(m):
    h, s, v = m[0] * 6, m[1], m[2]
    sector, f = int(h) % 6, h - int(h)
    p, q, t = v * (1 - s), v * (1 - s * f), v * (1 - s * (1 - f))
    return [(v, t, p), (q, v, p), (p, v, t), (p, q, v), (t, p, v), (v, p, q)][sector]


def ycbcr(kr, kb):
    def encode(c):
        y = kr * c[0] + (1 - kr - kb) * c[1] + kb * c[2]
        return [y, (c[2] - y) / (2 - 2 * kb) + 0.5, (c[0] - y) / (2 - 2 * kr) + 0.5]

    def decode(m):
        b, r = m[0] + (m[1] - 0.5) * (2 - 2 * kb), m[0] + (m[2] - 0.5) * (2 - 2 * kr)
        return r, (m[0] - kr * r - kb * b) / (1 - kr - kb), b

    return encode, decode


def round_trip(encode, decode, bits):
    worst, levels = 0.0, 2**bits - 1
    colors = [(r, g, b) for r in range(0, 256, 17) for g in range(0, 256, 17) for b in range(0, 256, 17)]
    colors += [tuple(rng.randrange(256) for _ in range(3)) for _ in range(20000)]
    for c in colors:
        c = [v / 255 for v in c]
        m = [math.floor(min(max(v, 0.0), 1.0) * levels + 0.5) / levels for v in encode(c)]
        worst = max(worst, max(abs(min(max(v, 0.0), 1.0) - w) for v, w in zip(decode(m), c)))
    return 255 * worst


def check_color_models(rows, check):
    panel = "RGB to the model and back"
    check(row(rows, "HSV", x=8, panel=panel), round_trip(hsv, from_hsv, 8))
    check(row(rows, "Y'CbCr BT.601, full range", x=8, panel=panel), round_trip(*ycbcr(0.299, 0.114), 8))
    check(row(rows, "Y'CbCr BT.709, full range", x=10, panel=panel), round_trip(*ycbcr(0.2126, 0.0722), 10))
    check(row(rows, "CMY", x=6, panel=panel), round_trip(lambda c: [1 - v for v in c], lambda m: [1 - v for v in m], 6))


# ---- proxy: outlines of a sphere on the plane z = 1 in closed form; expansions show no wrong pixel ----


def ellipse(kappa, tilt):
    """Half axes of the projected outline: along the tilt, and across it."""
    s, c = 1 / kappa, math.cos(tilt)
    below = c * c - s * s
    return s * math.sqrt(1 - s * s) / below, s / math.sqrt(below)


def check_proxy(rows, check):
    for tilt in (0, 30):
        panel = "Outlines of a sphere %d degrees" % tilt
        for kappa in (3.0, 10.0):
            a, b = ellipse(kappa, math.radians(tilt))
            name = "kappa = %g" % kappa
            check(row(rows, "tangent rectangle (mote)", parameter=name, panel=panel), 4 * a * b / (math.pi * a * b), "x")
            reach = math.tan(math.radians(tilt) + math.asin(1 / kappa)) - math.tan(math.radians(tilt))
            check(row(rows, "square around the center that holds all (point sprite)", parameter=name, panel=panel), 4 * reach * reach / (math.pi * a * b), "x")
    kappa = 1.5  # the circle beyond a square of half edge 1 / kappa: four segments
    radius, half = ellipse(kappa, 0)[0], 1 / kappa
    segment = radius * radius * math.acos(half / radius) - half * math.sqrt(radius * radius - half * half)
    check(row(rows, "quad through the center, parallel to the image", parameter="kappa = 1.5", panel="Outlines of a sphere 0"), 4 * segment / (math.pi * radius * radius))
    for r in rows:
        if r["panel"].startswith("Expansions"):
            check(r, 0.0)


# ---- transparency: stacks of layers ----


def stack(layers, alpha):
    def ramp(h):
        return min(max(abs(h % 6 - 3) - 1, 0), 1)

    out = []
    for _ in range(layers):
        hue = rng.uniform(0, 6)
        out.append(((ramp(hue), ramp(hue + 4), ramp(hue + 2)), alpha, rng.uniform(5, 50)))
    return out


def composite(layers, behind=(1.0, 1.0, 1.0)):
    """Over one another in this order: the last one is the nearest."""
    for color, alpha, _ in layers:
        behind = tuple(alpha * c + (1 - alpha) * b for c, b in zip(color, behind))
    return behind


def from_the_back(layers):
    return sorted(layers, key=lambda l: -l[2])


def weighted(layers):
    total, weights, through = [0.0] * 3, 0.0, 1.0
    for color, alpha, z in layers:
        w = alpha * min(max(10 / (1e-5 + (z / 5) ** 2 + (z / 200) ** 6), 1e-2), 3e3)  # McGuire and Bavoil 2013, equation 7
        total = [t + c * alpha * w for t, c in zip(total, color)]
        weights += alpha * w
        through *= 1 - alpha
    return tuple(t / weights * (1 - through) + through for t in total)


def solve(rows3, right):
    """Three equations, by Cramer's rule."""

    def det(m):
        return dot(m[0], cross(m[1], m[2]))

    columns = list(zip(*rows3))
    return [det([right if i == k else columns[i] for i in range(3)]) / det(columns) for k in range(3)]


def moments(layers):
    """Muenstermann et al. 2018, four power moments; bias 5e-7, overestimation 0.25."""
    places = [2 * math.log(z / 5) / math.log(10) - 1 for _, _, z in layers]
    absorbance = [-math.log(1 - alpha) for _, alpha, _ in layers]
    total = sum(absorbance)
    b = [(1 - 5e-7) * sum(a * x**k for a, x in zip(absorbance, places)) / total + 5e-7 * (1, 0, 0.375, 0, 0.375)[k] for k in range(5)]
    color, weight = [0.0] * 3, 0.0
    for (c, alpha, _), x in zip(layers, places):
        q = solve([b[0:3], b[1:4], b[2:5]], (1, x, x * x))
        middle, spread = -q[1] / (2 * q[2]), math.sqrt(max(q[1] ** 2 - 4 * q[0] * q[2], 0)) / abs(2 * q[2])
        at = (x, middle - spread, middle + spread)
        w = solve([(1, 1, 1), at, tuple(p * p for p in at)], b[0:3])
        before = 0.25 * w[0] + sum(v for v, p in zip(w[1:], at[1:]) if p < x)
        seen = alpha * math.exp(-total * min(max(before, 0), 1))
        color = [s + seen * v for s, v in zip(color, c)]
        weight += seen
    through = math.exp(-total)
    return tuple(s / weight * (1 - through) + through for s in color)


def check_transparency(rows, check):
    ways = {
        "four moments": moments,
        "as they come": composite,
        "weighted sums": weighted,
        "first 4 layers": lambda s: composite(from_the_back(s)[-4:]),
    }
    for method, layers, alpha in (("as they come", 16, 0.5), ("as they come", 64, 0.3), ("weighted sums", 16, 0.5), ("four moments", 16, 0.5), ("four moments", 64, 0.3), ("first 4 layers", 16, 0.1), ("first 4 layers", 16, 0.5)):
        errors = []
        for _ in range(4000):
            s = stack(layers, alpha)
            errors += [255 * (a - b) for a, b in zip(ways[method](s), composite(from_the_back(s)))]
        check(row(rows, method, parameter="%d layers of %g" % (layers, alpha)), rms(errors))


# ---- ocio: per-channel views, so a table in three dimensions is one in one dimension ----


def check_ocio(rows, check):
    low, high = -9.0, math.log2(64 + 2.0**-9)

    def srgb(v):
        v = min(max(v, 0.0), 65504.0)
        return min(v * 12.92 if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055, 1.0)

    def raw(v):
        return min(max(v, 0.0), 1.0)

    values = [0.001 * 64000 ** (i / 899) for i in range(900)] + [0.0] + [0.001 * 64000 ** (k / 27) for k in range(28)]
    for view, curve in (("Un-tone-mapped", srgb), ("Raw", raw)):
        for n in (17, 33, 65):
            knots = [curve(2 ** (low + (high - low) * i / (n - 1)) - 2.0**-9) for i in range(n)]
            worst = 0.0
            for v in values:
                at = min(max((math.log2(v + 2.0**-9) - low) / (high - low), 0.0), 1.0) * (n - 1)
                i = min(int(at), n - 2)
                worst = max(worst, abs(knots[i] + (at - i) * (knots[i + 1] - knots[i]) - curve(v)))
            check(row(rows, "3-D table behind a logarithm", parameter="%d^3" % n, panel=view), 255 * worst)


# ---- mesh: how deep a face of an icosphere lies below the sphere ----


def check_mesh(rows, check):
    golden = (1 + math.sqrt(5)) / 2
    corners = [unit(v) for a in (-1, 1) for b in (-golden, golden) for v in ((0, a, b), (a, b, 0), (b, 0, a))]
    edge = min(math.dist(corners[0], c) for c in corners[1:])
    near = [[math.dist(a, b) < 1.01 * edge for b in corners] for a in corners]
    faces = [(corners[i], corners[j], corners[k]) for i in range(12) for j in range(i) for k in range(j) if near[i][j] and near[j][k] and near[i][k]]
    for level in range(4):
        deepest = max(1 - abs(dot(unit(cross(sub(b, a), sub(c, a))), a)) for a, b, c in faces)
        check(row(rows, "icosphere", parameter="level %d" % level), deepest)
        split = []
        for a, b, c in faces:
            ab, bc, ca = (unit(tuple(x + y for x, y in zip(p, q))) for p, q in ((a, b), (b, c), (c, a)))
            split += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = split


CHECKS = {
    "sphere": check_sphere,
    "placement": check_placement,
    "depth": check_depth,
    "color_models": check_color_models,
    "proxy": check_proxy,
    "transparency": check_transparency,
    "ocio": check_ocio,
    "mesh": check_mesh,
    "sampling": check_sampling,
    "shadow": check_shadow,
}


def main():
    folder, bad, checked = sys.argv[1], 0, 0
    for topic, of_topic in CHECKS.items():
        path = os.path.join(folder, topic + ".csv")
        if not os.path.exists(path):
            print("%s: no file, skipped" % topic)
            continue
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))

        def check(r, wanted, column="y"):
            nonlocal bad, checked
            found = number(r, column)
            fine = abs(found - wanted) <= 0.1 * abs(wanted)
            checked += 1
            bad += not fine
            print("%-13s %-52s %-22s %-12.6g recomputed %-12.6g %s" % (topic, r["method"], r["parameter"], found, wanted, "" if fine else "DIFFERS"))

        of_topic(rows, check)
    print("%d points, %d differ by more than 10 %%" % (checked, bad))
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
