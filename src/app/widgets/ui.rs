//! Loads `.ui` files: a text `tr:key` stands for the message `key` of the catalogue, `tr:key#` for one that takes the argument `$number`,
//! `tr:key@command,command` for one with the shortcuts of commands that do the same, and `tip:command` for the label of a command with its shortcut.

use gtk4::glib::signal::signal_stop_emission_by_name;
use gtk4::glib::{Object, Propagation, idle_add_local_once, markup_escape_text};
use gtk4::prelude::*;
use gtk4::{
    Builder, DropDown, Editable, Entry, EventControllerScroll, Expression, InputPurpose, Label, ListItem, ListView, MenuButton, Popover,
    PropagationPhase, PropertyExpression, Scale, ScrolledWindow, SignalListItemFactory, SpinButton, StringList, StringObject, ToggleButton,
    Widget, pango,
};

use crate::app::commands::Command;
use crate::app::format;
use crate::i18n::{shown, shown_lines};
use crate::tr;

/// A struct of the widgets of a `.ui` file that code works with: a field an id. `from` a file, which lies at this path beside the module, the struct builds it
/// itself (`build`); `in` a file it is one of several that find theirs among what was built (`of`). A test of the module holds ids and classes against the file,
/// so that a slip is found without a display.
macro_rules! widgets {
    ($(#[$doc:meta])* struct $name:ident from $file:literal { $($field:ident: $class:ty,)+ }) => {
        $crate::app::widgets::ui::widgets! { $(#[$doc])* struct $name in $file { $($field: $class,)+ } }

        impl $name {
            /// Builds the file, in the user's language.
            fn build() -> Self {
                Self::of(&$crate::app::widgets::ui::builder(include_str!($file)))
            }
        }
    };
    ($(#[$doc:meta])* struct $name:ident in $file:literal { $($field:ident: $class:ty,)+ }) => {
        $(#[$doc])*
        #[derive(Clone)]
        struct $name {
            $($field: $class,)+
        }

        impl $name {
            /// Finds them among what was built from the file.
            fn of(builder: &gtk::Builder) -> Self {
                Self { $($field: $crate::app::widgets::ui::object(builder, stringify!($field)),)+ }
            }
        }

        #[cfg(test)]
        mod widgets_of_the_file {
            use super::*;

            #[test]
            fn each_is_there_with_its_class() {
                let text = include_str!($file);
                $($crate::app::widgets::ui::assert_declared(text, <$class as gtk::glib::types::StaticType>::static_type().name(), stringify!($field));)+
            }
        }
    };
}
pub(crate) use widgets;

/// Asserts that a `.ui` text has an object of this class with this id.
#[cfg(test)]
pub(crate) fn assert_declared(text: &str, class: &str, id: &str) {
    let document = roxmltree::Document::parse(text).expect("sound XML");
    let declared = document.descendants().find(|node| node.has_tag_name("object") && node.attribute("id") == Some(id));
    assert_eq!(declared.and_then(|node| node.attribute("class")), Some(class), "{id}");
}

/// A builder of one of the files, in the user's language.
pub(crate) fn builder(text: &str) -> Builder {
    numbered(text, 1)
}

/// A builder of a file of which there are several, told apart by a number from 1.
pub(crate) fn numbered(text: &str, number: usize) -> Builder {
    let builder = Builder::from_string(&translate(text, number));
    for object in &builder.objects() {
        hide_tooltip_while_open(object);
        let_scroll(object);
        if let Some(number) = object.downcast_ref::<SpinButton>() {
            speak_numbers(number);
            take_numbers(number);
        }
        if let Some(entry) = object.downcast_ref::<Entry>().filter(|entry| is_of_numbers(entry)) {
            take_numbers(entry);
        }
    }
    builder
}

/// An object of a `.ui` file.
///
/// # Panics
/// Where the file lacks it: the files are compiled in, and the first start of the window would show the slip.
pub(crate) fn object<T: IsA<Object>>(builder: &Builder, id: &str) -> T {
    builder.object(id).unwrap_or_else(|| panic!("the .ui file has no {id}"))
}

/// Sets the text of a label; text that came from a file is [`shown_lines`].
pub(crate) fn set_label(label: &Label, text: &str) {
    label.set_text(&shown_lines(text));
}

/// A list of names of any origin, each on one line.
pub(crate) fn words<T: AsRef<str>>(names: &[T]) -> StringList {
    let names: Vec<_> = names.iter().map(|name| shown(name.as_ref())).collect();
    StringList::new(&names.iter().map(AsRef::as_ref).collect::<Vec<_>>())
}

/// A widget of a class that GTK or this program has, with its accessible name. GTK before 4.10 takes such names from `.ui` texts only.
pub(crate) fn named<T: IsA<Object>>(class: &str, name: &str) -> T {
    let label = format!("<accessibility><property name=\"label\">{}</property></accessibility>", markup_escape_text(&shown(name)));
    let builder = Builder::from_string(&format!("<interface><object class=\"{class}\" id=\"named\">{label}</object></interface>"));
    object(&builder, "named")
}

/// Lets a list be as narrow as there is room: its button shortens the name that is chosen to some `chars` characters; its rows show names in full.
pub(crate) fn narrow(list: &DropDown, chars: i32) {
    let factory = move |short: bool| {
        let factory = SignalListItemFactory::new();
        factory.connect_setup(move |_, item| {
            let label = Label::builder().xalign(0.0).build();
            if short {
                label.set_ellipsize(pango::EllipsizeMode::Middle);
                label.set_width_chars(4);
                label.set_max_width_chars(chars);
                label.set_hexpand(true);
            }
            if let Some(item) = item.downcast_ref::<ListItem>() {
                item.set_child(Some(&label));
            }
        });
        factory.connect_bind(|_, item| {
            let Some(item) = item.downcast_ref::<ListItem>() else { return };
            let text = item.item().and_downcast::<StringObject>().map(|object| object.string());
            if let (Some(label), Some(text)) = (item.child().and_downcast::<Label>(), text) {
                label.set_text(&text);
            }
        });
        factory
    };
    list.set_factory(Some(&factory(true)));
    list.set_list_factory(Some(&factory(false)));
    // A search needs to be told what is searched.
    list.set_expression(Some(PropertyExpression::new(StringObject::static_type(), Expression::NONE, "string")));
}

/// Sets whether a widget is sensitive. One that has the keyboard, or holds what has it, loses it first: GTK takes it from a text without telling the text, whose
/// cursor then blinks on and complains.
pub(crate) fn set_sensitive(widget: &impl IsA<Widget>, may: bool) {
    if !may
        && let Some(root) = widget.root()
        && root.focus().is_some_and(|focus| focus == *widget.upcast_ref::<Widget>() || focus.is_ancestor(widget))
    {
        root.set_focus(Widget::NONE);
    }
    widget.set_sensitive(may);
}

/// Moves a slider or a box to a value, unless that differs from its own by rounding alone: by less than the hundred thousandth part of a step. While a
/// hand's value is being told, GTK tells of any other one after it; one that comes back from a pose rounded otherwise each time would be told of without end.
pub(crate) fn show_value(adjustment: &gtk4::Adjustment, value: f64) {
    if (value - adjustment.value()).abs() > 1e-5 * adjustment.step_increment() {
        adjustment.set_value(value);
    }
}

/// Scrolls a list to a row, after its listeners have handled a change of its rows. A list that is not seen has nowhere to scroll.
pub(crate) fn scroll_to(list: &ListView, row: u32) {
    let list = list.downgrade();
    idle_add_local_once(move || {
        let there = |list: &ListView| list.is_mapped() && list.model().is_some_and(|rows| row < rows.n_items());
        if let Some(list) = list.upgrade().filter(there) {
            // An action of the list itself: scrolling by code has a function from GTK 4.12 on only.
            let _ = list.activate_action("list.scroll-to-item", Some(&row.to_variant()));
        }
    });
}

/// Lets a box write and read numbers as the rest of the window does, in the language of the program; GTK's own way is that of the system's locale.
fn speak_numbers(number: &SpinButton) {
    // The filter of numeric boxes knows the locale's decimal mark only.
    number.set_numeric(false);
    number.connect_output(|number| {
        let text = format::number(number.value(), number.digits() as usize);
        if number.text() != text {
            number.set_text(&text);
        }
        Propagation::Stop
    });
    // What is no number changes nothing; GTK would take it for 0.
    number.connect_input(|number| Some(Ok(format::parse_number(&number.text()).unwrap_or_else(|| number.value()))));
}

/// Lets a box or an entry take numbers only: a letter is never a part of one.
pub(crate) fn take_numbers(editable: &impl IsA<Editable>) {
    if let Some(text) = editable.delegate() {
        text.connect_insert_text(|text, inserted, _| {
            if inserted.chars().any(char::is_alphabetic) {
                signal_stop_emission_by_name(text, "insert-text");
            }
        });
    }
}

/// Whether an entry is one of numbers.
pub(crate) fn is_of_numbers(entry: &Entry) -> bool {
    entry.input_purpose() == InputPurpose::Number
}

/// In a panel that scrolls, the wheel scrolls: a slider or a box that happens to come under the pointer is not turned by it.
fn let_scroll(object: &Object) {
    let Some(widget) = object.downcast_ref::<Widget>().filter(|widget| widget.is::<Scale>() || widget.is::<SpinButton>()) else { return };
    widget.connect_map(|widget| {
        if widget.ancestor(ScrolledWindow::static_type()).is_some() {
            let controllers = widget.observe_controllers();
            let wheels = (0..controllers.n_items()).filter_map(|place| controllers.item(place).and_downcast::<EventControllerScroll>());
            wheels.for_each(|wheel| wheel.set_propagation_phase(PropagationPhase::None));
        }
    });
}

/// Takes the tooltip away while what it belongs to is unfolded. A popover inherits it, and GTK before 4.10 asks the surface of one that has closed
/// before its half second was over.
fn hide_tooltip_while_open(object: &Object) {
    if let Some(button) = object.downcast_ref::<MenuButton>() {
        if let Some(toggle) = button.first_child().and_downcast::<ToggleButton>() {
            let button = button.downgrade();
            toggle.connect_active_notify(move |toggle| {
                if let Some(button) = button.upgrade() {
                    button.set_has_tooltip(!toggle.is_active());
                }
            });
        }
    } else if let Some(list) = object.downcast_ref::<DropDown>() {
        let parts = std::iter::successors(list.first_child(), WidgetExt::next_sibling);
        if let Some(popover) = parts.filter_map(|part| part.downcast::<Popover>().ok()).next() {
            let list = list.downgrade();
            popover.connect_visible_notify(move |popover| {
                if let Some(list) = list.upgrade() {
                    list.set_has_tooltip(!popover.is_visible());
                }
            });
        }
    }
}

/// Puts the catalogue's text in place of each `>tr:key<` and `>tip:command<`.
fn translate(text: &str, number: usize) -> String {
    let mut result = String::with_capacity(text.len() + 1024);
    let mut rest = text;
    while let Some(at) = rest.find('>') {
        let (before, after) = rest.split_at(at + 1);
        result.push_str(before);
        rest = after;
        let (placeholder, tail) = after.split_at(after.find('<').unwrap_or(after.len()));
        if let Some(words) = meaning(placeholder, number) {
            result.push_str(&markup_escape_text(&words));
            rest = tail;
        }
    }
    result.push_str(rest);
    result
}

fn meaning(placeholder: &str, number: usize) -> Option<String> {
    let label_of = |id: &str| Command::from_id(id).map_or_else(|| id.to_owned(), Command::tooltip);
    let plain = |key: &str| key.strip_suffix('#').map_or_else(|| tr!(key), |key| tr!(key, number = number));
    let message = |text: &str| match text.split_once('@') {
        Some((key, commands)) => Command::with_keys(&plain(key), &commands.split(',').filter_map(Command::from_id).collect::<Vec<_>>()),
        None => plain(text),
    };
    placeholder.strip_prefix("tr:").map(message).or_else(|| placeholder.strip_prefix("tip:").map(label_of))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::{Path, PathBuf};

    /// The `.ui` files of the window, with their texts.
    fn files() -> Vec<(PathBuf, String)> {
        let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src/app")];
        let mut files = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in folder.read_dir().expect("a folder of the sources") {
                let path = entry.expect("an entry").path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "ui") {
                    let text = std::fs::read_to_string(&path).expect("a text");
                    files.push((path, text));
                }
            }
        }
        assert!(!files.is_empty());
        files
    }

    #[test]
    fn placeholders_become_escaped_text() {
        let translated = translate("<property name=\"label\">tr:app-no-such-key</property>\n<a>b</a>", 1);
        assert_eq!(translated, "<property name=\"label\">app-no-such-key</property>\n<a>b</a>");
        assert_eq!(translate("<a>tr:a&b</a>", 1), "<a>a&amp;b</a>");
        assert_eq!(translate("no markup", 1), "no markup");
        assert_eq!(translate("<a>tr:app-via-number#</a>", 7), format!("<a>{}</a>", tr!("app-via-number", number = 7)));
    }

    #[test]
    fn every_placeholder_is_known() {
        for (file, text) in files() {
            let file = file.display();
            for piece in text.split('>') {
                let piece = piece.split('<').next().unwrap_or_default();
                if let Some(text) = piece.strip_prefix("tr:") {
                    let (key, commands) = text.split_once('@').unwrap_or((text.trim_end_matches('#'), ""));
                    for id in commands.split(',').filter(|id| !id.is_empty()) {
                        assert!(Command::from_id(id).is_some(), "{file} asks for the keys of {id}, which is not in the table");
                    }
                    assert_ne!(tr!(key), key, "{file} asks for the message {key}, which the catalogue lacks");
                }
                if let Some(id) = piece.strip_prefix("tip:") {
                    assert!(Command::from_id(id).is_some(), "{file} asks for the command {id}, which is not in the table");
                }
            }
        }
    }

    #[test]
    fn every_action_in_a_file_is_in_the_table() {
        for (file, text) in files() {
            let file = file.display();
            for piece in text.split("\"action-name\">win.").skip(1) {
                let id = piece.split(['<', ':', '(']).next().unwrap_or_default();
                assert!(Command::from_id(id).is_some(), "{file} uses the action {id}, which is not in the table");
            }
        }
    }

    #[test]
    fn no_text_is_written_into_a_file() {
        for (file, text) in files() {
            let file = file.display();
            for property in ["label", "tooltip-text", "title", "placeholder-text", "text"] {
                for piece in text.split(&format!("name=\"{property}\">")).skip(1) {
                    let value = piece.split('<').next().unwrap_or_default();
                    let plain = value.chars().any(char::is_alphabetic) && !value.starts_with("tr:") && !value.starts_with("tip:");
                    assert!(!plain, "{file} says “{value}” past the catalogue");
                }
            }
        }
    }
}
