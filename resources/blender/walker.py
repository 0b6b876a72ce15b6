"""Makes configs/walker.dae and configs/walker.png: a small robot in a striped jumper that walks on the spot, 1.2 s a cycle.

Z up, metres; it faces -y and stands on z = 0. The feet move at one speed while they carry weight, so nothing slides.
"""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
from mathutils import Vector

import common
import walker_paint
from common import about, smoothstep

FPS, LAST = 30, 36
SIDES = (("L", 1.0), ("R", -1.0))
FORWARD, ACROSS, UP = Vector((0.0, -1.0, 0.0)), Vector((1.0, 0.0, 0.0)), Vector((0.0, 0.0, 1.0))

HIPS, CHEST, NECK, HEAD = (Vector((0.0, 0.0, z)) for z in (0.520, 0.680, 0.900, 0.960))
HIP, KNEE, ANKLE = Vector((0.085, 0.0, 0.490)), Vector((0.090, -0.006, 0.285)), Vector((0.092, 0.012, 0.085))
BALL, TOE, HEEL = Vector((0.092, -0.085, 0.0)), Vector((0.092, -0.165, 0.030)), Vector((0.092, 0.055, 0.0))
SHOULDER, ELBOW, WRIST = Vector((0.150, 0.0, 0.835)), Vector((0.222, 0.004, 0.665)), Vector((0.262, -0.012, 0.500))
FINGERS = Vector((0.285, -0.018, 0.405))

PAINT, JUMPER, TROUSERS, RUBBER, CORAL = range(5)


def mirrored(point, side):
    """The point on the left (+1) or right (-1) side."""
    return Vector((point.x * side, point.y, point.z))


def tube(points, radii, count):
    """Rings along a bent line through the points; the ring's start is behind, where a seam is not seen."""
    made = []
    for k in range(count):
        s = k / (count - 1) * (len(points) - 1)
        i = min(int(s), len(points) - 2)
        t = s - i
        p = [points[min(max(i + d, 0), len(points) - 1)] for d in (-1, 0, 1, 2)]
        centre = 0.5 * (2 * p[1] + (p[2] - p[0]) * t + (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) * t * t
                        + (3 * p[1] - p[0] - 3 * p[2] + p[3]) * t ** 3)
        e = t * t * (3.0 - 2.0 * t)
        made.append((centre, radii[i] * (1.0 - e) + radii[i + 1] * e))
    rings = []
    for k, (centre, radius) in enumerate(made):
        ahead = (made[min(k + 1, count - 1)][0] - made[max(k - 1, 0)][0]).normalized()
        x_axis = (Vector((0.0, 1.0, 0.0)) - ahead * ahead.y).normalized()
        rings.append((centre, x_axis * radius, ahead.cross(x_axis) * radius))
    return rings


def ball(centre, radii, ahead, count):
    """Rings of an ellipsoid with half axes `radii` = (across, across, ahead)."""
    x_axis = (Vector((0.0, 1.0, 0.0)) - ahead * ahead.y).normalized()
    y_axis = ahead.cross(x_axis)
    rings = []
    for k in range(count):
        a = math.pi * (k + 0.6) / (count + 0.2) - math.pi / 2.0
        rings.append((centre + ahead * (radii[2] * math.sin(a)), x_axis * (radii[0] * math.cos(a)), y_axis * (radii[1] * math.cos(a))))
    return rings


def rounded(rings, steps=3, start=True, end=True):
    """The rings with rounded ends."""
    made = list(rings)
    for at_end in (False, True):
        if not (end if at_end else start):
            continue
        centre, x_axis, y_axis = made[-1] if at_end else made[0]
        other = made[-2][0] if at_end else made[1][0]
        reach = (centre - other).normalized() * min(x_axis.length, y_axis.length) * 0.8
        extra = []
        for k in range(1, steps + 1):
            a = 0.5 * math.pi * k / (steps + 0.4)
            extra.append((centre + reach * math.sin(a), x_axis * math.cos(a), y_axis * math.cos(a)))
        made = made + extra if at_end else list(reversed(extra)) + made
    return made


