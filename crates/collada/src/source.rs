//! Sources: arrays of numbers or names, and the accessors that say how to walk them.

use std::borrow::Cow;
use std::rc::Rc;

use roxmltree::NodeId;
use rustc_hash::{FxHashMap, FxHashSet};

use super::context::{Context, ReadResult, child, children};
use super::numbers::{Real, names};
use super::{El, Finding};

/// The tags of arrays that hold numbers, and of those that hold names.
const NUMBER_ARRAYS: [&str; 2] = ["float_array", "int_array"];
const NAME_ARRAYS: [&str; 4] = ["Name_array", "IDREF_array", "SIDREF_array", "bool_array"];

/// A view on an array: rows of components.
#[derive(Debug, Clone)]
pub(super) struct Accessor<T> {
    data: Rc<Vec<T>>,
    array: NodeId,
    offset: usize,
    stride: usize,
    /// Rows that the file says there are, as far as the data reach.
    pub count: usize,
    /// Rows that the data reach for.
    pub available: usize,
    /// Rows that the accessor says there are.
    pub said: Option<usize>,
    /// Which numbers of a row count; a `param` without a name leaves its number out.
    components: Vec<usize>,
}

impl<T: Copy> Accessor<T> {
    /// Numbers a row.
    pub(super) fn width(&self) -> usize {
        self.components.len()
    }

    /// One number; `None` outside of the data.
    pub(super) fn get(&self, row: usize, component: usize) -> Option<T> {
        let column = self.components.get(component)?;
        self.data.get(row.checked_mul(self.stride)?.checked_add(self.offset)?.checked_add(*column)?).copied()
    }

    /// The first numbers of a row, with `fill` for those that it lacks.
    pub(super) fn row<const N: usize>(&self, row: usize, fill: [T; N]) -> [T; N] {
        let start = row.saturating_mul(self.stride).saturating_add(self.offset);
        let mut values = fill;
        for (value, column) in values.iter_mut().zip(&self.components) {
            if let Some(found) = self.data.get(start.saturating_add(*column)) {
                *value = *found;
            }
        }
        values
    }

    /// All numbers of the first `count` rows, as far as the data reach.
    pub(super) fn first_rows(&self, count: usize) -> Vec<T> {
        let count = count.min(self.available);
        let dense = self.components.len() == self.stride && self.components.iter().enumerate().all(|(place, column)| place == *column);
        if dense {
            let rows = self.data.get(self.offset..).and_then(|data| data.get(..count.checked_mul(self.stride)?));
            return rows.map(<[T]>::to_vec).unwrap_or_default();
        }
        let mut values = Vec::with_capacity(count * self.width());
        for row in 0..count {
            values.extend((0..self.width()).filter_map(|component| self.get(row, component)));
        }
        values
    }
}

/// The arrays that were read, so that each is read once.
pub(super) struct Arrays<T> {
    read: FxHashMap<NodeId, Rc<Vec<T>>>,
    /// Accessors whose count was found wrong, so that it is said once.
    said: FxHashSet<NodeId>,
    /// The same for their strides.
    said_stride: FxHashSet<NodeId>,
    /// Arrays that were let go once; when they are asked for again, they are kept.
    released: FxHashSet<NodeId>,
}

impl<T> Default for Arrays<T> {
    fn default() -> Self {
        Self { read: FxHashMap::default(), said: FxHashSet::default(), said_stride: FxHashSet::default(), released: FxHashSet::default() }
    }
}

