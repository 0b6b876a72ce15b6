"""Sets how the skin lies over the muscles of a clip, and lets it no longer follow them, as a person would. Run as drive.py is, whose hands it uses."""

import os
import shutil

from drive import Atspi, Window, configs, fail, folder, pressed, run, still, told, wait
from drive_hands import click, enter, named, page, reveal, text, title


def changes(window, what, before):
    wait(what, lambda: window.picture() != before)
    return still(window)


def test_skin():
    for name in ("curl-muscles.yaml", "curl.dae"):
        shutil.copy(os.path.join(configs, name), folder)
        os.chmod(os.path.join(folder, name), 0o644)
    path = os.path.join(folder, "curl-muscles.yaml")
    window = Window(path)
    page(window, "Muscle")
    window.get("slider", "Elbow angle").set_current_value(70.0)
    fat = lambda: wait("the fat layer has an entry", lambda: named(window, "Fat layer"))[0]
    wait("the usual thickness is shown", lambda: text(fat()) == "3.00")
    usual = still(window)

    enter(fat(), "12")
    wait("a typed thickness is taken", lambda: text(fat()) == "12.00")
    wait("the title marks what is not saved", lambda: title(window).startswith("•"))
    thick = changes(window, "a thicker layer is seen", usual)
    told("a thicker fat layer pushes the skin out")

    enter(fat(), "-1")
    wait("a negative thickness is refused in place", lambda: window.shows("The fat layer and the reach must be") and text(fat()) == "-1")
    enter(fat(), "12")
    told("a thickness that cannot be is refused")

    window.get("button", "Undo").do_action(0)
    wait("Undo brings the thickness back", lambda: text(fat()) == "3.00" and not title(window).startswith("•"))
    if changes(window, "the skin goes back", thick) != usual:
        fail("the skin is what it was")
    window.get("button", "Redo").do_action(0)
    wait("Redo changes it again", lambda: text(fat()) == "12.00")
    run("xdotool", "mousemove", 500, 300, "click", 1)
    window.key("ctrl+s")
    wait("Ctrl+S writes the key", lambda: "skin: {fat: 12" in open(path).read())
    told("the change is undone, made again and saved")

    before = still(window)
    page(window, "Display")
    switch = window.get("check box", "Skin follows muscles")
    wait("the skin follows at first", lambda: pressed(switch))
    reveal(switch)
    click(switch)
    wait("the switch is off", lambda: not pressed(switch))
    changes(window, "the skin no longer follows", before)
    told("the switch lets the skin be bent by the skeleton alone")
    window.quit()


def test_no_skin():
    window = Window(os.path.join(configs, "biceps.yaml"))
    page(window, "Muscle")
    wait("the muscle is shown", lambda: window.shows("Wrap surfaces"))
    if window.shows("Skin over the muscles"):
        fail("a muscle without skin has no fields for it")
    page(window, "Display")
    switch = window.get("check box", "Skin follows muscles")
    if switch.get_state_set().contains(Atspi.StateType.SENSITIVE):
        fail("a switch for skin that is not there cannot be used")
    told("without a skin there is nothing to set")
    window.quit()


test_skin()
test_no_skin()
print("all is so")
