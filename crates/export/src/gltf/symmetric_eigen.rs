//! Eigenvalues of small symmetric matrices, by cyclic Jacobi rotations (Golub & Van Loan, Matrix Computations, section 8.5).
//!
//! The order of the rotations is fixed, so that the same matrix gives the same bits on every machine and for any number of threads.

/// Sweeps over all off-diagonal elements; convergence is quadratic, and matrices of 64 rows need about 8.
const MAX_SWEEPS: usize = 32;

/// Eigenvalues, the largest first, and for each the unit eigenvector. `matrix` holds `rows` rows of `rows` numbers, symmetric and finite.
pub(super) fn symmetric_eigen(mut matrix: Vec<f64>, rows: usize) -> Vec<(f64, Vec<f64>)> {
    debug_assert_eq!(matrix.len(), rows * rows);
    let at = |row: usize, column: usize| row * rows + column;
    // Rows of `vectors` become the eigenvectors.
    let mut vectors = vec![0.0; rows * rows];
    for row in 0..rows {
        vectors[at(row, row)] = 1.0;
    }
    let total: f64 = matrix.iter().map(|number| number * number).sum();
    for _ in 0..MAX_SWEEPS {
        let off: f64 = (0..rows).flat_map(|row| (0..row).map(move |column| (row, column))).map(|(r, c)| matrix[at(r, c)].powi(2)).sum();
        if off <= total * f64::EPSILON * f64::EPSILON {
            break;
        }
        for p in 0..rows {
            for q in p + 1..rows {
                let apq = matrix[at(p, q)];
                if apq == 0.0 {
                    continue;
                }
                // The smaller of the two rotations that make the element zero.
                let theta = (matrix[at(q, q)] - matrix[at(p, p)]) / (2.0 * apq);
                let tangent = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let cosine = 1.0 / tangent.hypot(1.0);
                let sine = tangent * cosine;
                let rotate = |numbers: &mut [f64], a: usize, b: usize| {
                    let (x, y) = (numbers[a], numbers[b]);
                    numbers[a] = cosine * x - sine * y;
                    numbers[b] = sine * x + cosine * y;
                };
                (0..rows).for_each(|row| rotate(&mut matrix, at(row, p), at(row, q)));
                (0..rows).for_each(|column| rotate(&mut matrix, at(p, column), at(q, column)));
                (0..rows).for_each(|column| rotate(&mut vectors, at(p, column), at(q, column)));
            }
        }
    }
    let mut pairs: Vec<(f64, Vec<f64>)> = (0..rows).map(|row| (matrix[at(row, row)], vectors[row * rows..][..rows].to_vec())).collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_matrix_of_two_rows_has_the_known_values() {
        let pairs = symmetric_eigen(vec![2.0, 1.0, 1.0, 2.0], 2);
        assert!((pairs[0].0 - 3.0).abs() < 1e-14 && (pairs[1].0 - 1.0).abs() < 1e-14, "{pairs:?}");
        assert!((pairs[0].1[0] - pairs[0].1[1]).abs() < 1e-14, "{pairs:?}");
        assert!(symmetric_eigen(Vec::new(), 0).is_empty());
    }

    proptest! {
        #[test]
        fn eigenvectors_are_orthonormal_and_make_the_matrix_again(rows in 1..20_usize, seed in proptest::collection::vec(-1.0..1.0_f64, 400)) {
            let matrix: Vec<f64> = (0..rows * rows).map(|i| seed[i] + seed[i % rows * rows + i / rows]).collect();
            let pairs = symmetric_eigen(matrix.clone(), rows);
            for row in 0..rows {
                for column in 0..rows {
                    let made: f64 = pairs.iter().map(|(value, vector)| value * vector[row] * vector[column]).sum();
                    prop_assert!((made - matrix[row * rows + column]).abs() < 1e-12 * rows as f64);
                    let dot: f64 = pairs[row].1.iter().zip(&pairs[column].1).map(|(a, b)| a * b).sum();
                    prop_assert!((dot - f64::from(u8::from(row == column))).abs() < 1e-12);
                }
            }
            prop_assert!(pairs.windows(2).all(|pair| pair[0].0 >= pair[1].0));
        }
    }
}
