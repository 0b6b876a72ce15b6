//! From the YAML tree to values, with a complaint that names key, place and remedy for whatever does not fit.

use std::rc::Rc;

use super::yaml::{Step, Yaml};
use crate::i18n::shortened;
use crate::tr;

/// A complaint about the value at a path.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Complaint {
    /// Where in the tree.
    pub path: Vec<Step>,
    /// The sentence.
    pub message: String,
}

/// A value together with where it stands and what it is called.
#[derive(Debug, Clone)]
pub(super) struct At<'a> {
    /// The value.
    pub value: &'a Yaml,
    /// Where in the tree.
    pub path: Vec<Step>,
    /// The key that it or the list round it belongs to.
    key: Rc<str>,
    /// Its places in that list, from 1.
    numbers: Vec<usize>,
}

impl<'a> At<'a> {
    /// The root of a file.
    pub(super) fn root(value: &'a Yaml) -> Self {
        Self { value, path: Vec::new(), key: tr!("muscle-yaml-the-file").into(), numbers: Vec::new() }
    }

    /// What messages call it: the key, or the key and the number of the item. Made for a message only: a list may have many items.
    pub(super) fn name(&self) -> String {
        let named = |name: String, number: &usize| tr!("muscle-yaml-item", name = name, number = *number);
        self.numbers.iter().fold(self.key.to_string(), named)
    }

    /// A complaint about this value.
    pub(super) fn complain(&self, message: String) -> Complaint {
        Complaint { path: self.path.clone(), message }
    }

    fn wrong(&self, wanted: &str) -> Complaint {
        let found = match self.value {
            Yaml::Null => tr!("document-yaml-found-nothing"),
            Yaml::Bool => tr!("document-yaml-found-bool"),
            Yaml::Number(_) => tr!("document-yaml-found-number"),
            Yaml::Text(_) => tr!("document-yaml-found-text"),
            Yaml::List(_) => tr!("document-yaml-found-list"),
            Yaml::Map(_) => tr!("document-yaml-found-map"),
            Yaml::Tagged => tr!("document-yaml-found-tag"),
        };
        self.complain(tr!("muscle-yaml-wrong-type", name = self.name(), wanted = message_of(wanted), found = found))
    }

    /// A finite number.
    pub(super) fn number(&self) -> Result<f64, Complaint> {
        match self.value {
            Yaml::Number(number) if number.is_finite() => Ok(*number),
            Yaml::Number(_) => Err(self.complain(tr!("muscle-yaml-not-finite", name = self.name()))),
            Yaml::Text(text) if text.replace(',', ".").trim().parse::<f64>().is_ok() => {
                let number = text.replace(',', ".").trim().to_owned();
                Err(self.complain(tr!("muscle-yaml-number-as-text", name = self.name(), text = shortened(text), number = number)))
            }
            _ => Err(self.wrong("muscle-yaml-a-number")),
        }
    }

    /// A number above zero, or from zero on where `or_zero`.
    pub(super) fn positive(&self, or_zero: bool) -> Result<f64, Complaint> {
        let number = self.number()?;
        if number > 0.0 || (or_zero && number == 0.0) {
            Ok(number)
        } else {
            let key = if or_zero { "muscle-yaml-negative" } else { "muscle-yaml-not-positive" };
            Err(self.complain(crate::i18n::message(key, &[("name", self.name().into()), ("value", format!("{number}").into())])))
        }
    }

    /// Text.
    pub(super) fn text(&self) -> Result<&'a str, Complaint> {
        match self.value {
            Yaml::Text(text) => Ok(text),
            _ => Err(self.wrong("muscle-yaml-a-text")),
        }
    }

    /// The items of a list, each named after the list.
    pub(super) fn items(&self) -> Result<Vec<At<'a>>, Complaint> {
        let Yaml::List(items) = self.value else { return Err(self.wrong("muscle-yaml-a-list")) };
        let at = |(index, value)| At {
            value,
            path: self.below(Step::Item(index)),
            key: Rc::clone(&self.key),
            numbers: self.numbers.iter().copied().chain([index + 1]).collect(),
        };
        Ok(items.iter().enumerate().map(at).collect())
    }

    /// A list of numbers of any length.
    pub(super) fn numbers(&self) -> Result<Vec<f64>, Complaint> {
        self.items()?.iter().map(At::number).collect()
    }

    /// A list of exactly `N` numbers.
    pub(super) fn some_numbers<const N: usize>(&self) -> Result<[f64; N], Complaint> {
        let numbers = self.numbers()?;
        let count = numbers.len();
        <[f64; N]>::try_from(numbers)
            .map_err(|_| self.complain(tr!("muscle-yaml-wrong-count", name = self.name(), wanted = N, found = count)))
    }

    /// A mapping whose keys are all among `known`.
    pub(super) fn map(&self, known: &'static [&'static str]) -> Result<Map<'a>, Complaint> {
        let Yaml::Map(entries) = self.value else { return Err(self.wrong("muscle-yaml-a-map")) };
        let mut seen: Vec<&str> = Vec::new();
        for (index, (key, _)) in entries.iter().enumerate() {
            let refuse = |message| Err(Complaint { path: self.below(Step::Key(index)), message });
            let Some(key) = key else { return refuse(tr!("muscle-yaml-key-not-text", name = self.name())) };
            if !known.contains(&key.as_str()) {
                let list = known.join(", ");
                return refuse(match nearest(key, known) {
                    Some(near) => tr!("muscle-yaml-unknown-key-near", key = shortened(key), near = near, known = list),
                    None => tr!("muscle-yaml-unknown-key", key = shortened(key), known = list),
                });
            }
            if seen.contains(&key.as_str()) {
                return refuse(tr!("muscle-yaml-repeated-key", key = shortened(key)));
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
    name: String,
}

impl<'a> Map<'a> {
    /// The value of a key that may be left out; an empty one counts as left out.
    pub(super) fn get(&self, key: &str) -> Option<At<'a>> {
        let (index, (_, value)) = self.entries.iter().enumerate().find(|(_, (name, _))| name.as_deref() == Some(key))?;
        let mut path = self.path.clone();
        path.push(Step::Value(index));
        (*value != Yaml::Null).then(|| At { value, path, key: key.into(), numbers: Vec::new() })
    }

    /// The value of a key that must be there.
    pub(super) fn need(&self, key: &str) -> Result<At<'a>, Complaint> {
        self.get(key).ok_or_else(|| Complaint {
            path: self.path.clone(),
            message: tr!("muscle-yaml-missing-key", key = key.to_owned(), name = self.name.clone()),
        })
    }
}

fn message_of(key: &str) -> String {
    crate::i18n::message(key, &[])
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