def only(bone):
    """All weight on one bone."""
    return lambda point: {bone: 1.0}


def blend(joints):
    """Weights along a limb: `joints` = [(bone, where it starts, its direction, half width of the blend)], root first."""
    def owner(point):
        made, left = {}, 1.0
        for bone, start, direction, width in reversed(joints):
            share = 1.0 if start is None else smoothstep(-width, width, (point - start).dot(direction.normalized()))
            made[bone] = left * share
            left *= 1.0 - share
        return made
    return owner


def body(parts):
    """Pelvis, jumper, neck, head with its ears and antenna."""
    pelvis = [(0.420, 0.050, 0.090), (0.440, 0.088, 0.128), (0.480, 0.105, 0.150), (0.530, 0.108, 0.152), (0.580, 0.102, 0.144)]
    parts.loft(rings_up(pelvis), 18, TROUSERS, blend([("hips", None, None, 0.0), ("spine", Vector((0, 0, 0.585)), UP, 0.05)]))
    trunk = [(0.540, 0.100, 0.140), (0.545, 0.114, 0.158), (0.562, 0.119, 0.163), (0.582, 0.117, 0.160), (0.640, 0.114, 0.152),
             (0.700, 0.114, 0.152), (0.760, 0.115, 0.158), (0.810, 0.112, 0.160), (0.845, 0.102, 0.150), (0.872, 0.084, 0.122),
             (0.890, 0.062, 0.085), (0.900, 0.050, 0.060)]
    parts.loft(rings_up(trunk), 20, PAINT, blend([
        ("hips", None, None, 0.0), ("spine", Vector((0, 0, 0.575)), UP, 0.045), ("chest", CHEST, UP, 0.06)]), uv=walker_paint.jumper)
    collar = [(0.882, 0.052, 0.062), (0.886, 0.062, 0.073), (0.898, 0.067, 0.078), (0.910, 0.062, 0.073), (0.914, 0.052, 0.062)]
    parts.loft(rings_up(collar), 14, CORAL, only("chest"))
    parts.loft(rings_up([(0.88, 0.036, 0.036), (0.92, 0.034, 0.034), (0.98, 0.034, 0.034)]), 8, RUBBER,
               blend([("chest", None, None, 0.0), ("neck", NECK, UP, 0.02), ("head", HEAD, UP, 0.015)]))
    skull = []
    for k in range(12):
        a = math.pi * (k + 0.45) / 11.9 - math.pi / 2.0
        # A rounded box rather than an egg: the cosine raised below 1 fills the corners.
        width = math.cos(a) ** 0.72
        skull.append((1.120 + 0.160 * math.copysign(abs(math.sin(a)) ** 0.86, math.sin(a)), 0.158 * width, 0.190 * width))
    parts.loft(rings_up(skull), 24, PAINT, only("head"), uv=walker_paint.head)
    for _, side in SIDES:
        out = ACROSS * side
        parts.loft(ball(Vector((0.186 * side, 0.0, 1.105)), (0.062, 0.062, 0.030), out, 4), 12, CORAL, only("head"))
    stem = tube([Vector((0.0, 0.0, 1.26)), Vector((0.0, 0.0, 1.31)), Vector((0.0, 0.0, 1.355))], [0.013, 0.010, 0.009], 4)
    parts.loft(stem, 6, RUBBER, only("antenna"))
    parts.loft(ball(Vector((0.0, 0.0, 1.380)), (0.034, 0.034, 0.034), UP, 6), 10, CORAL, only("antenna"))


def rings_up(rows):
    """Level rings from (height, half depth, half width), the seam at the back."""
    return [(Vector((0.0, 0.0, z)), Vector((0.0, depth, 0.0)), Vector((-width, 0.0, 0.0))) for z, depth, width in rows]


