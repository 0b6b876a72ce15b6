#![doc = include_str!("../README.md")]

mod balance;
mod binding;
mod clearance;
mod fairing;
mod follow;
mod follower;
mod layout;
mod lists;
mod pieces;
mod points;
mod section;
mod soft;
mod splines;
mod station;
mod winding;

pub use binding::Binding;
pub use follower::Follower;
pub use points::SkinMesh;
pub use section::{CrossSection, MuscleTissue, Segment, SkinLayer};
pub use station::Stations;
