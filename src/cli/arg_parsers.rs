//! Values of options: text to number, size, colour. Each parser's error is the end of a sentence that begins with the option and the value.

use glam::Vec3;

use crate::limits;
use crate::tr;

/// The longest list that `--angles`, `--sweep` and `--times` make.
const ANGLES: usize = 100_000;

/// Largest angle accepted, degrees: beyond it the sine would have few digits left.
pub(super) const MOST_DEGREES: f64 = 1e6;

/// A finite number with a decimal point.
pub(super) fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(tr!("cli-value-not-finite")),
        Err(_) if text.contains(',') && text.replace(',', ".").trim().parse::<f64>().is_ok() => Err(tr!("cli-value-decimal-comma")),
        Err(_) => Err(tr!("cli-value-not-number")),
    }
}

/// A number within a range, both ends included.
pub(super) fn number_within(low: f64, high: f64) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let value = number(text)?;
        if (low..=high).contains(&value) { Ok(value) } else { Err(tr!("cli-value-out-of-range", low = plain(low), high = plain(high))) }
    }
}

/// A number as options take it: no thousands marks, decimal point; a power of ten where it would have very many digits.
pub(super) fn plain(value: f64) -> String {
    if value != 0.0 && !(1e-6..1e15).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
}

/// `1280x720`.
pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let wrong = || tr!("cli-value-not-size", limit = plain(limits::PICTURE_SIDE.into()));
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let side = |text: &str| text.trim().parse::<u32>().ok().filter(|side| (1..=limits::PICTURE_SIDE).contains(side)).ok_or_else(wrong);
    Ok((side(width)?, side(height)?))
}

/// `X,Y,Z` in metres.
pub(super) fn point(text: &str) -> Result<Vec3, String> {
    let parts = text.split(',').map(number).collect::<Result<Vec<_>, _>>().map_err(|_| tr!("cli-value-not-point"))?;
    match parts[..] {
        [x, y, z] => {
            Some(Vec3::new(x as f32, y as f32, z as f32)).filter(|point| point.is_finite()).ok_or_else(|| tr!("cli-value-not-finite"))
        }
        _ => Err(tr!("cli-value-not-point")),
    }
}

/// A background: nothing, or `0xRRGGBB`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BackgroundArg {
    /// `none`: the picture has an alpha channel.
    None,
    /// One colour, `0xRRGGBB`.
    Color(u32),
}

/// `none`, `#rrggbb`, `#rgb` (the mark may be left out) or one of CSS's sixteen basic names.
pub(super) fn backdrop(text: &str) -> Result<BackgroundArg, String> {
    const NAMES: [(&str, u32); 17] = [
        ("black", 0x000000),
        ("silver", 0xC0C0C0),
        ("gray", 0x808080),
        ("grey", 0x808080),
        ("white", 0xFFFFFF),
        ("maroon", 0x800000),
        ("red", 0xFF0000),
        ("purple", 0x800080),
        ("fuchsia", 0xFF00FF),
        ("green", 0x008000),
        ("lime", 0x00FF00),
        ("olive", 0x808000),
        ("yellow", 0xFFFF00),
        ("navy", 0x000080),
        ("blue", 0x0000FF),
        ("teal", 0x008080),
        ("aqua", 0x00FFFF),
    ];
    let wanted = text.trim().to_ascii_lowercase();
    if wanted == "none" {
        return Ok(BackgroundArg::None);
    }
    if let Some((_, color)) = NAMES.iter().find(|(name, _)| *name == wanted) {
        return Ok(BackgroundArg::Color(*color));
    }
    let digits = wanted.strip_prefix('#').unwrap_or(&wanted);
    let full = match digits.len() {
        3 => digits.chars().flat_map(|digit| [digit, digit]).collect(),
        6 => digits.to_owned(),
        _ => return Err(tr!("cli-value-not-color")),
    };
    // `from_str_radix` would take a sign.
    if !full.chars().all(|c| c.is_ascii_hexdigit()) {
        return Err(tr!("cli-value-not-color"));
    }
    u32::from_str_radix(&full, 16).map(BackgroundArg::Color).map_err(|_| tr!("cli-value-not-color"))
}

