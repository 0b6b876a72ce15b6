//! What can be wrong with the instruction set that the user asks for.

/// Why the environment variable `SINEW_SIMD` cannot be followed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SimdError {
    /// It is set, to nothing.
    Empty,
    /// This is no instruction set.
    Unknown(String),
    /// This is one, but the processor does not have it.
    Missing(String),
}
