//! A text to a tree, within bounds.

use std::rc::Rc;

use rustc_hash::FxHashMap;
use saphyr_parser::{Event, Marker, Parser, ScalarStyle, Span, Tag};

use super::reasons::reason;
use super::{Scalar, SyntaxReason, YamlError, YamlErrorKind};
use sinew_scene::limits;

/// Line and column, both from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Line from 1.
    pub line: u32,
    /// Column from 1, in letters.
    pub column: u32,
}

impl Place {
    fn of(marker: &Marker) -> Self {
        let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Self { line: number(marker.line()), column: number(marker.col().saturating_add(1)) }
    }
}

/// A value and where it stands. To copy one is cheap: what is in it is shared.
#[derive(Debug, Clone)]
pub struct Node {
    /// Where it stands; of an alias, where the alias does.
    pub place: Place,
    /// What it is.
    pub value: Value,
}

/// What stands in a text.
#[derive(Debug, Clone)]
pub enum Value {
    /// A word without quotes; [`Scalar::of`] knows what it means.
    Plain(Rc<str>),
    /// Text in quotes, or a block of it.
    Text(Rc<str>),
    /// A list.
    List(Rc<[Node]>),
    /// Keys and values, in the order of the text.
    Map(Rc<[(Node, Node)]>),
    /// A value with a tag of its own, such as `!thing`.
    Tagged,
}

impl Node {
    /// Whether nothing stands there.
    pub fn is_null(&self) -> bool {
        matches!(&self.value, Value::Plain(word) if Scalar::of(word) == Scalar::Null)
    }
}

/// What a value amounts to, everything below it and behind its aliases included.
#[derive(Debug, Clone, Copy, Default)]
struct Amount {
    values: usize,
    text: usize,
    /// Levels of lists and mappings.
    depth: usize,
}

/// A list or mapping that is not closed yet.
struct Open {
    place: Place,
    anchor: usize,
    tagged: bool,
    kind: Kind,
    amount: Amount,
}

enum Kind {
    List(Vec<Node>),
    Map(Vec<(Node, Node)>, Option<Node>),
}

#[derive(Default)]
struct TreeBuilder<'t> {
    text: &'t str,
    /// The lines of the text, found when the first block scalar asks for them.
    lines: Option<Vec<&'t str>>,
    open: Vec<Open>,
    anchors: FxHashMap<usize, (Node, Amount)>,
    total: Amount,
    root: Option<Node>,
}

/// Reads the one document of a text of at most `bytes` bytes; a byte order mark before it is passed over. A text without a value is one that is null.
///
/// # Errors
/// [`YamlError`] for what is not YAML, for a second document, and for what goes beyond a bound of [`limits`].
pub fn read(text: &str, bytes: u64) -> Result<Node, YamlError> {
    if text.len() as u64 > bytes {
        return Err(YamlError::whole(YamlErrorKind::TooLarge(bytes)));
    }
    look_over(text, bytes)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reading = TreeBuilder { text, ..TreeBuilder::default() };
    let mut parser = Parser::new_from_str(text);
    let mut documents = 0;
    while let Some(event) = parser.next_event() {
        let (event, span) = event.map_err(|error| {
            let before = text.char_indices().nth(error.marker().index()).map_or(text, |(end, _)| text.get(..end).unwrap_or(text));
            YamlError::at(Place::of(error.marker()), refusal(error.info(), before))
        })?;
        let place = Place::of(&span.start);
        match event {
            Event::DocumentStart(_) => {
                documents += 1;
                if documents > 1 {
                    return Err(YamlError::at(place, YamlErrorKind::SeveralDocuments));
                }
            }
            Event::StreamEnd => break,
            event => reading.take(event, &span)?,
        }
    }
    Ok(reading.root.unwrap_or_else(|| Node { place: Place { line: 1, column: 1 }, value: Value::Plain("".into()) }))
}

