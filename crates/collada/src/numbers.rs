//! Lists of numbers, straight from the text.

/// What a list of numbers held.
pub(super) struct ParsedNumbers<T> {
    /// The values; 0 for what was no number.
    pub values: Vec<T>,
    /// Entries that were no number.
    pub bad: usize,
    /// The first of them.
    pub first_bad: Option<String>,
    /// The first entry with a decimal comma, which was read as a point.
    pub decimal_comma: Option<String>,
}

/// A comma stands between numbers: a separator that COLLADA does not have.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Comma {
    /// The entry.
    pub entry: String,
    /// Its byte position in the list.
    pub at: usize,
}

/// A number type that lists are read into.
pub(super) trait Real: Copy {
    /// The nearest value.
    fn from_f64(value: f64) -> Self;

    /// The nearest values.
    fn all_from_f64(values: Vec<f64>) -> Vec<Self>;
}

impl Real for f32 {
    fn from_f64(value: f64) -> Self {
        value as Self
    }

    fn all_from_f64(values: Vec<f64>) -> Vec<Self> {
        values.into_iter().map(Self::from_f64).collect()
    }
}

impl Real for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }

    fn all_from_f64(values: Vec<f64>) -> Vec<Self> {
        values
    }
}

impl ParsedNumbers<f64> {
    /// The same as another number type.
    pub(super) fn into_reals<T: Real>(self) -> ParsedNumbers<T> {
        ParsedNumbers { values: T::all_from_f64(self.values), bad: self.bad, first_bad: self.first_bad, decimal_comma: self.decimal_comma }
    }
}

/// Powers of ten that f64 holds exactly.
const POWERS: [f64; 23] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22];

#[inline(always)]
fn is_blank(byte: u8) -> bool {
    // Space, and tab to carriage return; other control characters are no XML.
    byte == b' ' || byte.wrapping_sub(b'\t') < 5
}

/// Cuts `text` into entries. A byte list, because indexing by characters would cost.
fn next_entry(bytes: &[u8], at: &mut usize) -> Option<std::ops::Range<usize>> {
    let rest = bytes.get(*at..)?;
    let start = *at + rest.iter().position(|b| !is_blank(*b))?;
    let tail = bytes.get(start..)?;
    let end = start + tail.iter().position(|b| is_blank(*b)).unwrap_or(tail.len());
    *at = end;
    Some(start..end)
}

/// `10^n` for what fits into eight digits.
const TENS: [u64; 9] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// How many of eight bytes, the first in the lowest place, are digits before one is not, and the number that they write.
///
/// All eight are looked at in one word: a digit has the value 0 to 9 once `0` is taken off, and pairs, fours and eights of them are then added up
/// with a multiplication each (D. Lemire, "Quickly parsing eight digits", 2018).
#[inline(always)]
fn eight_digits(bytes: [u8; 8]) -> (usize, u64) {
    let values = u64::from_le_bytes(bytes) ^ 0x3030_3030_3030_3030;
    // The high bit of a byte is set where its value is 10 or more. What runs over goes to later bytes, after the first that is none.
    let others = (values.wrapping_add(0x7676_7676_7676_7676) | values) & 0x8080_8080_8080_8080;
    let count = (others.trailing_zeros() / 8) as usize;
    if count == 0 {
        return (0, 0);
    }
    // Zeros in front make it eight.
    let padded = values << (64 - 8 * count);
    let pairs = padded.wrapping_mul(10).wrapping_add(padded >> 8);
    let low = (pairs & 0x0000_00FF_0000_00FF).wrapping_mul(100 + (1_000_000 << 32));
    let high = ((pairs >> 16) & 0x0000_00FF_0000_00FF).wrapping_mul(1 + (10_000 << 32));
    (count, low.wrapping_add(high) >> 32)
}

/// Reads digits into `mantissa`; wraps, so the caller counts them.
#[inline(always)]
fn digits(rest: &mut &[u8], mantissa: &mut u64) -> usize {
    let before = rest.len();
    while let Some(bytes) = rest.first_chunk::<8>() {
        let (count, value) = eight_digits(*bytes);
        *mantissa = mantissa.wrapping_mul(TENS.get(count).copied().unwrap_or(1)).wrapping_add(value);
        *rest = rest.get(count..).unwrap_or_default();
        if count < 8 {
            return before - rest.len();
        }
    }
    while let [byte, tail @ ..] = rest {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        *mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        *rest = tail;
    }
    before - rest.len()
}

