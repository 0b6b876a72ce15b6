"""Makes configs/curl.dae: an arm that hangs straight, bends at the elbow to 140 degrees, and comes back.

Z up, metres. The arm hangs along -z and bends in the x-z plane, towards +x: the front of the arm, where a biceps lies, is +x;
the back, where a triceps lies, is -x; y runs across it, and the thumb points to +x.

    joint     at (x, y, z)          bone to
    shoulder  (0, 0, 0.750)         upper_arm, 0.30 m down to the elbow
    elbow     (0, 0, 0.450)         forearm,   0.26 m down to the wrist; and elbow, a helper that turns half as far
    wrist     (0, 0, 0.190)         hand,      0.09 m down to the knuckles
"""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bmesh
import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

import common
from common import smoothstep

FPS, LAST = 24, 96
SHOULDER, ELBOW, WRIST, KNUCKLES = (Vector((0.0, 0.0, z)) for z in (0.750, 0.450, 0.190, 0.100))

# Where the hand is sewn to the arm.
CUT = 0.212

# Outline of the arm: height, centre in x, half depth (x, front to back), half width (y).
ARM = [
    (0.795, 0.004, 0.010, 0.010),
    (0.790, 0.004, 0.028, 0.027),
    (0.777, 0.004, 0.043, 0.042),
    (0.755, 0.003, 0.051, 0.049),
    (0.720, 0.002, 0.053, 0.049),
    (0.680, 0.002, 0.051, 0.046),
    (0.630, 0.002, 0.047, 0.043),
    (0.580, 0.002, 0.0445, 0.041),
    (0.530, 0.000, 0.041, 0.039),
    (0.490, -0.002, 0.038, 0.040),
    (0.465, -0.003, 0.0375, 0.042),
    (0.445, -0.002, 0.038, 0.0435),
    (0.425, 0.000, 0.0385, 0.044),
    (0.395, 0.002, 0.0395, 0.0445),
    (0.360, 0.003, 0.0385, 0.042),
    (0.320, 0.003, 0.035, 0.0375),
    (0.280, 0.003, 0.030, 0.032),
    (0.240, 0.002, 0.0260, 0.0275),
    (0.210, 0.001, 0.0250, 0.0235),
    (0.190, 0.001, 0.0260, 0.0215),
    (0.170, 0.001, 0.0265, 0.0190),
    (0.150, 0.001, 0.0220, 0.0140),
]
# The palm: as above. It faces -y (the body's side) when the arm hangs.
PALM = [
    (0.210, 0.001, 0.0140, 0.0120),
    (0.190, 0.001, 0.0225, 0.0175),
    (0.168, 0.001, 0.0285, 0.0185),
    (0.145, 0.002, 0.0350, 0.0175),
    (0.125, 0.002, 0.0385, 0.0160),
    (0.108, 0.001, 0.0390, 0.0145),
    (0.096, 0.000, 0.0365, 0.0125),
    (0.090, 0.000, 0.0300, 0.0100),
]
# Fingers: knuckle, middle, tip, and the radius at each. They hang a little bent, towards the palm (-y).
FINGERS = [
    ((0.0300, 0.000, 0.108), (0.0410, -0.006, 0.064), (0.0460, -0.019, 0.028), (0.0110, 0.0098, 0.0082)),
    ((0.0105, 0.001, 0.104), (0.0135, -0.006, 0.052), (0.0145, -0.022, 0.012), (0.0113, 0.0101, 0.0084)),
    ((-0.0095, 0.001, 0.105), (-0.0135, -0.007, 0.056), (-0.0160, -0.024, 0.018), (0.0109, 0.0098, 0.0082)),
    ((-0.0240, -0.001, 0.120), (-0.0365, -0.009, 0.074), (-0.0425, -0.023, 0.044), (0.0112, 0.0092, 0.0076)),
    ((0.0180, -0.006, 0.158), (0.0520, -0.016, 0.122), (0.0680, -0.022, 0.086), (0.0155, 0.0120, 0.0090)),
]


