#!/usr/bin/env python3
"""Draws the textures of the looks: flower_print.png and damask_mask.png, both tileable.

    looks/textures/make_textures.py [folder]

Nothing but the standard library: a picture is a function of a point, sampled 3 x 3 times a pixel.
"""
import math
import struct
import sys
import zlib
from pathlib import Path

SIDE = 384
SUBSAMPLES = (1 / 6, 3 / 6, 5 / 6)


def turned(x, y, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return c * x + s * y, c * y - s * x


def wrapped(x, y, cx, cy):
    """The point seen from the nearest copy of (cx, cy) on the unit torus."""
    return (x - cx + 0.5) % 1 - 0.5, (y - cy + 0.5) % 1 - 0.5


def rosette(x, y, radius, petals, depth, twist=0.0):
    """Above 0 inside a flower whose rim has rounded petals."""
    r, a = math.hypot(x, y), math.degrees(math.atan2(y, x)) + twist
    wave = abs(math.sin(math.radians(a * petals / 2)))
    return radius * (1 - depth + depth * wave ** 0.6) - r


def leaf(x, y, length, width):
    """Above 0 inside a pointed leaf from the origin along +x; its middle vein is at y = 0."""
    t = x / length
    if not 0 < t < 1:
        return -1.0
    return width * math.sin(math.pi * t ** 0.8) ** 1.1 - abs(y)


def ring(x, y, radius, half):
    return half - abs(math.hypot(x, y) - radius)


# --- the print -------------------------------------------------------------------------------------------------------

IVORY, CORAL, ROSE, WINE = (238, 228, 208), (214, 98, 74), (233, 158, 132), (150, 52, 62)
TEAL, SAGE, GOLD = (62, 112, 116), (138, 164, 140), (218, 172, 92)


def print_color(x, y):
    color = IVORY
    # Fine gold seeds on a half-drop grid.
    for cx, cy in ((0.25, 0.0), (0.75, 0.5), (0.0, 0.27), (0.0, 0.73), (0.5, 0.23), (0.5, 0.77)):
        px, py = wrapped(x, y, cx, cy)
        if math.hypot(px, py) < 0.011:
            color = GOLD
    for cx, cy, turn, size in ((0.25, 0.5, 12, 1.0), (0.75, 0.0, -20, 1.0)):
        px, py = wrapped(x, y, cx, cy)
        # Two sprays of leaves on bent stems.
        for way in (0, 180):
            qx, qy = turned(px, py, turn + 62 + way)
            bend = qy - 0.045 * math.sin(math.pi * qx / 0.36)
            if 0.1 < qx < 0.36 and abs(bend) < 0.0045:
                color = TEAL
            for at, angle, length in ((0.17, 46, 0.13), (0.20, -44, 0.13), (0.26, 38, 0.11), (0.285, -40, 0.10),
                                      (0.335, 2, 0.11)):
                stem = 0.045 * math.sin(math.pi * at / 0.36)
                lx, ly = turned(qx - at, qy - stem, angle)
                inside = leaf(lx, ly, length, 0.027)
                if inside > 0:
                    color = SAGE if ly > 0 else TEAL
                    if abs(ly) < 0.0022:
                        color = IVORY
        # The flower: three whorls and a heart.
        for radius, petals, depth, fill, line in ((0.165, 9, 0.22, CORAL, WINE), (0.118, 9, 0.26, ROSE, CORAL),
                                                  (0.072, 7, 0.3, CORAL, WINE)):
            inside = rosette(px, py, radius * size, petals, depth, turn + radius * 500)
            if inside > 0:
                color = line if inside < 0.005 else fill
        r, a = math.hypot(px, py), math.atan2(py, px)
        if 0.085 < r < 0.112 and abs(math.sin(4.5 * a + turn)) < 0.13:
            color = CORAL
        if r < 0.034:
            color = WINE if r > 0.027 else GOLD
        if r < 0.02 and (math.sin(9 * a) > 0.2 or r < 0.006):
            color = WINE
    # Small blossoms between them.
    for cx, cy, turn in ((0.25, 0.0, 0), (0.75, 0.5, 36)):
        px, py = wrapped(x, y, cx, cy)
        for k in range(4):
            lx, ly = turned(px, py, turn + 45 + 90 * k)
            if leaf(lx - 0.03, ly, 0.07, 0.013) > 0:
                color = SAGE
        inside = rosette(px, py, 0.052, 5, 0.34, turn)
        if inside > 0:
            color = CORAL if inside < 0.004 else ROSE
        if math.hypot(px, py) < 0.014:
            color = GOLD
    return color


# --- the damask ------------------------------------------------------------------------------------------------------

def ogee(x, y):
    """Distance to the nearest curve of an ogival lattice: waves that all but touch, so that two ogives fill a period."""
    sway = 0.238 * math.cos(2 * math.pi * y)
    slope = math.hypot(1, 0.476 * math.pi * math.sin(2 * math.pi * y))
    return min(abs((x - sway + 0.5) % 1 - 0.5), abs((x - 0.5 + sway + 0.5) % 1 - 0.5)) / slope


def palmette(x, y):
    """A standing flower of leaves, symmetric about x = 0, about 0.8 high around the origin."""
    x = abs(x)
    inside = -1.0
    for angle, length, width, foot in ((90, 0.27, 0.042, 0.02), (62, 0.245, 0.04, 0.01), (34, 0.2, 0.036, 0.0),
                                       (6, 0.15, 0.03, -0.012)):
        lx, ly = turned(x - 0.012, y - foot - 0.03, angle)
        one = leaf(lx - 0.035, ly - 0.35 * (lx - 0.035) ** 2, length, width)
        if one > 0 and abs(ly - 0.35 * (lx - 0.035) ** 2) < 0.004 and 0.06 < lx < length - 0.02:
            one = -1.0  # a vein
        inside = max(inside, one)
    # Heart, calyx and a stem with two curled leaves.
    inside = max(inside, 0.036 - math.hypot(x, y - 0.03))
    if math.hypot(x, y - 0.03) < 0.016:
        inside = -1.0
    if -0.33 < y < 0.0 and x < 0.008:
        inside = 0.01
    for at, angle, length, width in ((-0.1, 20, 0.17, 0.03), (-0.2, -8, 0.14, 0.026)):
        lx, ly = turned(x - 0.004, y - at, angle)
        curve = ly - 0.9 * lx * lx
        one = leaf(lx, curve, length, width)
        if one > 0 and abs(curve) < 0.0035 and lx > 0.03:
            one = -1.0
        inside = max(inside, one)
    return max(inside, rosette(x, y + 0.36, 0.032, 4, 0.35, 45))


def damask(x, y):
    d = ogee(x, y)
    figure = d < 0.007 or abs(d - 0.024) < 0.006
    # A small flower where two waves meet.
    for cx, cy in ((0.25, 0.0), (0.75, 0.5)):
        px, py = wrapped(x, y, cx, cy)
        inside = rosette(px, py, 0.07, 8, 0.24, 22.5)
        if inside > -0.014:
            figure = inside > 0 and not abs(math.hypot(px, py) - 0.034) < 0.006
    # A palmette in the middle of every ogive, standing, half-dropped.
    for cx, cy in ((0.25, 0.5), (0.75, 0.0)):
        px, py = wrapped(x, y, cx, cy)
        if palmette(px / 1.22, (py + 0.02) / 1.1) > 0:
            figure = True
    return (255,) if figure else (0,)


def write_png(path, side, channels, sample):
    rows = bytearray()
    for j in range(side):
        rows.append(0)
        for i in range(side):
            sums = [0.0] * channels
            for b in SUBSAMPLES:
                for a in SUBSAMPLES:
                    # y runs up, as v does.
                    for c, value in enumerate(sample((i + a) / side, 1 - (j + b) / side)):
                        sums[c] += value
            rows.extend(int(s / len(SUBSAMPLES) ** 2 + 0.5) for s in sums)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", side, side, 8, 2 if channels == 3 else 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9)) +
                     chunk(b"IEND", b""))


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    write_png(folder / "flower_print.png", SIDE, 3, print_color)
    write_png(folder / "damask_mask.png", SIDE, 1, damask)
