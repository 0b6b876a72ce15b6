"""Gives a muscle via points and a ball to go round as a person would, saves it and opens it again. Run as drive.py is, whose hands it uses."""

import os
import shutil

from drive import Atspi, Window, configs, fail, folder, run, steadily, still, told, wait, walk
from drive_hands import click, enter, muscle_page, reveal, text, title
from hands import click as click_at, drag


def button(window, name):
    fits = lambda node: node.get_name() == name and node.get_role_name().endswith("button")
    return wait(f"there is a button {name}", lambda: next(filter(fits, walk(window.root)), None))


def press(window, name):
    node = button(window, name)
    reveal(node)
    click(node)


def shown(window, name):
    """The entries of this name that are seen: neither they nor what they stand in is hidden."""

    def within(node):
        if not node.get_state_set().contains(Atspi.StateType.VISIBLE):
            return
        if node.get_name() == name and node.get_role_name() in ("text", "entry"):
            yield node
        for index in range(node.get_child_count()):
            yield from within(node.get_child_at_index(index))

    def anywhere():
        window.root.clear_cache()
        tops = [window.root.get_child_at_index(index) for index in range(window.root.get_child_count())]
        return [node for top in tops for node in within(top)]

    return steadily(anywhere)


def offset(number, axis):
    return f"Via point {number}: offset along the bone’s {axis} axis"


def click_along(window, y, hint):
    """Clicks from left to right at this height until what was asked for is there and the hint goes: where the last click was."""
    for x in range(440, 660, 6):
        click_at(x, y)
        if not window.shows(hint):
            break
    return x


