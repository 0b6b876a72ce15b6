"""Timeline, cameras, tools, light and looks, driven as a person would; see drive.py, whose hands these are.

usage: views.py PROGRAM FOLDER CONFIGS
"""

import os

from drive import Atspi, CLIP, Window, fail, folder, pressed, run, still, told, value, wait
from hands import at, changes, click, drag, focus_picture


def test_time(window, slider):
    play = window.get("button", "Play")
    box = slider.get_extents(Atspi.CoordType.WINDOW)
    across = lambda part: box.x + round(box.width * part)

    # Scrubbing while it plays goes on playing.
    slider.set_current_value(0.0)
    play.do_action(0)
    wait("it plays", lambda: pressed(play))
    drag(across(0.3), box.y + box.height // 2, across(0.6), box.y + box.height // 2)
    if not pressed(play):
        fail("scrubbing while playing stopped it")
    play.do_action(0)
    wait("it stops", lambda: not pressed(play))
    told("scrubbing while playing goes on playing")

    # Shift and a drag bound what plays.
    drag(across(0.25), box.y + box.height // 2, across(0.75), box.y + box.height // 2, held="shift")
    slider.set_current_value(0.1)
    focus_picture()
    window.key("space")
    wait("playing enters the marked stretch", lambda: value(slider) > 0.4)
    seen = []
    wait("and turns at its end", lambda: seen.append(value(slider)) or (len(seen) > 3 and seen[-1] < seen[-2]))
    if max(seen) > 1.6:
        fail(f"playing left the marks: {max(seen)}")
    window.key("space")
    wait("Space stops", lambda: not pressed(play))
    told("marks from a drag bound what plays")

    # Space plays while a button has the focus.
    click(*at(window.get("button", "To the start")))
    window.key("space")
    wait("Space plays though a button has the focus", lambda: pressed(play))
    window.key("space")
    wait("and stops", lambda: not pressed(play))
    told("Space is not swallowed by a button")

    for name, key in (("One frame forward", None), ("One frame back", None)):
        before = value(slider)
        window.get("button", name).do_action(0)
        wait(name, lambda: abs(value(slider) - before) > 1e-6)
    told("frame buttons step")

    # The boxes seek.
    exact = wait("the time box is there", lambda: window.find("spin button", "Exact time, seconds"))
    exact.set_current_value(1.25)
    wait("the time box seeks", lambda: abs(value(slider) - 1.25) < 1e-6)
    frame = window.find("spin button", "Frame number")
    frame.set_current_value(10)
    wait("the frame box seeks", lambda: abs(value(slider) - 10 / 24) < 0.01 or abs(value(slider) - 10 / 30) < 0.01)
    told("time and frame boxes seek")

    focus_picture()
    window.key("k")
    wait("K unfolds the keys", lambda: window.shows("Keyframes of each bone"))
    row = wait("the node has a row", lambda: next(
        (node for node in walk_rows(window) if node.get_name() == "Node" and at(node)[1] > 600), None))
    x, y = at(row)
    click(x, y)
    wait("a row selects its node", lambda: window.count("Node") >= 2)
    run("xdotool", "mousemove", across(0.5), y, "click", 1)
    wait("a click near a key goes to the key", lambda: abs(value(slider) - 1.0) < 1e-6)
    focus_picture()
    window.key("shift+k")
    wait("Shift+K shows the curves with the value", lambda: window.shows("Z 60.000°"))
    window.key("shift+k")
    wait("and folds them away", lambda: not window.shows("Z 60.000°"))
    told("dope sheet and curves unfold, select and seek")


def walk_rows(window):
    from drive import walk

    return list(walk(window.root))


def test_cameras(window):
    focus_picture()
    for key, what in (("1", "front"), ("3", "right"), ("7", "top"), ("9", "isometric"), ("ctrl+1", "back"), ("ctrl+7", "below")):
        changes(window, f"{key} looks from the {what}", lambda: window.key(key))
    told("keys: 1 3 7 9 and Ctrl")
    window.key("Return")
    still(window)

    # The end of the Y axis in the corner looks from above: it stands 44 pixels from either edge, and its arms are 27 long.
    window.key("1")
    still(window)
    tools = window.get("button", "Navigate: drag moves the camera").get_extents(Atspi.CoordType.WINDOW)
    # Spaces within a thought of the hint are such as do not break.
    is_hint = lambda node: (node.get_name() or "").replace("\u00a0", " ").startswith("Drag to orbit")
    hint = wait("the hint is there", lambda: next(filter(is_hint, walk_rows(window)), None)).get_extents(Atspi.CoordType.WINDOW)
    left, bottom = tools.x - 13, hint.y + hint.height + 12
    changes(window, "a click on the Y axis looks from above", lambda: click(left + 44, bottom - 44 - 27))
    told("the axes in the corner are clicked")
    window.key("f")
    changes(window, "W flies ahead while it is held", lambda: run("xdotool", "keydown", "w"))
    run("xdotool", "keyup", "w")
    changes(window, "a drag in flight looks elsewhere", lambda: drag(600, 300, 640, 310))
    window.key("Escape")
    window.key("Return")
    told("flight: F, W, drag, Esc")

    changes(window, "the wheel zooms", lambda: run("xdotool", "mousemove", 560, 330, "click", 4))
    changes(window, "Ctrl and the wheel zoom to the pointer", lambda: run("xdotool", "keydown", "ctrl", "click", 4, "keyup", "ctrl"))
    changes(window, "Shift and a drag pan", lambda: drag(560, 330, 600, 350, held="shift"))
    changes(window, "Home fits", lambda: window.key("Home"))
    told("wheel, pan, fit")
    window.key("Return")
    still(window)


def test_model(window):
    focus_picture()
    window.key("1")
    still(window)
    window.key("g")
    x_box = wait("the tool has numbers", lambda: window.find("spin button", "X"))
    changes(window, "a drag moves the model", lambda: drag(600, 400, 640, 380))
    wait("and the numbers say so", lambda: abs(value(x_box)) > 0.01)
    changes(window, "Ctrl+Z takes it back", lambda: window.key("ctrl+z"))
    wait("and the numbers say so", lambda: abs(value(x_box)) < 1e-9)
    if not window.find("button", "Redo"):
        fail("there is a button to redo")
    changes(window, "Redo", lambda: window.key("ctrl+shift+z"))
    wait("the model is where it was moved", lambda: abs(value(x_box)) > 0.01)
    window.get("button", "Reset the model").do_action(0)
    wait("reset puts it back", lambda: abs(value(x_box)) < 1e-9)
    changes(window, "a number moves the model", lambda: x_box.set_current_value(0.25))
    window.get("button", "Reset the model").do_action(0)
    window.key("r")
    changes(window, "R and a drag turn the model", lambda: drag(600, 400, 660, 400))
    window.get("button", "Reset the model").do_action(0)
    still(window)
    window.key("s")
    changes(window, "S and a drag scale the model", lambda: drag(600, 400, 600, 360))
    window.get("button", "Reset the model").do_action(0)
    window.key("v")
    told("tools: move, turn, scale, numbers, reset, undo, redo")

    changes(window, "a right drag moves the light", lambda: drag(600, 300, 500, 260, button=3))
    yaw = wait("the light has numbers", lambda: window.find("spin button", "Light azimuth, °"))
    before = value(yaw)
    changes(window, "a number moves the light", lambda: yaw.set_current_value((before + 120.0) % 360.0))
    changes(window, "Shift and a right click put it back", lambda: run(
        "xdotool", "keydown", "shift", "mousemove", 600, 300, "click", 3, "keyup", "shift"))
    told("light: drag, numbers, reset")


def test_looks(window):
    focus_picture()
    for name in ("Inspect", "Print", "Skeleton", "Clean"):
        changes(window, f"the look {name}", lambda: window.get("button", name).do_action(0))
    told("looks: inspect, print, skeleton, clean")
    window.key("9")
    still(window)
    # On a Russian layout the same keys do the same.
    subprocess_layout("us,ru")
    for key in ("Cyrillic_u", "Cyrillic_es"):
        changes(window, f"{key} is the key of its place", lambda: window.key(key))
        changes(window, f"{key} again", lambda: window.key(key))
    told("keys of a Russian keyboard")


def subprocess_layout(layout):
    import subprocess

    subprocess.run(["setxkbmap", layout], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def test_files_cameras():
    """What was chosen is there at the next start."""
    path = os.path.join(folder, "turn.dae")
    window = Window(path)
    window.get("slider", "Time")
    focus_picture()
    window.get("button", "Inspect").do_action(0)
    wait("edges are shown", lambda: pressed(window.get("check box", "Wireframe")))
    window.key("k")
    wait("the keys are unfolded", lambda: window.shows("Keyframes of each bone"))
    window.quit()
    window = Window(path)
    wait("the look is remembered", lambda: pressed(window.get("check box", "Wireframe")))
    if not window.shows("Keyframes of each bone"):
        fail("the unfolded page is remembered")
    window.quit()
    told("looks and pages are remembered")


def sheet(side):
    """A clip whose node `Sheet` carries so many quads that reading it takes a while."""
    points = " ".join(f"{x} {y} 0" for y in range(side + 1) for x in range(side + 1))
    corner = lambda x, y: y * (side + 1) + x
    quads = " ".join(f"{corner(x, y)} {corner(x + 1, y)} {corner(x + 1, y + 1)} {corner(x, y + 1)}" for y in range(side) for x in range(side))
    text = CLIP.replace('name="Node"', f'name="Sheet {side}"').replace('count="12">-1 -1 0 1 -1 0 1 1 0 -1 1 0', f'count="{3 * (side + 1) ** 2}">{points}')
    text = text.replace('count="4" stride="3"', f'count="{(side + 1) ** 2}" stride="3"')
    return text.replace('<triangles count="2">', f'<polylist count="{side * side}">').replace(
        "<p>0 1 2 0 2 3</p></triangles>", f"<vcount>{'4 ' * (side * side)}</vcount><p>{quads}</p></polylist>"
    )


def test_cancel(path):
    """What is open stays until what is read is ready, and for good where reading is given up."""
    with open(path, "w") as file:
        file.write(CLIP)
    window = Window(path)
    slider = window.get("slider", "Time")
    shown = "Node"
    wait("the clip is listed", lambda: window.count(shown) > 0)
    # A quick machine may be ready before Cancel is pressed, and a busy one may let the driver wait longer than the reader: then another one is tried.
    for side in (400, 800, 1600, 1700, 1800, 1900):
        before = window.count(shown)
        with open(path + ".new", "w") as file:
            file.write(sheet(side))
        os.replace(path + ".new", path)
        wait("the changed file is being read", lambda: window.shows("Cancel") or window.count(f"Sheet {side}") > 0)
        button = window.find("button", "Cancel")
        if button:
            old = window.count(shown)
            # It may have become ready in between.
            if old != before and window.shows("Cancel") and window.count(f"Sheet {side}") == 0:
                fail("the old scene is gone while the new one is read")
            button.do_action(0)
        wait("reading ends", lambda: not window.shows("Cancel"))
        if window.count(f"Sheet {side}") == 0:
            break
        shown = f"Sheet {side}"
    else:
        fail("Cancel stops reading")
    if window.count(shown) != before:
        fail("the old scene stays after Cancel")
    with open(path + ".new", "w") as file:
        file.write(CLIP.replace("0 1 2</float_array>", "0 1 3</float_array>"))
    os.replace(path + ".new", path)
    wait("after Cancel a file is read as before", lambda: abs(slider.get_maximum_value() - 3.0) < 1e-6)
    window.quit()
    told("reading shows itself, can be given up, and leaves what is open alone")


def main():
    path = os.path.join(folder, "turn.dae")
    with open(path, "w") as file:
        file.write(CLIP)
    window = Window(path)
    slider = window.get("slider", "Time")
    wait("the clip runs from 0 to 2 s", lambda: abs(slider.get_maximum_value() - 2.0) < 1e-6)
    test_time(window, slider)
    test_cameras(window)
    test_model(window)
    test_looks(window)
    window.quit()
    test_files_cameras()
    test_cancel(os.path.join(folder, "cancel.dae"))
    print("all is so")


main()
