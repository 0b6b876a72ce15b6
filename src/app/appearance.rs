//! Light and dark, animation or none: what the desktop asks for.

use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, gio, glib};
use gtk4 as gtk;

use super::settings::ColorScheme;
use crate::app::handles::app_context::AppContext;
use crate::app::widgets::drawing_area::text_color;
use crate::render::Theme;

const PORTAL: &str = "org.freedesktop.portal.Desktop";
const PORTAL_PATH: &str = "/org/freedesktop/portal/desktop";
const PORTAL_SETTINGS: &str = "org.freedesktop.portal.Settings";
const APPEARANCE: &str = "org.freedesktop.appearance";
const COLOR_SCHEME: &str = "color-scheme";

/// Loads the program's few styles.
pub(crate) fn load_style() {
    let Some(display) = gdk::Display::default() else { return };
    let provider = gtk::CssProvider::new();
    provider.load_from_data(include_str!("../../resources/style.css"));
    gtk::style_context_add_provider_for_display(&display, &provider, gtk::STYLE_PROVIDER_PRIORITY_APPLICATION);
}

/// Whether the desktop wants animation.
pub(crate) fn animates() -> bool {
    gtk::Settings::default().is_none_or(|settings| settings.is_gtk_enable_animations())
}

/// Follows the desktop's colours, or the user's choice, from now on.
pub(crate) fn follow(app: &Rc<AppContext>) {
    choose(app.settings.borrow().colours);
    show(app);
    let Some(settings) = gtk::Settings::default() else { return };
    let weak = Rc::downgrade(app);
    let changed = move |_: &gtk::Settings| {
        let weak = weak.clone();
        // The new style is there once the main loop has run.
        glib::idle_add_local_once(move || {
            if let Some(app) = weak.upgrade() {
                show(&app);
            }
        });
    };
    settings.connect_gtk_application_prefer_dark_theme_notify(changed.clone());
    settings.connect_gtk_theme_name_notify(changed.clone());
    let weak = Rc::downgrade(app);
    settings.connect_gtk_enable_animations_notify(move |_| {
        if let Some(app) = weak.upgrade() {
            let smooth = app.settings.borrow().smooth_camera;
            app.session.update(|session| session.set_eased(smooth && animates()));
        }
    });
    follow_portal(app);
}

/// Sets light or dark. What the desktop wants is asked of its portal, which GTK before 4.20 does not do by itself.
pub(crate) fn choose(colours: ColorScheme) {
    let Some(settings) = gtk::Settings::default() else { return };
    match colours {
        ColorScheme::System => {
            settings.reset_property("gtk-application-prefer-dark-theme");
            if let Some(dark) = desktop_is_dark() {
                settings.set_gtk_application_prefer_dark_theme(dark);
            }
        }
        ColorScheme::Light => settings.set_gtk_application_prefer_dark_theme(false),
        ColorScheme::Dark => settings.set_gtk_application_prefer_dark_theme(true),
    }
}

/// Takes over whether the window is dark: text that is lighter than its ground says so, in any theme.
fn show(app: &Rc<AppContext>) {
    let color = text_color(&app.widget);
    let light = color.red() * 0.3 + color.green() * 0.6 + color.blue() * 0.1;
    let theme = if light > 0.5 { Theme::Dark } else { Theme::Light };
    app.session.update(|session| session.set_theme(theme));
}

/// What the desktop's portal says, if there is one that answers at once.
fn desktop_is_dark() -> Option<bool> {
    let bus = gio::bus_get_sync(gio::BusType::Session, gio::Cancellable::NONE).ok()?;
    let question = (APPEARANCE, COLOR_SCHEME).to_variant();
    let flags = gio::DBusCallFlags::NO_AUTO_START;
    let answer = bus
        .call_sync(Some(PORTAL), PORTAL_PATH, PORTAL_SETTINGS, "Read", Some(&question), None, flags, 200, gio::Cancellable::NONE)
        .ok()?;
    scheme(&answer.try_child_value(0)?)
}

/// 1 = dark, 2 = light; portals wrap the number once or twice.
fn scheme(value: &glib::Variant) -> Option<bool> {
    let mut value = value.clone();
    while value.type_() == glib::VariantTy::VARIANT {
        value = value.as_variant()?;
    }
    match value.get::<u32>()? {
        1 => Some(true),
        2 => Some(false),
        _ => None,
    }
}

/// Hears of changes while the program runs.
fn follow_portal(app: &Rc<AppContext>) {
    let weak = Rc::downgrade(app);
    glib::spawn_future_local(async move {
        let Ok(bus) = gio::bus_get_future(gio::BusType::Session).await else { return };
        let flags = gio::DBusProxyFlags::DO_NOT_AUTO_START | gio::DBusProxyFlags::DO_NOT_LOAD_PROPERTIES;
        let proxy = gio::DBusProxy::new_future(&bus, flags, None, Some(PORTAL), PORTAL_PATH, PORTAL_SETTINGS).await;
        let Ok(proxy) = proxy else { return };
        let listener = weak.clone();
        proxy.connect_local("g-signal", false, move |_| {
            if let Some(app) = listener.upgrade() {
                choose(app.settings.borrow().colours);
            }
            None
        });
        // The proxy lives as long as the window.
        if let Some(app) = weak.upgrade() {
            app.widget.connect_destroy(move |_| {
                let _ = &proxy;
            });
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_portal_wraps_its_number() {
        assert_eq!(scheme(&1u32.to_variant()), Some(true));
        assert_eq!(scheme(&2u32.to_variant().to_variant().to_variant()), Some(false));
        assert_eq!(scheme(&0u32.to_variant()), None);
        assert_eq!(scheme(&"dark".to_variant()), None);
    }
}
