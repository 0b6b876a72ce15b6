"""Makes configs/atlas.dae: the arm of curl.dae as an anatomical atlas shows it, glassy skin over ivory bones.

The same skeleton and the same movement as curl.py, so that a muscle made for one fits the other, and here it can be seen.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from mathutils import Vector

import arm_shape
import common
import curl
import solids
from solids import ball, blend, carve, chain, scaled, union


def rods(points, radii):
    """Rods from point to point, in mm, as the one solid of a list."""
    return [union(chain(scaled(points), [0.001 * radius for radius in radii]))]


def lump(centre, radii):
    """An ellipsoid, in mm."""
    return ball([0.001 * c for c in centre], [0.001 * r for r in radii])


def humerus():
    """The bone of the upper arm: its head looks towards the body, the rolls of the elbow lie across its lower end."""
    shaft = rods([(1, 6, 742), (2, -2, 700), (1, -3, 610), (0, -1, 525), (0, 0, 495)], [17, 11.5, 9.4, 9.0, 6.5])
    shaft = [blend(shaft + [lump((2, -7, 612), (5, 5, 24))], 0.004)]
    flare = rods([(0, -2, 515), (0, -17, 464)], [7.0, 6.5]) + rods([(0, 1, 515), (0, 16, 466)], [7.0, 6.8])
    head = [lump((-1, 11, 752), (22.5, 22, 22.5)), lump((1, -15, 746), (13, 9, 16)), lump((12, 2, 739), (9, 8, 14))]
    knobs = [lump((-5, 29, 463), (7, 8, 8)), lump((-1, -26, 461), (7, 6, 9))]
    rolls = rods([(1, 18, 449.5), (1, 11, 449.5), (1, 2, 449.5)], [12.5, 10.5, 11.5]) + [lump((4, -14, 450.5), (11, 10.5, 11))]
    whole = blend(shaft + flare + head + knobs, 0.012)
    whole = carve(blend([whole] + rolls, 0.004), lump((-15, 8, 471), (9, 9, 9)), 0.004)
    return solids.mesh_of("humerus", whole, (-0.036, -0.042, 0.428), (0.036, 0.046, 0.786), 0.0016, 1200)


def ulna():
    """The bone of the forearm on the little finger's side; it holds the roll of the humerus like a spanner."""
    end = [lump((-20, 7, 467), (8.5, 10.5, 10.5)), lump((-3, 8, 431), (10, 8.5, 6))]
    shaft = rods([(-20, 7, 458), (-14, 7, 425), (-13, 5, 340), (-12.5, 3, 260), (-12, 0, 203)], [9, 9, 7, 5.6, 6.2])
    whole = blend(end + shaft + [lump((-12, 0, 201), (7.5, 7, 6))] + rods([(-15, 2, 198), (-16, 3, 193)], [4.2, 3.4]), 0.008)
    whole = carve(whole, rods([(1, -12, 449.5), (1, 32, 449.5)], [13.6, 13.6])[0], 0.003)
    return solids.mesh_of("ulna", whole, (-0.036, -0.016, 0.182), (0.014, 0.026, 0.484), 0.0014, 950)


def radius():
    """The bone of the forearm on the thumb's side; the biceps pulls at the bump below its head."""
    head = [lump((2, -14, 431), (10.5, 10.5, 5.5))]
    shaft = rods([(2, -14, 431), (3, -12, 415), (5, -9, 396), (10, -6, 330), (12, -3, 260), (11, -1, 216)], [7, 6.6, 7.2, 7.4, 6.8, 9.5])
    bump = [lump((6.5, -5.5, 404), (5.5, 6, 10))]
    end = [lump((9, 0, 204), (15, 11, 10))] + rods([(18, -1, 200), (20, -1, 193)], [5.5, 4.0])
    whole = blend(head + shaft + bump + end, 0.007)
    return solids.mesh_of("radius", whole, (-0.014, -0.030, 0.182), (0.032, 0.018, 0.442), 0.0014, 850)


