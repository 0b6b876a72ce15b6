"""Bends a clip's joint about chosen axes, on top of the clip and instead of it. Run as drive.py is, whose hands it uses."""

from drive import Atspi, fail, run, steadily, still, told, value, wait, walk
from drive_hands import click, open_curl


def one(window, name, *roles):
    fits = lambda node: name in (node.get_name(), node.get_description()) and node.get_role_name() in roles
    return wait(f"there is {name}", lambda: steadily(lambda: next(filter(fits, walk(window.root)), None)))


def test_joint():
    window, elbow = open_curl()
    on_top = one(window, "On top of the clip", "check box", "toggle button")
    release = window.get("button", "Release")
    checked = lambda: on_top.get_state_set().contains(Atspi.StateType.CHECKED)
    time = window.get("slider", "Time")
    time.set_current_value(time.get_maximum_value() / 2)
    wait("the clip bends the elbow", lambda: value(elbow) > 20.0)
    by_clip = value(elbow)
    elbow.set_current_value(35.0)
    wait("instead of the clip it has the angle that was asked for", lambda: window.shows("35.0°"))
    was = still(window)
    if checked():
        click(on_top)
    time.set_current_value(0.0)
    wait("whatever the clip does", lambda: abs(value(elbow) - 35.0) < 0.1)
    told("a joint bent instead of the clip stays as it is")

    click(on_top)
    wait("it is told that the clip goes on", checked)
    elbow.set_current_value(20.0)
    wait("on top of the clip the angle is added", lambda: window.shows("+20.0°"))
    at_start = still(window)
    time.set_current_value(time.get_maximum_value() / 2)
    wait("and the clip moves the arm beneath", lambda: still(window) != at_start)
    if still(window) == was:
        fail("on top of the clip looks as instead of it")
    told("a joint bent on top of the clip moves with it")

    click(release)
    wait("a joint that is let go is the clip's", lambda: not window.shows("+20.0°"))
    click(on_top)
    wait("the clip bends it as before", lambda: not checked() and abs(value(elbow) - by_clip) < 0.5)
    told("a joint is let go")

    axis = one(window, "Axis", "combo box")
    pictures = []
    for _ in range(2):
        click(axis)
        run("xdotool", "sleep", 0.3, "key", "Down", "Return")
        slider = lambda: next(node for node in walk(window.root) if node.get_role_name() == "slider" and node.get_name() in ("Elbow angle", "Angle"))
        wait("the slider turns about an axis of the bone", lambda: window.shows("Angle"))
        slider().set_current_value(25.0)
        wait("by the angle asked for", lambda: window.shows("25.0°"))
        pictures.append(still(window))
        click(release)
    if pictures[0] == pictures[1]:
        fail("two axes turn alike")
    told("another axis of the joint is chosen")
    window.process.kill()
    window.process.wait()


test_joint()
print("all is so")
