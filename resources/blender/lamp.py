#!/usr/bin/env python3
"""Writes configs/lamp.dae without Blender: a lamp on a cord that is let go, swings, and comes to rest.

    python3 resources/blender/lamp.py

What Blender's exporter never writes is shown here: rotations as channels of their own, BEZIER keys with
tangents, two named clips over one set of keys, centimetres, Y up.
"""

import math
import os

CONFIGS = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "configs"))
CORD = 82.0
HALF_SWING = 0.9


def numbers(values):
    """Numbers as text."""
    return " ".join(f"{round(v, 4) + 0.0:.6g}" for v in values)


def lathe(name, outline, material, segments):
    """A geometry: an outline [(radius, height)] turned about y, with smooth normals."""
    positions, normals = [], []
    for i, (radius, height) in enumerate(outline):
        before, after = outline[max(i - 1, 0)], outline[min(i + 1, len(outline) - 1)]
        dr, dh = after[0] - before[0], after[1] - before[1]
        length = math.hypot(dr, dh)
        for k in range(segments):
            a = 2.0 * math.pi * k / segments
            positions += [radius * math.cos(a), height, radius * math.sin(a)]
            normals += [-dh / length * math.cos(a), dr / length, -dh / length * math.sin(a)]
    triangles = []
    for i in range(len(outline) - 1):
        for k in range(segments):
            n = (k + 1) % segments
            a, b, c, d = i * segments + k, i * segments + n, (i + 1) * segments + n, (i + 1) * segments + k
            triangles += [a, b, c, a, c, d]
    count = len(positions) // 3

    def source(kind, values):
        return f"""
        <source id="{name}-{kind}">
          <float_array id="{name}-{kind}-array" count="{len(values)}">{numbers(values)}</float_array>
          <technique_common>
            <accessor source="#{name}-{kind}-array" count="{count}" stride="3">
              <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>"""

    return f"""
    <geometry id="{name}" name="{name}">
      <mesh>{source("positions", positions)}{source("normals", normals)}
        <vertices id="{name}-vertices">
          <input semantic="POSITION" source="#{name}-positions"/>
          <input semantic="NORMAL" source="#{name}-normals"/>
        </vertices>
        <triangles material="{material}" count="{len(triangles) // 3}">
          <input semantic="VERTEX" source="#{name}-vertices" offset="0"/>
          <p>{" ".join(map(str, triangles))}</p>
        </triangles>
      </mesh>
    </geometry>"""


def material(name, diffuse, emission=(0.0, 0.0, 0.0), specular=0.0, shininess=20.0):
    """A Phong effect and its material."""
    def colour(kind, rgb):
        return f"<{kind}><color>{numbers((*rgb, 1.0))}</color></{kind}>"

    effect = f"""
    <effect id="{name}-effect">
      <profile_COMMON>
        <technique sid="common">
          <phong>
            {colour("emission", emission)}
            {colour("diffuse", diffuse)}
            {colour("specular", (specular,) * 3)}
            <shininess><float>{numbers([shininess])}</float></shininess>
          </phong>
        </technique>
      </profile_COMMON>
    </effect>"""
    return effect, f"""
    <material id="{name}" name="{name}"><instance_effect url="#{name}-effect"/></material>"""


def swings():
    """Keys (time, angle) at the turning points: one full swing that loops, then smaller and smaller ones, then rest."""
    angles = [26.0, -26.0, 26.0]
    while abs(angles[-1]) > 0.8:
        angles.append(-0.74 * angles[-1])
    return [(HALF_SWING * i, angle) for i, angle in enumerate(angles + [0.0])]


def channel(name, target, keys):
    """An animation of BEZIER keys with level tangents: 0.3642 of the way makes the curve a cosine to within 0.1 %."""
    times, values = [k[0] for k in keys], [k[1] for k in keys]
    arrive, leave = [], []
    for i, (time, value) in enumerate(keys):
        before = keys[i - 1][0] if i else time - (keys[1][0] - time)
        after = keys[i + 1][0] if i + 1 < len(keys) else time + (time - before)
        arrive += [time - 0.3642 * (time - before), value]
        leave += [time + 0.3642 * (after - time), value]
    rows = [("input", times, 1, "TIME"), ("output", values, 1, "ANGLE"), ("intangent", arrive, 2, "X"), ("outtangent", leave, 2, "X")]
    text = ""
    for kind, data, stride, param in rows:
        params = f'<param name="{param}" type="float"/>' + ('<param name="Y" type="float"/>' if stride == 2 else "")
        text += f"""
      <source id="{name}-{kind}">
        <float_array id="{name}-{kind}-array" count="{len(data)}">{numbers(data)}</float_array>
        <technique_common><accessor source="#{name}-{kind}-array" count="{len(keys)}" stride="{stride}">{params}</accessor></technique_common>
      </source>"""
    return f"""
    <animation id="{name}">{text}
      <source id="{name}-interpolation">
        <Name_array id="{name}-interpolation-array" count="{len(keys)}">{" ".join(["BEZIER"] * len(keys))}</Name_array>
        <technique_common><accessor source="#{name}-interpolation-array" count="{len(keys)}" stride="1"><param name="INTERPOLATION" type="name"/></accessor></technique_common>
      </source>
      <sampler id="{name}-sampler">
        <input semantic="INPUT" source="#{name}-input"/>
        <input semantic="OUTPUT" source="#{name}-output"/>
        <input semantic="IN_TANGENT" source="#{name}-intangent"/>
        <input semantic="OUT_TANGENT" source="#{name}-outtangent"/>
        <input semantic="INTERPOLATION" source="#{name}-interpolation"/>
      </sampler>
      <channel source="#{name}-sampler" target="{target}"/>
    </animation>"""


