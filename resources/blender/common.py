"""What the clip scripts share: an empty scene, lofted parts, skin weights, and a tidy export.

Run the scripts with Blender 3.4 (Debian 12), the last line of releases that writes COLLADA with Debian's build:

    blender --background --threads 1 --factory-startup --python resources/blender/curl.py

Each writes one clip to configs/. One thread of the same Blender gives the same bytes: nothing here reads a clock or a random
number, but the remesher adds up in the order in which its threads finish.
"""

import math
import os
import re

import bpy
from mathutils import Matrix, Quaternion, Vector

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
CONFIGS = os.path.join(ROOT, "configs")


def smoothstep(low, high, x):
    """0 below `low`, 1 above `high`, with level ends."""
    t = min(1.0, max(0.0, (x - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


def empty_scene(fps, last_frame):
    """A scene with nothing in it, in metres, that runs from frame 0 to `last_frame`."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.unit_settings.system = "METRIC"
    scene.render.fps = fps
    scene.frame_start = 0
    scene.frame_end = last_frame
    return scene


LOOKS = {}


def material(name, colour, image=None, specular=0.08, shininess=18.0, opacity=1.0):
    """A material of one sRGB colour, or of an image. The exporter leaves shine and opacity out; `export` puts them back."""
    LOOKS[name] = (specular, shininess, opacity)
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Specular"].default_value = 0.2
    if image is not None:
        texture = made.node_tree.nodes.new("ShaderNodeTexImage")
        texture.image = image
        made.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    return made


class Parts:
    """A mesh put together from lofted parts; every corner has a texture coordinate, every face a material."""

    def __init__(self):
        self.vertices = []
        self.faces = []
        self.corners = []
        self.slots = []
        self.owner = []

    def loft(self, rings, segments, slot, owner, uv=None, mould=None):
        """Closes a surface over `rings` = [(centre, x axis, y axis)]; both ends are closed by a fan at the ring's centre.

        `owner(point)` gives the weights {bone: weight} at a point; `uv(turn, along)` the texture coordinate, of a
        part that has a texture; `mould(point)` moves a point after it has been laid.
        """
        uv = uv or (lambda turn, along: (0.0, 0.0))
        self.mould = mould or (lambda point: point)
        first = len(self.vertices)
        for centre, x_axis, y_axis in rings:
            for k in range(segments):
                a = 2.0 * math.pi * k / segments
                self._vertex(centre + x_axis * math.cos(a) + y_axis * math.sin(a), owner)
        start = self._vertex(rings[0][0], owner)
        end = self._vertex(rings[-1][0], owner)
        last = len(rings) - 1
        for r in range(last):
            for k in range(segments):
                n = (k + 1) % segments
                a, b = first + r * segments, first + (r + 1) * segments
                low, high = (r + 0.5) / (last + 1), (r + 1.5) / (last + 1)
                left, right = k / segments, (k + 1) / segments
                self._face((a + k, a + n, b + n, b + k), slot,
                           (uv(left, low), uv(right, low), uv(right, high), uv(left, high)))
        for k in range(segments):
            n = (k + 1) % segments
            left, right, middle = k / segments, (k + 1) / segments, (k + 0.5) / segments
            low, high = 0.5 / (last + 1), (last + 0.5) / (last + 1)
            self._face((first + n, first + k, start), slot, (uv(right, low), uv(left, low), uv(middle, 0.0)))
            top = first + last * segments
            self._face((top + k, top + n, end), slot, (uv(left, high), uv(right, high), uv(middle, 1.0)))

    def add(self, made, slot, owner):
        """Takes the faces of a Blender object over, and removes the object."""
        first = len(self.vertices)
        for vertex in made.data.vertices:
            self.vertices.append(tuple(vertex.co))
            self.owner.append(owner(vertex.co))
        for polygon in made.data.polygons:
            self._face(tuple(first + number for number in polygon.vertices), slot, ((0.0, 0.0),) * len(polygon.vertices))
        bpy.data.objects.remove(made)

    def _vertex(self, point, owner):
        point = self.mould(point)
        self.vertices.append(tuple(point))
        self.owner.append(owner(point))
        return len(self.vertices) - 1

    def _face(self, indices, slot, corners):
        self.faces.append(indices)
        self.slots.append(slot)
        self.corners.append(corners)

    def build(self, name, materials, with_uv):
        """The Blender object, with smooth faces, vertex groups and materials."""
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(self.vertices, [], self.faces)
        for made in materials:
            mesh.materials.append(made)
        for polygon, slot in zip(mesh.polygons, self.slots):
            polygon.material_index = slot
            polygon.use_smooth = True
        if with_uv:
            layer = mesh.uv_layers.new(name="map")
            flat = [c for face in self.corners for c in face]
            for loop, corner in zip(layer.data, flat):
                loop.uv = (round(corner[0], 4), round(corner[1], 4))
        mesh.validate()
        made = bpy.data.objects.new(name, mesh)
        bpy.context.scene.collection.objects.link(made)
        weigh(made, self.owner)
        return made


def weigh(made, weights):
    """Gives vertex i of the object the vertex-group weights `weights[i]` = {bone: weight}."""
    groups = {}
    for index, entry in enumerate(weights):
        for bone, weight in entry.items():
            if weight > 1e-4:
                if bone not in groups:
                    groups[bone] = made.vertex_groups.new(name=bone)
                groups[bone].add([index], weight, "REPLACE")


def dome(first, second, radius_x, radius_y, x_axis, y_axis, steps, start=False):
    """Rings that round off an end: from the full ring at `first` towards `second`, never quite to the point."""
    rings = []
    for k in range(1, steps + 1):
        a = 0.5 * math.pi * k / (steps + 0.35)
        centre = first.lerp(second, math.sin(a))
        rings.append((centre, x_axis * (radius_x * math.cos(a)), y_axis * (radius_y * math.cos(a))))
    return list(reversed(rings)) if start else rings


def armature(name, bones):
    """An armature of `bones` = [(name, head, tail, parent, direction of the bone's z axis)]."""
    data = bpy.data.armatures.new(name)
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode="EDIT")
    for bone_name, head, tail, parent, roll in bones:
        bone = data.edit_bones.new(bone_name)
        bone.head, bone.tail = Vector(head), Vector(tail)
        bone.align_roll(Vector(roll))
        if parent:
            bone.parent = data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in made.pose.bones:
        bone.rotation_mode = "QUATERNION"
    return made


def bind(made, rig):
    """Skins the object to the armature."""
    made.parent = rig
    modifier = made.modifiers.new("Armature", "ARMATURE")
    modifier.object = rig


class Pose:
    """One frame of an armature, bone by bone from the root, in the armature's own space."""

    def __init__(self, rig, frame):
        self.rig, self.frame, self.matrices = rig, frame, {}

    def _carried(self, bone):
        """Where the bone stands when only its parents have moved."""
        if bone.parent is None:
            return bone.bone.matrix_local.copy()
        return self.matrices[bone.parent.name] @ bone.parent.bone.matrix_local.inverted() @ bone.bone.matrix_local

    def turn(self, name, rotation, shift=(0.0, 0.0, 0.0)):
        """Turns the bone about its head by a quaternion and shifts it, both seen in the rest pose's axes; sets its key."""
        bone = self.rig.pose.bones[name]
        rest = bone.bone.matrix_local.to_3x3()
        basis = (rest.inverted() @ rotation.to_matrix() @ rest).to_4x4()
        basis.translation = rest.inverted() @ Vector(shift)
        self._set(bone, self._carried(bone) @ basis)

    def aim(self, name, direction):
        """Points the bone's length along `direction`, its x axis level and along -x, as legs and feet have it; sets its key."""
        bone = self.rig.pose.bones[name]
        along = direction.normalized()
        up = Vector((-1.0, 0.0, 0.0)).cross(along).normalized()
        matrix = Matrix((along.cross(up), along, up)).transposed().to_4x4()
        carried = self._carried(bone)
        matrix.translation = carried.translation
        self._set(bone, matrix)

    def point(self, name, rest_point):
        """Where a point of the rest pose goes that is fixed to the bone."""
        return self.matrices[name] @ self.rig.pose.bones[name].bone.matrix_local.inverted() @ Vector(rest_point)

    def _set(self, bone, matrix):
        basis = self._carried(bone).inverted() @ matrix
        self.matrices[bone.name] = matrix
        bone.location = basis.translation
        bone.rotation_quaternion = basis.to_quaternion()
        bone.keyframe_insert("rotation_quaternion", frame=self.frame)
        bone.keyframe_insert("location", frame=self.frame)


def about(axis, degrees):
    """A turn about an axis by degrees."""
    return Quaternion(axis, math.radians(degrees))


def looked(text, name, specular, shininess, opacity):
    """Makes the Lambert effect of a material a Phong one, and lets it be seen through where it should be."""
    start = text.index(f'<effect id="{name}-effect">')
    end = text.index("</effect>", start)
    effect = text[start:end].replace("<lambert>", "<phong>").replace("</lambert>", "</phong>")
    phong = (f'<specular>\n              <color sid="specular">{specular} {specular} {specular} 1</color>\n            </specular>\n'
             f'            <shininess>\n              <float sid="shininess">{shininess}</float>\n            </shininess>\n            ')
    if opacity < 1.0:
        phong += (f'<transparent opaque="A_ONE">\n              <color sid="alpha">1 1 1 {opacity}</color>\n            </transparent>\n'
                  '            <transparency>\n              <float sid="transparency">1</float>\n            </transparency>\n            ')
    effect = effect.replace("<index_of_refraction>", phong + "<index_of_refraction>")
    return text[:start] + effect + text[end:]


def shorter(text):
    """Rounds positions to 0.01 mm, normals and texture coordinates to four places: half the file was digits nobody sees."""
    places = {"positions": 5, "normals": 4, "map-0": 4}

    def rounded(match):
        numbers = " ".join(f"{round(float(n), places[match[2]]) + 0.0:.6g}" for n in match[3].split())
        return match[1] + numbers

    return re.sub(r'(<float_array id="[^"]*-mesh-(positions|normals|map-0)-array"[^>]*>)([^<]*)', rounded, text)


def export(file_name, author_note):
    """Writes the scene to configs/ with baked matrix keys, then takes out what differs from run to run."""
    os.makedirs(CONFIGS, exist_ok=True)
    path = os.path.join(CONFIGS, file_name)
    bpy.ops.wm.collada_export(
        filepath=path,
        apply_modifiers=False,
        triangulate=True,
        include_armatures=True,
        include_animations=True,
        include_all_actions=False,
        deform_bones_only=False,
        export_animation_type_selection="sample",
        sampling_rate=1,
        keep_flat_curves=True,
        export_object_transformation_type_selection="matrix",
        export_animation_transformation_type_selection="matrix",
        use_texture_copies=False,
        use_blender_profile=False,
        sort_by_name=True,
        limit_precision=True,
    )
    with open(path, encoding="utf-8") as file:
        text = file.read()
    text = re.sub(r"<(created|modified)>[^<]*</", r"<\1>2026-01-01T00:00:00</", text)
    text = re.sub(r"<author>[^<]*</author>", "<author>The Sinew authors</author>", text)
    text = re.sub(r"(\s*)(<authoring_tool>[^<]*</authoring_tool>)",
                  rf"\1\2\1<comments>{author_note}</comments>\1<copyright>MIT OR Apache-2.0</copyright>", text)
    # Images lie beside the clip; the exporter names them by the path on this machine.
    text = re.sub(r"<init_from>[^<]*/([^</]+)</init_from>", r"<init_from>\1</init_from>", text)
    for name, look in LOOKS.items():
        text = looked(text, name, *look)
    text = shorter(text)
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)
    print("wrote", path, os.path.getsize(path), "bytes")