def arm(parts, name, side):
    """Sleeve, cuff and mitten."""
    shoulder, elbow, wrist, fingers = (mirrored(p, side) for p in (SHOULDER, ELBOW, WRIST, FINGERS))
    upper, fore, hand = f"upper_arm.{name}", f"forearm.{name}", f"hand.{name}"
    weights = blend([("chest", None, None, 0.0), (upper, shoulder.lerp(elbow, 0.06), elbow - shoulder, 0.035),
                     (fore, elbow, (wrist - shoulder), 0.045), (hand, wrist, wrist - elbow, 0.015)])
    start = shoulder + Vector((-0.030 * side, 0.0, 0.012))
    sleeve = tube([start, shoulder.lerp(elbow, 0.35), elbow, wrist.lerp(elbow, 0.12)], [0.066, 0.055, 0.050, 0.046], 10)
    parts.loft(rounded(sleeve, end=False), 12, JUMPER, weights)
    ahead = (wrist - elbow).normalized()
    cuff = [(elbow.lerp(wrist, f), r) for f, r in ((0.80, 0.046), (0.81, 0.054), (0.87, 0.058), (0.93, 0.054), (0.94, 0.040))]
    x_axis = (Vector((0.0, 1.0, 0.0)) - ahead * ahead.y).normalized()
    parts.loft([(c, x_axis * r, ahead.cross(x_axis) * r) for c, r in cuff], 12, CORAL, only(fore))
    palm = (fingers - wrist).normalized()
    middle = wrist.lerp(fingers, 0.52)
    parts.loft(ball(middle, (0.050, 0.038, 0.066), palm, 6), 10, RUBBER, only(hand))
    thumb = middle + Vector((-0.010 * side, -0.040, 0.010))
    parts.loft(ball(thumb, (0.020, 0.020, 0.036), (palm + Vector((0.0, -0.75, 0.0))).normalized(), 4), 8, RUBBER, only(hand))


def leg(parts, name, side):
    """Trouser leg, its turned-up hem, shoe and sole."""
    hip, knee, ankle, ball_of_foot, toe = (mirrored(p, side) for p in (HIP, KNEE, ANKLE, BALL, TOE))
    thigh, shin, foot, toes = (f"{bone}.{name}" for bone in ("thigh", "shin", "foot", "toes"))
    weights = blend([("hips", None, None, 0.0), (thigh, hip.lerp(knee, 0.02), knee - hip, 0.05), (shin, knee, ankle - hip, 0.05)])
    trouser = tube([hip + Vector((-0.012 * side, 0.0, 0.03)), hip.lerp(knee, 0.45), knee, ankle.lerp(knee, 0.22)],
                   [0.076, 0.073, 0.066, 0.064], 11)
    parts.loft(rounded(trouser, end=False), 12, TROUSERS, weights)
    hem = [(knee.lerp(ankle, f), r) for f, r in ((0.66, 0.060), (0.67, 0.070), (0.75, 0.074), (0.83, 0.070), (0.84, 0.050))]
    parts.loft([(c, Vector((0.0, r, 0.0)), ACROSS * r) for c, r in hem], 12, JUMPER, only(shin))
    parts.loft(tube([knee.lerp(ankle, 0.75), ankle, ankle + Vector((0.0, 0.0, -0.03))], [0.036, 0.034, 0.034], 3), 8, RUBBER,
               blend([(shin, None, None, 0.0), (foot, ankle, -UP, 0.015)]))
    walk = blend([(foot, None, None, 0.0), (toes, Vector((ball_of_foot.x, ball_of_foot.y, 0.0)), FORWARD, 0.028)])
    shoe = [(0.075, 0.030, 0.038), (0.060, 0.050, 0.052), (0.025, 0.060, 0.070), (-0.020, 0.062, 0.068), (-0.070, 0.066, 0.052),
            (-0.115, 0.070, 0.050), (-0.150, 0.062, 0.042), (-0.172, 0.040, 0.028)]
    upper = [(Vector((ball_of_foot.x, y, 0.008 + tall)), UP * tall, ACROSS * wide) for y, wide, tall in shoe]
    parts.loft(upper, 14, CORAL, walk, mould=lambda p: Vector((p.x, p.y, max(p.z, 0.022))))
    sole = [(Vector((ball_of_foot.x, y * 1.03, 0.014)), UP * 0.026, ACROSS * (wide * 1.06)) for y, wide, _ in shoe]
    parts.loft(sole, 10, RUBBER, walk, mould=lambda p: Vector((p.x, p.y, min(max(p.z, 0.0), 0.028))))


