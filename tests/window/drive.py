"""Drives the window as a person would: through the accessibility tree, the mouse and the keyboard. Waits for states, never for times.

usage: drive.py PROGRAM FOLDER CONFIGS    (inside a D-Bus session with a display; FOLDER is empty and writable)
Prints what was proven, line by line; ends with 1 at the first thing that is not so.
"""

import ctypes
import os
import subprocess
import sys
import time

import gi

gi.require_version("Atspi", "2.0")
from gi.repository import Atspi, GLib  # noqa: E402

PATIENCE = float(os.environ.get("SINEW_TEST_PATIENCE", "30"))
program, folder, configs = sys.argv[1:4]
Atspi.init()
# On a busy machine a window that has just read a large file may not answer within the usual 0.8 seconds.
Atspi.set_timeout(10_000, 30_000)
Atspi.get_desktop(0).get_child_count()  # the accessibility bus is up before the program looks for it


def fail(text):
    print("NOT SO:", text, flush=True)
    if "SINEW_TEST_SHOT" in os.environ:
        subprocess.run(["import", "-window", "root", os.environ["SINEW_TEST_SHOT"]], check=False)
    sys.exit(1)


def wait(what, state):
    """Waits until `state()` is true (or a value that is) and returns it."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            value = state()
        except Exception:  # what is looked at may go away meanwhile, or be there later
            value = None
        if value:
            return value
        time.sleep(0.03)
    fail(what)


def steadily(look):
    """What `look()` sees in the tree, looking again where something that it walked over went away meanwhile."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            return look()
        except GLib.Error:
            if time.monotonic() > end:
                raise
            time.sleep(0.03)


def left_out(text):
    """Says that something is not tested; where nobody would read it, that is a failure."""
    if os.environ.get("CI"):
        fail(f"not tested: {text}")
    print("SKIPPED:", text, flush=True)


# What a library says of the machine that a test runs on, not of what the program does.
OF_THE_MACHINE = "dconf", "portal", "Unknown key gtk-modules", "session bus", "accessibility bus", "Locale not supported"


def complaints(lines):
    """What GTK, GLib or the program itself complains of in these lines: warnings too."""
    words = "CRITICAL", "WARNING", "panicked", "ERROR"
    return [line for line in lines if any(word in line for word in words) and not any(known in line for known in OF_THE_MACHINE)]


def told(text):
    print("ok:", text, flush=True)