def spline(rows, count):
    """`count` rows on a smooth curve (Catmull-Rom) through the rows."""
    made = []
    for k in range(count):
        s = k / (count - 1) * (len(rows) - 1)
        i = min(int(s), len(rows) - 2)
        t = s - i
        p0, p1, p2, p3 = (rows[min(max(i + d, 0), len(rows) - 1)] for d in (-1, 0, 1, 2))
        made.append(tuple(
            0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t * t * t)
            for a, b, c, d in zip(p0, p1, p2, p3)))
    return made


def nobody(_):
    """No weights yet: they are given after the parts have been joined."""
    return {}


def upright(rows):
    """Rings across the z axis, from top to bottom."""
    return [(Vector((x, 0.0, z)), Vector((depth, 0.0, 0.0)), Vector((0.0, -width, 0.0))) for z, x, depth, width in rows]


def finger(parts, base, middle, tip, radii):
    """One finger: a rounded tube along a bent line."""
    rows = spline([(*base, radii[0]), (*middle, radii[1]), (*tip, radii[2])], 9)
    rings = []
    for k, (x, y, z, radius) in enumerate(rows):
        ahead = Vector(rows[min(k + 1, 8)][:3]) - Vector(rows[max(k - 1, 0)][:3])
        across = ahead.cross(Vector((0.0, 1.0, 0.0))).normalized()
        up = ahead.cross(across).normalized()
        rings.append((Vector((x, y, z)), across * radius, up * radius))
    end, x_axis, y_axis = rings[-1]
    ahead = (Vector(rows[-1][:3]) - Vector(rows[-2][:3])).normalized()
    radius = radii[2]
    for a in (0.35, 0.7, 1.05, 1.35):
        rings.append((end + ahead * (radius * math.sin(a)), x_axis * math.cos(a), y_axis * math.cos(a)))
    parts.loft(rings, 14, 0, nobody)


def arm_rings():
    """The arm's rings, close together where the surface turns or bends: at the shoulder's dome and round the elbow."""
    rows, chosen = spline(ARM, 2000), []
    for row in rows:
        z = row[0]
        if z < CUT + 0.010:
            break
        gap = 0.006 + 0.012 * smoothstep(0.045, 0.100, abs(z - ELBOW.z)) * smoothstep(0.005, 0.060, ARM[0][0] - z)
        if not chosen or chosen[-1][0] - z >= gap:
            chosen.append(row)
    return upright(chosen)


def hand():
    """The hand: its parts melted together, smoothed, thinned out, and cut off above the wrist."""
    parts = common.Parts()
    parts.loft(upright(spline([row for row in ARM if row[0] < 0.30], 40)), 40, 0, nobody)
    parts.loft(upright(spline(PALM, 30)), 32, 0, nobody)
    for base, middle, tip, radii in FINGERS:
        finger(parts, base, middle, tip, radii)
    made = parts.build("hand", [], False)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    made.data.remesh_voxel_size = 0.0016
    bpy.ops.object.voxel_remesh()
    relax(made, 0.5, 7)
    thin_out(made, 2000)
    cut = bmesh.new()
    cut.from_mesh(made.data)
    bmesh.ops.bisect_plane(cut, geom=cut.verts[:] + cut.edges[:] + cut.faces[:], plane_co=(0.0, 0.0, CUT), plane_no=(0.0, 0.0, 1.0),
                           clear_outer=True)
    bpy.data.objects.remove(made)
    return cut