def skeleton():
    """Twenty bones; knees and elbows bend about x."""
    bones = [
        ("hips", HIPS, HIPS + UP * 0.06, None, FORWARD),
        ("spine", HIPS + UP * 0.06, CHEST, "hips", FORWARD),
        ("chest", CHEST, NECK, "spine", FORWARD),
        ("neck", NECK, HEAD, "chest", FORWARD),
        ("head", HEAD, HEAD + UP * 0.30, "neck", FORWARD),
        ("antenna", Vector((0.0, 0.0, 1.26)), Vector((0.0, 0.0, 1.38)), "head", FORWARD),
    ]
    for name, side in SIDES:
        p = [mirrored(q, side) for q in (SHOULDER, ELBOW, WRIST, FINGERS, HIP, KNEE, ANKLE, BALL, TOE)]
        ball_of_foot = p[7] + UP * 0.020
        bones += [
            (f"upper_arm.{name}", p[0], p[1], "chest", FORWARD),
            (f"forearm.{name}", p[1], p[2], f"upper_arm.{name}", FORWARD),
            (f"hand.{name}", p[2], p[3], f"forearm.{name}", FORWARD),
            (f"thigh.{name}", p[4], p[5], "hips", FORWARD),
            (f"shin.{name}", p[5], p[6], f"thigh.{name}", FORWARD),
            (f"foot.{name}", p[6], ball_of_foot, f"shin.{name}", UP),
            (f"toes.{name}", ball_of_foot, p[8], f"foot.{name}", UP),
        ]
    return common.armature("skeleton", bones)


STANCE, STRIDE, LIFT = 0.58, 0.125, 0.060


def step(phase):
    """One foot in the cycle: how far back it is (m), its height, and its pitch (degrees, + = toes up)."""
    phase %= 1.0
    if phase < STANCE:
        t = phase / STANCE
        pitch = 20.0 * (1.0 - smoothstep(0.0, 0.18, t)) - 38.0 * smoothstep(0.55, 1.0, t) ** 1.3
        return STRIDE * (2.0 * t - 1.0), 0.0, pitch
    t = (phase - STANCE) / (1.0 - STANCE)
    # The foot leaves and lands at the speed of the ground (a cubic with that slope at both ends).
    slope = 2.0 * STRIDE * (1.0 - STANCE) / STANCE
    back = STRIDE * (1.0 - 2.0 * t * t * (3.0 - 2.0 * t)) + slope * (t * (1.0 - t) ** 2 - t * t * (1.0 - t))
    pitch = -38.0 * (1.0 - smoothstep(0.0, 0.62, t)) + 20.0 * smoothstep(0.35, 1.0, t)
    return back, LIFT * math.sin(math.pi * t) ** 1.5, pitch