/// A number of threads.
pub(super) fn threads(text: &str) -> Result<usize, String> {
    text.trim()
        .parse::<usize>()
        .ok()
        .filter(|count| (1..=limits::THREADS).contains(count))
        .ok_or_else(|| tr!("cli-value-not-count", limit = plain(limits::THREADS as f64)))
}

/// Angles in degrees, in the order given.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Angles(pub Vec<f64>);

/// `0,30,60,90`.
pub(super) fn angles(text: &str) -> Result<Angles, String> {
    let angles = text.split(',').map(number).collect::<Result<Vec<_>, _>>().map_err(|_| tr!("cli-value-not-angles"))?;
    if angles.len() > ANGLES { Err(too_many()) } else { Ok(Angles(angles)) }
}

/// What messages about a `FROM:TO:STEP` say, by what it counts.
struct Words {
    wrong: fn() -> String,
    empty: fn() -> String,
    too_many: fn() -> String,
    too_fine: fn() -> String,
}

/// `FROM:TO:STEP` in degrees, both ends included where the step meets them.
pub(super) fn sweep(text: &str) -> Result<Angles, String> {
    let words = Words {
        wrong: || tr!("cli-value-not-sweep"),
        empty: || tr!("cli-value-sweep-empty"),
        too_many,
        too_fine: || tr!("cli-value-sweep-too-fine"),
    };
    stepped(text, &words).map(Angles)
}

/// Times in seconds, in the order given.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Times(pub Vec<f64>);

/// `FROM:TO:STEP` in seconds, both ends included where the step meets them.
pub(super) fn times(text: &str) -> Result<Times, String> {
    let words = Words {
        wrong: || tr!("cli-value-not-times"),
        empty: || tr!("cli-value-times-empty"),
        too_many: || tr!("cli-value-too-many-times", limit = plain(ANGLES as f64)),
        too_fine: || tr!("cli-value-times-too-fine"),
    };
    stepped(text, &words).map(Times)
}

fn stepped(text: &str, words: &Words) -> Result<Vec<f64>, String> {
    let parts = text.split(':').map(number).collect::<Result<Vec<_>, _>>().map_err(|_| (words.wrong)())?;
    let [from, to, step] = parts[..] else {
        return Err((words.wrong)());
    };
    if step == 0.0 || (to - from) * step < 0.0 {
        return Err((words.empty)());
    }
    // A step such as 0.1 is not exact: the last value counts where it misses the end by less than a millionth of a step.
    let steps = ((to - from) / step + 1e-6).floor();
    if steps.is_nan() || steps >= ANGLES as f64 {
        return Err((words.too_many)());
    }
    if steps >= 1.0 && (from + step == from || to - step == to) {
        return Err((words.too_fine)());
    }
    Ok((0..=steps as usize).map(|i| from + step * i as f64).collect())
}

/// From one value to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ValueRange(pub f64, pub f64);

/// `FROM:TO`, each within a range.
pub(super) fn span(low: f64, high: f64) -> impl Fn(&str) -> Result<ValueRange, String> + Clone + Send + Sync + 'static {
    move |text| {
        let wrong = || tr!("cli-value-not-span", example = format!("0:{}", plain(high.min(130.0))));
        let parts = text.split(':').map(number).collect::<Result<Vec<_>, _>>().map_err(|_| wrong())?;
        match parts[..] {
            [from, to] if (low..=high).contains(&from) && (low..=high).contains(&to) => Ok(ValueRange(from, to)),
            [_, _] => Err(tr!("cli-value-out-of-range", low = plain(low), high = plain(high))),
            _ => Err(wrong()),
        }
    }
}