def skin(material):
    """The arm's surface: even rings down to the wrist, sewn to the hand."""
    whole = hand()
    segments, before = 32, None
    for centre, x_axis, y_axis in arm_rings():
        turns = [2.0 * math.pi * k / segments for k in range(segments)]
        ring = [whole.verts.new(centre + x_axis * math.cos(a) + y_axis * math.sin(a)) for a in turns]
        for k in range(segments):
            n = (k + 1) % segments
            if before is None:
                continue
            whole.faces.new((before[k], before[n], ring[n], ring[k]))
        if before is None:
            top = whole.verts.new(centre)
            for k in range(segments):
                whole.faces.new((ring[(k + 1) % segments], ring[k], top))
        before = ring
    whole.verts.index_update()
    open_edges = [edge for edge in whole.edges if edge.is_boundary]
    bmesh.ops.bridge_loops(whole, edges=open_edges)
    bmesh.ops.recalc_face_normals(whole, faces=whole.faces[:])
    mesh = bpy.data.meshes.new("arm")
    whole.to_mesh(mesh)
    whole.free()
    assert len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons) == 2, "the surface is not one closed piece"
    mesh.materials.append(material)
    made = bpy.data.objects.new("arm", mesh)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    bpy.ops.object.shade_smooth()
    common.weigh(made, [weights(v.co) for v in mesh.vertices])
    return made


def thin_out(made, triangles):
    """Fewer triangles where the surface is flat; no point of the fine surface may be left more than 2 mm outside."""
    points = [v.co.copy() for v in made.data.vertices][::7]
    faces = sum(len(p.vertices) - 2 for p in made.data.polygons)
    modifier = made.modifiers.new("Decimate", "DECIMATE")
    modifier.ratio = triangles / faces
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    mesh = made.data
    tree = BVHTree.FromPolygons([v.co for v in mesh.vertices], [p.vertices for p in mesh.polygons])
    furthest = max(tree.find_nearest(point)[3] for point in points)
    assert furthest < 0.002, f"a part was lost: {furthest} m"


def relax(made, factor, iterations):
    """Smooths the surface."""
    modifier = made.modifiers.new("Smooth", "SMOOTH")
    modifier.factor, modifier.iterations = factor, iterations
    bpy.ops.object.modifier_apply(modifier=modifier.name)


def weights(point):
    """Blended over 12 cm at the elbow, half of it by way of the helper, and over 4 cm at the wrist."""
    below = 1.0 - smoothstep(ELBOW.z - 0.004, ELBOW.z + 0.056, point.z)
    forearm = 1.0 - smoothstep(ELBOW.z - 0.056, ELBOW.z + 0.004, point.z)
    hand = 1.0 - smoothstep(WRIST.z - 0.022, WRIST.z + 0.018, point.z)
    return {"upper_arm": 1.0 - below, "elbow": below - forearm, "forearm": forearm - hand, "hand": hand}


def curl(rig):
    """One key a frame: the elbow goes to 140 degrees and back, the wrist bends a little with it, the shoulder gives way."""
    across = (0.0, 1.0, 0.0)
    for frame in range(LAST + 1):
        t = frame / LAST
        lift = smoothstep(0.04, 0.46, t) * (1.0 - smoothstep(0.54, 0.96, t))
        pose = common.Pose(rig, frame)
        for name, degrees in (("upper_arm", -7.0), ("elbow", -70.0), ("forearm", -140.0), ("hand", -18.0)):
            pose.turn(name, common.about(across, degrees * lift))


def skeleton():
    """The four bones."""
    return common.armature("skeleton", [
        ("upper_arm", SHOULDER, ELBOW, None, (0.0, 1.0, 0.0)),
        ("elbow", ELBOW, ELBOW + Vector((0.0, 0.0, -0.03)), "upper_arm", (0.0, 1.0, 0.0)),
        ("forearm", ELBOW, WRIST, "upper_arm", (0.0, 1.0, 0.0)),
        ("hand", WRIST, KNUCKLES, "forearm", (0.0, 1.0, 0.0)),
    ])


def main():
    common.empty_scene(FPS, LAST)
    made = skin(common.material("skin", (0.800, 0.585, 0.475)))
    rig = skeleton()
    common.bind(made, rig)
    curl(rig)
    common.export("curl.dae", "An arm that curls; made by resources/blender/curl.py")


if __name__ == "__main__":
    main()
