"""Draws a clip of configs/ with Blender itself, to hold Sinew's picture beside it.

    blender --background --factory-startup --python resources/blender/preview.py -- CLIP.dae OUT-PREFIX YAW FRAME…

Reads the file back through Blender's own COLLADA importer, looks at it from YAW degrees (0 = from -y), and writes one picture a frame.
"""

import math
import sys

import bpy
from mathutils import Vector


def bounds():
    """The middle of what is on the scene, and the radius round it."""
    corners = [o.matrix_world @ Vector(c) for o in bpy.context.scene.objects if o.type == "MESH" for c in o.bound_box]
    low = Vector(min(c[i] for c in corners) for i in range(3))
    high = Vector(max(c[i] for c in corners) for i in range(3))
    return (low + high) / 2.0, (high - low).length / 2.0


def main():
    path, prefix, yaw, *frames = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.collada_import(filepath=path)
    scene = bpy.context.scene
    middle, radius = bounds()
    a = math.radians(float(yaw))
    direction = Vector((math.sin(a) * 0.95, -math.cos(a) * 0.95, 0.3))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.angle = math.radians(35.0)
    camera.location = middle + direction * (1.12 * radius / math.sin(math.radians(17.5)))
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 3.0
    sun.rotation_euler = (math.radians(50.0), 0.0, a - math.radians(40.0))
    scene.collection.objects.link(camera)
    scene.collection.objects.link(sun)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.25, 0.28, 0.33, 1.0)
    scene.view_settings.view_transform = "Standard"
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 12
    scene.cycles.use_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = 560
    for frame in frames:
        scene.frame_set(int(frame))
        scene.render.filepath = f"{prefix}-{int(frame):03d}.png"
        bpy.ops.render.render(write_still=True)


main()
