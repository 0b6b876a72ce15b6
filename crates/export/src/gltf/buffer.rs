//! The one binary buffer of a file, with its views and accessors (glTF 2.0, section 3.6).

use serde_json::{Value, json};

use sinew_scene::limits;

/// Component types of accessors, by their numbers in the format.
const BYTE: u32 = 5121;
const SHORT: u32 = 5123;
const INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// What an entry of the JSON takes while it is put together, roughly, bytes.
pub(super) const ENTRY: usize = 1_024;

/// What a sparse accessor takes of the JSON beside a dense one, roughly, bytes.
const SPARSE_JSON: usize = 200;

/// The smallest and the largest number of each column; zeros where there are no rows.
fn extremes<const N: usize>(rows: &[[f32; N]]) -> [[f32; N]; 2] {
    let first = rows.first().copied().unwrap_or([0.0; N]);
    [f32::min, f32::max].map(|pick: fn(f32, f32) -> f32| {
        rows.iter().fold(first, |mut found, row| {
            found.iter_mut().zip(row).for_each(|(found, number)| *found = pick(*found, *number));
            found
        })
    })
}

/// What a view is for, where the format wants it said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Usage {
    /// Vertex attributes.
    Vertices,
    /// Vertex indices.
    Indices,
    /// Anything else: animation, matrices, images.
    Other,
}

/// Bytes, the views into them and the accessors that type them.
#[derive(Debug, Default)]
pub(super) struct Buffer {
    pub bytes: Vec<u8>,
    pub views: Vec<Value>,
    pub accessors: Vec<Value>,
    /// Bytes that everything besides takes: entries of the JSON, and what is only looked at.
    spent: usize,
}

impl Buffer {
    /// Counts what is about to be made, bytes.
    pub(super) fn spend(&mut self, bytes: usize) {
        self.spent = self.spent.saturating_add(bytes);
    }

    /// Whether the document takes more than converting may.
    pub(super) fn is_full(&self) -> bool {
        self.spent.saturating_add(self.bytes.len()) > limits::CONVERTED_BYTES
    }

    /// Adds bytes that begin at a multiple of four; returns the view.
    pub(super) fn view(&mut self, usage: Usage, stride: Option<usize>, fill: impl FnOnce(&mut Vec<u8>)) -> usize {
        self.spend(ENTRY);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        fill(&mut self.bytes);
        let mut view = json!({"buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start});
        match usage {
            Usage::Vertices => view["target"] = 34962.into(),
            Usage::Indices => view["target"] = 34963.into(),
            Usage::Other => {}
        }
        if let Some(stride) = stride {
            view["byteStride"] = stride.into();
        }
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, view: usize, component: u32, count: usize, shape: &str) -> usize {
        self.spend(ENTRY);
        self.accessors.push(json!({"bufferView": view, "componentType": component, "count": count, "type": shape}));
        self.accessors.len() - 1
    }

    /// Adds rows of `N` floats. With `bounds` the smallest and largest of each column are noted, which positions and times must have.
    pub(super) fn floats<const N: usize>(&mut self, usage: Usage, rows: &[[f32; N]], bounds: bool) -> usize {
        let view = self.view(usage, None, |bytes| {
            bytes.reserve(rows.len() * N * 4);
            rows.iter().flatten().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
        });
        let shape = match N {
            1 => "SCALAR",
            2 => "VEC2",
            3 => "VEC3",
            4 => "VEC4",
            _ => "MAT4",
        };
        let accessor = self.accessor(view, FLOAT, rows.len(), shape);
        if bounds && !rows.is_empty() {
            let [low, high] = extremes(rows);
            self.accessors[accessor]["min"] = low.to_vec().into();
            self.accessors[accessor]["max"] = high.to_vec().into();
        }
        accessor
    }

    /// Adds differences of vectors, most of which may be zero: as a sparse accessor (section 3.6.2.3) where that takes fewer bytes.
    pub(super) fn differences(&mut self, rows: &[[f32; 3]], bounds: bool) -> usize {
        let mut moved: Vec<u32> = (0..).zip(rows).filter(|(_, row)| **row != [0.0; 3]).map(|(vertex, _)| vertex).collect();
        if moved.is_empty() && !rows.is_empty() {
            // A sparse accessor of nothing is not allowed.
            moved.push(0);
        }
        let short = rows.len() <= usize::from(u16::MAX);
        let bytes = moved.len() * (size_of::<[f32; 3]>() + if short { 2 } else { 4 }) + SPARSE_JSON;
        if bytes >= size_of_val(rows) {
            return self.floats(Usage::Vertices, rows, bounds);
        }
        let indices = self.view(Usage::Other, None, |bytes| {
            for &vertex in &moved {
                match u16::try_from(vertex) {
                    Ok(vertex) if short => bytes.extend_from_slice(&vertex.to_le_bytes()),
                    _ => bytes.extend_from_slice(&vertex.to_le_bytes()),
                }
            }
        });
        let values = self.view(Usage::Other, None, |bytes| {
            let rows = moved.iter().filter_map(|vertex| rows.get(*vertex as usize));
            rows.flatten().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
        });
        self.spend(ENTRY);
        let mut accessor = json!({"componentType": FLOAT, "count": rows.len(), "type": "VEC3", "sparse": {
            "count": moved.len(),
            "indices": {"bufferView": indices, "componentType": if short { SHORT } else { INT }},
            "values": {"bufferView": values},
        }});
        if bounds {
            let [low, high] = extremes(rows);
            accessor["min"] = low.to_vec().into();
            accessor["max"] = high.to_vec().into();
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds a list of single floats.
    pub(super) fn scalars(&mut self, numbers: &[f32], bounds: bool) -> usize {
        self.floats(Usage::Other, numbers.as_chunks::<1>().0, bounds)
    }

    /// Adds vertex indices of a mesh of `vertices` vertices, in two bytes each where they fit.
    pub(super) fn indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        // The largest number of each width is kept for restarting strips and may not be used.
        let short = vertices <= usize::from(u16::MAX);
        let view = self.view(Usage::Indices, None, |bytes| {
            for &index in indices {
                match u16::try_from(index) {
                    Ok(index) if short => bytes.extend_from_slice(&index.to_le_bytes()),
                    _ => bytes.extend_from_slice(&index.to_le_bytes()),
                }
            }
        });
        self.accessor(view, if short { SHORT } else { INT }, indices.len(), "SCALAR")
    }

    /// Adds four joint numbers a vertex, in a byte each where they fit.
    pub(super) fn joints(&mut self, rows: &[[u16; 4]]) -> usize {
        let small = rows.iter().flatten().all(|joint| *joint <= u16::from(u8::MAX));
        let view = self.view(Usage::Vertices, None, |bytes| {
            for &joint in rows.iter().flatten() {
                match u8::try_from(joint) {
                    Ok(joint) if small => bytes.push(joint),
                    _ => bytes.extend_from_slice(&joint.to_le_bytes()),
                }
            }
        });
        self.accessor(view, if small { BYTE } else { SHORT }, rows.len(), "VEC4")
    }
}
