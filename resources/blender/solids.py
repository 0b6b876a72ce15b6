"""Surfaces of solids that are told by a function: how far a point lies outside, negative inside, in metres.

Balls, rods and blended unions of them, as modellers of organic shapes use them, and a mesh of where the function is zero. Blender's own
Python is all that is needed; a fixed order of sums gives the same mesh on every run.
"""

import math

import bmesh
import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree


def rod(start, end, start_radius, end_radius):
    """A rod with round ends whose radius changes evenly."""
    (ax, ay, az), (bx, by, bz) = start, end
    dx, dy, dz = bx - ax, by - ay, bz - az
    square = dx * dx + dy * dy + dz * dz

    def distance(x, y, z):
        x, y, z = x - ax, y - ay, z - az
        t = min(1.0, max(0.0, (x * dx + y * dy + z * dz) / square))
        return math.sqrt((x - t * dx) ** 2 + (y - t * dy) ** 2 + (z - t * dz) ** 2) - start_radius - t * (end_radius - start_radius)

    return distance


def ball(centre, radii):
    """An ellipsoid along the axes of space; the distance is exact to the first order near its surface."""
    (cx, cy, cz), (rx, ry, rz) = centre, radii

    def distance(x, y, z):
        x, y, z = (x - cx) / rx, (y - cy) / ry, (z - cz) / rz
        near = math.sqrt(x * x + y * y + z * z)
        steep = math.sqrt((x / rx) ** 2 + (y / ry) ** 2 + (z / rz) ** 2)
        return near * (near - 1.0) / steep if steep > 1e-9 else -min(rx, ry, rz)

    return distance


def chain(points, radii):
    """Rods from point to point."""
    return [rod(points[k], points[k + 1], radii[k], radii[k + 1]) for k in range(len(points) - 1)]


def union(solids):
    """The union of solids as they are."""
    return lambda x, y, z: min(solid(x, y, z) for solid in solids)


def blend(solids, width):
    """The union of solids, its inner corners filled: two surfaces nearer to one another than `width` melt together."""

    def distance(x, y, z):
        least = solids[0](x, y, z)
        for solid in solids[1:]:
            other = solid(x, y, z)
            near = max(0.0, width - abs(least - other))
            least = min(least, other) - near * near / (4.0 * width)
        return least

    return distance


def carve(solid, tool, width):
    """The solid without the tool, the edge rounded over `width`."""

    def distance(x, y, z):
        one, other = solid(x, y, z), -tool(x, y, z)
        near = max(0.0, width - abs(one - other))
        return max(one, other) + near * near / (4.0 * width)

    return distance