def set_leg(pose, name, side, phase):
    """Hip and knee from where the foot must be."""
    back, height, pitch = step(phase)
    pivot = mirrored(BALL if pitch < 0.0 else HEEL, side)
    rest = mirrored(ANKLE, side)
    turned = about(ACROSS, -pitch)
    ankle = pivot + turned @ (rest - pivot) + Vector((0.0, back, height))
    hip = pose.point("hips", mirrored(HIP, side))
    upper, lower = (KNEE - HIP).length, (ANKLE - KNEE).length
    reach = ankle - hip
    distance = min(reach.length, (upper + lower) * 0.9995)
    along = reach.normalized()
    forward = (FORWARD - along * FORWARD.dot(along)).normalized()
    part = (upper * upper - lower * lower + distance * distance) / (2.0 * distance)
    bend = math.sqrt(max(upper * upper - part * part, 0.0))
    knee = hip + along * part + forward * bend
    pose.aim(f"thigh.{name}", knee - hip)
    pose.aim(f"shin.{name}", ankle - knee)
    down = mirrored(BALL, side) + UP * 0.020 - rest
    pose.aim(f"foot.{name}", turned @ down)
    # Toes stay on the floor while the heel rises.
    ahead = mirrored(TOE, side) - (mirrored(BALL, side) + UP * 0.020)
    grip = 1.0 - smoothstep(STANCE - 0.01, STANCE + 0.10, phase % 1.0)
    toes = about(ACROSS, -pitch if pitch > 0.0 else -pitch * (1.0 - grip))
    pose.aim(f"toes.{name}", toes @ ahead)


def walk(rig):
    """One key a frame; the last is the first again."""
    for frame in range(LAST + 1):
        phase = (frame % LAST) / LAST
        a = 2.0 * math.pi * phase
        pose = common.Pose(rig, frame)
        # Left heel strikes at 0: lowest just after each strike, highest over the standing leg.
        bob = -0.016 - 0.013 * math.cos(2.0 * a - 0.75)
        sway = 0.016 * math.sin(a - 0.15)
        pose.turn("hips", about(UP, 7.0 * math.cos(a)) @ about(FORWARD, 3.0 * math.sin(a)) @ about(ACROSS, 3.0), (sway, 0.0, bob))
        pose.turn("spine", about(UP, -5.0 * math.cos(a)) @ about(FORWARD, -3.0 * math.sin(a)))
        pose.turn("chest", about(UP, -9.0 * math.cos(a)) @ about(FORWARD, -1.5 * math.sin(a)) @ about(ACROSS, 1.5 * math.sin(2.0 * a)))
        pose.turn("neck", about(UP, 4.0 * math.cos(a)))
        pose.turn("head", about(UP, 3.0 * math.cos(a)) @ about(FORWARD, 3.5 * math.sin(a - 0.5)) @ about(ACROSS, -3.0 + 2.5 * math.sin(2.0 * a + 0.6)))
        pose.turn("antenna", about(ACROSS, 13.0 * math.sin(2.0 * a - 0.6)) @ about(FORWARD, 10.0 * math.sin(a - 1.4)))
        for name, side in SIDES:
            swing = math.cos(a) * side
            # The arm goes back when the leg of its side is in front; the elbow bends more in front.
            pose.turn(f"upper_arm.{name}", about(FORWARD, 4.0 * side) @ about(ACROSS, 6.0 + 30.0 * swing))
            pose.turn(f"forearm.{name}", about(ACROSS, -34.0 + 20.0 * math.cos(a - 0.5) * side))
            pose.turn(f"hand.{name}", about(ACROSS, -8.0 + 12.0 * math.cos(a - 1.1) * side))
            set_leg(pose, name, side, phase if side > 0.0 else phase + 0.5)


def main():
    common.empty_scene(FPS, LAST)
    image = walker_paint.picture(os.path.join(common.CONFIGS, "walker.png"))
    parts = common.Parts()
    body(parts)
    for name, side in SIDES:
        arm(parts, name, side)
        leg(parts, name, side)
    materials = [
        common.material("paint", (1.0, 1.0, 1.0), image=image, specular=0.25, shininess=40.0),
        common.material("jumper", walker_paint.TEAL, specular=0.06, shininess=12.0),
        common.material("trousers", (0.330, 0.395, 0.520), specular=0.06, shininess=12.0),
        common.material("rubber", (0.430, 0.440, 0.480), specular=0.30, shininess=30.0),
        common.material("coral", (0.925, 0.430, 0.330), specular=0.30, shininess=40.0),
    ]
    made = parts.build("robot", materials, True)
    rig = skeleton()
    common.bind(made, rig)
    walk(rig)
    common.export("walker.dae", "A small robot that walks on the spot; made by resources/blender/walker.py")


main()