def girdle():
    """What of the shoulder blade and the collar bone lies in the arm: socket, hook, roof of the joint, and the bone's end on it."""
    socket = [lump((-2, 39.5, 750), (13, 4.5, 17))] + rods([(-2, 40, 752), (-3, 43, 754)], [10, 8])
    hook = rods([(4, 43, 764), (14, 41, 766), (24, 35, 756), (26, 31, 749)], [6.5, 6, 5.2, 4.4])
    blade = blend(socket + hook, 0.008)
    roof = blend(rods([(-33, 42, 780), (-24, 18, 782), (-12, -6, 782)], [4.6, 4.4, 4.0]) + [lump((-7, -9, 781.5), (13, 9, 4.2))], 0.008)
    collar = blend(rods([(12, 44, 788.5), (9, 24, 787), (3, 4, 784)], [5.2, 4.6, 5.2]), 0.004)
    return [solids.mesh_of("blade", blade, (-0.020, 0.024, 0.726), (0.036, 0.060, 0.780), 0.0012, 320),
            solids.mesh_of("roof", roof, (-0.042, -0.024, 0.772), (0.012, 0.054, 0.792), 0.0012, 340),
            solids.mesh_of("collar", collar, (-0.006, -0.006, 0.776), (0.022, 0.056, 0.798), 0.0012, 180)]


# The bones of the wrist: middles and half sizes, mm.
WRIST_BONES = [
    ((14, 0, 183), (8, 6.5, 9)), ((3.5, 0, 185.5), (6.3, 7, 7.5)), ((-7, 1, 183), (6.3, 6, 6.5)), ((-10, 8.5, 179), (4.5, 4.5, 5)),
    ((17, 4, 168), (7, 7, 6.5)), ((9.5, -1, 166.5), (5, 6.5, 6.5)), ((1.5, -1, 169), (6, 7, 10)), ((-8, 0, 168), (7, 7, 8.5)),
]


def pebble(parts, centre, radii):
    """A bone of the wrist."""
    centre, radii = Vector(centre) * 0.001, [0.001 * r for r in radii]
    poles = [centre + Vector((0.0, 0.0, radii[2] * s)) for s in (1.0, -1.0)]
    x_axis, y_axis = Vector((1.0, 0.0, 0.0)), Vector((0.0, -1.0, 0.0))
    upper = common.dome(centre, poles[0], radii[0], radii[1], x_axis, y_axis, 3, start=True)
    lower = common.dome(centre, poles[1], radii[0], radii[1], x_axis, y_axis, 3)
    parts.loft(upper + [(centre, x_axis * radii[0], y_axis * radii[1])] + lower, 10, 0, lambda point: {"hand": 1.0})


def small_bone(parts, start, end, radius):
    """A bone of the hand: thick ends, a thin shaft."""
    ahead = (end - start).normalized()
    across = ahead.cross(Vector((0.0, 1.0, 0.0))).normalized()
    up = ahead.cross(across)
    shape = [(0.01, 0.55), (0.05, 0.95), (0.15, 0.98), (0.33, 0.68), (0.62, 0.62), (0.84, 0.90), (0.95, 0.90), (0.99, 0.5)]
    parts.loft([(start.lerp(end, s), across * (radius * r), up * (radius * r)) for s, r in shape], 8, 0, lambda point: {"hand": 1.0})


def hand():
    """The bones of wrist, palm and fingers."""
    parts = common.Parts()
    for centre, radii in WRIST_BONES:
        pebble(parts, centre, radii)
    digits = [(scaled([root] + arm_shape.digit(finger)), finger[4]) for root, finger in zip(arm_shape.ROOTS, arm_shape.FINGERS)]
    digits.append((scaled([(20.0, 5.0, 162.0)] + arm_shape.THUMB[1:]), arm_shape.THUMB_RADII))
    for points, radii in digits:
        last = len(points) - 2
        for k in range(last + 1):
            # A little room at the joints; the last bone ends inside the tip.
            start, end = points[k].lerp(points[k + 1], 0.02 if k else 0.0), points[k].lerp(points[k + 1], 0.98)
            small_bone(parts, start, end, 0.001 * (radii[0] * 0.50 if k == 0 else radii[k - 1 if last == 3 else k] * 0.50 * 0.97 ** k))
    return parts


def bones():
    """Shoulder, upper arm, forearm and hand: one mesh, each part of it on one joint."""
    parts = hand()
    for bone, made in [("upper_arm", humerus())] + [("upper_arm", made) for made in girdle()] + [("forearm", ulna()), ("forearm", radius())]:
        parts.add(made, 0, lambda point, bone=bone: {bone: 1.0})
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