impl<T: Real> Arrays<T> {
    /// The accessor of a source of numbers. `width` is what its use expects, for sources that don't say. `None` where there are no numbers.
    ///
    /// # Errors
    /// Where commas separate the numbers of the array.
    pub(super) fn accessor<'a>(&mut self, context: &mut Context<'a>, source: El<'a>, width: usize) -> ReadResult<Option<Accessor<T>>> {
        let accessor = child(source, "technique_common").and_then(|technique| child(technique, "accessor"));
        let Some(array) = array_of(context, source, accessor, &NUMBER_ARRAYS) else { return Ok(None) };
        let data = self.array(context, array)?;
        let (layout, given) = match accessor {
            Some(accessor) => (AccessorLayout::of(accessor, width), number_attribute(accessor, "count")),
            None => (AccessorLayout { offset: 0, stride: width.max(1), components: (0..width.max(1)).collect(), small: None }, None),
        };
        let reach = layout.components.iter().max().map_or(1, |last| last + 1);
        let room = data.len().checked_sub(layout.offset.saturating_add(reach));
        let available = room.map_or(0, |room| room / layout.stride + 1);
        // Fewer rows than there are is how accessors share an array. None at all, or as few as the array itself wrongly says, is a wrong count.
        let array_said = number_attribute(array, "count").filter(|said| *said != data.len());
        let follows_array =
            |given: usize| array_said.is_some_and(|said| given.saturating_mul(layout.stride).saturating_add(layout.offset) == said);
        let count = match given {
            Some(given) if given <= available && given > 0 && !follows_array(given) => given,
            _ => available,
        };
        if let (Some(given), Some(accessor)) = (given, accessor)
            && given != count
            // The array's own count was told already.
            && !follows_array(given)
            && self.said.insert(accessor.id())
        {
            context.report.wrong_count(accessor, given, available);
        }
        if let (Some(small), Some(accessor)) = (layout.small, accessor)
            && self.said_stride.insert(accessor.id())
        {
            context.report.report(accessor, Finding::StrideMismatch { said: small, found: layout.stride });
        }
        Ok(Some(Accessor {
            data,
            array: array.id(),
            offset: layout.offset,
            stride: layout.stride,
            count,
            available,
            said: given,
            components: layout.components,
        }))
    }

    /// Lets go of the numbers that `accessor` walks, most of which are used once. What is used twice stays from then on.
    pub(super) fn release(&mut self, accessor: Accessor<T>) {
        let (id, data) = (accessor.array, accessor.data);
        if Rc::strong_count(&data) == 2 && self.released.insert(id) {
            self.read.remove(&id);
        }
    }

    fn array<'a>(&mut self, context: &mut Context<'a>, array: El<'a>) -> ReadResult<Rc<Vec<T>>> {
        if let Some(known) = self.read.get(&array.id()) {
            return Ok(known.clone());
        }
        let said = number_attribute(array, "count");
        let values: Vec<T> = context.reals(array, said.unwrap_or(0))?;
        if let Some(said) = said
            && said != values.len()
        {
            context.report.wrong_count(array, said, values.len());
        }
        let values = Rc::new(values);
        self.read.insert(array.id(), values.clone());
        Ok(values)
    }
}

/// How an accessor walks its array.
struct AccessorLayout {
    offset: usize,
    stride: usize,
    components: Vec<usize>,
    /// The stride that the file gives, where its params take more.
    small: Option<usize>,
}

impl AccessorLayout {
    fn of(accessor: El<'_>, width: usize) -> Self {
        let params: Vec<(bool, usize)> = children(accessor, "param")
            .take(256)
            .map(|param| {
                (param.attribute("name").is_some_and(|name| !name.is_empty()), param_size(param.attribute("type").unwrap_or_default()))
            })
            .collect();
        let size: usize = params.iter().map(|(_, size)| size).sum();
        let params_count = params.len();
        // Many exporters name no param at all; then all are meant.
        let any_named = params.iter().any(|(named, _)| *named);
        let mut components = Vec::new();
        let mut at = 0;
        for (named, size) in params {
            if named || !any_named {
                components.extend(at..at + size);
            }
            at += size;
        }
        let given = number_attribute(accessor, "stride").filter(|stride| *stride > 0);
        let small = given.filter(|stride| *stride < size);
        let stride = given.map_or(if size > 0 { size } else { width.max(1) }, |stride| stride.max(size));
        // No param, or one plain one for the whole row: the stride tells. One that has a name stands for all where they are as many as expected.
        let one_for_all = components.len() == 1 && size == 1 && stride > 1 && (!any_named || (params_count == 1 && stride == width));
        if components.is_empty() || one_for_all {
            components = (0..stride.min(256)).collect();
        }
        Self { offset: number_attribute(accessor, "offset").unwrap_or(0), stride, components, small }
    }
}

