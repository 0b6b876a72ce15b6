//! From the YAML tree to values, with an error that names key and place for each value that does not fit.

use super::error::{ConfigErrorKind, DecodeError, ValueName, WantedKind};
use super::yaml::{Step, Yaml};
use sinew_yaml::ValueKind;

/// A value together with where it stands and what it is called.
#[derive(Debug, Clone)]
pub(super) struct At<'a> {
    /// The value.
    pub value: &'a Yaml,
    /// Where in the tree.
    pub path: Vec<Step>,
    /// What errors call it.
    name: ValueName,
}

impl<'a> At<'a> {
    /// The root of a file.
    pub(super) fn root(value: &'a Yaml) -> Self {
        Self { value, path: Vec::new(), name: ValueName { key: None, items: Vec::new() } }
    }

    /// What errors call it.
    pub(super) fn name(&self) -> ValueName {
        self.name.clone()
    }

    /// An error about this value.
    pub(super) fn error(&self, kind: ConfigErrorKind) -> DecodeError {
        DecodeError { path: self.path.clone(), kind }
    }

    fn wrong(&self, wanted: WantedKind) -> DecodeError {
        let found = match self.value {
            Yaml::Null => ValueKind::Null,
            Yaml::Bool => ValueKind::Bool,
            Yaml::Number(_) => ValueKind::Number,
            Yaml::Text(_) => ValueKind::Text,
            Yaml::List(_) => ValueKind::List,
            Yaml::Map(_) => ValueKind::Map,
            Yaml::Tagged => ValueKind::Tagged,
        };
        self.error(ConfigErrorKind::WrongType { name: self.name(), wanted, found })
    }

    /// A finite number.
    pub(super) fn number(&self) -> Result<f64, DecodeError> {
        match self.value {
            Yaml::Number(number) if number.is_finite() => Ok(*number),
            Yaml::Number(_) => Err(self.error(ConfigErrorKind::NotFinite(self.name()))),
            Yaml::Text(text) if text.replace(',', ".").trim().parse::<f64>().is_ok() => {
                Err(self.error(ConfigErrorKind::NumberAsText { name: self.name(), text: text.clone() }))
            }
            _ => Err(self.wrong(WantedKind::Number)),
        }
    }

    /// A number above zero, or not below it where `or_zero`.
    pub(super) fn positive(&self, or_zero: bool) -> Result<f64, DecodeError> {
        let number = self.number()?;
        if number > 0.0 || (or_zero && number == 0.0) {
            return Ok(number);
        }
        let (name, value) = (self.name(), number);
        Err(self.error(if or_zero { ConfigErrorKind::Negative { name, value } } else { ConfigErrorKind::NotPositive { name, value } }))
    }

    /// Text.
    pub(super) fn text(&self) -> Result<&'a str, DecodeError> {
        match self.value {
            Yaml::Text(text) => Ok(text),
            _ => Err(self.wrong(WantedKind::Text)),
        }
    }

    /// The items of a list, each named after the list.
    pub(super) fn items(&self) -> Result<Vec<At<'a>>, DecodeError> {
        let Yaml::List(items) = self.value else { return Err(self.wrong(WantedKind::List)) };
        let at = |(index, value)| At {
            value,
            path: self.below(Step::Item(index)),
            name: ValueName { items: self.name.items.iter().copied().chain([index + 1]).collect(), ..self.name },
        };
        Ok(items.iter().enumerate().map(at).collect())
    }

    /// A list of numbers of any length.
    pub(super) fn numbers(&self) -> Result<Vec<f64>, DecodeError> {
        self.items()?.iter().map(At::number).collect()
    }

    /// A list of exactly `N` numbers.
    pub(super) fn some_numbers<const N: usize>(&self) -> Result<[f64; N], DecodeError> {
        let numbers = self.numbers()?;
        let count = numbers.len();
        <[f64; N]>::try_from(numbers).map_err(|_| self.error(ConfigErrorKind::WrongCount { name: self.name(), wanted: N, found: count }))
    }

    /// A mapping whose keys are all among `known`.
    pub(super) fn map(&self, known: &'static [&'static str]) -> Result<Map<'a>, DecodeError> {
        let Yaml::Map(entries) = self.value else { return Err(self.wrong(WantedKind::Map)) };
        let mut seen: Vec<&str> = Vec::new();
        for (index, (key, _)) in entries.iter().enumerate() {
            let refuse = |kind| Err(DecodeError { path: self.below(Step::Key(index)), kind });
            let Some(key) = key else { return refuse(ConfigErrorKind::KeyNotText(self.name())) };
            if !known.contains(&key.as_str()) {
                return refuse(ConfigErrorKind::UnknownKey { key: key.clone(), near: nearest(key, known), known });
            }
            if seen.contains(&key.as_str()) {
                return refuse(ConfigErrorKind::RepeatedKey(key.clone()));
            }
            seen.push(key);
        }
        Ok(Map { entries, path: self.path.clone(), name: self.name() })
    }

    /// Whether the value is a mapping with this key.
    pub(super) fn has(&self, key: &str) -> bool {
        matches!(self.value, Yaml::Map(entries) if entries.iter().any(|(name, _)| name.as_deref() == Some(key)))
    }

    fn below(&self, step: Step) -> Vec<Step> {
        let mut path = self.path.clone();
        path.push(step);
        path
    }
}

/// A mapping whose keys are known.
#[derive(Debug)]
pub(super) struct Map<'a> {
    entries: &'a [(Option<String>, Yaml)],
    path: Vec<Step>,
    name: ValueName,
}

impl<'a> Map<'a> {
    /// The value of a key that may be left out; an empty one counts as left out.
    pub(super) fn get(&self, key: &'static str) -> Option<At<'a>> {
        let (index, (_, value)) = self.entries.iter().enumerate().find(|(_, (name, _))| name.as_deref() == Some(key))?;
        let mut path = self.path.clone();
        path.push(Step::Value(index));
        (*value != Yaml::Null).then(|| At { value, path, name: ValueName { key: Some(key), items: Vec::new() } })
    }

    /// The value of a key that must be there.
    pub(super) fn need(&self, key: &'static str) -> Result<At<'a>, DecodeError> {
        self.get(key)
            .ok_or_else(|| DecodeError { path: self.path.clone(), kind: ConfigErrorKind::MissingKey { key, name: self.name.clone() } })
    }
}

/// The known key that `key` was probably meant to be: at most a third of its letters differ.
pub(super) fn nearest(key: &str, known: &[&'static str]) -> Option<&'static str> {
    // Long keys are nothing anybody mistyped, and comparing them costs.
    if key.len() > 60 {
        return None;
    }
    let lower = key.to_lowercase();
    known
        .iter()
        .map(|name| (distance(&lower, name), *name))
        .min()
        .filter(|(far, name)| *far <= name.len().div_ceil(3).max(2))
        .map(|(_, name)| name)
}

/// Levenshtein's distance.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut corner = i;
        let mut left = i + 1;
        for (y, cell) in b.iter().zip(row.iter_mut().skip(1)) {
            let next = (corner + usize::from(x != *y)).min(left + 1).min(*cell + 1);
            corner = *cell;
            *cell = next;
            left = next;
        }
        if let Some(first) = row.first_mut() {
            *first = i + 1;
        }
    }
    row.last().copied().unwrap_or(0)
}
