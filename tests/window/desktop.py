"""Drives what a desktop expects: files of a folder, the file dialog, files that are dropped, clips, frame rates, cameras of a file. Run as drive.py is."""

import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
from drive import CLIP, Atspi, Window, called, configs, fail, left_out, pressed, run, settled, still, told, value, wait, write  # noqa: E402,F401

CAMERA = """<library_cameras><camera id="lens" name="Lens"><optics><technique_common><perspective><xfov>40</xfov><aspect_ratio>1.5</aspect_ratio>
  <znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera></library_cameras>"""
EYE = """<node id="Eye" name="Eye"><matrix>0.8 -0.6 0 0 0.6 0.8 0 0 0 0 1 6 0 0 0 1</matrix><instance_camera url="#lens"/></node>"""


def title(window):
    return run("xdotool", "getwindowname", window.window).decode().strip()


def press(node):
    box = node.get_extents(Atspi.CoordType.WINDOW)
    run("xdotool", "mousemove", box.x + box.width // 2, box.y + box.height // 2, "click", 1)


def test_folder():
    """Three files side by side; the middle one is opened."""
    paths = [write(f"{name}.dae", CLIP.replace('name="Node"', f'name="Node {name}"')) for name in ("one", "three", "two")]
    window = Window(paths[1])
    wait("the file is open", lambda: "three.dae" in title(window))
    run("xdotool", "mousemove", 700, 90, "click", 1)
    window.key("ctrl+Next")
    wait("Ctrl+PgDn opens the next file of the folder", lambda: "two.dae" in title(window))
    window.key("ctrl+Prior")
    wait("Ctrl+PgUp goes back", lambda: "three.dae" in title(window))
    window.key("ctrl+Prior")
    wait("and on to the first", lambda: "one.dae" in title(window))
    told("Ctrl+PgUp and Ctrl+PgDn step through the folder")

    window.key("ctrl+o")
    wait("Ctrl+O shows the dialog", lambda: window.find("button", "Open") and window.shows("Animation clips and muscles"))
    dialog = wait("it is a window", lambda: run("xdotool", "search", "--name", "Open files").split()[0].decode())
    run("xdotool", "windowfocus", dialog)
    settled(dialog)
    run("xdotool", "type", "--delay", "30", "--window", dialog, paths[2])
    # What the entry proposes beyond what was typed goes.
    run("xdotool", "key", "shift+End", "Delete", "Return")
    wait("a path that is typed opens", lambda: "two.dae" in title(window))
    told("the file dialog opens a file whose path is typed")
    run("xdotool", "windowfocus", window.window)
    window.quit()


def test_drop():
    source_program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "drag_source.py")
    try:
        import gi

        gi.require_version("Gtk", "4.0")
    except ValueError:
        left_out("no files are dropped, because gir1.2-gtk-4.0 is missing")
        return
    config = lambda name: os.path.join(configs, name)
    for open_now, dropped in (((), ("curl.dae", "biceps.yaml")), (("curl.dae",), ("biceps.yaml",))):
        drop(source_program, list(map(config, open_now)), list(map(config, dropped)))
    told("a clip and a muscle that are dropped together, or one on the other, become one, and the place is marked meanwhile")


def drop(source_program, open_now, dropped):
    window = Window(*open_now)
    if not open_now:
        window.get("slider", "Contraction")
    run("xdotool", "windowsize", window.window, 1100, 760)
    source = subprocess.Popen(["/usr/bin/python3", source_program, *dropped], stdout=subprocess.PIPE, text=True)
    if source.stdout.readline().strip() != "READY":
        fail("the window to drag from is shown")
    other = wait("it is found", lambda: run("xdotool", "search", "--onlyvisible", "--name", "drag source").split()[0].decode())
    run("xdotool", "windowmove", other, 1150, 300)
    run("xdotool", "mousemove", 1230, 370, "mousedown", 1)
    for x in (1220, 1200, 1100, 900, 700, 600, 595, 590):
        run("xdotool", "mousemove", x, 370, "sleep", 0.08)
    wait("the place where files can be dropped is marked", lambda: window.shows("Drop to open"))
    run("xdotool", "mouseup", 1)
    wait("both files are open", lambda: "curl.dae" in title(window) and "biceps.yaml" in title(window))
    wait("it is said where the muscle went", lambda: window.shows("The muscle is attached to “forearm”. Undo returns it to its arm."))
    press(window.get("button", "Undo"))
    attach = lambda: next((node for node in walk(window) if node.get_name() == "Attach to “forearm” of the clip"), None)
    wait("Undo puts it back on its arm, and a button offers the bones again", lambda: window.shows("Attach to “forearm” of the clip"))
    press(wait("the button is there", attach))
    wait("pressed it hangs there again", lambda: title(window).startswith("•") and not window.shows("Attach to “forearm” of the clip"))
    press(window.get("button", "Undo"))
    wait("nothing is left to be saved", lambda: not title(window).startswith("•"))
    source.terminate()
    source.wait(10)
    run("xdotool", "windowfocus", window.window)
    window.quit()


def test_camera_and_time():
    path = write("filmed.dae", CLIP.replace("<library_animations>", CAMERA + "<library_animations>").replace("</visual_scene>", EYE + "</visual_scene>"))
    window = Window(path)
    slider = window.get("slider", "Time")
    rates = wait("there is a choice of frame rates", lambda: next((node for node in walk(window) if "Frames per second used for frame numbers" in (node.get_name(), node.get_description())), None))
    if rates is None:
        fail("the frame rate can be chosen")
    run("xdotool", "mousemove", 700, 90, "click", 1)
    window.key("1")
    front = still(window)
    press(window.get("button", "Camera"))
    wait("the camera of the file is in the menu", lambda: any("menu" in node.get_role_name() and called(node) == "Eye" for node in walk(window)))
    # It is the last one; a place in a popover cannot be asked for through the accessibility tree of GTK 4.8.
    window.key("Up", "Return")
    wait("the menu closes and its view is shown", lambda: not window.shows("Start view") and window.picture() != front)
    rolled = still(window)
    run("xdotool", "mousemove", 640, 380, "mousedown", 1, "mousemove", 660, 380, "mousemove", 700, 380, "mouseup", 1)
    wait("a drag goes back to the turntable", lambda: window.picture() != rolled)
    run("xdotool", "mousemove", 700, 90)
    window.key("Return", "1")
    wait("which is level", lambda: window.picture() == front)
    slider.set_current_value(0.5)
    told("a camera of the file is chosen and gives its own view; the turntable stays level")
    window.quit()


def walk(window):
    from drive import walk as nodes

    return list(nodes(window.root))


if __name__ == "__main__":
    test_folder()
    test_drop()
    test_camera_and_time()
    print("all is so")