# A cell's corners, and the six tetrahedra round its diagonal into which it is cut.
CORNERS = [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
TETRAHEDRA = [(0, 4, 6, 7), (0, 6, 2, 7), (0, 2, 3, 7), (0, 3, 1, 7), (0, 1, 5, 7), (0, 5, 4, 7)]


def surface(solid, low, high, pitch):
    """(vertices, faces) of the surface within a box, on the edges of a grid that is `pitch` wide.

    Each cell is cut into tetrahedra, each of which the surface crosses in three or four edges: that leaves no question which corners
    belong together, so the surface is closed. Blocks of cells that are far from the surface are passed over.
    """
    block = 4
    count = [int(math.ceil((high[i] - low[i]) / pitch / block)) for i in range(3)]
    samples, numbers, vertices, faces = {}, {}, [], []

    def sample(corner):
        if corner not in samples:
            samples[corner] = solid(*(low[i] + corner[i] * pitch for i in range(3)))
        return samples[corner]

    def crossing(one, other):
        key = (one, other) if one < other else (other, one)
        if key not in numbers:
            a, b = sample(key[0]), sample(key[1])
            t = min(0.9, max(0.1, a / (a - b)))
            numbers[key] = len(vertices)
            vertices.append(tuple(low[i] + pitch * (key[0][i] + t * (key[1][i] - key[0][i])) for i in range(3)))
        return numbers[key]

    def cross(corners):
        inside = [corner for corner in corners if sample(corner) < 0.0]
        outside = [corner for corner in corners if sample(corner) >= 0.0]
        if not inside or not outside:
            return
        if len(inside) == 2:
            pairs = [(inside[0], outside[0]), (inside[0], outside[1]), (inside[1], outside[1]), (inside[1], outside[0])]
        else:
            pairs = [(a, b) for a in inside for b in outside]
        out = [sum(c[i] for c in outside) / len(outside) - sum(c[i] for c in inside) / len(inside) for i in range(3)]
        face = [crossing(*pair) for pair in pairs]
        a, b, c = (Vector(vertices[number]) for number in face[:3])
        faces.append(face if (b - a).cross(c - a).dot(Vector(out)) > 0.0 else face[::-1])

    reach = 1.3 * 0.5 * math.sqrt(3.0) * block * pitch
    for corner in ((i, j, k) for i in range(count[0]) for j in range(count[1]) for k in range(count[2])):
        if abs(solid(*(low[i] + (corner[i] + 0.5) * block * pitch for i in range(3)))) > reach:
            continue
        for step in ((i, j, k) for i in range(block) for j in range(block) for k in range(block)):
            at = [corner[i] * block + step[i] for i in range(3)]
            cell = [(at[0] + a, at[1] + b, at[2] + c) for a, b, c in CORNERS]
            signs = [sample(one) < 0.0 for one in cell]
            if any(signs) and not all(signs):
                for tetrahedron in TETRAHEDRA:
                    cross([cell[n] for n in tetrahedron])
    return vertices, faces


def mesh_of(name, solid, low, high, pitch, quads):
    """The surface as a Blender object of about so many four-cornered faces that follow its form."""
    vertices, faces = surface(solid, low, high, pitch)
    whole = bmesh.new()
    for vertex in vertices:
        whole.verts.new(vertex)
    whole.verts.ensure_lookup_table()
    for face in faces:
        whole.faces.new([whole.verts[number] for number in face])
    # Where the box cuts the solid off, it is closed: the remesher takes closed surfaces only.
    bmesh.ops.holes_fill(whole, edges=[edge for edge in whole.edges if edge.is_boundary])
    bmesh.ops.triangulate(whole, faces=whole.faces[:])
    bmesh.ops.recalc_face_normals(whole, faces=whole.faces[:])
    # It takes edges shorter than 0.1 mm for points, hence decimetres for now.
    bmesh.ops.scale(whole, vec=(10.0, 10.0, 10.0), verts=whole.verts[:])
    mesh = bpy.data.meshes.new(name)
    whole.to_mesh(mesh)
    whole.free()
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    relax(made, 0.5, 8)
    points = [v.co.copy() for v in mesh.vertices][::31]
    bpy.ops.object.quadriflow_remesh(mode="FACES", target_faces=quads, seed=0, use_mesh_symmetry=False)
    mesh = made.data
    assert len(mesh.polygons) < 2 * quads, "the surface was not made of new faces"
    tree = BVHTree.FromPolygons([v.co for v in mesh.vertices], [p.vertices for p in mesh.polygons])
    furthest = 0.1 * max(tree.find_nearest(point)[3] for point in points)
    assert furthest < 0.003, f"a part was lost: {furthest} m"
    for vertex in mesh.vertices:
        vertex.co *= 0.1
    return made


def closed(mesh, pieces=1):
    """Refuses a mesh that is not so many closed surfaces without a hole through them."""
    whole = bmesh.new()
    whole.from_mesh(mesh)
    good = all(edge.is_manifold for edge in whole.edges)
    whole.free()
    assert good and len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons) == 2 * pieces, f"{mesh.name} is not {pieces} closed surfaces"


def relax(made, factor, iterations):
    """Smooths the surface."""
    modifier = made.modifiers.new("Smooth", "SMOOTH")
    modifier.factor, modifier.iterations = factor, iterations
    bpy.ops.object.modifier_apply(modifier=modifier.name)


def scaled(points):
    """Millimetres as metres."""
    return [Vector(point) * 0.001 for point in points]
