//! Each stretch of a limb changes its volume by what the muscles in it change.
//!
//! Skin that clears a muscle encloses more than before. Along each bone the rest of the skin moves in or out by a sum of B-splines, so that for each spline
//! the volume swept by the skin, weighted with the spline, is what came to the muscles there. A few Newton steps with one matrix solve for it.

use glam::Vec3;

use crate::binding::Binding;
use crate::splines::SPLINES;
use crate::station::Stations;

/// Skin is moved by less than this to balance volumes, metres.
const MOST: f32 = 0.007;
/// Newton steps.
const STEPS: usize = 3;
/// Added to the diagonal, as a share of the largest element: a stretch whose skin has no room is left as it is.
const RIDGE: f64 = 1e-3;

/// Working memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Balance {
    /// By bone: what the splines are multiplied by, metres.
    factors: Vec<[f64; SPLINES]>,
    /// By bone: the matrix of Newton's steps.
    matrices: Vec<[[f64; SPLINES]; SPLINES]>,
    lacking: Vec<[f64; SPLINES]>,
    swept: Vec<f64>,
}

/// A skin in a pose: one entry a point of the binding.
pub(crate) struct BentSkin<'a> {
    /// Where the skeleton has put the points, metres.
    pub(crate) positions: &'a [Vec3],
    /// Outward, of length 1, shorter where the skin is crushed.
    pub(crate) normals: &'a [Vec3],
    /// By point that moves: how freely it may be moved, 0 to 1.
    pub(crate) room: &'a [f32],
    /// By how much points are moved to clear the muscles, metres.
    pub(crate) cleared: &'a [Vec3],
}

/// `x` between −[`MOST`] and [`MOST`].
fn held(x: f64, most: f64) -> f64 {
    most * (x / most).tanh()
}

/// The volumes swept by triangles from `positions` by `moves`, as a third to each corner. m³.
///
/// Of a triangle with sides e₁, e₂ whose corners move by straight lines, f₁, f₂ being the changes of the sides and ū the mean of the moves:
/// `V = ū · ½ (e₁×e₂ + ½ (e₁×f₂ + f₁×e₂) + ⅓ f₁×f₂)`.
pub(crate) fn swept_volumes(triangles: &[[u32; 3]], positions: &[Vec3], moves: &[Vec3], swept: &mut Vec<f64>) {
    swept.clear();
    swept.resize(positions.len(), 0.0);
    for triangle in triangles {
        let [Some(a), Some(b), Some(c)] = triangle.map(|point| positions.get(point as usize).copied()) else { continue };
        let [Some(u), Some(v), Some(w)] = triangle.map(|point| moves.get(point as usize).copied()) else { continue };
        if u == Vec3::ZERO && v == Vec3::ZERO && w == Vec3::ZERO {
            continue;
        }
        let (e1, e2, f1, f2) = (b - a, c - a, v - u, w - u);
        let normal = e1.cross(e2) + (e1.cross(f2) + f1.cross(e2)) * 0.5 + f1.cross(f2) / 3.0;
        let volume = f64::from((u + v + w).dot(normal)) / 18.0;
        for point in triangle {
            if let Some(sum) = swept.get_mut(*point as usize) {
                *sum += volume;
            }
        }
    }
}

impl Balance {
    /// Adds to `moves` what balances the volumes.
    pub(crate) fn add(&mut self, binding: &Binding, stations: &Stations, skin: &BentSkin<'_>, moves: &mut [Vec3]) {
        let BentSkin { positions, normals, room, cleared } = *skin;
        let bones = stations.volumes.len();
        self.factors.clear();
        self.factors.resize(bones, [0.0; SPLINES]);
        self.factor_matrices(binding, stations, room);
        for _ in 0..STEPS {
            self.measure(binding, stations, positions, moves);
            for ((factors, matrix), lacking) in self.factors.iter_mut().zip(&self.matrices).zip(&self.lacking) {
                let step = solved(matrix, *lacking);
                for (factor, step) in factors.iter_mut().zip(step) {
                    *factor += step;
                }
            }
            self.apply(binding, stations, normals, room, moves, cleared);
        }
    }

    /// Prepares the matrices: areas times splines times splines, factored.
    fn factor_matrices(&mut self, binding: &Binding, stations: &Stations, room: &[f32]) {
        self.matrices.clear();
        self.matrices.resize(stations.volumes.len(), [[0.0; SPLINES]; SPLINES]);
        let square = stations.scale * stations.scale;
        for (point, (room, area)) in room.iter().zip(&binding.layout.areas).enumerate() {
            let weight = f64::from(*room) * f64::from(*area) * square;
            let entries = binding.splines.of(point);
            for (one, value) in entries {
                let (bone, row) = (*one as usize / SPLINES, *one as usize % SPLINES);
                let Some(matrix) = self.matrices.get_mut(bone) else { continue };
                for (other, factor) in entries.iter().filter(|(other, _)| *other as usize / SPLINES == bone) {
                    matrix[row][*other as usize % SPLINES] += weight * f64::from(*value) * f64::from(*factor);
                }
            }
        }
        for matrix in &mut self.matrices {
            let most = (0..SPLINES).map(|index| matrix[index][index]).fold(0.0, f64::max);
            for (index, row) in matrix.iter_mut().enumerate() {
                row[index] += RIDGE * most;
            }
            factor(matrix);
        }
    }

