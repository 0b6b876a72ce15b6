//! The fewest shapes that a moving surface is made of: a sequence of vertex displacements as Σ weightₖ(moment) · shapeₖ, within a largest error of any vertex
//! at any moment.
//!
//! The displacements may be in any space: of muscles in that of a bone, of skinned surfaces in that of their bind shape. They are handed in moment by moment
//! and are not kept:
//!
//! 1. [`ShapeBasisBuilder::add`] projects a moment on an orthonormal basis (modified Gram–Schmidt) and adds what is left over to the basis where a vertex of
//!    it is further off than [`ShapeTolerance::projection`]. Of each moment its coordinates are kept.
//! 2. [`ShapeBasisBuilder::finish`] rotates the basis by the eigenvectors of the coordinates' Gram matrix (a principal component analysis), so that the first
//!    shapes hold most of the movement, and leaves out of each shape the vertices that do without it within [`ShapeTolerance::omission`]. Most vertices
//!    need few shapes; where many are needed, as beside a wrap surface, they are few vertices. Sparse accessors hold them in few bytes.
//!
//! Normals follow the same weights: their shapes are the least-squares fit over all moments.

use glam::Vec3;

use super::symmetric_eigen::symmetric_eigen;

/// Largest errors of the two steps, each in the unit of displacement · `scale`; their sum bounds the error of the whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ShapeTolerance {
    /// What a moment may be off that adds nothing to the basis.
    pub projection: f32,
    /// What leaving vertices out of shapes may add to it.
    pub omission: f32,
    /// What leaving vertices out of shapes may add to the error of a normal, a part of its length.
    pub normal: f32,
}

/// Takes the moments of one surface and makes the shapes of them.
#[derive(Debug)]
pub(super) struct ShapeBasisBuilder {
    vertices: usize,
    tolerance: ShapeTolerance,
    most: usize,
    /// Orthonormal rows of three numbers a vertex.
    basis: Vec<Vec<f32>>,
    /// The longest vertex displacement of each row.
    peaks: Vec<f32>,
    /// For each row of the basis, Σ over the moments of coordinate · normal displacements.
    normals: Vec<Vec<f32>>,
    moments: Vec<ShapeMoment>,
    /// Left over of the last moment.
    rest: Vec<f32>,
    exceeded: bool,
}

/// A moment in the basis as it was then; rows that were added later count 0.
#[derive(Debug)]
struct ShapeMoment {
    coordinates: Vec<f32>,
    scale: f32,
}

/// What one shape adds to the surface at weight 1, one displacement a vertex; zero for vertices that do without it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    /// The longest displacement of a vertex · the largest scale of a moment.
    pub peak: f32,
}

/// The shapes of a surface and how much of each it has at each moment.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShapeBasis {
    pub shapes: Vec<Shape>,
    /// One row a moment in the order in which they were added, with one weight a shape, from −1 to 1.
    pub weights: Vec<Vec<f32>>,
    /// Whether there were more shapes to keep than allowed, so that the error is larger than the tolerance.
    pub exceeded: bool,
}

impl ShapeBasisBuilder {
    /// For a surface of so many vertices; `most` bounds the number of shapes.
    pub(super) fn new(vertices: usize, tolerance: ShapeTolerance, most: usize) -> Self {
        let (basis, peaks, normals, moments) = Default::default();
        Self { vertices, tolerance, most, basis, peaks, normals, moments, rest: Vec::new(), exceeded: false }
    }

    /// Adds a moment: displacements of positions and normals from the surface at rest, and how many units of the tolerance a unit of displacement is then.
    /// Vertices that are missing or not finite count as at rest.
    pub(super) fn add(&mut self, positions: &[Vec3], normals: &[Vec3], scale: f32) {
        let scale = if scale.is_finite() { scale.abs() } else { 0.0 };
        flatten(positions, self.vertices, &mut self.rest);
        let mut coordinates: Vec<f32> = self.basis.iter().map(|row| take_out(row, &mut self.rest)).collect();
        if longest(&self.rest) * scale > self.tolerance.projection {
            if self.basis.len() < self.most {
                // A second time against rounding: what is left may be small beside what was taken out.
                for (row, coordinate) in self.basis.iter().zip(&mut coordinates) {
                    *coordinate += take_out(row, &mut self.rest);
                }
                let length = dot(&self.rest, &self.rest).sqrt();
                if length > 0.0 && length.is_finite() {
                    let row: Vec<f32> = self.rest.iter().map(|number| number / length).collect();
                    self.peaks.push(longest(&row));
                    self.basis.push(row);
                    self.normals.push(vec![0.0; 3 * self.vertices]);
                    coordinates.push(length);
                }
            } else {
                self.exceeded = true;
            }
        }
        flatten(normals, self.vertices, &mut self.rest);
        for (sum, coordinate) in self.normals.iter_mut().zip(&coordinates) {
            sum.iter_mut().zip(&self.rest).for_each(|(sum, number)| *sum += coordinate * number);
        }
        self.moments.push(ShapeMoment { coordinates, scale });
    }