/// Reads one plain number from the start of `rest` and moves past it. Exact where the mantissa and the power of ten are both exact in f64
/// (W. D. Clinger, "How to read floating point numbers accurately", 1990); `None` where that doesn't hold, and `rest` is untouched.
#[inline(always)]
fn plain_number(rest: &mut &[u8]) -> Option<f64> {
    let mut text = *rest;
    let negative = match text {
        [b'-', tail @ ..] => {
            text = tail;
            true
        }
        [b'+', tail @ ..] => {
            text = tail;
            false
        }
        _ => false,
    };
    let mut mantissa = 0;
    let mut count = digits(&mut text, &mut mantissa);
    let mut power = 0i32;
    if let [b'.', tail @ ..] = text {
        text = tail;
        let decimals = digits(&mut text, &mut mantissa);
        count += decimals;
        power = -(decimals as i32);
    }
    if count == 0 || count > 19 || mantissa >= 1 << 53 {
        return None;
    }
    if let [b'e' | b'E', tail @ ..] = text {
        text = tail;
        let minus = matches!(text, [b'-', ..]);
        if let [b'-' | b'+', tail @ ..] = text {
            text = tail;
        }
        let mut exponent = 0;
        let count = digits(&mut text, &mut exponent);
        if count == 0 || count > 4 {
            return None;
        }
        power += if minus { -(exponent as i32) } else { exponent as i32 };
    }
    if !text.first().is_none_or(|b| is_blank(*b)) {
        return None;
    }
    let size = POWERS.get(power.unsigned_abs() as usize)?;
    let value = if power < 0 { mantissa as f64 / size } else { mantissa as f64 * size };
    *rest = text;
    Some(if negative { -value } else { value })
}

/// A number in any form that is met: `INF`, `NaN`, and what old C libraries print for them.
fn odd_number(entry: &[u8]) -> Option<f64> {
    let unsigned = match entry {
        [b'+', tail @ ..] => tail,
        _ => entry,
    };
    if let Ok(value) = fast_float2::parse::<f64, _>(unsigned) {
        return Some(value);
    }
    let (negative, name) = match unsigned {
        [b'-', tail @ ..] => (true, tail),
        _ => (false, unsigned),
    };
    let lower = name.to_ascii_lowercase();
    let sign = if negative { -1.0 } else { 1.0 };
    if lower.starts_with(b"1.#inf") {
        Some(sign * f64::INFINITY)
    } else if lower.starts_with(b"1.#") || lower.starts_with(b"nan") {
        Some(f64::NAN)
    } else {
        None
    }
}

/// A number with a decimal comma: one comma with something on both sides, and no point.
fn comma_number(entry: &[u8]) -> Option<f64> {
    let mut pointed = [0; 64];
    let pointed = pointed.get_mut(..entry.len())?;
    pointed.copy_from_slice(entry);
    let comma = entry.iter().position(|byte| *byte == b',')?;
    if entry.contains(&b'.') || comma + 1 == entry.len() || comma == 0 || matches!(entry, [b'+' | b'-', b',', ..]) {
        return None;
    }
    *pointed.get_mut(comma)? = b'.';
    odd_number(pointed)
}

/// Whether commas stand between numbers in an entry, or at its ends.
fn separates(entry: &[u8]) -> bool {
    entry.split(|byte| *byte == b',').all(|part| part.is_empty() || odd_number(part).is_some())
}

/// The number in an attribute, also with a decimal comma, and whether it has one; `None` where it is no finite number.
pub(super) fn attribute_number(text: &str) -> Option<(f64, bool)> {
    let text = text.trim();
    match text.parse::<f64>() {
        Ok(value) => value.is_finite().then_some((value, false)),
        Err(_) => comma_number(text.as_bytes()).filter(|value| value.is_finite()).map(|value| (value, true)),
    }
}