def write(name, text):
    """A file of this name and text in the folder of the test; its path."""
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def run(*command):
    return subprocess.run([str(part) for part in command], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


def walk(node, depth=0):
    if node is None or depth > 40:
        return
    if depth == 0:
        node.clear_cache()  # what was added since is seen only so: no main loop runs here
    yield node
    for index in range(node.get_child_count()):
        yield from walk(node.get_child_at_index(index), depth + 1)


def called(node):
    """The name of a node. GTK since 4.10 lets an item of a menu take its name from a label and then leaves the label's out: its text is asked for."""
    if node.get_name() or node.get_role_name() != "menu item":
        return node.get_name() or ""
    labels = [relation.get_target(0) for relation in node.get_relation_set() if relation.get_relation_type() == Atspi.RelationType.LABELLED_BY]
    return "".join(Atspi.Text.get_text(label, 0, Atspi.Text.get_character_count(label)) for label in labels)


def settled(window):
    """Waits until a window, of which all has come up, no longer changes: what is typed before that is lost."""
    looks = []

    def same():
        looks.append(run("import", "-window", window, "-depth", "8", "rgb:-"))
        return len(looks) > 4 and len(set(looks[-4:])) == 1

    wait("a window comes to rest", same)


def flatten():
    """Takes all borders and paddings away where GTK tells places without them.

    GTK since 4.10 adds up the places of widgets within their parents, each measured from inside the parent's border and padding, and forgets what these
    take: everything is told too far to the left and too high, and what lies under a point likewise. Where there are none it tells the truth.
    Highlights, bars of progress and separators hold nothing, and have margins below 0 that rely on theirs.
    """
    if ctypes.CDLL("libgtk-4.so.1").gtk_get_minor_version() < 10:
        return
    path = os.path.join(GLib.get_user_config_dir(), "gtk-4.0", "gtk.css")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write("*:not(highlight):not(progress):not(separator) { padding: 0; border-width: 0; }\n")
        # A margin is told rightly, and at the sides of a page is where the wheel turns the page itself.
        file.write(".page { margin: 0 18px 0 12px; }\n")


class Window:
    """A running program."""

    def __init__(self, *files, opens=True, flat=True):
        if flat:
            flatten()
        # For the program alone: this one's own library for the accessibility bus has critical messages of its own.
        environment = {"G_DEBUG": "fatal-criticals", **os.environ}
        self.process = subprocess.Popen([program, *files], stderr=subprocess.PIPE, text=True, env=environment)
        self.root = wait("the program appears in the accessibility tree", self.find_root)
        self.window = wait("the window is there", self.find_window)
        run("xdotool", "windowmove", self.window, 0, 0)
        run("xdotool", "windowfocus", self.window)
        if files and opens:
            # Widgets are there before their files are, and do nothing until then.
            wait("the file is shown", lambda: run("xdotool", "getwindowname", self.window).decode().strip() not in ("", "Sinew"))

    def find_window(self):
        """The program's largest window: under a pointer that rests a tooltip may have come up already, which is a window too."""
        def area(window):
            size = dict(line.split("=") for line in run("xdotool", "getwindowgeometry", "--shell", window).decode().split())
            return int(size["WIDTH"]) * int(size["HEIGHT"])

        windows = run("xdotool", "search", "--onlyvisible", "--pid", self.process.pid).decode().split()
        window = max(windows, key=area)
        return window if area(window) > 90_000 else None

    def find_root(self):
        if self.process.poll() is not None:
            fail(f"the program ended at once: {self.process.stderr.read()}")
        desktop = Atspi.get_desktop(0)
        for index in range(desktop.get_child_count()):
            child = desktop.get_child_at_index(index)
            if child and child.get_process_id() == self.process.pid:
                return child
        return None

    def find(self, role, name):
        # A toggle button is a "push button" to some versions of GTK and a "toggle button" to others. A list that unfolds has since GTK 4.12 the name of
        # what is chosen in it, and its own stands in the description.
        fits = lambda node: node.get_role_name().endswith(role) and (called(node) == name or role == "combo box" and node.get_description() == name)
        return steadily(lambda: next(filter(fits, walk(self.root)), None))

    def get(self, role, name):
        return wait(f"there is a {role} named {name}", lambda: self.find(role, name))

    def shows(self, text):
        """Whether a text is there, and neither it nor what it stands in is hidden."""

        def within(node):
            if not node.get_state_set().contains(Atspi.StateType.VISIBLE):
                return False
            if text in called(node):
                return True
            return any(within(node.get_child_at_index(index)) for index in range(node.get_child_count()))

        def anywhere():
            self.root.clear_cache()
            return any(within(self.root.get_child_at_index(index)) for index in range(self.root.get_child_count()))

        return steadily(anywhere)

    def count(self, name):
        """How many labels say exactly this."""
        says = lambda node: node.get_name() == name and node.get_role_name() == "label"
        return steadily(lambda: sum(map(says, walk(self.root))))

    def others(self):
        """The other windows that the program shows: dialogs, questions."""
        shown = run("xdotool", "search", "--onlyvisible", "--pid", self.process.pid).decode().split()
        return [other for other in shown if other != self.window]

    def picture(self):
        """The middle of the viewport, without the labels over it."""
        return run("import", "-window", self.window, "-crop", "200x260+400+150", "-depth", "8", "rgb:-")

    def key(self, *keys):
        run("xdotool", "key", *keys)

    def quit(self):
        self.key("ctrl+q")
        wait("Ctrl+Q ends the program", lambda: self.process.poll() is not None)
        if self.process.returncode != 0:
            fail(f"the program ended with {self.process.returncode}: {self.process.stderr.read()}")
        said = complaints(self.process.stderr.read().splitlines())
        if said:
            fail("something was complained of: " + "; ".join(said))


def pressed(node):
    states = node.get_state_set()
    return states.contains(Atspi.StateType.PRESSED) or states.contains(Atspi.StateType.CHECKED)


def value(node):
    return node.get_current_value()


def still(window):
    """The picture once it no longer changes."""
    before = [None]

    def same():
        now = window.picture()
        unchanged = now == before[0]
        before[0] = now
        return unchanged

    wait("the picture comes to rest", same)
    return before[0]


CLIP = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
  <library_geometries><geometry id="plate" name="Plate"><mesh>
    <source id="p"><float_array id="pa" count="12">-1 -1 0 1 -1 0 1 1 0 -1 1 0</float_array>
      <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>
  </mesh></geometry></library_geometries>
  <library_animations><animation id="turn">
    <source id="t"><float_array id="ta" count="3">0 1 2</float_array>
      <technique_common><accessor source="#ta" count="3"><param name="TIME" type="float"/></accessor></technique_common></source>
    <source id="o"><float_array id="oa" count="3">0 60 180</float_array>
      <technique_common><accessor source="#oa" count="3"><param name="ANGLE" type="float"/></accessor></technique_common></source>
    <source id="i"><Name_array id="ia" count="3">LINEAR LINEAR LINEAR</Name_array>
      <technique_common><accessor source="#ia" count="3"><param name="INTERPOLATION" type="name"/></accessor></technique_common></source>
    <sampler id="s"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#o"/><input semantic="INTERPOLATION" source="#i"/></sampler>
    <channel source="#s" target="Node/spin.ANGLE"/>
  </animation></library_animations>
  <library_visual_scenes><visual_scene id="scene">
    <node id="Node" name="Node"><rotate sid="spin">0 0 1 0</rotate><instance_geometry url="#plate"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""


def test_clip():
    path = os.path.join(folder, "turn.dae")
    with open(path, "w") as file:
        file.write(CLIP)
    window = Window(path)
    slider = window.get("slider", "Time")
    wait("the clip runs from 0 to 2 s", lambda: abs(slider.get_maximum_value() - 2.0) < 1e-6)
    told("a file from the command line opens")

    rest = still(window)
    slider.set_current_value(0.5)
    wait("setting Time changes the picture", lambda: window.picture() != rest)
    told("Time can be read and set, and the picture follows")

    start = value(slider)
    play = window.get("button", "Play")
    play.do_action(0)
    wait("Play lets time go on", lambda: value(slider) != start)
    play.do_action(0)
    wait("Play again stops", lambda: not pressed(play))
    told("Play plays and stops")

    box = slider.get_extents(Atspi.CoordType.WINDOW)
    for part in (0.25, 0.75):
        run("xdotool", "mousemove", box.x + round(box.width * part), box.y + box.height // 2, "click", 1)
        wait(f"a click at {part} of the timeline goes there", lambda: abs(value(slider) - 2.0 * part) < 0.08)
    window.key("Up")
    wait("Up goes to the key before with the keyboard on the timeline", lambda: abs(value(slider) - 1.0) < 1e-6)
    told("a click on the timeline seeks and leaves the keys what they are")

    run("xdotool", "mousemove", 500, 300, "click", 1)  # the keyboard goes to the picture
    slider.set_current_value(0.5)
    wait("Time is 0.5", lambda: abs(value(slider) - 0.5) < 1e-9)
    window.key("shift+Right")
    wait("Shift+Right goes to the end", lambda: abs(value(slider) - 2.0) < 1e-6)
    window.key("Up")
    wait("Up goes to the key before", lambda: abs(value(slider) - 1.0) < 1e-6)
    window.key("Right")
    wait("Right goes one frame on", lambda: 1.0 < value(slider) < 1.1)
    window.key("space")
    wait("Space plays", lambda: pressed(play))
    window.key("space")
    told("keys: Shift+Right, Up, Right, Space")

    slider.set_current_value(0.0)  # the plate faces the eye
    before = still(window)
    window.key("5")
    wait("5 makes the rays parallel", lambda: window.picture() != before)
    window.key("5")
    wait("5 again makes them meet", lambda: window.picture() == before)
    window.key("e")
    wait("E draws edges", lambda: window.picture() != before)
    window.key("e")
    wait("E again draws none", lambda: window.picture() == before)
    told("keys: 5, E")

    # The tree names the node once; the status line and the inspector name it too while it is selected.
    for x, y, selected in ((350, 450, False), (600, 330, True), (350, 450, False)):
        run("xdotool", "mousemove", x, y, "click", 1)
        wait(f"a click at {x}, {y} selects: {selected}", lambda: (window.count("Node") > 1) == selected)
    told("a click selects")
    run("xdotool", "mousemove", 500, 300)
    before = still(window)

    run("xdotool", "mousemove", 500, 300, "mousedown", 1, "mousemove", 540, 320, "mousemove", 580, 340, "mouseup", 1)
    wait("a drag turns the camera", lambda: window.picture() != before)
    run("xdotool", "mousemove", 500, 300)
    window.key("Return")
    told("a drag orbits")

    broken = "<COLLADA version='1.4.1'><asset></COLLADA>"
    with open(path, "w") as file:
        file.write(broken)
    wait("a broken file is told", lambda: window.shows("cannot be opened"))
    if abs(slider.get_maximum_value() - 2.0) > 1e-6:
        fail("the old scene stays when the file breaks")
    told("a broken file shows a message and the old scene stays")
    with open(path, "w") as file:
        file.write(CLIP.replace("0 1 2<", "0 1 3<"))
    wait("the mended file is read again", lambda: abs(slider.get_maximum_value() - 3.0) < 1e-6)
    wait("the message goes", lambda: not window.shows("cannot be opened"))
    told("a mended file opens by itself")

    run("xdotool", "windowsize", window.window, 800, 600)

    def fits():
        for role, name in (("slider", "Time"), ("button", "Play")):
            box = window.get(role, name).get_extents(Atspi.CoordType.WINDOW)
            if box.width < 20 or box.x < 0 or box.y < 0 or box.x + box.width > 800 or box.y + box.height > 600:
                return False
        return True

    wait("everything fits into 800 × 600", fits)
    size = run("xdotool", "getwindowgeometry", "--shell", window.window).decode()
    if "WIDTH=800" not in size or "HEIGHT=600" not in size:
        fail(f"the window can be made 800 × 600: {size}")
    told("the window works at 800 × 600")
    window.quit()
    told("Ctrl+Q leaves with 0")


def open_arm():
    """A window with an arm, and its sliders for contraction and elbow."""
    window = Window(os.path.join(configs, "biceps-measured.yaml"))
    # The window before left its size behind, and there the arm is elsewhere.
    run("xdotool", "windowsize", "--sync", window.window, 1280, 800)
    contraction, elbow = window.get("slider", "Contraction"), window.get("slider", "Elbow angle")
    wait("the elbow can be bent", lambda: elbow.get_maximum_value() > 80)
    return window, contraction, elbow


def test_muscle():
    window, contraction, elbow = open_arm()
    rest = still(window)
    elbow.set_current_value(60.0)
    wait("the elbow bends", lambda: abs(value(elbow) - 60.0) < 1e-6)
    wait("the contraction follows the elbow", lambda: value(contraction) > 5.0)
    wait("the picture follows the elbow", lambda: window.picture() != rest)
    bent = still(window)
    before = value(elbow)
    contraction.set_current_value(90.0)
    wait("the elbow follows the contraction", lambda: value(elbow) > before + 5.0)
    wait("the picture follows the contraction", lambda: window.picture() != bent)
    told("each slider moves and the other follows")
    window.quit()


if __name__ == "__main__":
    test_clip()
    test_muscle()
    print("all is so")
