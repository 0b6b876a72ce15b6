//! Which muscles lie in which connected piece of a skin.

use glam::Vec3;

use crate::points::Points;
use crate::section::MuscleTissue;
use crate::station::Stations;
use crate::winding::WindingNumbers;

/// A muscle lies in a piece where more than this share of its belly does.
const INSIDE: f64 = 0.5;
/// Every so many cross-sections of the belly are looked at.
const STEP: usize = 3;

/// A connected piece of a skin.
#[derive(Debug, Clone, Default)]
pub(crate) struct Piece {
    /// The muscles in it.
    pub(crate) muscles: Vec<usize>,
    /// Whether its triangles run clockwise seen from outside.
    pub(crate) inverted: bool,
}

/// The pieces of a skin at rest, by number.
pub(crate) fn pieces_of(points: &Points, muscles: &[MuscleTissue], rest: &Stations) -> Vec<Piece> {
    let mut triangles: Vec<Vec<[Vec3; 3]>> = vec![Vec::new(); points.piece_count];
    for triangle in &points.triangles {
        let piece = points.pieces.get(triangle[0] as usize).copied().unwrap_or(0);
        if let (Some(list), Some(corners)) = (triangles.get_mut(piece as usize), points.corners(*triangle)) {
            list.push(corners);
        }
    }
    triangles.into_iter().map(|triangles| piece_of(triangles, muscles, rest)).collect()
}

fn piece_of(triangles: Vec<[Vec3; 3]>, muscles: &[MuscleTissue], rest: &Stations) -> Piece {
    let low = triangles.iter().flatten().fold(Vec3::INFINITY, |low, corner| low.min(*corner));
    let high = triangles.iter().flatten().fold(Vec3::NEG_INFINITY, |high, corner| high.max(*corner));
    let in_box = |center: Vec3| center.cmpge(low).all() && center.cmple(high).all();
    // Made for the first muscle that needs it: most pieces of most files lie round none.
    let (mut triangles, mut numbers) = (Some(triangles), None);
    let (mut piece, mut sum) = (Piece::default(), 0.0);
    for (index, muscle) in muscles.iter().enumerate().filter(|(_, muscle)| !muscle.bones.is_empty()) {
        let own = rest.list.get(muscle.sections.clone()).unwrap_or(&[]);
        let belly: Vec<Vec3> = own.iter().filter(|station| station.belly).step_by(STEP).map(|station| station.center).collect();
        let enough = INSIDE * belly.len() as f64;
        let near: Vec<Vec3> = belly.into_iter().filter(|center| in_box(*center)).collect();
        if near.len() as f64 <= enough {
            continue;
        }
        let numbers = numbers.get_or_insert_with(|| WindingNumbers::of(triangles.take().unwrap_or_default().into_iter()));
        let windings: Vec<f64> = near.iter().map(|center| numbers.at(center.as_dvec3())).collect();
        if windings.iter().filter(|winding| winding.abs() > 0.5).count() as f64 > enough {
            piece.muscles.push(index);
            sum += windings.iter().sum::<f64>();
        }
    }
    piece.inverted = sum < 0.0;
    piece
}