/// Reads a list of decimal numbers separated by blanks. A decimal comma, at most one in an entry, is read as a point.
///
/// # Errors
/// [`Comma`] at the first entry in which commas stand between numbers.
pub(super) fn reals<T: Real>(text: &str, expected: usize) -> Result<ParsedNumbers<T>, Comma> {
    let bytes = text.as_bytes();
    // A count in a file may be a lie: a number takes two bytes at least.
    let mut parsed =
        ParsedNumbers { values: Vec::with_capacity(expected.min(bytes.len() / 2 + 1)), bad: 0, first_bad: None, decimal_comma: None };
    let mut rest = bytes;
    loop {
        while let [byte, tail @ ..] = rest
            && is_blank(*byte)
        {
            rest = tail;
        }
        if rest.is_empty() {
            return Ok(parsed);
        }
        if let Some(value) = plain_number(&mut rest) {
            parsed.values.push(T::from_f64(value));
            continue;
        }
        let at = bytes.len() - rest.len();
        let end = rest.iter().position(|b| is_blank(*b)).unwrap_or(rest.len());
        let (entry, tail) = rest.split_at(end);
        rest = tail;
        match odd_number(entry) {
            Some(value) => parsed.values.push(T::from_f64(value)),
            None => match comma_number(entry) {
                Some(value) => {
                    parsed.decimal_comma.get_or_insert_with(|| shown(entry));
                    parsed.values.push(T::from_f64(value));
                }
                None if entry.contains(&b',') && separates(entry) => return Err(Comma { entry: shown(entry), at }),
                None => {
                    parsed.note_bad(entry);
                    parsed.values.push(T::from_f64(0.0));
                }
            },
        }
    }
}

/// Reads a list of whole numbers. What does not fit becomes the nearest i32; what is no number becomes `i32::MIN`.
///
/// # Errors
/// [`Comma`] at the first entry with a comma in it.
pub(super) fn integers(text: &str, expected: usize) -> Result<ParsedNumbers<i32>, Comma> {
    let bytes = text.as_bytes();
    let mut parsed =
        ParsedNumbers { values: Vec::with_capacity(expected.min(bytes.len() / 2 + 1)), bad: 0, first_bad: None, decimal_comma: None };
    let mut rest = bytes;
    loop {
        while let [byte, tail @ ..] = rest
            && is_blank(*byte)
        {
            rest = tail;
        }
        if rest.is_empty() {
            return Ok(parsed);
        }
        let mut value = 0;
        let mut after = rest;
        let count = digits(&mut after, &mut value);
        if (1..=9).contains(&count) && after.first().is_none_or(|b| is_blank(*b)) {
            // Nine digits fit.
            parsed.values.push(value as i32);
            rest = after;
            continue;
        }
        let at = bytes.len() - rest.len();
        let end = rest.iter().position(|b| is_blank(*b)).unwrap_or(rest.len());
        let (entry, tail) = rest.split_at(end);
        rest = tail;
        match std::str::from_utf8(entry).ok().and_then(whole) {
            Some(value) => parsed.values.push(value),
            None if entry.contains(&b',') => return Err(Comma { entry: shown(entry), at }),
            None => {
                parsed.note_bad(entry);
                parsed.values.push(i32::MIN);
            }
        }
    }
}

fn whole(entry: &str) -> Option<i32> {
    let digits = entry.strip_prefix(['+', '-']).unwrap_or(entry);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let negative = entry.starts_with('-');
    let size = digits.parse::<i32>().unwrap_or(i32::MAX);
    Some(if negative { -size } else { size })
}

/// The entries of a list of names.
pub(super) fn names(text: &str) -> impl Iterator<Item = &str> {
    let mut at = 0;
    std::iter::from_fn(move || next_entry(text.as_bytes(), &mut at).and_then(|range| text.get(range)))
}

/// An entry for a message: not too long.
fn shown(entry: &[u8]) -> String {
    String::from_utf8_lossy(entry.get(..entry.len().min(24)).unwrap_or(entry)).into_owned()
}

