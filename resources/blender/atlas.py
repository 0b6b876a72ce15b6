"""Makes configs/atlas.dae: the arm of curl.dae as an anatomical atlas shows it, glassy skin over ivory bones.

The same skeleton and the same movement as curl.py, so that a muscle made for one fits the other, and here it can be seen.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from mathutils import Vector

import common
import curl

# Rows of a bone: centre x, y, z, half depth (x), half width (y).
HUMERUS = [
    (0.004, 0.000, 0.764, 0.008, 0.008), (0.004, 0.000, 0.760, 0.017, 0.017), (0.004, 0.000, 0.750, 0.0225, 0.0225),
    (0.004, 0.000, 0.736, 0.0215, 0.0215), (0.003, 0.000, 0.716, 0.0150, 0.0150), (0.002, 0.000, 0.680, 0.0115, 0.0115),
    (0.000, 0.000, 0.600, 0.0100, 0.0105), (-0.001, 0.000, 0.530, 0.0098, 0.0125), (0.000, 0.000, 0.490, 0.0100, 0.0200),
    (0.001, 0.000, 0.468, 0.0115, 0.0275), (0.001, 0.000, 0.452, 0.0140, 0.0265), (0.001, 0.000, 0.440, 0.0110, 0.0210),
    (0.001, 0.000, 0.436, 0.0060, 0.0150),
]
ULNA = [
    (-0.0215, 0.000, 0.474, 0.0040, 0.0050), (-0.0225, 0.000, 0.469, 0.0085, 0.0100), (-0.0215, 0.000, 0.455, 0.0090, 0.0120),
    (-0.0200, 0.000, 0.438, 0.0080, 0.0115), (-0.0130, 0.000, 0.422, 0.0115, 0.0110), (-0.0120, -0.001, 0.400, 0.0090, 0.0085),
    (-0.0125, -0.002, 0.330, 0.0068, 0.0066), (-0.0120, -0.001, 0.260, 0.0056, 0.0056), (-0.0110, 0.000, 0.206, 0.0062, 0.0062),
    (-0.0110, 0.000, 0.196, 0.0066, 0.0066), (-0.0110, 0.000, 0.192, 0.0035, 0.0035),
]
RADIUS = [
    (0.0100, 0.002, 0.4275, 0.0060, 0.0060), (0.0100, 0.002, 0.4250, 0.0100, 0.0100), (0.0100, 0.002, 0.4170, 0.0100, 0.0100),
    (0.0100, 0.002, 0.4080, 0.0070, 0.0070), (0.0120, 0.001, 0.3950, 0.0085, 0.0080), (0.0150, 0.001, 0.3300, 0.0070, 0.0068),
    (0.0150, 0.000, 0.2600, 0.0076, 0.0072), (0.0110, 0.000, 0.2150, 0.0110, 0.0095), (0.0095, 0.000, 0.1980, 0.0130, 0.0110),
    (0.0095, 0.000, 0.1930, 0.0080, 0.0070),
]
WRIST_BONES = [(0.001, 0.000, 0.190, 0.0090, 0.0065), (0.001, 0.000, 0.184, 0.0175, 0.0105), (0.002, 0.000, 0.170, 0.0205, 0.0110),
               (0.002, 0.000, 0.158, 0.0185, 0.0095), (0.002, 0.000, 0.153, 0.0110, 0.0060)]
# Where each finger's long bone starts in the palm, in the order of curl.FINGERS; the thumb has none.
ROOTS = [(0.0130, 0.000, 0.152), (0.0055, 0.001, 0.151), (-0.0030, 0.001, 0.151), (-0.0105, 0.000, 0.153), None]


def long_bone(parts, rows, count, segments, bone):
    """A bone on a smooth curve through the rows, all of it on one joint."""
    rings = [(Vector(row[:3]), Vector((row[3], 0.0, 0.0)), Vector((0.0, -row[4], 0.0))) for row in curl.spline(rows, count)]
    parts.loft(rings, segments, 0, lambda point: {bone: 1.0})


def small_bone(parts, start, end, radius):
    """A bone of the hand: thick ends, a thin shaft."""
    start, end = Vector(start), Vector(end)
    ahead = (end - start).normalized()
    across = ahead.cross(Vector((0.0, 1.0, 0.0))).normalized()
    up = ahead.cross(across)
    shape = [(0.01, 0.5), (0.05, 0.95), (0.16, 0.95), (0.35, 0.66), (0.65, 0.62), (0.86, 0.86), (0.95, 0.86), (0.99, 0.45)]
    parts.loft([(start.lerp(end, s), across * (radius * r), up * (radius * r)) for s, r in shape], 7, 0, lambda point: {"hand": 1.0})


def bones():
    """Upper arm, forearm and hand."""
    parts = common.Parts()
    long_bone(parts, HUMERUS, 24, 14, "upper_arm")
    long_bone(parts, ULNA, 20, 10, "forearm")
    long_bone(parts, RADIUS, 20, 10, "forearm")
    long_bone(parts, WRIST_BONES, 9, 12, "hand")
    for (base, middle, tip, radii), root in zip(curl.FINGERS, ROOTS):
        base, middle, tip = Vector(base), Vector(middle), Vector(tip)
        radius = radii[0] * 0.52
        if root is not None:
            small_bone(parts, root, base.lerp(middle, 0.12), radius)
            base = base.lerp(middle, 0.15)
        small_bone(parts, base, middle, radius * 0.92)
        small_bone(parts, middle.lerp(tip, 0.03), middle.lerp(tip, 0.60), radius * 0.82)
        small_bone(parts, middle.lerp(tip, 0.63), tip, radius * 0.72)
    return parts.build("bones", [common.material("bone", (0.914, 0.886, 0.816), specular=0.15, shininess=24.0)], False)


def main():
    common.empty_scene(curl.FPS, curl.LAST)
    skin = curl.skin(common.material("glass", (0.940, 0.800, 0.720), specular=0.30, shininess=45.0, opacity=0.18))
    skeleton = curl.skeleton()
    common.bind(bones(), skeleton)
    common.bind(skin, skeleton)
    curl.curl(skeleton)
    common.export("atlas.dae", "An arm of glass with its bones; made by resources/blender/atlas.py")


if __name__ == "__main__":
    main()
