#!/usr/bin/env python3
"""Draws docs/pictures/viewpoints.svg: python3 docs/pictures/viewpoints.py

The eight horizontal classes from above and the two vertical ones from the side. Rays and faces are computed from the
geometry, and the vertices on the rays are checked against the table of docs/viewpoints.md."""
import math
import pathlib

LENGTH, WIDTH, HEIGHT = 3.9, 1.9, 1.5
DISTANCE = 7.0
SCALE = 22.0  # px a metre
PANEL_W, PANEL_H, TOP = 210, 262, 30
NAMES = {0: "right side", 1: "front, right", 2: "front", 3: "front, left", 4: "left side", 5: "rear, left", 6: "rear",
         7: "rear, right"}
# left edge, right edge, near corner, far corner: signs along the length and to the left
TABLE = {0: ((-1, -1), (1, -1), (1, -1), (1, 1)), 1: ((-1, -1), (1, 1), (1, -1), (-1, 1)),
         2: ((1, -1), (1, 1), (1, 1), (-1, 1)), 3: ((1, -1), (-1, 1), (1, 1), (-1, -1)),
         4: ((1, 1), (-1, 1), (1, 1), (1, -1)), 5: ((1, 1), (-1, -1), (-1, 1), (1, -1)),
         6: ((-1, 1), (-1, -1), (-1, 1), (1, 1)), 7: ((-1, 1), (1, -1), (-1, -1), (1, 1))}
FACES = {1: ("front", 0), 2: ("left", 1), 3: ("rear", 2), 4: ("right", 3)}  # number: name, quarter turns from the front
CORNER_NAMES = {(1, 1): "FL", (1, -1): "FR", (-1, 1): "RL", (-1, -1): "RR"}
VISIBLE, HIDDEN, RAY, CAMERA = "#1f6fb4", "#b8b8b8", "#d1495b", "#333333"


def place(turn, x, y):
    """Object axes to (right, ahead) of a camera that looks at the box's centre; turn: the class's angle alpha."""
    return (x * math.cos(turn) + y * math.sin(turn), DISTANCE - x * math.sin(turn) + y * math.cos(turn))


def line(a, b, colour, width, extra=""):
    return (f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{colour}" '
            f'stroke-width="{width}" {extra}/>')


def text(at, words, size=12, colour=CAMERA, anchor="middle", weight="normal"):
    return (f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" font-family="sans-serif" font-size="{size}" fill="{colour}" '
            f'text-anchor="{anchor}" font-weight="{weight}">{words}</text>')


def dot(at, filled):
    return (f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="4" stroke="{RAY}" stroke-width="1.5" '
            f'fill="{RAY if filled else "white"}"/>')


