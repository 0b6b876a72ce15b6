//! The time cursor: plays, seeks, loops. Knows no clock of its own: whoever drives it says how much time went by.

/// What happens at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LoopMode {
    /// Starts again.
    #[default]
    Loop,
    /// Stops.
    Once,
    /// Turns round.
    PingPong,
}

/// A cursor on a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Playback {
    /// First moment, seconds.
    pub start: f64,
    /// Last moment, seconds.
    pub end: f64,
    /// The present moment, seconds.
    pub time: f64,
    /// Whether time goes on.
    pub playing: bool,
    /// Seconds of the clip a second; negative runs backwards.
    pub speed: f64,
    /// What happens at the end.
    pub mode: LoopMode,
}
