//! The two ways to bend a skin, one blended transform a point of the file, applied to all vertices that were split from it.
//!
//! Blending the matrices first and transforming once costs less than transforming by each joint; the two loops that do it are in
//! [`super::skin_kernel`].

use glam::{DMat3, DMat4, DQuat, Mat3A, Quat, Vec3};

use super::skin_kernel::{self, Columns};
use crate::scene::{Bounds, Influence, Mesh, Skin};

/// Matrices of one skin at one moment, and what blending them needs. Kept between frames.
#[derive(Debug, Clone, Default)]
pub(super) struct Palette {
    /// `Jᵢ · IBMᵢ · BSM`, one a joint, into the world.
    joints: Vec<Columns>,
    /// Where points go that no joint moves: the holding node's world matrix times the bind shape matrix.
    loose: Columns,
    /// Where the influence −1 puts a point: the bind shape in the file's world.
    bind: Columns,
    /// Whether a matrix scales unevenly, so that normals need the inverse transpose.
    uneven: bool,
    /// The same matrices as dual quaternions, filled for that mode only: joints, then `loose`, then `bind`.
    rigid: Vec<Rigid>,
    /// One a point of the file.
    blended: Vec<Columns>,
}

/// A palette matrix as rotation and translation (a unit dual quaternion) after a scale and shear.
#[derive(Debug, Clone, Copy)]
struct Rigid {
    real: Quat,
    dual: Quat,
    stretch: Mat3A,
}

impl Rigid {
    fn of(matrix: &DMat4) -> Self {
        let linear = DMat3::from_mat4(*matrix);
        let rotation = rotation_of(linear);
        let stretch = DMat3::from_quat(rotation.conjugate()) * linear;
        let t = matrix.w_axis.truncate() * 0.5;
        // Dual part: ½ t q.
        let dual = DQuat::from_xyzw(t.x, t.y, t.z, 0.0) * rotation;
        Self { real: rotation.as_quat(), dual: dual.as_quat(), stretch: Mat3A::from(stretch.as_mat3()) }
    }
}

/// The rotation in a matrix, by Gram–Schmidt; a mirroring stays in the rest.
fn rotation_of(linear: DMat3) -> DQuat {
    let x = linear.x_axis.try_normalize().unwrap_or(glam::DVec3::X);
    let y = (linear.y_axis - x * x.dot(linear.y_axis)).try_normalize().unwrap_or_else(|| x.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y)))
}

/// Whether a matrix stretches one direction more than another by over a thousandth.
fn is_uneven(matrix: &Columns) -> bool {
    let m = matrix.linear();
    let lengths = [m.x_axis.length_squared(), m.y_axis.length_squared(), m.z_axis.length_squared()];
    let (low, high) = (lengths[0].min(lengths[1]).min(lengths[2]), lengths[0].max(lengths[1]).max(lengths[2]));
    let skew = m.x_axis.dot(m.y_axis).abs().max(m.y_axis.dot(m.z_axis).abs()).max(m.z_axis.dot(m.x_axis).abs());
    !(high - low <= high * 2e-3 && skew <= high * 1e-3)
}

impl Palette {
    /// Computes the matrices of `skin` for nodes at `joint_worlds` (`None` where a joint has no node: it stays in its bind pose).
    ///
    /// `node` is the world matrix of the node that holds the skin, `file` that of the file's root.
    pub(super) fn set(
        &mut self,
        skin: &Skin,
        joint_worlds: impl Iterator<Item = Option<DMat4>>,
        node: &DMat4,
        file: &DMat4,
        dual_quaternions: bool,
    ) {
        self.joints.clear();
        self.rigid.clear();
        let (loose, bind) = (*node * skin.bind_shape, *file * skin.bind_shape);
        for (joint, world) in skin.joints.iter().zip(joint_worlds) {
            let matrix = world.map_or(bind, |world| world * joint.inverse_bind * skin.bind_shape);
            self.joints.push(Columns::of(&matrix));
            if dual_quaternions {
                self.rigid.push(Rigid::of(&matrix));
            }
        }
        if dual_quaternions {
            self.rigid.extend([Rigid::of(&loose), Rigid::of(&bind)]);
        }
        (self.loose, self.bind) = (Columns::of(&loose), Columns::of(&bind));
        self.uneven = self.joints.iter().chain([&self.loose, &self.bind]).any(is_uneven);
    }

    /// Whether the skin as a whole is mirrored: by its first matrix.
    pub(super) fn mirrors(&self) -> bool {
        self.joints.first().unwrap_or(&self.loose).linear().determinant() < 0.0
    }

    /// Bends the mesh: `positions` and `normals` hold the shape before and the world afterwards. Returns the box round it.
    pub(super) fn bend(&mut self, skin: &Skin, mesh: &Mesh, positions: &mut [Vec3], normals: &mut [Vec3]) -> Bounds {
        let points = mesh.source_count as usize;
        let mut blended = std::mem::take(&mut self.blended);
        blended.clear();
        if self.rigid.is_empty() {
            skin_kernel::blend(skin, points, &self.joints, &self.loose, &self.bind, &mut blended);
        } else {
            blended.extend((0..points).map(|point| self.blend_quaternions(skin.influences_of(point))));
        }
        let bounds = skin_kernel::transform(&blended, &self.loose, &mesh.source_vertex, self.uneven, positions, normals);
        self.blended = blended;
        // A coordinate that is no number gets lost or spoils the box: then the careful way.
        if bounds.min.is_finite() && bounds.max.is_finite() { bounds } else { Bounds::of(positions.iter().copied()) }
    }

    fn blend_quaternions(&self, influences: &[Influence]) -> Columns {
        let pick = |joint: i32| {
            let at = usize::try_from(joint).ok().filter(|joint| *joint < self.joints.len()).unwrap_or(self.joints.len() + 1);
            self.rigid.get(at)
        };
        let Some(first) = influences.first().and_then(|first| pick(first.joint)) else {
            return self.loose;
        };
        let (mut real, mut dual, mut stretch) = (Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), Mat3A::ZERO);
        for influence in influences {
            let Some(part) = pick(influence.joint) else { continue };
            // q and −q are the same turn: all are taken from the side of the first.
            let weight = if first.real.dot(part.real) < 0.0 { -influence.weight } else { influence.weight };
            real += part.real * weight;
            dual += part.dual * weight;
            stretch += part.stretch * influence.weight;
        }
        let length = real.length();
        if length <= 1e-12 {
            // Opposite half turns cancel out: then the first joint alone decides.
            return influences.first().map_or(self.loose, |first| self.joints.get(first.joint as usize).copied().unwrap_or(self.bind));
        }
        let (real, dual) = (real * (1.0 / length), dual * (1.0 / length));
        let t = dual * real.conjugate() * 2.0;
        Columns::from_parts(Mat3A::from_quat(real) * stretch, Vec3::new(t.x, t.y, t.z))
    }
}

/// Turns normals of a rigid surface: the inverse transpose, up to a positive factor.
pub(super) fn normal_matrix(matrix: &DMat4) -> Mat3A {
    skin_kernel::cofactor(&Columns::of(matrix).linear())
}
