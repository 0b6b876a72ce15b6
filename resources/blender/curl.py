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

import arm_shape
import common
from common import smoothstep
import solids

FPS, LAST = 24, 96
SHOULDER, ELBOW, WRIST, KNUCKLES = (Vector((0.0, 0.0, z)) for z in (0.750, 0.450, 0.190, 0.100))

# Where the hand is sewn to the arm.
CUT = 0.212
SEGMENTS = 40


def arm_rings(outline):
    """The arm's outlines, close together where the surface turns or bends: on the shoulder's edge and round the elbow."""
    end = outline.at[-1]
    while outline.row(end)[5] < 1000.0 * (CUT + 0.008):
        end -= 0.5
    chosen, at = [], 0.0
    while at < end - 4.0:
        row = outline.row(at)
        chosen.append(row)
        at += 5.5 + 5.5 * smoothstep(45.0, 100.0, abs(row[5] - 1000.0 * ELBOW.z)) * smoothstep(0.0, 20.0, at)
    return chosen + [outline.row(end)]


def cap(outline, row):
    """The flat face where the arm was cut off the body, with a rounded edge: rings from its middle to the outline."""
    middle = Vector((0.0, 0.001 * row[4], 0.001 * row[5]))
    edge = [Vector(outline.point(row, 2.0 * math.pi * k / SEGMENTS)) for k in range(SEGMENTS)]
    across = Vector((0.0, row[1] - row[3], row[2] - row[0])).normalized()
    across = across if across.y > 0.0 else -across
    for share, out in ((0.25, 0.0035), (0.5, 0.0033), (0.75, 0.0030), (0.92, 0.0026), (0.97, 0.0020), (0.993, 0.0009)):
        yield [middle.lerp(point, share) + across * out for point in edge]


def hand():
    """The hand, cut off above the wrist."""
    made = solids.mesh_of("hand", arm_shape.hand(), (-0.060, -0.045, -0.010), (0.090, 0.100, 0.236), 0.0020, 2300)
    cut = bmesh.new()
    cut.from_mesh(made.data)
    bmesh.ops.bisect_plane(cut, geom=cut.verts[:] + cut.edges[:] + cut.faces[:], plane_co=(0.0, 0.0, CUT), plane_no=(0.0, 0.0, 1.0),
                           clear_outer=True)
    bpy.data.objects.remove(made)
    return cut


def skin(material):
    """The arm's surface: even rings down to the wrist, sewn to the hand."""
    whole, outline = hand(), arm_shape.Outline()
    rows = arm_rings(outline)
    rings = list(cap(outline, rows[0]))
    first = sum(rings[0], Vector()) / SEGMENTS
    rings += [[Vector(outline.point(row, 2.0 * math.pi * k / SEGMENTS)) for k in range(SEGMENTS)] for row in rows]
    before = None
    for points in rings:
        ring = [whole.verts.new(point) for point in points]
        for k in range(SEGMENTS):
            n = (k + 1) % SEGMENTS
            if before is not None:
                whole.faces.new((before[k], before[n], ring[n], ring[k]))
        if before is None:
            top = whole.verts.new(first)
            for k in range(SEGMENTS):
                whole.faces.new((ring[(k + 1) % SEGMENTS], ring[k], top))
        before = ring
    whole.verts.index_update()
    open_edges = [edge for edge in whole.edges if edge.is_boundary]
    bmesh.ops.bridge_loops(whole, edges=open_edges)
    bmesh.ops.recalc_face_normals(whole, faces=whole.faces[:])
    mesh = bpy.data.meshes.new("arm")
    whole.to_mesh(mesh)
    whole.free()
    solids.closed(mesh)
    mesh.materials.append(material)
    made = bpy.data.objects.new("arm", mesh)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    bpy.ops.object.shade_smooth()
    common.weigh(made, [weights(v.co) for v in mesh.vertices])
    print("skin:", len(mesh.vertices), "vertices")
    return made


def weights(point):
    """Blended over 12 cm at the elbow, half of it by way of the helper, and over 4 cm at the wrist.

    The blend lies 5 cm higher behind than in front: the point of the elbow belongs to the ulna and goes with it.
    """
    z = point.z - 0.060 * smoothstep(-0.050, 0.045, -point.x)
    below = 1.0 - smoothstep(ELBOW.z - 0.004, ELBOW.z + 0.056, z)
    forearm = 1.0 - smoothstep(ELBOW.z - 0.056, ELBOW.z + 0.004, z)
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
    made = skin(common.material("skin", (0.850, 0.610, 0.495)))
    rig = skeleton()
    common.bind(made, rig)
    curl(rig)
    common.export("curl.dae", "An arm that curls; made by resources/blender/curl.py")


if __name__ == "__main__":
    main()