def arc(radius, height, low, high, steps):
    """Points of a circle's arc about (0, height), from `low` to `high` degrees above level."""
    angles = [math.radians(low + (high - low) * k / steps) for k in range(steps + 1)]
    return [(max(radius * math.cos(a), 0.01), height + radius * math.sin(a)) for a in angles]


def main():
    # Heights are above the point that the part turns about. Outlines run so that the normals look away from the stuff: up on
    # the outside, down on the inside.
    outside = arc(22.0, -25.0, 2.0, 76.0, 14)
    inside = [(radius * 0.965, height - 0.45) for radius, height in reversed(outside)]
    rim = [(22.0 + 0.55 * math.cos(math.radians(a)), -24.3 + 0.55 * math.sin(math.radians(a))) for a in range(-180, 181, 45)]
    cap = [(5.8, -4.6), (5.7, -3.4), (4.4, -2.2), (2.4, -1.2), (1.7, 0.4), (1.1, 1.5), (0.01, 1.8)]
    bulb = arc(6.2, -20.0, -89.0, 62.0, 14) + [(2.4, -12.0), (2.3, -6.0)]
    shapes = {
        "rose": ([(0.01, 0.0), (8.8, 0.0), (9.2, 0.4), (9.0, 1.6), (7.4, 3.2), (3.6, 4.4), (0.01, 4.8)], "brass", 32),
        "cord": ([(0.5, -CORD), (0.5, -CORD * 0.5), (0.5, 0.5)], "cloth", 10),
        "cap": (cap, "brass", 24),
        "shade": (outside, "enamel", 40),
        "lining": (inside, "white", 40),
        "rim": (rim, "brass", 40),
        "bulb": (bulb, "glow", 24),
    }
    looks = [
        material("brass", (0.80, 0.62, 0.32), specular=0.5, shininess=40.0),
        material("cloth", (0.45, 0.46, 0.50)),
        material("enamel", (0.13, 0.36, 0.38), specular=0.35, shininess=50.0),
        material("white", (0.95, 0.92, 0.84), emission=(0.38, 0.33, 0.22)),
        material("glow", (0.30, 0.28, 0.22), emission=(0.98, 0.88, 0.62)),
    ]
    cord_keys = swings()
    shade_keys = [(time, -0.35 * angle) for time, angle in cord_keys]
    loop, end = numbers([2.0 * HALF_SWING]), numbers([cord_keys[-1][0]])
    geometry = "".join(lathe(name, *shape) for name, shape in shapes.items())

    def drawn(*names):
        return "".join(f"""
          <node id="{name}-surface" name="{name} surface">
            <instance_geometry url="#{name}"><bind_material><technique_common>
              <instance_material symbol="{shapes[name][1]}" target="#{shapes[name][1]}"/>
            </technique_common></bind_material></instance_geometry>
          </node>""" for name in names)

    text = f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <contributor>
      <author>The Sinew authors</author>
      <authoring_tool>resources/blender/lamp.py</authoring_tool>
      <comments>A lamp on a cord that swings and comes to rest</comments>
      <copyright>MIT OR Apache-2.0</copyright>
    </contributor>
    <created>2026-01-01T00:00:00</created>
    <modified>2026-01-01T00:00:00</modified>
    <unit name="centimeter" meter="0.01"/>
    <up_axis>Y_UP</up_axis>
  </asset>
  <library_effects>{"".join(look[0] for look in looks)}
  </library_effects>
  <library_materials>{"".join(look[1] for look in looks)}
  </library_materials>
  <library_geometries>{geometry}
  </library_geometries>
  <library_animations>{channel("cord-swing", "cord-node/swing.ANGLE", cord_keys)}{channel("shade-swing", "shade-node/swing.ANGLE", shade_keys)}
  </library_animations>
  <library_animation_clips>
    <animation_clip id="swing" name="swing" start="0" end="{loop}">
      <instance_animation url="#cord-swing"/>
      <instance_animation url="#shade-swing"/>
    </animation_clip>
    <animation_clip id="settle" name="settle" start="{loop}" end="{end}">
      <instance_animation url="#cord-swing"/>
      <instance_animation url="#shade-swing"/>
    </animation_clip>
  </library_animation_clips>
  <library_visual_scenes>
    <visual_scene id="scene" name="scene">
      <node id="lamp-node" name="lamp">
        <translate sid="location">0 130 0</translate>{drawn("rose")}
        <node id="cord-node" name="cord">
          <rotate sid="swing">0 0 1 26</rotate>{drawn("cord")}
          <node id="shade-node" name="shade">
            <translate sid="location">0 {numbers([-CORD])} 0</translate>
            <rotate sid="swing">0 0 1 -9.1</rotate>{drawn("cap", "shade", "lining", "rim", "bulb")}
          </node>
        </node>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""
    path = os.path.join(CONFIGS, "lamp.dae")
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)
    print("wrote", path, len(text), "bytes")


if __name__ == "__main__":
    main()