def test_way():
    path = os.path.join(folder, "way.yaml")
    shutil.copy(os.path.join(configs, "example.yaml"), path)
    os.chmod(path, 0o644)
    window = Window(path)
    muscle_page(window)
    before = still(window)
    press(window, "Add via point")
    first = lambda axis: wait("there is a first via point", lambda: shown(window, offset(1, axis)))[0]
    was = wait("a via point stands on the muscle", lambda: text(first("X")))
    told("a via point is added half-way")
    enter(first("X"), "45")
    wait("its offset is taken", lambda: text(first("X")) == "45.00")
    wait("the muscle follows it in the picture", lambda: window.picture() != before)
    enter(first("Y"), "far")
    wait("what is no number is refused in place", lambda: window.shows("An offset must be three numbers"))
    enter(first("Y"), "-160")
    wait("the refusal goes", lambda: text(first("Y")) == "−160.00" and not window.shows("An offset must be three numbers"))
    told("an offset is typed, and refused where it is none")

    press(window, "Add via point")
    second = lambda axis: wait("there is a second via point", lambda: shown(window, offset(2, axis)))[0]
    wait("the second has an offset", lambda: text(second("Y")))
    one, two = text(first("Y")), text(second("Y"))
    if one == two:
        fail("a second via point stands elsewhere")
    name = "Move via point 2 up, towards the origin"
    press(window, name)
    wait("the points change places", lambda: (text(first("Y")), text(second("Y"))) == (two, one))
    # The keyboard goes with the point: to the arrow of the first row that can be pressed.
    window.key("Return")
    wait("the keyboard goes with the point that moved", lambda: (text(first("Y")), text(second("Y"))) == (one, two))
    window.key("Return")
    wait("and back again", lambda: (text(first("Y")), text(second("Y"))) == (two, one))
    undo = lambda: window.get("button", "Undo").do_action(0)
    redo = lambda: window.get("button", "Redo").do_action(0)
    for _ in range(3):
        undo()
    wait("Undo puts them back", lambda: (text(first("Y")), text(second("Y"))) == (one, two))
    press(window, "Delete via point 1" if one != "−160.00" else "Delete via point 2")
    wait("a point is deleted", lambda: not shown(window, offset(2, "Y")) and text(first("Y")) == "−160.00")
    undo()
    wait("Undo brings it back", lambda: shown(window, offset(2, "Y")))
    redo()
    wait("Redo deletes it again", lambda: not shown(window, offset(2, "Y")))
    told("via points are ordered, deleted, undone and redone")

    enter(shown(window, "Radius of the wrap sphere")[0], "0")
    wait("a ball without a radius is refused in place", lambda: window.shows("needs a radius above 0"))
    enter(shown(window, "Radius of the wrap sphere")[0], "21.5")
    radius = lambda: text(shown(window, "Radius of the wrap sphere")[0])
    wait("a radius is taken", lambda: radius() == "21.50" and not window.shows("needs a radius above 0"))
    side = lambda: text(shown(window, "Side on which the muscle passes: component along the bone’s X axis")[0])
    wait("the side is shown", lambda: side() == "1.000")
    press(window, "Flip wrap side")
    wait("the muscle passes on the other side", lambda: side() in ("−1.000", "-1.000"))
    undo()
    wait("Undo turns it back", lambda: side() == "1.000")
    told("the ball is made larger and passed on its other side")

    # The keyboard goes to the picture first: Ctrl+S is the window's, wherever it is.
    run("xdotool", "mousemove", 500, 300, "click", 1)
    window.key("ctrl+s")
    wait("it is saved", lambda: "radius: 21.5" in open(path).read() and not title(window).startswith("•"))
    saved = open(path).read()
    for line in open(os.path.join(configs, "example.yaml")).read().splitlines():
        if "#" in line and "wrap:" not in line and line.split("#")[1] not in saved:
            fail(f"the comment in “{line}” stays")
    if "via: [{bone: \"upper arm\", offset: [45.0, -160.0" not in saved:
        fail(f"the via point is in the file: {saved}")
    told("saving keeps the comments")
    window.quit()

    window = Window(path)
    muscle_page(window)
    wait("the via point is read again", lambda: (text(first("X")), text(first("Y"))) == ("45.00", "−160.00"))
    wait("the ball is read again", lambda: radius() == "21.50")
    pick = "Pick the position of a new via point"
    press(window, pick)
    wait("a hint says what to click", lambda: window.shows("Click the position of the via point on a bone"))
    window.key("Escape")
    wait("Esc leaves picking", lambda: not window.shows("Click the position of the via point on a bone"))
    told("what was saved is read again, and a picking left")

    press(window, "Delete via point 1")
    wait("the last via point goes", lambda: not shown(window, offset(1, "X")))
    window.key("Return")
    wait("the keyboard is on the button that adds one", lambda: shown(window, offset(1, "X")))
    press(window, "Delete via point 1")
    wait("it goes again", lambda: not shown(window, offset(1, "X")))
    press(window, pick)
    wait("picking begins anew", lambda: window.shows("Click the position of the via point on a bone"))
    # Beside the arm a click changes nothing, so it is looked for from left to right, half-way up its upper rod.
    x = click_along(window, 250, "Click the position of the via point on a bone")
    picked = float(wait("a click on the arm puts a via point there", lambda: text(first("X"))).replace("−", "-"))
    drag(x, 250, x + 60, 250)
    wait("its dot is dragged in the picture", lambda: float(text(first("X")).replace("−", "-")) > picked + 10.0)
    undo()
    wait("the drag is one step", lambda: float(text(first("X")).replace("−", "-")) == picked)
    told("a via point is picked and dragged in the picture")

    joint = "Pick the bone at whose joint the wrap sphere is put"
    press(window, "Flip wrap side")
    press(window, joint)
    wait("a hint says what the click is for", lambda: window.shows("Click the bone whose joint the muscle wraps around"))
    click_along(window, 330, "Click the bone whose joint the muscle wraps around")
    wait("a click on a bone is taken", lambda: not window.shows("Click the bone whose joint the muscle wraps around"))
    if radius() != "21.50" or "1.000" not in side() or side() == "1.000":
        fail("the ball keeps its radius and its side")
    told("the joint to go round is picked")
    window.process.kill()
    window.process.wait()


test_way()
print("all is so")