def from_above(h, ox, oy):
    turn = h * math.pi / 4

    def at(point):
        return (ox + SCALE * point[0], oy - SCALE * point[1])

    corners = {s: place(turn, 0.5 * LENGTH * s[0], 0.5 * WIDTH * s[1]) for s in CORNER_NAMES}
    out = []
    seen = []
    for number, (name, quarter) in FACES.items():
        normal = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarter]
        ends = [s for s in corners if (s[0] == normal[0] if normal[0] else s[1] == normal[1])]
        middle = place(turn, 0.5 * LENGTH * normal[0], 0.5 * WIDTH * normal[1])
        outwards = place(turn, 0.5 * LENGTH * normal[0] + 0.5 * normal[0], 0.5 * WIDTH * normal[1] + 0.5 * normal[1])
        facing = sum((m - o) * m for m, o in zip(middle, outwards)) > 0  # the camera is at the origin
        if facing:
            seen.append(name)
        out.append(line(at(corners[ends[0]]), at(corners[ends[1]]), VISIBLE if facing else HIDDEN, 4 if facing else 2))
        inwards = place(turn, 0.5 * LENGTH * normal[0] - 0.35 * normal[0], 0.5 * WIDTH * normal[1] - 0.35 * normal[1])
        out.append(text((at(inwards)[0], at(inwards)[1] + 4), number, 11, VISIBLE if facing else HIDDEN))
    assert sorted(seen) == sorted(NAMES[h].replace(" side", "").split(", ")), (h, seen)
    angle = {s: math.atan2(p[0], p[1]) for s, p in corners.items()}
    left, right, near, far = TABLE[h]
    # Two corners of a face seen end on may lie on one ray only by chance; here the extremes are unique.
    assert left == min(angle, key=angle.get) and right == max(angle, key=angle.get), h
    for corner, side in ((left, -1), (right, 1)):
        p = corners[corner]
        out.append(line(at((0, 0)), at((1.25 * p[0], 1.25 * p[1])), RAY, 1.2, 'stroke-dasharray="5 3"'))
        out.append(text((at(p)[0] + 15 * side, at(p)[1] + 4), CORNER_NAMES[corner], 11, RAY))
    out.append(dot(at(corners[near]), True))
    out.append(dot(at(corners[far]), False))
    nose, tail = at(place(turn, 0.35, 0.0)), at(place(turn, -0.5, 0.0))
    out.append(line(tail, nose, CAMERA, 1.5, 'marker-end="url(#arrow)"'))
    out.append(f'<path d="M{ox - 7} {oy + 9} L{ox} {oy - 2} L{ox + 7} {oy + 9} Z" fill="{CAMERA}"/>')
    out.append(text((ox, oy - SCALE * DISTANCE - 66), f"h = {h}: {NAMES[h]}", 13, weight="bold"))
    return out


def from_the_side(v, ox, oy):
    """Camera at the left, below or above the roof."""
    eye = 1.0 if v == 0 else 2.4
    near, far, scale = 4.0, 4.0 + LENGTH, 24.0

    def at(z, y):
        return (ox + scale * z, oy - scale * y)

    top = (near, HEIGHT) if v == 0 else (far, HEIGHT)
    out = [line(at(-0.5, 0), at(9.3, 0), HIDDEN, 1),
           line(at(near, 0), at(near, HEIGHT), VISIBLE, 4), line(at(far, 0), at(far, HEIGHT), HIDDEN, 2),
           line(at(near, 0), at(far, 0), HIDDEN, 2), line(at(near, HEIGHT), at(far, HEIGHT), VISIBLE if v else HIDDEN, 4 if v else 2)]
    for z, y in (top, (near, 0)):
        out.append(line(at(0, eye), at(z, y), RAY, 1.2, 'stroke-dasharray="5 3"'))
        out.append(dot(at(z, y), (z, y) != (far, HEIGHT)))
    x, y = at(0, eye)
    out.append(f'<path d="M{x - 9:.1f} {y - 6:.1f} L{x + 2:.1f} {y:.1f} L{x - 9:.1f} {y + 6:.1f} Z" fill="{CAMERA}"/>')
    words = "roof not seen: top edge from the near corner" if v == 0 else "roof seen: top edge from the far corner"
    out.append(text((ox + 4.2 * scale, oy - 78), f"v = {v}: {words}", 13, weight="bold"))
    return out


def picture():
    width, height = 4 * PANEL_W, 2 * PANEL_H + 150
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">',
           '<defs><marker id="arrow" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="6" markerHeight="6" orient="auto">'
           f'<path d="M0 0 L8 4 L0 8 Z" fill="{CAMERA}"/></marker></defs>',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for h in range(8):
        out += from_above(h, PANEL_W * (h % 4) + PANEL_W / 2, PANEL_H * (h // 4) + PANEL_H - 14)
    for v in range(2):
        out += from_the_side(v, 2 * PANEL_W * v + 100, height - 26)
    out.append("</svg>")
    return "\n".join(out) + "\n"


pathlib.Path(__file__).with_suffix(".svg").write_text(picture())
