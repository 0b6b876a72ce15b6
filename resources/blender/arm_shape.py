"""The shape of a right arm that hangs at rest, thumb forward: what curl.py covers with skin and atlas.py fills with bones.

Millimetres in the tables, metres out of the functions. x is forward, z up, and the body lies towards +y: the outer side of the arm is -y. The
proportions are those of an adult of about 1.75 m: upper arm 33 cm from the acromion to the elbow, 29 cm round its middle, forearm 26 cm, 27 cm
round where it is thickest, 16 to 17 cm round the wrist.
"""

import bisect
import math

from common import smoothstep
import solids

# The shoulder, from where it was cut off the body to the arm: points on the outline as seen from the front, outer (y, z), inner (y, z), and
# between them the middle (y, z); how far it reaches forward and back from there.
SHOULDER_ROWS = [
    ((52.0, 803.0), (52.5, 668.0), (52.5, 737.0), 53.0, 54.0),
    ((22.0, 798.5), (51.0, 667.5), (37.0, 734.0), 54.5, 55.5),
    ((-10.0, 793.5), (49.5, 667.0), (20.0, 731.0), 55.5, 56.0),
    ((-35.0, 784.0), (48.0, 666.5), (7.0, 726.0), 56.0, 56.5),
    ((-50.0, 768.0), (47.0, 665.5), (-1.0, 718.0), 56.0, 56.5),
    ((-57.5, 745.0), (46.0, 664.0), (-3.0, 706.0), 55.5, 56.0),
    ((-58.5, 720.0), (44.5, 662.0), (-3.5, 692.0), 54.5, 55.5),
    ((-55.8, 692.0), (43.0, 659.0), (-2.5, 677.0), 53.0, 54.0),
]
# The arm: height; how far it reaches forward, back, outward and inward from the line x = y = 0, which runs through the joints.
ARM_ROWS = [
    (654.0, 51.0, 52.0, 50.8, 41.2),
    (625.0, 50.0, 51.0, 46.2, 40.6),
    (595.0, 49.6, 50.0, 42.8, 40.4),
    (565.0, 48.0, 48.0, 41.4, 40.0),
    (535.0, 45.0, 44.5, 40.8, 38.8),
    (508.0, 41.8, 42.3, 41.6, 38.6),
    (485.0, 39.6, 41.4, 43.0, 39.2),
    (465.0, 38.8, 41.4, 44.4, 40.6),
    (448.0, 39.2, 40.0, 45.6, 41.8),
    (428.0, 40.6, 37.6, 46.6, 42.6),
    (404.0, 42.2, 36.4, 46.6, 43.2),
    (376.0, 42.2, 36.6, 44.8, 42.6),
    (346.0, 40.0, 36.4, 40.8, 40.0),
    (312.0, 36.4, 34.8, 35.4, 35.4),
    (278.0, 32.6, 32.2, 30.2, 30.2),
    (246.0, 29.8, 29.8, 26.0, 25.6),
    (216.0, 28.8, 28.6, 23.2, 22.6),
    (192.0, 28.6, 28.2, 21.8, 20.8),
    (170.0, 28.4, 27.0, 18.6, 18.4),
    (148.0, 29.0, 26.0, 15.4, 15.4),
    (120.0, 30.0, 29.0, 12.0, 11.0),
]
# Fingers from the index to the little one: knuckle (x, y, z); degrees that they spread forward; how far each of three bones points towards the
# palm, degrees from straight down; their lengths; radii at the knuckle, the two joints and the tip.
FINGERS = [
    ((30.5, -3.0, 101.0), 4.5, (12.0, 34.0, 46.0), (46.0, 27.0, 19.0), (11.8, 10.1, 8.9, 7.6)),
    ((9.5, -5.0, 97.0), 0.5, (17.0, 43.0, 56.0), (50.0, 31.0, 20.0), (12.0, 10.3, 9.1, 7.8)),
    ((-11.5, -4.0, 100.0), -4.0, (22.0, 50.0, 63.0), (46.0, 29.0, 20.0), (11.6, 9.8, 8.7, 7.5)),
    ((-30.0, -1.0, 107.0), -9.0, (26.0, 54.0, 68.0), (36.0, 22.0, 18.0), (10.8, 8.8, 7.8, 6.8)),
]
# The thumb: where its long bone begins at the wrist, its knuckle, joint and tip, and the radii there.
THUMB = [(18.0, 4.0, 170.0), (40.0, 14.0, 133.0), (55.0, 19.0, 102.0), (63.5, 23.0, 75.0)]
THUMB_RADII = (15.0, 12.6, 10.9, 8.3)
# Where the long bones of the palm begin at the wrist, in the order of the fingers.
ROOTS = [(12.0, 0.0, 156.0), (4.5, -1.5, 155.0), (-4.0, -1.0, 155.5), (-11.5, 1.0, 157.0)]


