//! The window. GTK appears here and nowhere else.
