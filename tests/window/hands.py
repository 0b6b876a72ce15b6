"""Hands on the picture: points, clicks, drags, and what they change in it."""

from drive import Atspi, run, still, wait


def at(node, part=0.5, down=0.5):
    """A point of a widget, in the window."""
    box = node.get_extents(Atspi.CoordType.WINDOW)
    return box.x + round(box.width * part), box.y + round(box.height * down)


def click(x, y, button=1):
    run("xdotool", "mousemove", x, y, "click", button)


def drag(x, y, to_x, to_y, button=1, held=None):
    """A drag in three steps, so that it is not taken for a click that trembled."""
    if held:
        run("xdotool", "keydown", held)
    run("xdotool", "mousemove", x, y, "mousedown", button)
    for part in (0.3, 0.7, 1.0):
        run("xdotool", "mousemove", round(x + (to_x - x) * part), round(y + (to_y - y) * part), "sleep", 0.03)
    run("xdotool", "mouseup", button)
    if held:
        run("xdotool", "keyup", held)


def focus_picture():
    """The keyboard goes to the picture; the place holds nothing."""
    click(700, 90)


def changes(window, what, act):
    before = still(window)
    act()
    wait(what, lambda: window.picture() != before)