/// Refuses a text in which more stands than may be read, before the parser sees it: inside brackets it gathers all that is there before it tells of the
/// first value.
fn look_over(text: &str, bytes: u64) -> Result<(), YamlError> {
    let most = limits::YAML_SIGNS.saturating_mul(usize::try_from(bytes / limits::YAML_BYTES).unwrap_or(usize::MAX).max(1));
    let (mut signs, mut directives, mut line) = (0_usize, 0_usize, 1_u32);
    let mut before = b'\n';
    for byte in text.bytes() {
        match byte {
            b'\n' => line = line.saturating_add(1),
            b',' | b'[' | b']' | b'{' | b'}' | b':' | b'?' | b'&' | b'*' | b'!' | b'"' | b'\'' => signs += 1,
            b'%' if before == b'\n' => directives += 1,
            _ => {}
        }
        let place = Place { line, column: 1 };
        if signs > most {
            return Err(YamlError::at(place, YamlErrorKind::TooManyValues));
        }
        if directives > limits::YAML_DIRECTIVES {
            return Err(YamlError::at(place, YamlErrorKind::Syntax(SyntaxReason::Directive)));
        }
        before = byte;
    }
    Ok(())
}

/// The parser has a bound of its own on brackets, which is beyond ours but met earlier where many stand on one line.
fn refusal(info: &str, before: &str) -> YamlErrorKind {
    if info.contains("recursion limit") {
        return YamlErrorKind::TooDeep;
    }
    // A colon out of place inside brackets most often stands behind one that was not closed.
    YamlErrorKind::Syntax(match (reason(info), unclosed(before)) {
        (SyntaxReason::Colon, Some(']')) => SyntaxReason::List,
        (SyntaxReason::Colon, Some('}')) => SyntaxReason::Map,
        (reason, _) => reason,
    })
}

/// The bracket that is missing at the end of a text; brackets in quotes and comments count too, which matters for the wording of an error alone.
fn unclosed(text: &str) -> Option<char> {
    let mut open = Vec::new();
    for letter in text.chars() {
        match letter {
            '[' => open.push(']'),
            '{' => open.push('}'),
            ']' | '}' => drop(open.pop()),
            _ => {}
        }
    }
    open.pop()
}

