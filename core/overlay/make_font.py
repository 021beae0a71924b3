# SPDX-License-Identifier: MIT
# Writes font_outlines.cpp: the outlines of the letters that legends need, out of a TrueType file (DejaVu Sans 2.37,
# package fonts-dejavu-core). Run by hand: python3 make_font.py DejaVuSans.ttf > font_outlines.cpp
import struct, sys

LETTERS = "".join(chr(c) for c in range(32, 127)) + "Å°µ·²³¹×±−⁰⁴⁵⁶⁷⁸⁹⁻"
data = open(sys.argv[1], "rb").read()
u16 = lambda at: struct.unpack(">H", data[at:at + 2])[0]
i16 = lambda at: struct.unpack(">h", data[at:at + 2])[0]
u32 = lambda at: struct.unpack(">I", data[at:at + 4])[0]
tables = {data[12 + 16 * k:16 + 16 * k].decode(): u32(20 + 16 * k) for k in range(u16(4))}
head, loca, glyf, hmtx, hhea = (tables[t] for t in ("head", "loca", "glyf", "hmtx", "hhea"))
units, long_loca, metrics = u16(head + 18), i16(head + 50), u16(hhea + 34)


def glyph_index(code):
    for k in range(u16(tables["cmap"] + 2)):
        at = tables["cmap"] + u32(tables["cmap"] + 8 + 8 * k)
        if u16(at) != 4: continue
        segments = u16(at + 6) // 2
        for s in range(segments):
            end, start = u16(at + 14 + 2 * s), u16(at + 16 + 2 * segments + 2 * s)
            if start <= code <= end:
                delta = u16(at + 16 + 4 * segments + 2 * s)
                place = at + 16 + 6 * segments + 2 * s
                if u16(place) == 0: return (code + delta) & 0xFFFF
                found = u16(place + u16(place) + 2 * (code - start))
                return (found + delta) & 0xFFFF if found else 0
    return 0


def outline(index):
    """Contours as lists of (x, y, on the curve?), TrueType's rules: two points off the curve imply one between them."""
    at = glyf + (u32(loca + 4 * index) if long_loca else 2 * u16(loca + 2 * index))
    end = glyf + (u32(loca + 4 * index + 4) if long_loca else 2 * u16(loca + 2 * index + 2))
    if at == end: return []
    contours, at = i16(at), at + 10
    if contours < 0: return composite(at)
    ends = [u16(at + 2 * k) for k in range(contours)]
    at += 2 * contours
    at += 2 + u16(at)
    flags = []
    while len(flags) < ends[-1] + 1:
        flags.append(data[at]); at += 1
        if flags[-1] & 8:
            flags += [flags[-1]] * data[at]; at += 1
    axes = []
    for short, same in ((2, 16), (4, 32)):
        value, values = 0, []
        for f in flags:
            if f & short:
                value += data[at] if f & same else -data[at]; at += 1
            elif not f & same:
                value += i16(at); at += 2
            values.append(value)
        axes.append(values)
    points = [(x, y, f & 1) for x, y, f in zip(axes[0], axes[1], flags)]
    return [points[a:b] for a, b in zip([0] + [e + 1 for e in ends], [e + 1 for e in ends])]


def composite(at):
    out = []
    while True:
        flags, index = u16(at), u16(at + 2)
        at += 4
        dx, dy = (i16(at), i16(at + 2)) if flags & 1 else struct.unpack("bb", data[at:at + 2])
        at += 4 if flags & 1 else 2
        a, b, c, d = 1.0, 0.0, 0.0, 1.0
        if flags & 8: a = d = i16(at) / 16384; at += 2
        elif flags & 64: a, d = i16(at) / 16384, i16(at + 2) / 16384; at += 4
        elif flags & 128: a, b, c, d = (i16(at + 2 * k) / 16384 for k in range(4)); at += 8
        out += [[(round(a * x + c * y) + dx, round(b * x + d * y) + dy, on) for x, y, on in contour] for contour in outline(index)]
        if not flags & 32: return out


def advance(index): return u16(hmtx + 4 * min(index, metrics - 1))


numbers, rows = [], []
for letter in LETTERS:
    index = glyph_index(ord(letter))
    assert index or letter == " ", letter
    first = len(numbers)
    for contour in outline(index):
        numbers.append(len(contour))
        for x, y, on in contour: numbers += [2 * x + on, y]
    rows.append((ord(letter), advance(index), first, len(numbers) - first))

print("""// SPDX-License-Identifier: MIT
// The letters of legends: outlines of DejaVu Sans 2.37, a subset under another name as its license asks
// (Copyright 2003 Bitstream, Inc.; DejaVu changes are in the public domain; see LICENSE.font). Made by make_font.py.
#include "core/overlay/font.hpp"

// clang-format off
namespace mote::overlay {
""")
print(f"const std::array<Glyph, {len(rows)}> glyphs{{{{")
line = "   "
for row in rows:
    text = " {%d, %d, %d, %d}," % row
    if len(line) + len(text) > 158: print(line); line = "   "
    line += text
print(line + "\n}};\n")
print(f"const std::array<std::int16_t, {len(numbers)}> outline_numbers{{")
line = "   "
for n in numbers:
    text = f" {n},"
    if len(line) + len(text) > 158: print(line); line = "   "
    line += text
print(line + "\n};\n\n} // namespace mote::overlay")
print(f"{len(rows)} letters, {units} units", file=sys.stderr)
