//! Frame numbers: the frame rate of a clip, inferred from its keys' times.

/// Rates that exporters use, in the order in which they are tried.
const RATES: [f64; 9] = [24.0, 25.0, 30.0, 60.0, 15.0, 12.0, 50.0, 120.0, 10.0];

/// The rate where none can be inferred.
pub const DEFAULT_FRAME_RATE: f64 = 30.0;

/// The frame rate whose grid all key times lie on; [`DEFAULT_FRAME_RATE`] where there is none. Times are seconds on the file's axis.
pub fn infer_frame_rate(keys: &[f64]) -> f64 {
    let nonzero = keys.iter().filter(|time| time.abs() > 1e-6);
    if nonzero.clone().next().is_none() {
        return DEFAULT_FRAME_RATE;
    }
    // Exporters write about six digits; a fifth of a per cent of a frame is well above their rounding.
    let fits = |rate: f64| nonzero.clone().all(|time| ((time * rate) - (time * rate).round()).abs() < 2e-3 * (1.0 + time.abs()));
    RATES.into_iter().find(|rate| fits(*rate)).unwrap_or(DEFAULT_FRAME_RATE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn baked(rate: f64, first: u32) -> Vec<f64> {
        (first..first + 90).map(|frame| (f64::from(frame) / rate * 1e6).round() / 1e6).collect()
    }

    #[test]
    fn baked_keys_tell_their_rate() {
        for rate in [24.0, 25.0, 30.0, 60.0] {
            assert_eq!(infer_frame_rate(&baked(rate, 1)), rate);
        }
        assert_eq!(infer_frame_rate(&[0.0, 10.0 / 24.0, 33.0 / 24.0]), 24.0);
    }

    #[test]
    fn keys_off_every_grid_use_the_default() {
        assert_eq!(infer_frame_rate(&[0.0, 0.1234, 0.777]), DEFAULT_FRAME_RATE);
        assert_eq!(infer_frame_rate(&[]), DEFAULT_FRAME_RATE);
        assert_eq!(infer_frame_rate(&[0.0]), DEFAULT_FRAME_RATE);
    }
}
