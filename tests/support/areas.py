"""areas.py FILE.svg: of a drawing of `celspan render --flat regions`, prints COUNT OVERLAP GAP.

OVERLAP is the sum of the areas, in square units, that two of its paths have in common, by shapely.
GAP is what the paths together leave of the view box. Curves become chords, the same
from either end.
"""
import re
import sys
import xml.etree.ElementTree as xml

from shapely.geometry import LinearRing, MultiPolygon, box
from shapely.ops import polygonize, unary_union

CHORDS = 16
ARGUMENTS = {"m": 2, "l": 2, "h": 1, "v": 1, "c": 6, "z": 0}


def chords(p):
    """The points of a cubic curve after its first one."""
    if p[3] < p[0]:
        return chords(p[::-1])[-2::-1] + [p[3]]
    out = []
    for i in range(1, CHORDS):
        t, s = i / CHORDS, 1 - i / CHORDS
        weights = (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)
        out.append(tuple(sum(w * q[c] for w, q in zip(weights, p)) for c in (0, 1)))
    return out + [p[3]]


def rings(text, grid):
    """The closed lines of a path. Sums are of whole numbers: equal points are equal."""
    words = re.findall(r"[mlhvcz]|-?\d*\.?\d+", text)
    x = y = i = 0
    out, command = [], ""
    while i < len(words):
        if words[i].isalpha():
            command = words[i]
            i += 1
        count = ARGUMENTS[command]
        numbers = [round(float(w) * grid) for w in words[i:i + count]]
        i += count
        if command == "z":
            x, y = out[-1][0]
            continue
        if command in "hv":
            numbers = [numbers[0], 0] if command == "h" else [0, numbers[0]]
        points = [(x + a, y + b) for a, b in zip(numbers[::2], numbers[1::2])]
        if command == "m":
            out.append(points)
        else:
            out[-1] += chords([(x, y)] + points) if command == "c" else points
        x, y = points[-1]
    return [[(a / grid, b / grid) for a, b in ring] for ring in out]


def even_odd(all_rings):
    """The area inside of rings, which may touch themselves."""
    lines = unary_union([LinearRing(r) for r in all_rings if len(set(r)) > 2])
    parts = []
    for part in polygonize(lines):
        at, inside = part.representative_point(), False
        x, y = at.x, at.y
        for ring in all_rings:
            for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
                if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
                    inside = not inside
        if inside:
            parts.append(part)
    return MultiPolygon(parts)


def main(path):
    root = xml.parse(path).getroot()
    grid = 10 ** 6
    paths = [p.get("d") for p in root.iter("{http://www.w3.org/2000/svg}path")]
    areas = [even_odd(rings(d, grid)) for d in paths]
    overlap = 0
    for i, one in enumerate(areas):
        for other in areas[:i]:
            overlap += one.intersection(other).area
    x, y, width, height = (float(n) for n in root.get("viewBox").split())
    gap = box(x, y, x + width, y + height).area - unary_union(areas).area
    print(len(areas), "%.9f" % overlap, "%.9f" % gap)


main(sys.argv[1])