    /// Whether the moment `between`, half-way from one to another, deviates from their mean by no more than `most` at any vertex.
    pub(super) fn is_straight(&self, [from, between, to]: [usize; 3], most: f32) -> bool {
        let (Some(from), Some(between), Some(to)) = (self.moments.get(from), self.moments.get(between), self.moments.get(to)) else {
            return true;
        };
        let coordinate = |moment: &ShapeMoment, row: usize| moment.coordinates.get(row).copied().unwrap_or(0.0);
        let off = |row: usize| coordinate(between, row) - 0.5 * (coordinate(from, row) + coordinate(to, row));
        let off: Vec<f32> = (0..self.basis.len()).map(off).collect();
        let scale = from.scale.max(between.scale).max(to.scale);
        // No vertex is further off than the sum of what each row moves at most; only where that is too much each one is looked at.
        if scale * off.iter().zip(&self.peaks).map(|(off, peak)| off.abs() * peak).sum::<f32>() <= most {
            return true;
        }
        let mut sum = vec![0.0_f32; 3 * self.vertices];
        for (row, off) in self.basis.iter().zip(&off) {
            sum.iter_mut().zip(row).for_each(|(sum, number)| *sum += off * number);
        }
        longest(&sum) * scale <= most
    }

    /// The shapes and the weights of all moments.
    pub(super) fn finish(self) -> ShapeBasis {
        let rows = self.basis.len();
        let mut gram = vec![0.0_f64; rows * rows];
        for ShapeMoment { coordinates, .. } in &self.moments {
            for (row, a) in coordinates.iter().enumerate() {
                for (column, b) in coordinates.iter().enumerate() {
                    gram[row * rows + column] += f64::from(*a) * f64::from(*b);
                }
            }
        }
        let widest = self.moments.iter().map(|moment| moment.scale).fold(0.0, f32::max);
        let mut components: Vec<Component> = Vec::new();
        for (value, vector) in symmetric_eigen(gram, rows) {
            let weight = |moment: &ShapeMoment| moment.coordinates.iter().zip(&vector).map(|(a, b)| f64::from(*a) * b).sum::<f64>();
            let weights: Vec<f64> = self.moments.iter().map(weight).collect();
            let largest = weights.iter().fold(0.0_f64, |most, weight| if weight.abs() > most.abs() { *weight } else { most });
            if value <= 0.0 || largest == 0.0 {
                continue;
            }
            components.push(Component {
                weights: weights.iter().map(|weight| (weight / largest) as f32).collect(),
                positions: mixed(&self.basis, &vector, largest, self.vertices),
                normals: mixed(&self.normals, &vector, largest / value, self.vertices),
            });
        }
        let scales: Vec<f32> = self.moments.iter().map(|moment| moment.scale).collect();
        omit(&mut components, |component| &mut component.positions, &scales, self.tolerance.omission);
        components.retain(|component| component.positions.iter().any(|delta| *delta != [0.0; 3]));
        omit(&mut components, |component| &mut component.normals, &vec![1.0; scales.len()], self.tolerance.normal);
        let weights =
            (0..self.moments.len()).map(|moment| components.iter().map(|component| component.weights[moment]).collect()).collect();
        let shape = |Component { positions, normals, .. }: Component| {
            let peak = widest * positions.iter().map(|delta| Vec3::from_array(*delta).length()).fold(0.0, f32::max);
            Shape { positions, normals, peak }
        };
        ShapeBasis { shapes: components.into_iter().map(shape).collect(), weights, exceeded: self.exceeded }
    }
}

/// A shape with its weight at each moment.
struct Component {
    weights: Vec<f32>,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
}

/// Part of the error that shapes may take which move a vertex so little that it is not looked at when.
const UNSEEN: f32 = 0.25;

