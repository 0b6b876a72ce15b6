"""A small window from which files are dragged: drag_source.py FILE…  Prints READY once it is shown."""

import sys

import gi

gi.require_version("Gtk", "4.0")
gi.require_version("Gdk", "4.0")
from gi.repository import Gdk, Gio, GLib, Gtk  # noqa: E402

files = [Gio.File.new_for_path(path) for path in sys.argv[1:]]


def start(application):
    window = Gtk.ApplicationWindow(application=application, title="drag source", default_width=120, default_height=90)
    label = Gtk.Label(label="drag me", hexpand=True, vexpand=True)
    source = Gtk.DragSource(actions=Gdk.DragAction.COPY)
    text = "".join(f"{file.get_uri()}\r\n" for file in files)
    source.set_content(Gdk.ContentProvider.new_for_bytes("text/uri-list", GLib.Bytes.new(text.encode())))
    label.add_controller(source)
    window.set_child(label)
    window.connect("map", lambda _: print("READY", flush=True))
    window.present()


application = Gtk.Application(application_id="io.github.sinew.DragSource", flags=Gio.ApplicationFlags.NON_UNIQUE)
application.connect("activate", start)
application.run([])