def rows():
    """All outlines in one form: outer, inner and middle (y, z), forward, back."""
    arm = [((-outer, z), (inner, z), (0.0, z), front, back) for z, front, back, outer, inner in ARM_ROWS]
    return [(*outer, *inner, *middle, front, back) for outer, inner, middle, front, back in SHOULDER_ROWS + arm]


class Outline:
    """A smooth curve through the outlines, by the length along it, in mm."""

    def __init__(self):
        self.rows, self.at = rows(), [0.0]
        for a, b in zip(self.rows, self.rows[1:]):
            # The mean of the way outside and that through the middle.
            self.at.append(self.at[-1] + 0.5 * (math.dist(a[0:2], b[0:2]) + math.dist(a[4:6], b[4:6])))
        self.slopes = [self.slope(i) for i in range(len(self.rows))]

    def slope(self, i):
        """How fast each number changes at row i: the slope of the parabola through it and the rows beside it."""
        low, high = max(i - 1, 0), min(i + 1, len(self.rows) - 1)
        if high - low < 2:
            return [(b - a) / (self.at[high] - self.at[low]) for a, b in zip(self.rows[low], self.rows[high])]
        before, after = self.at[i] - self.at[low], self.at[high] - self.at[i]
        return [((b - a) / before * after + (c - b) / after * before) / (before + after)
                for a, b, c in zip(self.rows[low], self.rows[i], self.rows[high])]

    def row(self, length):
        """The outline there: a cubic of Hermite between the two rows."""
        i = min(max(bisect.bisect_right(self.at, length) - 1, 0), len(self.rows) - 2)
        step = self.at[i + 1] - self.at[i]
        t = (length - self.at[i]) / step
        a, b, c, d = (2 * t - 3) * t * t + 1, ((t - 2) * t + 1) * t * step, (3 - 2 * t) * t * t, (t - 1) * t * t * step
        return [a * p + b * m + c * q + d * n for p, m, q, n in zip(self.rows[i], self.slopes[i], self.rows[i + 1], self.slopes[i + 1])]

    def point(self, row, turn):
        """The point of an outline at an angle: 0 outer, a quarter turn forward, half a turn inner."""
        outer_y, outer_z, inner_y, inner_z, y, z, front, back = row
        across, ahead = math.cos(turn), math.sin(turn)
        side = (outer_y - y, outer_z - z) if across > 0.0 else (y - inner_y, z - inner_z)
        dx, dy, dz = (front if ahead > 0.0 else back) * ahead, side[0] * across, side[1] * across
        more = 1.0 + relief(turn, z + dz) / math.sqrt(dx * dx + dy * dy + dz * dz)
        return (0.001 * dx * more, 0.001 * (y + dy * more), 0.001 * (z + dz * more))


def bump(turn, degrees, width, z, low, high, soft):
    """1 along a strip of the skin at so many degrees, `width` from its middle to where it ends, from `low` to `high`; soft ends."""
    off = abs((math.degrees(turn) - degrees + 180.0) % 360.0 - 180.0)
    if off >= width:
        return 0.0
    return 0.5 * (1.0 + math.cos(math.pi * off / width)) * smoothstep(low, low + soft, z) * (1.0 - smoothstep(high - soft, high, z))