/// Leaves each vertex out of the shapes that move it least, as long as no moment of it is off by more than `most` / scale for it.
fn omit(components: &mut [Component], part: fn(&mut Component) -> &mut Vec<[f32; 3]>, scales: &[f32], most: f32) {
    let vertices = components.first_mut().map_or(0, |component| part(component).len());
    let widest = scales.iter().copied().fold(0.0, f32::max);
    // Weights in the unit of the tolerance, so that every moment has the same bound.
    let scaled = |component: &Component| component.weights.iter().zip(scales).map(|(weight, scale)| weight * scale).collect();
    let weights: Vec<Vec<f32>> = components.iter().map(scaled).collect();
    let mut off = MomentErrors::new(scales.len());
    for vertex in 0..vertices {
        let mut order: Vec<(f32, usize)> = Vec::with_capacity(components.len());
        for (number, component) in components.iter_mut().enumerate() {
            order.push((widest * Vec3::from_array(part(component)[vertex]).length(), number));
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        off.clear();
        let (mut unseen, mut left) = (0.0, most);
        for (length, number) in order {
            let delta = &mut part(&mut components[number])[vertex];
            if unseen + length <= UNSEEN * most {
                unseen += length;
                left = most - unseen;
            } else if !off.add(*delta, &weights[number], left) {
                break;
            }
            *delta = [0.0; 3];
        }
    }
}

/// How far a vertex is off at each moment, in lanes of [`LANES`] moments that the compiler turns into vectors.
struct MomentErrors {
    off: [Vec<[f32; LANES]>; 3],
    moments: usize,
}

const LANES: usize = 8;

impl MomentErrors {
    fn new(moments: usize) -> Self {
        Self { off: [(); 3].map(|()| vec![[0.0; LANES]; moments.div_ceil(LANES)]), moments }
    }

    fn clear(&mut self) {
        self.off.iter_mut().for_each(|axis| axis.fill([0.0; LANES]));
    }

    /// Adds a displacement at these weights; `false` where a moment then is off by more than `most`.
    fn add(&mut self, delta: [f32; 3], weights: &[f32], most: f32) -> bool {
        debug_assert_eq!(weights.len(), self.moments);
        let [x, y, z] = &mut self.off;
        let (whole, rest) = weights.as_chunks::<LANES>();
        let mut last = [0.0; LANES];
        last[..rest.len()].copy_from_slice(rest);
        let chunks = whole.iter().chain(std::iter::once(&last));
        for (((weights, x), y), z) in chunks.zip(x).zip(y).zip(z) {
            let mut worst = [0.0_f32; LANES];
            for lane in 0..LANES {
                x[lane] += weights[lane] * delta[0];
                y[lane] += weights[lane] * delta[1];
                z[lane] += weights[lane] * delta[2];
                worst[lane] = x[lane] * x[lane] + y[lane] * y[lane] + z[lane] * z[lane];
            }
            if worst.iter().any(|worst| *worst > most * most) {
                return false;
            }
        }
        true
    }
}

/// Σ vectorₖ · rowₖ · factor, three numbers a vertex.
fn mixed(rows: &[Vec<f32>], vector: &[f64], factor: f64, vertices: usize) -> Vec<[f32; 3]> {
    let mut sum = vec![[0.0_f32; 3]; vertices];
    for (row, part) in rows.iter().zip(vector) {
        let part = (part * factor) as f32;
        sum.as_flattened_mut().iter_mut().zip(row).for_each(|(sum, number)| *sum += part * number);
    }
    // Zeros without a sign, and nothing that the format does not allow.
    sum.iter_mut().for_each(|delta| *delta = if delta.iter().all(|number| number.is_finite()) { delta.map(|n| n + 0.0) } else { [0.0; 3] });
    sum
}

/// Three numbers a vertex, zeros for those that are missing or not finite.
fn flatten(deltas: &[Vec3], vertices: usize, into: &mut Vec<f32>) {
    into.clear();
    into.extend(deltas.iter().take(vertices).flat_map(|delta| if delta.is_finite() { delta.to_array() } else { [0.0; 3] }));
    into.resize(3 * vertices, 0.0);
}

/// Takes the part along a unit row out of `rest` and returns its length.
fn take_out(row: &[f32], rest: &mut [f32]) -> f32 {
    let coordinate = dot(row, rest);
    rest.iter_mut().zip(row).for_each(|(rest, number)| *rest -= coordinate * number);
    coordinate
}

/// Sums in eight lanes, which the compiler turns into vectors; the order of the additions is the same on every machine.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let (a, b) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut lanes = [0.0_f32; 8];
    for (a, b) in a.0.iter().zip(b.0) {
        lanes.iter_mut().zip(a.iter().zip(b)).for_each(|(lane, (a, b))| *lane += a * b);
    }
    lanes.iter().sum::<f32>() + a.1.iter().zip(b.1).map(|(a, b)| a * b).sum::<f32>()
}

/// Length of the longest of the vectors.
fn longest(numbers: &[f32]) -> f32 {
    numbers.as_chunks::<3>().0.iter().map(|[x, y, z]| x * x + y * y + z * z).fold(0.0, f32::max).sqrt()
}

#[cfg(test)]
mod tests;
