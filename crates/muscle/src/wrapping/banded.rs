//! Linear equations with a band of coefficients: those of the path errors, where a surface is coupled to its two neighbours alone.

/// Unknowns of a surface.
pub(super) const BLOCK: usize = 4;
/// Coefficients on either side of the diagonal: those of a neighbour's block.
const BAND: usize = 2 * BLOCK - 1;
/// Numbers of a stored row: the band, and what exchanging rows adds on the right.
const WIDTH: usize = 3 * BAND + 1;
/// A pivot smaller than this share of the largest coefficient is taken as that much, so that a singular step is a long one and not an endless one.
const PIVOT: f64 = 1e-13;

/// A block-tridiagonal system, solved by elimination with exchange of rows.
#[derive(Debug, Clone, Default)]
pub(super) struct BandedSystem {
    /// Row `r` holds columns `r − BAND` to `r + 2 BAND`.
    rows: Vec<[f64; WIDTH]>,
    /// The right-hand side, and after solving the solution.
    pub values: Vec<f64>,
}

impl BandedSystem {
    /// Makes it `size` equations of zeros.
    pub(super) fn reset(&mut self, size: usize) {
        self.rows.clear();
        self.rows.resize(size, [0.0; WIDTH]);
        self.values.clear();
        self.values.resize(size, 0.0);
    }

    /// Sets a coefficient. One outside of the band is left out: no two surfaces that are not neighbours are coupled.
    pub(super) fn set(&mut self, row: usize, column: usize, value: f64) {
        if let Some(slot) = self.rows.get_mut(row).and_then(|cells| cells.get_mut((column + BAND).wrapping_sub(row))) {
            *slot = value;
        }
    }

    /// Replaces the right-hand side by the solution.
    pub(super) fn solve(&mut self) {
        // Indices: `row`, `other` and `column` stay below `size`, which is the length of both lists; places in a row are below `WIDTH`, because
        // `column − row` is at most 2 BAND and `other − row` at most BAND.
        let size = self.values.len();
        let largest = self.rows.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        let least = (PIVOT * largest).max(f64::MIN_POSITIVE);
        for row in 0..size {
            let last_row = (row + BAND).min(size - 1);
            let last_column = (row + 2 * BAND).min(size - 1);
            let mut pivot = row;
            for other in row + 1..=last_row {
                if self.rows[other][row + BAND - other].abs() > self.rows[pivot][row + BAND - pivot].abs() {
                    pivot = other;
                }
            }
            if pivot != row {
                for column in row..=last_column {
                    let (here, there) = (self.rows[row][column + BAND - row], self.rows[pivot][column + BAND - pivot]);
                    self.rows[row][column + BAND - row] = there;
                    self.rows[pivot][column + BAND - pivot] = here;
                }
                self.values.swap(row, pivot);
            }
            let diagonal = self.rows[row][BAND];
            let diagonal = if diagonal.abs() < least { least.copysign(diagonal) } else { diagonal };
            self.rows[row][BAND] = diagonal;
            for other in row + 1..=last_row {
                let factor = self.rows[other][row + BAND - other] / diagonal;
                if factor != 0.0 {
                    for column in row..=last_column {
                        self.rows[other][column + BAND - other] -= factor * self.rows[row][column + BAND - row];
                    }
                    self.values[other] -= factor * self.values[row];
                }
            }
        }
        for row in (0..size).rev() {
            let last_column = (row + 2 * BAND).min(size - 1);
            let known: f64 = (row + 1..=last_column).map(|column| self.rows[row][column + BAND - row] * self.values[column]).sum();
            self.values[row] = (self.values[row] - known) / self.rows[row][BAND];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_gives_back_the_right_hand_side() {
        let size = 5 * BLOCK;
        let mut random = 1_u64;
        let mut next = || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut system = BandedSystem::default();
        system.reset(size);
        let mut dense = vec![vec![0.0; size]; size];
        for (row, coefficients) in dense.iter_mut().enumerate() {
            let block = row / BLOCK * BLOCK;
            for (column, coefficient) in coefficients.iter_mut().enumerate() {
                // A diagonal of zeros: rows have to be exchanged.
                if column != row && column + BLOCK >= block && column < block + 2 * BLOCK {
                    *coefficient = next();
                    system.set(row, column, *coefficient);
                }
            }
        }
        let right: Vec<f64> = (0..size).map(|_| next()).collect();
        system.values.copy_from_slice(&right);
        system.solve();
        for (row, right) in dense.iter().zip(right) {
            let left: f64 = row.iter().zip(&system.values).map(|(a, x)| a * x).sum();
            assert!((left - right).abs() < 1e-12, "{left} instead of {right}");
        }
    }
}