    /// What each spline's volume lacks.
    fn measure(&mut self, binding: &Binding, stations: &Stations, positions: &[Vec3], moves: &[Vec3]) {
        swept_volumes(&binding.layout.triangles, positions, moves, &mut self.swept);
        self.lacking.clear();
        let cube = stations.scale.powi(3);
        for (now, rest) in stations.volumes.iter().zip(&binding.muscle_volumes) {
            self.lacking.push(std::array::from_fn(|spline| now[spline] - rest[spline] * cube));
        }
        for (point, (swept, orientation)) in self.swept.iter().zip(&binding.orientation).enumerate() {
            if *swept == 0.0 {
                continue;
            }
            for (entry, value) in binding.splines.of(point) {
                if let Some(lacking) = self.lacking.get_mut(*entry as usize / SPLINES) {
                    lacking[*entry as usize % SPLINES] -= swept * f64::from(*orientation) * f64::from(*value);
                }
            }
        }
    }

    /// Sets the moves to the cleared ones and those along the normals.
    fn apply(&self, binding: &Binding, stations: &Stations, normals: &[Vec3], room: &[f32], moves: &mut [Vec3], cleared: &[Vec3]) {
        let most = f64::from(MOST) * stations.scale;
        let given = moves.iter_mut().zip(cleared).zip(normals.iter().zip(room));
        for (point, ((place, cleared), (normal, room))) in given.enumerate() {
            let mut sum = 0.0;
            for (entry, value) in binding.splines.of(point) {
                if let Some(factors) = self.factors.get(*entry as usize / SPLINES) {
                    sum += factors[*entry as usize % SPLINES] * f64::from(*value);
                }
            }
            *place = *cleared + *normal * (room * held(sum, most) as f32);
        }
    }
}

/// Factors a symmetric matrix in place: the lower triangle becomes that of `L` in `L Lᵀ`. Rows without a positive pivot become 0.
fn factor(matrix: &mut [[f64; SPLINES]; SPLINES]) {
    for column in 0..SPLINES {
        for row in column..SPLINES {
            let mut value = matrix[row][column];
            value -= (0..column).map(|k| matrix[row][k] * matrix[column][k]).sum::<f64>();
            matrix[row][column] = if row == column {
                if value > 0.0 { value.sqrt() } else { 0.0 }
            } else if matrix[column][column] > 0.0 {
                value / matrix[column][column]
            } else {
                0.0
            };
        }
    }
}

/// `x` in `L Lᵀ x = right`; 0 where `L` has no pivot.
fn solved(lower: &[[f64; SPLINES]; SPLINES], mut right: [f64; SPLINES]) -> [f64; SPLINES] {
    let divided = |value: f64, pivot: f64| if pivot > 0.0 { value / pivot } else { 0.0 };
    for row in 0..SPLINES {
        let sum: f64 = (0..row).map(|k| lower[row][k] * right[k]).sum();
        right[row] = divided(right[row] - sum, lower[row][row]);
    }
    for row in (0..SPLINES).rev() {
        let sum: f64 = (row + 1..SPLINES).map(|k| lower[k][row] * right[k]).sum();
        right[row] = divided(right[row] - sum, lower[row][row]);
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_swept_volume_of_a_closed_surface_is_the_change_of_its_volume() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let moves = [Vec3::new(0.1, -0.3, 0.2), Vec3::new(0.4, 0.1, 0.0), Vec3::new(0.0, 0.5, -0.2), Vec3::new(0.2, 0.2, 0.9)];
        let volume = |p: [Vec3; 4]| f64::from((p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]))) / 6.0;
        let mut swept = Vec::new();
        swept_volumes(&triangles, &positions, &moves, &mut swept);
        let moved = std::array::from_fn(|i| positions[i] + moves[i]);
        let expected = volume(moved) - volume(positions);
        assert!((swept.iter().sum::<f64>() - expected).abs() < 1e-6, "{swept:?} {expected}");
    }

    #[test]
    fn factors_solve_and_an_empty_matrix_gives_nothing() {
        let mut matrix = [[0.0; SPLINES]; SPLINES];
        let (mut copy, wanted) = (matrix, std::array::from_fn(|i| 1.0 + i as f64));
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = 1.0 / (1.0 + i.abs_diff(j) as f64).powi(2) + if i == j { 1.0 } else { 0.0 };
            }
        }
        let right = std::array::from_fn(|i| (0..SPLINES).map(|j| matrix[i][j] * wanted[j]).sum());
        factor(&mut matrix);
        for (found, wanted) in solved(&matrix, right).iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-9);
        }
        factor(&mut copy);
        assert_eq!(solved(&copy, wanted), [0.0; SPLINES]);
    }
}