/// Numbers that a param of this type takes.
fn param_size(kind: &str) -> usize {
    let digits: Vec<usize> = kind.chars().filter_map(|c| c.to_digit(10)).map(|d| d as usize).collect();
    match digits.as_slice() {
        [rows, columns] if (1..=4).contains(rows) && (1..=4).contains(columns) => rows * columns,
        [size] if (1..=4).contains(size) => *size,
        _ => 1,
    }
}

/// A whole number in an attribute; `None` where it is missing or none.
pub(super) fn number_attribute(element: El<'_>, key: &str) -> Option<usize> {
    element.attribute(key).and_then(|value| value.trim().parse().ok())
}

fn array_of<'a>(context: &mut Context<'a>, source: El<'a>, accessor: Option<El<'a>>, tags: &[&str]) -> Option<El<'a>> {
    let own = source.children().find(|child| tags.contains(&child.tag_name().name()));
    match accessor.and_then(|accessor| accessor.attribute("source").map(|url| (accessor, url))) {
        // The usual case, without a look into the index.
        Some((_, url)) if own.is_some_and(|own| own.attribute("id").is_some_and(|id| url.strip_prefix('#') == Some(id))) => own,
        Some((accessor, url)) => match context.lookup.url(accessor, url) {
            super::lookup::Url::Here { document, id } => context.lookup.in_document(accessor, document, &id, tags).or(own),
            super::lookup::Url::External(_) => own.or_else(|| context.resolve(accessor, url, tags)),
        },
        None => own,
    }
}

/// What the names of a list are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NameKind {
    /// Plain names: sids, mostly.
    Name,
    /// Ids.
    IdRef,
    /// Paths of ids and sids.
    SidRef,
}

/// A source of names.
pub(super) struct NameList<'a> {
    text: Cow<'a, str>,
    offset: usize,
    stride: usize,
    /// How many the accessor says there are.
    pub said: Option<usize>,
    /// What the names are.
    pub kind: NameKind,
}

impl NameList<'_> {
    /// The entries, whether or not the accessor counts them.
    pub(super) fn entries(&self) -> impl Iterator<Item = &str> {
        names(&self.text).skip(self.offset).step_by(self.stride)
    }
}

/// The names of a source; `None` where it has none.
pub(super) fn name_list<'a>(context: &mut Context<'a>, source: El<'a>) -> Option<NameList<'a>> {
    let accessor = child(source, "technique_common").and_then(|technique| child(technique, "accessor"));
    let array = array_of(context, source, accessor, &NAME_ARRAYS)?;
    let kind = match array.tag_name().name() {
        "IDREF_array" => NameKind::IdRef,
        "SIDREF_array" => NameKind::SidRef,
        _ => NameKind::Name,
    };
    let attribute = |key| accessor.and_then(|accessor| number_attribute(accessor, key));
    Some(NameList {
        text: context.list_of(array),
        offset: attribute("offset").unwrap_or(0),
        stride: attribute("stride").unwrap_or(1).max(1),
        said: attribute("count").filter(|count| *count > 0),
        kind,
    })
}

/// An `input` of a mesh, skin, morph or sampler.
#[derive(Debug, Clone, Copy)]
pub(super) struct Input<'a> {
    /// The element.
    pub element: El<'a>,
    /// What it holds, such as `POSITION`.
    pub semantic: &'a str,
    /// Where its index stands among those of a corner.
    pub offset: usize,
    /// Its set, where the file says.
    pub set: Option<u32>,
}

/// The inputs of an element.
pub(super) fn inputs<'a>(parent: El<'a>) -> Vec<Input<'a>> {
    children(parent, "input")
        .map(|element| Input {
            element,
            semantic: element.attribute("semantic").unwrap_or_default(),
            // 1.3 called it `idx`. An offset that is no number cannot be met by any index.
            offset: number_attribute(element, "offset").or_else(|| number_attribute(element, "idx")).unwrap_or(0),
            set: element.attribute("set").and_then(|set| set.trim().parse().ok()),
        })
        .collect()
}