fn too_many() -> String {
    tr!("cli-value-too-many-angles", limit = plain(ANGLES as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_with_times_is_said_in_seconds() {
        let told = |text: &str| times(text).expect_err(text);
        for text in ["abc", "1", "0:10", "0:1:x", "0:1:nan"] {
            assert!(told(text).contains("seconds"), "{}", told(text));
        }
        for text in ["0:1:0", "5:0:1", "0:1e9:1e-9", "-1e308:1e308:1", "1e17:100000000000000100:1"] {
            assert!(told(text).contains("time") && !told(text).contains("angle"), "{}", told(text));
        }
        assert!(sweep("1e17:100000000000000100:1").expect_err("too fine").contains("angle"));
    }

    #[test]
    fn sizes_are_two_whole_numbers_within_the_limit() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert_eq!(size("1×16384"), Ok((1, 16384)));
        for wrong in ["0x5", "5x0", "1000000x1000000", "16385x1", "-5x5", "5", "x", "5x5x5", "5.5x4", "", "99999999999x1"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn numbers_are_short_and_can_be_typed_again() {
        for (value, text) in [(90.0, "90"), (-0.5, "-0.5"), (0.0, "0"), (16384.0, "16384"), (1e300, "1e300"), (-2.5e-9, "-2.5e-9")] {
            assert_eq!(plain(value), text);
            assert_eq!(number(text), Ok(value));
        }
    }

    #[test]
    fn spans_have_two_ends() {
        assert_eq!(span(-180.0, 180.0)("0:-130.5"), Ok(ValueRange(0.0, -130.5)));
        for wrong in ["0", "0:1:2", "a:b", "", "0:181", "nan:1"] {
            assert!(span(-180.0, 180.0)(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn sweeps_hold_both_ends() {
        assert_eq!(sweep("0:90:30"), Ok(Angles(vec![0.0, 30.0, 60.0, 90.0])));
        assert_eq!(sweep("90:0:-45"), Ok(Angles(vec![90.0, 45.0, 0.0])));
        assert_eq!(sweep("5:5:1"), Ok(Angles(vec![5.0])));
        assert_eq!(sweep("0:1:0.1").map(|a| a.0.len()), Ok(11));
        assert_eq!(times("0.5:1:0.25"), Ok(Times(vec![0.5, 0.75, 1.0])));
        assert_eq!(sweep("0:10:4"), Ok(Angles(vec![0.0, 4.0, 8.0])));
        for wrong in ["0:90", "0:90:0", "90:0:1", "0:90:-1", "a:b:c", "0:nan:1", "0:inf:1", "", "0:90:1e-9", "-1e308:1e308:1"] {
            assert!(sweep(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn colours_are_hex_or_named() {
        assert_eq!(backdrop("#1a2B3c"), Ok(BackgroundArg::Color(0x1A2B3C)));
        assert_eq!(backdrop("fff"), Ok(BackgroundArg::Color(0xFFFFFF)));
        assert_eq!(backdrop("White"), Ok(BackgroundArg::Color(0xFFFFFF)));
        assert_eq!(backdrop("none"), Ok(BackgroundArg::None));
        for wrong in ["", "#", "#12", "#12345", "+12345", "whitish", "#ggg", "ййй"] {
            assert!(backdrop(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn numbers_are_finite_and_have_a_point() {
        assert_eq!(number("-1.5e2"), Ok(-150.0));
        for wrong in ["nan", "inf", "1e999", "1,5", "", "x", "0x10"] {
            assert!(number(wrong).is_err(), "{wrong}");
        }
        assert!(number_within(0.0, 100.0)("100.1").is_err());
        assert_eq!(point("1,-2,3.5"), Ok(Vec3::new(1.0, -2.0, 3.5)));
        assert!(point("1,2").is_err() && point("1e39,0,0").is_err());
    }
}
