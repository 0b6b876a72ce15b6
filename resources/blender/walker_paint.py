"""Draws the walker's texture: the jumper's stripes on the left half, the face on the right half."""

import math

import bpy

WIDTH, HEIGHT = 512, 256
TEAL = (0.165, 0.530, 0.545)
CREAM = (0.955, 0.925, 0.855)
DARK = (0.110, 0.130, 0.180)
GLOW = (0.520, 0.930, 0.900)
CORAL = (0.925, 0.430, 0.330)


def jumper(turn, along):
    """Texture coordinate on the jumper."""
    return (0.01 + 0.48 * turn, along)


def head(turn, along):
    """Texture coordinate on the head; the face looks out of the middle of the right half."""
    return (0.51 + 0.48 * turn, along)


def mix(under, over, amount):
    """Lays one colour over another."""
    return tuple(u + (o - u) * amount for u, o in zip(under, over))


def cover(distance, soft=0.006):
    """1 inside a shape, 0 outside, with a soft rim; `distance` is negative inside."""
    return min(1.0, max(0.0, 0.5 - distance / soft))


def rounded_box(x, y, half_width, half_height, radius):
    """Distance to a box with round corners."""
    dx, dy = abs(x) - half_width + radius, abs(y) - half_height + radius
    return math.hypot(max(dx, 0.0), max(dy, 0.0)) + min(max(dx, dy), 0.0) - radius


def jumper_colour(turn, along):
    """Teal with three cream bands that wave a little, a darker hem, and a coral badge on the chest."""
    wave = 0.006 * math.sin(turn * 2.0 * math.pi * 8.0)
    colour = TEAL
    for middle in (0.42, 0.54, 0.66):
        colour = mix(colour, CREAM, cover(abs(along + wave - middle) - 0.026, 0.012))
    return mix(colour, mix(TEAL, DARK, 0.35), cover(along - 0.30, 0.012))


def head_colour(turn, along):
    """A cream shell with a dark visor, two shining eyes, a smile and pink cheeks. x runs to the robot's left, y up."""
    x, y = (turn - 0.5) * 1.9, along - 0.52
    colour = CREAM
    colour = mix(colour, mix(CREAM, DARK, 0.45), cover(abs(abs(turn - 0.5) - 0.41) - 0.004))
    colour = mix(colour, mix(DARK, CREAM, 0.25), cover(rounded_box(x, y, 0.385, 0.225, 0.17)))
    colour = mix(colour, DARK, cover(rounded_box(x, y, 0.365, 0.205, 0.155)))
    for side in (-1.0, 1.0):
        eye = math.hypot((x - 0.165 * side) / 0.055, (y - 0.045) / 0.085) - 1.0
        colour = mix(colour, GLOW, cover(eye * 0.06))
        shine = math.hypot((x - 0.165 * side + 0.018) / 0.018, (y - 0.085) / 0.024) - 1.0
        colour = mix(colour, (1.0, 1.0, 1.0), cover(shine * 0.02))
        cheek = math.hypot((x - 0.255 * side) / 0.050, (y + 0.085) / 0.030) - 1.0
        colour = mix(colour, CORAL, 0.75 * cover(cheek * 0.04, 0.015))
    radius = math.hypot(x, y + 0.005)
    smile = max(abs(radius - 0.100) - 0.013, y + 0.062)
    return mix(colour, GLOW, cover(smile))


def picture(path):
    """Draws the texture, saves it and gives Blender's image of it."""
    image = bpy.data.images.new("walker", WIDTH, HEIGHT, alpha=False)
    pixels = []
    for row in range(HEIGHT):
        for column in range(WIDTH):
            u, v = (column + 0.5) / WIDTH, (row + 0.5) / HEIGHT
            left = u < 0.5
            turn = (u - (0.01 if left else 0.51)) / 0.48
            colour = jumper_colour(turn, v) if left else head_colour(turn, v)
            pixels.extend((*colour, 1.0))
    image.pixels = pixels
    image.filepath_raw = path
    image.file_format = "PNG"
    image.save()
    return image