impl<T> ParsedNumbers<T> {
    fn note_bad(&mut self, entry: &[u8]) {
        self.bad += 1;
        if self.first_bad.is_none() {
            self.first_bad = Some(shown(entry));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Vec<f64> {
        reals(text, 0).map(|parsed| parsed.values).unwrap_or_default()
    }

    #[test]
    fn every_way_of_writing_a_number_is_read() {
        assert_eq!(read("\n  1e-5 +1 -.5 2. 1E3\t0007\r\n-0 1e+2"), [1e-5, 1.0, -0.5, 2.0, 1000.0, 7.0, -0.0, 100.0]);
        assert_eq!(read("INF -INF inf 1.#INF"), [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY]);
        assert!(read("NaN nan -1.#IND 1.#QNAN -nan(ind)").iter().all(|v| v.is_nan()));
        assert_eq!(read("12345678901234567890.5 1e-320 1e400"), [12345678901234567890.5, 1e-320, f64::INFINITY]);
        assert!(read(" \n ").is_empty());
    }

    #[test]
    fn one_decimal_comma_an_entry_is_a_point_and_commas_between_numbers_are_refused() {
        let parsed = reals::<f64>("-1,0 0,25 1,5e-3 -1,#IND 2.5 +7,", 6);
        assert_eq!(parsed.err(), Some(Comma { entry: "+7,".into(), at: 29 }));
        let parsed = reals::<f64>("-1,0 0,25 1,5e-3 2.5 3", 5).unwrap_or_else(|_| unreachable!("these are decimal commas"));
        assert_eq!((parsed.values, parsed.bad, parsed.decimal_comma.as_deref()), (vec![-1.0, 0.25, 1.5e-3, 2.5, 3.0], 0, Some("-1,0")));
        for refused in ["1,2,3", "1, 2, 3", "1 ,2", "1.5,2.5", "1.000,5", ",", "0,5 1,2,3"] {
            assert!(reals::<f32>(refused, 3).is_err(), "{refused}");
        }
        assert_eq!(reals::<f64>("-,5 1", 2).map(|parsed| (parsed.bad, parsed.values)).ok(), Some((1, vec![0.0, 1.0])));
        assert_eq!(attribute_number(" 0,01 "), Some((0.01, true)));
        assert_eq!(attribute_number("0.01"), Some((0.01, false)));
        for none in ["0,01,0", "inf", "x", "", "1,"] {
            assert_eq!(attribute_number(none), None, "{none}");
        }
    }

    #[test]
    fn what_is_no_number_is_counted() {
        let parsed = reals::<f32>("1 x 2e 3", 4).unwrap_or_else(|_| unreachable!("there is no comma"));
        assert_eq!((parsed.values, parsed.bad, parsed.first_bad.as_deref()), (vec![1.0, 0.0, 0.0, 3.0], 2, Some("x")));
        let parsed = reals::<f32>("1 x,y", 2).unwrap_or_else(|_| unreachable!("nothing is separated"));
        assert_eq!((parsed.values, parsed.bad), (vec![1.0, 0.0], 1));
        assert_eq!(integers("1 2, 3", 3).err(), Some(Comma { entry: "2,".into(), at: 2 }));
    }

    #[test]
    fn whole_numbers_beyond_the_range_are_held_at_it() {
        let parsed = integers("0 -1 +7 4000000000 99999999999999999999 1.0 -", 9).unwrap_or_else(|_| unreachable!("there is no comma"));
        assert_eq!(parsed.values, [0, -1, 7, i32::MAX, i32::MAX, i32::MIN, i32::MIN]);
        assert_eq!(parsed.bad, 2);
    }

    #[test]
    fn digits_are_counted_and_added_up_whatever_follows() {
        for (text, wanted) in [
            ("12345678", (8, 12_345_678)),
            ("00000001", (8, 1)),
            ("1 345678", (1, 1)),
            ("99999/:9", (5, 99_999)),
            ("7\u{7f}234567", (1, 7)),
            ("42\u{ff}\u{ff}00", (2, 42)),
            (" 2345678", (0, 0)),
            ("98765e-3", (5, 98_765)),
        ] {
            let bytes = text.as_bytes().first_chunk::<8>().copied().unwrap_or_default();
            assert_eq!(eight_digits(bytes), wanted, "{text}");
        }
    }

    #[test]
    fn names_are_cut_at_blanks() {
        assert_eq!(names(" a\n b\t\tc ").collect::<Vec<_>>(), ["a", "b", "c"]);
    }

    proptest! {
        #[test]
        fn what_was_printed_is_read_back_exactly(values in prop::collection::vec(any::<f64>().prop_filter("finite", |v| v.is_finite()), 0..20)) {
            let text: Vec<String> = values.iter().enumerate().map(|(i, v)| if i % 2 == 0 { format!("{v}") } else { format!("{v:e}") }).collect();
            prop_assert_eq!(read(&text.join(" ")), values);
        }

        #[test]
        fn a_comma_for_the_point_changes_no_value(values in prop::collection::vec(-1e9..1e9f64, 1..20)) {
            let text: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
            let text = text.join(" ");
            prop_assert_eq!(read(&text.replace('.', ",")), read(&text));
        }

        #[test]
        fn any_text_at_all_ends(text in "\\PC{0,60}") {
            let _ = reals::<f32>(&text, usize::MAX);
            let _ = integers(&text, usize::MAX);
            let _ = names(&text).count();
        }
    }
}
