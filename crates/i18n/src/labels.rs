//! What people call the things of a scene, in their language.

use std::borrow::Cow;

use super::Sentence;
use sinew_scene::Label;

/// The name as it is, or what a thing without one is called.
pub fn label(label: Label<'_>) -> Cow<'_, str> {
    match label {
        Label::Name(name) => Cow::Borrowed(name),
        Label::Unnamed(unnamed) => Cow::Owned(unnamed.sentence()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Language, catalogue};
    use sinew_scene::message::ToMessage;
    use sinew_scene::{BodyPart, Unnamed};

    #[test]
    fn what_is_shown_for_nodes_and_clips_means_them_in_every_language() {
        let parts = BodyPart::ALL.map(Unnamed::Part);
        for unnamed in [Unnamed::Scene, Unnamed::Node(12), Unnamed::Clip(3), Unnamed::Animation].into_iter().chain(parts) {
            for language in Language::ALL {
                let shown = catalogue::message_in(language, unnamed.message().key, &[("number", unnamed_number(unnamed).into())]);
                assert_eq!(Unnamed::parse(&shown), Some(unnamed), "{shown}");
            }
        }
        let english = |unnamed: Unnamed| {
            catalogue::message_in(Language::English, unnamed.message().key, &[("number", unnamed_number(unnamed).into())])
        };
        use Unnamed as U;
        let others = [U::Node(7), U::Clip(7), U::Animation, U::Mesh, U::Skin, U::Morph, U::Material, U::Image, U::Light, U::Camera];
        for unnamed in others.into_iter().chain(parts) {
            assert_eq!(unnamed.plain(), english(unnamed));
        }
    }

    fn unnamed_number(unnamed: Unnamed) -> u32 {
        match unnamed {
            Unnamed::Node(number) | Unnamed::Clip(number) => number,
            _ => 0,
        }
    }
}