impl TreeBuilder<'_> {
    fn take(&mut self, event: Event<'_>, span: &Span) -> Result<(), YamlError> {
        let place = Place::of(&span.start);
        match event {
            Event::Scalar(text, style, anchor, tag) => {
                let amount = Amount { values: 1, text: text.len(), depth: 0 };
                let is_block = matches!(style, ScalarStyle::Literal | ScalarStyle::Folded);
                let place = if is_block { self.mark_of_block(place).unwrap_or(place) } else { place };
                self.count(amount, place)?;
                let value = match tag.as_deref().map(kind_of_tag) {
                    None if style == ScalarStyle::Plain => Value::Plain(text.as_ref().into()),
                    Some(Tagging::Resolved) => Value::Plain(text.as_ref().into()),
                    None | Some(Tagging::Text) => Value::Text(text.as_ref().into()),
                    Some(Tagging::Own) => Value::Tagged,
                };
                self.close(Node { place, value }, anchor, amount);
            }
            Event::SequenceStart(anchor, tag) => self.begin(Kind::List(Vec::new()), anchor, tag.as_deref(), place)?,
            Event::MappingStart(anchor, tag) => self.begin(Kind::Map(Vec::new(), None), anchor, tag.as_deref(), place)?,
            Event::SequenceEnd | Event::MappingEnd => {
                let Some(Open { place, anchor, tagged, kind, mut amount }) = self.open.pop() else { return Ok(()) };
                amount.depth += 1;
                let value = match kind {
                    _ if tagged => Value::Tagged,
                    Kind::List(items) => Value::List(items.into()),
                    Kind::Map(entries, _) => Value::Map(entries.into()),
                };
                self.close(Node { place, value }, anchor, amount);
            }
            Event::Alias(anchor) => {
                // What is not closed yet has no entry: an alias of it would be inside itself.
                let Some((node, amount)) = self.anchors.get(&anchor) else {
                    return Err(YamlError::at(place, YamlErrorKind::AliasInItself));
                };
                let (value, amount) = (node.value.clone(), *amount);
                self.count(amount, place)?;
                self.close(Node { place, value }, 0, amount);
            }
            Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentStart(_) | Event::DocumentEnd => {}
        }
        Ok(())
    }

    /// Where the `|` or `>` of a block scalar stands; the parser tells where its first line does.
    fn mark_of_block(&mut self, first: Place) -> Option<Place> {
        let text = self.text;
        let lines = self.lines.get_or_insert_with(|| text.lines().collect());
        let above = lines.get(..(first.line as usize).checked_sub(1)?)?;
        let row = above.iter().rposition(|line| !line.trim().is_empty())?;
        let header = above.get(row)?.split(" #").next()?.trim_end();
        let at = header.rfind(['|', '>'])?;
        let is_mark = header.get(at + 1..)?.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'+' | b'-'));
        let column = header.get(..at)?.chars().count();
        is_mark.then(|| Place { line: row as u32 + 1, column: column as u32 + 1 })
    }

    /// Adds to what there is and holds it against the bounds.
    fn count(&mut self, amount: Amount, place: Place) -> Result<(), YamlError> {
        let refuse = |kind| Err(YamlError::at(place, kind));
        self.total.values = self.total.values.saturating_add(amount.values);
        self.total.text = self.total.text.saturating_add(amount.text);
        if self.open.len().saturating_add(amount.depth) > limits::YAML_DEPTH {
            return refuse(YamlErrorKind::TooDeep);
        }
        if self.total.values > limits::YAML_VALUES {
            return refuse(YamlErrorKind::TooManyValues);
        }
        if self.total.text > limits::YAML_TEXT {
            return refuse(YamlErrorKind::TooMuchText);
        }
        Ok(())
    }

    fn begin(&mut self, kind: Kind, anchor: usize, tag: Option<&Tag>, place: Place) -> Result<(), YamlError> {
        let amount = Amount { values: 1, ..Amount::default() };
        self.count(Amount { depth: 1, ..amount }, place)?;
        let tagged = tag.is_some_and(|tag| kind_of_tag(tag) == Tagging::Own);
        self.open.push(Open { place, anchor, tagged, kind, amount });
        Ok(())
    }

    /// Puts a whole value where it belongs.
    fn close(&mut self, node: Node, anchor: usize, amount: Amount) {
        if anchor != 0 {
            self.anchors.insert(anchor, (node.clone(), amount));
        }
        let Some(open) = self.open.last_mut() else {
            self.root = Some(node);
            return;
        };
        open.amount.values = open.amount.values.saturating_add(amount.values);
        open.amount.text = open.amount.text.saturating_add(amount.text);
        open.amount.depth = open.amount.depth.max(amount.depth);
        match &mut open.kind {
            Kind::List(items) => items.push(node),
            Kind::Map(entries, key) => match key.take() {
                None => *key = Some(node),
                Some(key) => entries.push((key, node)),
            },
        }
    }
}

/// What a tag makes of a value.
#[derive(PartialEq, Eq)]
enum Tagging {
    /// What the word means without one.
    Resolved,
    /// Text, whatever it looks like.
    Text,
    /// Something that nobody here knows.
    Own,
}

fn kind_of_tag(tag: &Tag) -> Tagging {
    match (tag.is_yaml_core_schema(), tag.suffix.as_str()) {
        (true, "str") => Tagging::Text,
        (true, "int" | "float" | "bool" | "null" | "seq" | "map") => Tagging::Resolved,
        (false, "") => Tagging::Text,
        _ => Tagging::Own,
    }
}
