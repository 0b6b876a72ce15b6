//! A reader of `.glb` files, written from the specification and knowing nothing of the writer: what the surface is at a moment.

use std::collections::HashMap;

use glam::{DMat3, DMat4, DQuat, DVec3};
use serde_json::Value;

/// An open file.
pub(crate) struct Glb {
    root: Value,
    bytes: Vec<u8>,
}

/// One primitive at a moment.
pub(crate) struct Part {
    /// Its node.
    pub node: usize,
    corners: Vec<usize>,
    /// All vertices in the world.
    pub placed: Vec<DVec3>,
    /// The normals of all vertices in the world, of a primitive that has some.
    pub normals: Vec<DVec3>,
    /// Whether a skin bends it.
    pub skinned: bool,
    turned: bool,
}

fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value[name].as_array().map_or(&[], Vec::as_slice)
}

fn index(value: &Value) -> Option<usize> {
    value.as_u64().map(|number| number as usize)
}

impl Glb {
    /// Reads the chunks.
    pub(crate) fn read(file: &[u8]) -> Self {
        let number = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().expect("four bytes")) as usize;
        assert_eq!((&file[..4], number(4), number(8)), (b"glTF".as_slice(), 2, file.len()));
        let text = number(12);
        assert_eq!(&file[16..20], b"JSON");
        let root: Value = serde_json::from_slice(&file[20..20 + text]).expect("JSON");
        let rest = &file[20 + text..];
        let bytes = if rest.is_empty() { Vec::new() } else { rest[8..].to_vec() };
        if let Some(length) = index(&root["buffers"][0]["byteLength"]) {
            assert!(bytes.len() >= length && bytes.len() < length + 4);
        }
        Self { root, bytes }
    }

    /// The JSON part.
    pub(crate) fn root(&self) -> &Value {
        &self.root
    }

    /// The rows of an accessor.
    pub(crate) fn rows(&self, accessor: usize) -> Vec<Vec<f64>> {
        let accessor = &self.root["accessors"][accessor];
        let columns = match accessor["type"].as_str().expect("a type") {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            other => panic!("type {other}"),
        };
        let (kind, count) = (index(&accessor["componentType"]), index(&accessor["count"]).expect("a count"));
        let mut rows = match index(&accessor["bufferView"]) {
            Some(view) => self.view_rows(view, kind, columns, count),
            // Section 5.1: without a view the numbers are zeros, unless sparse values replace them.
            None => vec![vec![0.0; columns]; count],
        };
        if let Some(sparse) = accessor.get("sparse") {
            let replaced = index(&sparse["count"]).filter(|count| *count > 0).expect("a count");
            let (indices, values) = (&sparse["indices"], &sparse["values"]);
            let places = self.view_rows(index(&indices["bufferView"]).expect("a view"), index(&indices["componentType"]), 1, replaced);
            let values = self.view_rows(index(&values["bufferView"]).expect("a view"), kind, columns, replaced);
            assert!(places.windows(2).all(|pair| pair[0][0] < pair[1][0]), "indices rise");
            for (place, value) in places.iter().zip(values) {
                rows[place[0] as usize] = value;
            }
        }
        rows
    }

    /// The first rows of a view.
    fn view_rows(&self, view: usize, kind: Option<usize>, columns: usize, count: usize) -> Vec<Vec<f64>> {
        let view = &self.root["bufferViews"][view];
        let (start, length) = (index(&view["byteOffset"]).unwrap_or(0), index(&view["byteLength"]).expect("a length"));
        let size = match kind {
            Some(5121) => 1,
            Some(5123) => 2,
            Some(5125 | 5126) => 4,
            other => panic!("component type {other:?}"),
        };
        assert!(count * columns * size <= length && start + length <= self.bytes.len());
        let at = |row: usize, column: usize| {
            let bytes = &self.bytes[start + (row * columns + column) * size..][..size];
            match kind {
                Some(5121) => f64::from(bytes[0]),
                Some(5123) => f64::from(u16::from_le_bytes(bytes.try_into().expect("two"))),
                Some(5125) => f64::from(u32::from_le_bytes(bytes.try_into().expect("four"))),
                _ => f64::from(f32::from_le_bytes(bytes.try_into().expect("four"))),
            }
        };
        (0..count).map(|row| (0..columns).map(|column| at(row, column)).collect()).collect()
    }

    /// The animation of that name.
    pub(crate) fn animation(&self, name: &str) -> Option<&Value> {
        list(&self.root, "animations").iter().find(|animation| animation["name"] == name)
    }

    /// Values of a sampler at `time` (section 3.11 and appendix C of the specification), `width` numbers a key.
    fn sample(&self, sampler: &Value, time: f64, is_rotation: bool) -> Vec<f64> {
        let times: Vec<f64> = self.rows(index(&sampler["input"]).expect("an input")).into_iter().flatten().collect();
        let values: Vec<f64> = self.rows(index(&sampler["output"]).expect("an output")).into_iter().flatten().collect();
        assert!(times[0] >= 0.0 && times.windows(2).all(|pair| pair[0] < pair[1]), "times rise from 0 or later");
        let mode = sampler["interpolation"].as_str().unwrap_or("LINEAR");
        let cubic = mode == "CUBICSPLINE";
        let width = values.len() / times.len() / if cubic { 3 } else { 1 };
        let row = |key: usize, part: usize| {
            let start = if cubic { (key * 3 + part) * width } else { key * width };
            &values[start..start + width]
        };
        let after = times.partition_point(|key| *key <= time);
        if after == 0 || after == times.len() {
            return row(after.saturating_sub(1), 1).to_vec();
        }
        let (before, length) = (after - 1, times[after] - times[after - 1]);
        let s = (time - times[before]) / length;
        let (from, to) = (row(before, 1), row(after, 1));
        match mode {
            "STEP" => from.to_vec(),
            "CUBICSPLINE" => {
                let (leaving, arriving) = (row(before, 2), row(after, 0));
                let (s2, s3) = (s * s, s * s * s);
                let spline = |i: usize| {
                    (2.0 * s3 - 3.0 * s2 + 1.0) * from[i]
                        + length * (s3 - 2.0 * s2 + s) * leaving[i]
                        + (3.0 * s2 - 2.0 * s3) * to[i]
                        + length * (s3 - s2) * arriving[i]
                };
                (0..width).map(spline).collect()
            }
            _ if is_rotation => {
                let quaternion = |row: &[f64]| DQuat::from_slice(row);
                quaternion(from).slerp(quaternion(to), s).to_array().to_vec()
            }
            _ => from.iter().zip(to).map(|(a, b)| a + (b - a) * s).collect(),
        }
    }

    /// The positions of all vertices that a triangle uses, in the world, with this animation at this time.
    pub(crate) fn surface(&self, animation: Option<&Value>, time: f64) -> Vec<DVec3> {
        let mut points = Vec::new();
        for part in self.parts(animation, time) {
            let mut used = part.corners;
            used.sort_unstable();
            used.dedup();
            points.extend(used.into_iter().map(|vertex| part.placed[vertex]));
        }
        points
    }

    /// What the surface encloses, positive where its triangles are counter-clockwise seen from outside (section 3.7.4 of the specification: a node's
    /// matrix that mirrors turns them round).
    pub(crate) fn volume(&self, animation: Option<&Value>, time: f64) -> f64 {
        let of = |part: &Part| {
            let at = |corner: usize| part.placed[corner];
            let cones = part.corners.as_chunks::<3>().0.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c))) / 6.0);
            cones.sum::<f64>() * if part.turned { -1.0 } else { 1.0 }
        };
        self.parts(animation, time).iter().map(of).sum()
    }

    /// All primitives of triangles at a moment.
    pub(crate) fn parts(&self, animation: Option<&Value>, time: f64) -> Vec<Part> {
        let mut moved: HashMap<(usize, String), Vec<f64>> = HashMap::new();
        for channel in animation.map_or(&[][..], |animation| list(animation, "channels")) {
            let (node, path) = (index(&channel["target"]["node"]).expect("a node"), channel["target"]["path"].as_str().expect("a path"));
            let sampler = &animation.expect("there")["samplers"][index(&channel["sampler"]).expect("a sampler")];
            moved.insert((node, path.to_owned()), self.sample(sampler, time, path == "rotation"));
        }
        let nodes = list(&self.root, "nodes");
        let mut world = vec![None; nodes.len()];
        let mut open: Vec<(usize, DMat4)> =
            list(&self.root["scenes"][0], "nodes").iter().filter_map(index).map(|node| (node, DMat4::IDENTITY)).collect();
        while let Some((node, above)) = open.pop() {
            let numbers = |path: &str, rest: &[f64]| {
                let still = || nodes[node][path].as_array().map(|row| row.iter().filter_map(Value::as_f64).collect());
                moved.get(&(node, path.to_owned())).cloned().or_else(still).unwrap_or_else(|| rest.to_vec())
            };
            let local = DMat4::from_scale_rotation_translation(
                DVec3::from_slice(&numbers("scale", &[1.0; 3])),
                DQuat::from_slice(&numbers("rotation", &[0.0, 0.0, 0.0, 1.0])).normalize(),
                DVec3::from_slice(&numbers("translation", &[0.0; 3])),
            );
            assert!(world[node].replace(above * local).is_none(), "node {node} has two parents");
            open.extend(list(&nodes[node], "children").iter().filter_map(index).map(|child| (child, above * local)));
        }
        let at = |node: usize| world[node].expect("a node of the scene");
        let mut parts = Vec::new();
        for (number, node) in nodes.iter().enumerate() {
            let Some(mesh) = index(&node["mesh"]) else { continue };
            let mesh = &self.root["meshes"][mesh];
            let weights = moved.get(&(number, "weights".to_owned())).cloned();
            let weights = weights.unwrap_or_else(|| list(mesh, "weights").iter().filter_map(Value::as_f64).collect());
            let skin = index(&node["skin"]).map(|skin| &self.root["skins"][skin]);
            // Primitives of one mesh mostly have the same vertices.
            let mut known: Option<(&Value, &Value, [Vec<DVec3>; 2])> = None;
            for primitive in list(mesh, "primitives").iter().filter(|primitive| primitive["mode"] == 4) {
                let (attributes, targets) = (&primitive["attributes"], &primitive["targets"]);
                let [shape, directions] = match known.take() {
                    Some((same, bent, shape)) if same == attributes && bent == targets => shape,
                    _ => ["POSITION", "NORMAL"].map(|attribute| self.shape(primitive, &weights, attribute)),
                };
                known = Some((attributes, targets, [shape.clone(), directions.clone()]));
                // Normals go by the inverse of the transposed matrix.
                let upright = DMat3::from_mat4(at(number)).inverse().transpose();
                let (placed, normals): (Vec<DVec3>, Vec<DVec3>) = match skin {
                    None => (
                        shape.iter().map(|point| at(number).transform_point3(*point)).collect(),
                        directions.iter().map(|normal| (upright * *normal).normalize()).collect(),
                    ),
                    Some(skin) => {
                        let joints: Vec<usize> = list(skin, "joints").iter().filter_map(index).collect();
                        let inverse = self.rows(index(&skin["inverseBindMatrices"]).expect("matrices"));
                        let palette: Vec<DMat4> =
                            joints.iter().zip(&inverse).map(|(joint, rows)| at(*joint) * DMat4::from_cols_slice(rows)).collect();
                        let blended = self.blended(primitive, shape.len(), &palette);
                        let turned = |matrix: &DMat4| DMat3::from_mat4(*matrix).inverse().transpose();
                        (
                            blended.iter().zip(&shape).map(|(matrix, point)| matrix.transform_point3(*point)).collect(),
                            blended.iter().zip(&directions).map(|(matrix, normal)| (turned(matrix) * *normal).normalize()).collect(),
                        )
                    }
                };
                let corners = self.rows(index(&primitive["indices"]).expect("indices")).into_iter().flatten();
                // A skinned mesh goes where its joints are, whatever node it hangs on; players still look at that node's matrix.
                let turned = at(number).determinant() < 0.0;
                parts.push(Part {
                    node: number,
                    corners: corners.map(|vertex| vertex as usize).collect(),
                    placed,
                    normals,
                    skinned: skin.is_some(),
                    turned,
                });
            }
        }
        parts
    }

    /// An attribute of three numbers with its morph targets; nothing where there is no such attribute.
    fn shape(&self, primitive: &Value, weights: &[f64], attribute: &str) -> Vec<DVec3> {
        let read = |attributes: &Value| {
            let rows = index(&attributes[attribute]).map(|accessor| self.rows(accessor)).unwrap_or_default();
            rows.into_iter().map(|row| DVec3::from_slice(&row)).collect::<Vec<_>>()
        };
        let mut shape = read(&primitive["attributes"]);
        assert_eq!(weights.len(), list(primitive, "targets").len());
        for (target, weight) in list(primitive, "targets").iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            for (point, delta) in shape.iter_mut().zip(read(target)) {
                *point += delta * *weight;
            }
        }
        shape
    }

    /// The matrix of each vertex: those of its joints, weighted.
    fn blended(&self, primitive: &Value, vertices: usize, palette: &[DMat4]) -> Vec<DMat4> {
        let mut blended = vec![DMat4::ZERO; vertices];
        let mut sums = vec![0.0; vertices];
        for set in 0.. {
            let attribute = |name: &str| index(&primitive["attributes"][format!("{name}_{set}")]).map(|accessor| self.rows(accessor));
            let (Some(joints), Some(weights)) = (attribute("JOINTS"), attribute("WEIGHTS")) else { break };
            for vertex in 0..vertices {
                for (joint, weight) in joints[vertex].iter().zip(&weights[vertex]) {
                    blended[vertex] += palette[*joint as usize] * *weight;
                    sums[vertex] += weight;
                }
            }
        }
        assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-6), "weights add up to 1");
        blended
    }
}
