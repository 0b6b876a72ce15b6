//! What is said over the picture: notices, errors, progress of reading, a joint that is held, an empty scene.

pub(crate) mod empty_state;
pub(crate) mod error_bar;
pub(crate) mod held_joint_banner;
pub(crate) mod loading_bar;
pub(crate) mod toasts;
