"""Gives a muscle via points and surfaces to go round as a person would, saves it and opens it again. Run as drive.py is, whose hands it uses."""

import os
import shutil

from drive import Atspi, Window, configs, fail, folder, run, steadily, still, told, wait, walk, write
from drive_hands import click, enter, muscle_page, page, reveal, text, title
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


def checked(node):
    return node.get_state_set().contains(Atspi.StateType.CHECKED)


def check(window, name, label):
    """A check button: newer GTK calls it by its label, and these are asked for in the order of the page."""
    fits = lambda node: node.get_role_name() == "check box" and node.get_name() in (name, label)
    return wait(f"there is a check button {name}", lambda: next(filter(fits, walk(window.root)), None))


def choose(window, name, row):
    """Takes a row of a list that unfolds."""
    unfold(window.get("combo box", name), name, row)


def unfold(node, name, row):
    reveal(node)
    click(node)
    focused = lambda item: item.get_role_name() == "list item" and item.get_state_set().contains(Atspi.StateType.FOCUSED)
    wait(f"the list {name} unfolds", lambda: any(map(focused, walk(node))))
    run("xdotool", "key", "Home", *["Down"] * row, "Return")


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

    sphere = "Radius of wrap surface 1"
    enter(shown(window, sphere)[0], "0")
    wait("a sphere without a radius is refused in place", lambda: window.shows("A wrap surface needs sizes above 0"))
    enter(shown(window, sphere)[0], "21.5")
    radius = lambda: text(shown(window, sphere)[0])
    wait("a radius is taken", lambda: radius() == "21.50" and not window.shows("A wrap surface needs sizes above 0"))
    side = lambda: text(shown(window, "Side on which the muscle passes wrap surface 1: component along the X axis")[0])
    wait("the side is shown", lambda: side() == "1.000")
    flip = "Flip the side of wrap surface 1"
    press(window, flip)
    wait("the muscle passes on the other side", lambda: side() in ("−1.000", "-1.000"))
    undo()
    wait("Undo turns it back", lambda: side() == "1.000")
    told("the sphere is made larger and passed on its other side")

    long = "Length of wrap surface 1 along its axis"
    before = still(window)
    choose(window, "Shape of wrap surface 1", 1)
    wait("a cylinder has a length", lambda: shown(window, long) and radius() == "21.50")
    wait("its outline is another", lambda: window.picture() != before)
    undo()
    wait("Undo makes it a sphere", lambda: not shown(window, long))
    redo()
    wait("Redo makes it a cylinder", lambda: shown(window, long))
    enter(shown(window, long)[0], "64")
    wait("a length is taken", lambda: text(shown(window, long)[0]) == "64.00")
    told("a cylinder is made of the sphere")

    one_side = check(window, "The muscle passes wrap surface 1 on one side; otherwise on the shorter way", "Side")
    reveal(one_side)
    click(one_side)
    wait("a surface without a side has none to flip", lambda: not checked(one_side) and not shown(window, "Side on which the muscle passes wrap surface 1: component along the X axis"))
    undo()
    wait("Undo holds the muscle on its side", lambda: checked(one_side) and side() == "1.000")
    told("a side is let go and held")

    second_radius = lambda: shown(window, "Radius of wrap surface 2")
    press(window, "Add wrap surface")
    wait("there is a second surface", second_radius)
    press(window, "Delete wrap surface 2")
    wait("it is deleted", lambda: not second_radius())
    window.key("Return")
    wait("the keyboard is on the button that adds one", second_radius)
    undo()
    wait("Undo takes that back", lambda: not second_radius())
    undo()
    wait("Undo brings the deleted one back", second_radius)
    redo()
    wait("Redo deletes it again", lambda: not second_radius())
    told("a second surface is added, deleted and brought back")

    choose(window, "Part of the path on which wrap surface 1 acts", 2)
    ends = [f"Point of the path {which} which wrap surface 1 acts" for which in ("from", "up to")]
    said = lambda name: next(text(node) or node.get_name() for node in walk(window.get("combo box", name)) if node.get_role_name() == "label" and node.get_name() not in ("", "(None)"))
    wait("it acts from the origin to the insertion", lambda: list(map(said, ends)) == ["Origin", "Insertion"])
    choose(window, ends[1], 0)
    wait("or to the via point", lambda: list(map(said, ends)) == ["Origin", "Point 1"])
    choose(window, ends[0], 1)
    wait("the other end gives way", lambda: list(map(said, ends)) == ["Point 1", "Insertion"])
    told("a surface acts on a part of the path")

    ranged = check(window, "Via point 1 is passed only while a joint’s angle lies in a range", "Only at angles")
    least, greatest = (f"{which} angle at which via point 1 is passed, degrees" for which in ("Least", "Greatest"))
    before = still(window)
    reveal(ranged)
    click(ranged)
    wait("at first the range is that of the joint", lambda: (text(shown(window, least)[0]), text(shown(window, greatest)[0])) == ("0.0", "135.0"))
    enter(shown(window, least)[0], "170")
    wait("a range that ends before it begins is refused", lambda: window.shows("The range of a via point needs"))
    enter(shown(window, least)[0], "25")
    wait("an angle is taken", lambda: text(shown(window, least)[0]) == "25.0" and not window.shows("The range of a via point needs"))
    wait("the straight arm's muscle does not pass the point", lambda: window.picture() != before)
    undo()
    wait("Undo gives the range back", lambda: text(shown(window, least)[0]) == "0.0")
    undo()
    wait("Undo takes the range away", lambda: not checked(ranged) and not shown(window, least))
    redo()
    redo()
    wait("Redo brings it back", lambda: checked(ranged) and text(shown(window, least)[0]) == "25.0")
    told("a via point is passed in a range of angles alone")

    page(window, "Display")
    before = still(window)
    lines = check(window, "Lines of action", "Lines of action")
    click(lines)
    wait("lines of action are drawn", lambda: checked(lines) and window.picture() != before)
    page(window, "Muscle")
    told("lines of action are switched on")

    # The keyboard goes to the picture first: Ctrl+S is the window's, wherever it is.
    run("xdotool", "mousemove", 500, 300, "click", 1)
    window.key("ctrl+s")
    wait("it is saved", lambda: "radius: 21.5" in open(path).read() and not title(window).startswith("•"))
    saved = open(path).read()
    for line in open(os.path.join(configs, "example.yaml")).read().splitlines():
        if "#" in line and "wrap:" not in line and line.split("#")[1] not in saved:
            fail(f"the comment in “{line}” stays")
    for part in ("offset: [45.0, -160.0", "active: {joint: elbow, range: [25.0, 135.0]}", "shape: cylinder, radius: 21.5, length: 64.0"):
        if part not in saved.replace('"', ""):
            fail(f"“{part}” is in the file: {saved}")
    told("saving keeps the comments")
    window.quit()

    window = Window(path)
    muscle_page(window)
    wait("the via point is read again", lambda: (text(first("X")), text(first("Y"))) == ("45.00", "−160.00"))
    wait("the cylinder is read again", lambda: radius() == "21.50" and text(shown(window, long)[0]) == "64.00")
    wait("the range is read again", lambda: text(shown(window, least)[0]) == "25.0")
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

    joint = "Pick the bone at whose joint wrap surface 1 is put"
    press(window, flip)
    press(window, joint)
    wait("a hint says what the click is for", lambda: window.shows("Click the bone whose joint the muscle wraps around"))
    click_along(window, 330, "Click the bone whose joint the muscle wraps around")
    wait("a click on a bone is taken", lambda: not window.shows("Click the bone whose joint the muscle wraps around"))
    if radius() != "21.50" or "1.000" not in side() or side() == "1.000":
        fail("the surface keeps its radius and its side")
    told("the joint to go round is picked")
    window.process.kill()
    window.process.wait()


