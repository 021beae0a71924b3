# SPDX-License-Identifier: MIT
"""Part of chart_check.py: topics that are about float32, which is had by rounding each operation."""
import math
import random
import struct

rng = random.Random(20240)


def f32(x):
    try:
        return struct.unpack("f", struct.pack("f", x))[0]
    except OverflowError:
        return math.copysign(math.inf, x)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def dot32(a, b):
    return f32(f32(f32(a[0] * b[0]) + f32(a[1] * b[1])) + f32(a[2] * b[2]))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def scale(a, s):
    return tuple(x * s for x in a)


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def unit(a):
    return scale(a, 1 / math.sqrt(dot(a, a)))


def direction():
    while True:
        v = tuple(rng.uniform(-1, 1) for _ in range(3))
        if 0.01 < dot(v, v) <= 1:
            return unit(v)


def p99(values):
    values = sorted(values)
    at = 0.99 * (len(values) - 1)
    i = int(at)
    return values[i] + (at - i) * (values[min(i + 1, len(values) - 1)] - values[i])


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values))


def number(r, column):
    return float(r[column])


def row(rows, method, x=None, parameter=None, panel=""):
    for r in rows:
        if r["method"] == method and r["panel"].startswith(panel) and (x is None or abs(number(r, "x") / x - 1) < 1e-6) and (parameter is None or r["parameter"] == parameter):
            return r
    raise SystemExit("no row of method '%s', x %s, parameter '%s'" % (method, x, parameter))


# ---- sphere: the quadratic formula, Haines et al., the perpendicular; normals over distance / radius ----


def sphere_error(form, kappa):
    errors = []
    for _ in range(12000):
        r = f32(rng.uniform(0.5, 1.0))
        m = tuple(f32(x) for x in scale(direction(), kappa * r))
        to, distance = unit(m), math.sqrt(dot(m, m))
        x = unit(cross(to, (1.0, 0.0, 0.0) if abs(to[0]) < 0.5 else (0.0, 1.0, 0.0)))
        y = cross(to, x)
        rho, angle = 0.99 * math.sqrt(rng.random()), rng.uniform(0, 2 * math.pi)
        flat = r * math.sqrt(1 - (r / distance) ** 2)
        p = tuple(to[k] * (distance - r * r / distance) + flat * rho * (math.cos(angle) * x[k] + math.sin(angle) * y[k]) for k in range(3))
        d = tuple(f32(v) for v in unit(p))
        dd = dot(d, d)
        s = dot(m, d) / dd  # in double: a few 1e-16 kappa, far below what is looked for
        l = tuple(d[k] * s - m[k] for k in range(3))
        square = (r - math.sqrt(dot(l, l))) * (r + math.sqrt(dot(l, l)))
        if square < 0:
            continue
        truth = unit(sub(l, scale(d, math.sqrt(square / dd))))
        found = FORMS[form](m, r, d)
        if found is None:
            continue
        c = cross(found, truth)
        errors.append(math.atan2(math.sqrt(dot(c, c)), dot(found, truth)))
    return p99(errors)


def from_hit(t, d, m):
    return tuple(f32(f32(t * d[k]) - m[k]) for k in range(3))


def quadratic(m, r, d):
    a, b, c = dot32(d, d), -f32(2 * dot32(d, m)), f32(dot32(m, m) - f32(r * r))
    D = f32(f32(b * b) - f32(f32(4 * a) * c))
    return None if D < 0 else from_hit(f32(f32(-b - f32(math.sqrt(D))) / f32(2 * a)), d, m)


def haines(m, r, d):
    a, b, c = dot32(d, d), -dot32(d, m), f32(dot32(m, m) - f32(r * r))
    s = f32(b / a)
    l = tuple(f32(-m[k] - f32(d[k] * s)) for k in range(3))
    D = f32(f32(r * r) - dot32(l, l))
    if D < 0:
        return None
    root = f32(math.sqrt(f32(a * D)))
    q = f32(-b + (-root if b > 0 else root))
    return from_hit(min(f32(c / q), f32(q / a)), d, m)


def perpendicular(m, r, d):
    ia = f32(1 / dot32(d, d))
    s = f32(dot32(m, d) * ia)
    l = tuple(f32(m[k] - f32(d[k] * s)) for k in range(3))
    D = f32(f32(r * r) - dot32(l, l))
    if D < 0:
        return None
    h = f32(math.sqrt(f32(D * ia)))
    return tuple(f32(-f32(d[k] * h) - l[k]) for k in range(3))


FORMS = {"naive quadratic": quadratic, "Haines 2019": haines, "perpendicular, local normal": perpendicular}


def check_sphere(rows, check):
    for method, kappa in (("naive quadratic", 1e2), ("naive quadratic", 1e3), ("Haines 2019", 1e4), ("perpendicular, local normal", 1e4), ("perpendicular, local normal", 1e5)):
        check(row(rows, method, x=kappa, panel="Normals"), sphere_error(method, kappa))


# ---- placement ----


def placement_error(method, offset):
    errors = []
    for _ in range(6000):
        origin, local = scale(direction(), offset), tuple(f32(x) for x in scale(direction(), 4.0))
        world = tuple(origin[k] + local[k] for k in range(3))
        to = direction()
        eye = tuple(world[k] - 100 * to[k] for k in range(3))
        right = unit(cross(to, direction()))
        rows = (right, cross(to, right), to)
        truth = [dot(r, sub(world, eye)) for r in rows]
        rows32 = [tuple(f32(x) for x in r) for r in rows]
        if method == "world float32, 4x4 matrix":
            w = tuple(f32(x) for x in world)
            found = [f32(dot32(r32, w) + f32(-dot(r, eye))) for r, r32 in zip(rows, rows32)]
        else:  # minus the eye
            p = tuple(f32(f32(world[k]) - f32(eye[k])) for k in range(3))
            found = [dot32(r, p) for r in rows32]
        errors.append(math.sqrt(sum((a - b) ** 2 for a, b in zip(found, truth))))
    return p99(errors)


def check_placement(rows, check):
    for method, offset in (("world float32, 4x4 matrix", 1e6), ("world float32, minus the eye", 1e5), ("world float32, minus the eye", 1e7), ("world float32, 4x4 matrix", 1e4)):
        check(row(rows, method, x=offset), placement_error(method, offset))


# ---- depth ----


def depth_error(encode, decode, bits, decade):
    n, errors, levels = 0.1, [], 2.0**bits - 1
    for _ in range(20000):
        z = f32(n * decade * rng.uniform(0.7, 1.4))
        d = encode(z)
        if bits:
            d = math.floor(d * levels + 0.5) / levels
        errors.append(abs(decode(d) - z) / z if d else 1.0)
    return p99(errors)


def check_depth(rows, check):
    n, f = f32(0.1), 1e6
    a, b = f32(f / f32(f - n)), f32(f32(f * n) / f32(f - n))

    def reverse(z):
        return f32(n / z)

    def standard(z):
        return f32(f32(f32(a * z) - b) / z)

    def from_reverse(d):
        return 0.1 / d

    def from_standard(d):
        return f * 0.1 / (f - d * (f - 0.1))

    for method, encode, decode, bits, decade in (
        ("reverse, infinite far, D32F (mote)", reverse, from_reverse, 0, 1e4),
        ("reverse D24", reverse, from_reverse, 24, 1e3),
        ("reverse D16", reverse, from_reverse, 16, 1e2),
        ("standard D32F", standard, from_standard, 0, 1e3),
        ("standard D16", standard, from_standard, 16, 1e2),
    ):
        check(row(rows, method, x=decade), depth_error(encode, decode, bits, decade))