def relief(turn, z):
    """How far muscles and hollows at rest lift or sink the skin, mm."""
    # The deltoid: a V whose point lies on the outer side, 45 % down the upper arm; soft edges.
    half = 100.0 * smoothstep(590.0, 725.0, z) ** 0.8
    off = abs((math.degrees(turn) + 180.0) % 360.0 - 180.0)
    made = 3.4 * smoothstep(588.0, 665.0, z) * (1.0 - smoothstep(half - 14.0, half + 22.0, off))
    # The furrows between biceps and triceps, outer and inner.
    made -= 1.6 * bump(turn, -8.0, 34.0, z, 470.0, 632.0, 50.0)
    made -= 1.6 * bump(turn, 178.0, 34.0, z, 480.0, 668.0, 60.0)
    # Biceps in front; the outer and the long head of the triceps behind.
    made += 1.6 * bump(turn, 92.0, 58.0, z, 490.0, 660.0, 70.0)
    made += 1.8 * bump(turn, -52.0, 46.0, z, 545.0, 665.0, 50.0)
    made += 1.6 * bump(turn, -132.0, 46.0, z, 525.0, 655.0, 50.0)
    # The muscle that runs from above the elbow to the thumb's side of the forearm, and the ones on the inner side.
    made += 3.0 * bump(turn, 46.0, 56.0, z, 315.0, 500.0, 75.0)
    made += 2.2 * bump(turn, 150.0, 56.0, z, 300.0, 452.0, 70.0)
    # The hollow of the elbow between them; the edge of the ulna behind.
    made -= 2.6 * bump(turn, 97.0, 40.0, z, 395.0, 485.0, 36.0)
    made -= 1.2 * bump(turn, -62.0, 30.0, z, 300.0, 430.0, 50.0)
    # The point of the elbow, with hollows on both sides; the inner knob above it.
    made += 3.0 * bump(turn, -98.0, 48.0, z, 430.0, 500.0, 34.0)
    made -= 1.8 * bump(turn, -42.0, 34.0, z, 430.0, 500.0, 30.0)
    made -= 1.8 * bump(turn, -146.0, 30.0, z, 430.0, 500.0, 30.0)
    made += 2.4 * bump(turn, 188.0, 36.0, z, 440.0, 484.0, 20.0)
    return made


def forearm(outline):
    """The end of the forearm as a solid, for the hand to grow out of."""
    first = len(SHOULDER_ROWS)

    def distance(x, y, z):
        height = 1000.0 * z
        for i in range(first, len(outline.rows) - 1):
            if outline.rows[i + 1][1] <= height:
                break
        a, b = outline.at[i], outline.at[i + 1]
        length = a + (b - a) * (outline.rows[i][1] - height) / (outline.rows[i][1] - outline.rows[i + 1][1])
        row = outline.row(min(length, outline.at[-1]))
        turn = math.atan2(1000.0 * x / (row[6] if x > 0.0 else row[7]), 1000.0 * y / (row[0] if y < 0.0 else -row[2]))
        px, py, _ = outline.point(row, turn)
        wide = math.hypot(x, y) - math.hypot(px, py)
        return max(wide, 0.001 * (outline.rows[-1][1] - height))

    return distance


def digit(finger):
    """The joints of a finger, from the knuckle to the tip, in mm."""
    knuckle, spread, bends, lengths, _ = finger
    points, lean = [knuckle], math.tan(math.radians(spread))
    for bend, length in zip(bends, lengths):
        x, y, z = points[-1]
        a = math.radians(bend)
        points.append((x + length * lean * math.cos(a), y + length * math.sin(a), z - length * math.cos(a)))
    return points


def hand():
    """The hand with the end of the forearm, a solid."""
    outline = Outline()
    metres = solids.scaled
    palm = []
    for (base, _, _, _, radii), root in zip(FINGERS, ROOTS):
        x, y, z = root
        palm += solids.chain(metres([(1.25 * x, y, z + 12.0), (base[0], base[1] + 2.5, base[2] - 2.0)]), [0.0125, 0.001 * radii[0] + 0.0008])
    # The ball of the thumb and that of the little finger.
    palm += solids.chain(metres([(10.0, 8.0, 168.0), (33.0, 14.5, 138.0)]), [0.0125, 0.0125])
    palm += solids.chain(metres([(-16.0, 7.0, 166.0), (-27.0, 8.0, 122.0)]), [0.0128, 0.0112])
    palm = solids.blend([solids.blend(palm, 0.009), forearm(outline)], 0.026)
    fingers = []
    for finger in FINGERS:
        fingers.append(solids.blend(solids.chain(metres(digit(finger)), [0.001 * r for r in finger[4]]), 0.003))
    thumb = solids.blend(solids.chain(metres(THUMB), [0.001 * r for r in THUMB_RADII]), 0.004)
    # Fingers melt into the palm, and hardly into each other.
    whole = solids.blend([palm, thumb], 0.014)
    return solids.blend([whole] + fingers, 0.010)