TWO_JOINTS = """unit: mm
clip: curl.dae
joints:
  - {name: elbow, bone: forearm, axis: [0, 0, -1], range: [0, 140]}
  - {name: shoulder, bone: upper_arm, axis: [0, 0, -1], range: [-30, 90]}
muscles:
  - name: Biceps
    length: 265.0
    radii: [4.0, 13.0, 18.0, 17.5, 11.0, 3.5]
    growth: [0.0, 1.0, 1.9, 1.9, 1.0, 0.0]
    origin: {bone: upper_arm, offset: [26.0, 10.0, 0.0]}
    insertion: {bone: forearm, offset: [10.0, 45.0, 0.0]}
    via:
      - {bone: upper_arm, offset: [36.0, 150.0, 0.0], active: {joint: elbow, range: [20, 90]}}
      - {bone: forearm, moves: {joint: elbow, angles: [0, 90], offsets: [[22, 20, 0], [26, 24, 0]]}}
"""


def test_joints():
    shutil.copy(os.path.join(configs, "curl.dae"), os.path.join(folder, "curl.dae"))
    window = Window(write("joints.yaml", TWO_JOINTS))
    muscle_page(window)
    least = lambda: text(shown(window, "Least angle at which via point 1 is passed, degrees")[0])
    wait("the range of the file is shown", lambda: least() == "20.0")
    wait("a point that moves says so", lambda: window.shows("Moves with the joint elbow"))
    choose(window, "Joint whose angle decides whether via point 1 is passed", 1)
    wait("another joint has a range of its own", lambda: least() == "−30.0")
    window.get("button", "Undo").do_action(0)
    wait("Undo gives it back to the elbow", lambda: least() == "20.0")
    told("a via point depends on any joint of the file")

    page(window, "Measure")
    wait("it is measured over the elbow", lambda: window.shows("Click or drag in a plot to bend the joint elbow."))
    # The Muscle page has a list of joints too, and comes first.
    of_joints = lambda node: node.get_role_name() == "combo box" and "Joint" in (node.get_name(), node.get_description())
    unfold(steadily(lambda: list(filter(of_joints, walk(window.root)))[-1]), "Joint", 1)
    wait("and over the shoulder", lambda: window.shows("Click or drag in a plot to bend the joint shoulder."))
    told("a muscle is measured over another joint")
    window.process.kill()
    window.process.wait()


test_way()
test_joints()
print("all is so")
