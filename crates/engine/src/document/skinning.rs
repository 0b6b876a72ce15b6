//! The two ways to bend a skin: blended matrices, or dual quaternions.
//!
//! Blending the matrices first and transforming once costs less than transforming by each joint; the loop that does it is in
//! [`super::skin_kernel`].

use std::sync::LazyLock;

use glam::{DMat3, DMat4, DQuat, Mat3A, Quat, Vec3};

use super::skin_kernel::{self, Affine, DeformJob};
use super::skin_plan::SkinningPlan;
use sinew_scene::{Bounds, Influence, Mesh, Skin};
use sinew_simd::SimdLevel;

/// What the processor offers, asked once.
static LEVEL: LazyLock<SimdLevel> = LazyLock::new(SimdLevel::detect);

/// Matrices of one skin at one moment, and what blending them needs. Kept between frames.
#[derive(Debug, Clone, Default)]
pub(super) struct SkinDeformer {
    /// Into the world: `Jᵢ · IBMᵢ · BSM`, one a joint; where points go that no joint moves (the bind shape, with the holding node's world matrix
    /// where that is the identity); where the influence −1 puts a point (the bind shape in the file's world); then those that the plan wants blended beforehand.
    matrices: Vec<Affine>,
    /// Whether a matrix scales unevenly, so that normals need the inverse transpose.
    has_nonuniform_scale: bool,
    /// Made with the first frame.
    plan: Option<SkinningPlan>,
    /// The joints and the two other matrices as dual quaternions; filled for that mode only.
    rigid: Vec<DualQuaternion>,
    /// One a point of the file, then the one for vertices of no point; for dual quaternions only, like their plan.
    blended: Vec<Affine>,
    rigid_plan: Option<SkinningPlan>,
}

/// A palette matrix as rotation and translation (a unit dual quaternion) after a scale and shear.
#[derive(Debug, Clone, Copy)]
struct DualQuaternion {
    real: Quat,
    dual: Quat,
    stretch: Mat3A,
}

impl DualQuaternion {
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
fn has_nonuniform_scale(matrix: &Affine) -> bool {
    let m = matrix.linear();
    let lengths = [m.x_axis.length_squared(), m.y_axis.length_squared(), m.z_axis.length_squared()];
    let (low, high) = (lengths[0].min(lengths[1]).min(lengths[2]), lengths[0].max(lengths[1]).max(lengths[2]));
    let skew = m.x_axis.dot(m.y_axis).abs().max(m.y_axis.dot(m.z_axis).abs()).max(m.z_axis.dot(m.x_axis).abs());
    !(high - low <= high * 2e-3 && skew <= high * 1e-3)
}

impl SkinDeformer {
    /// Computes the matrices of `skin` for nodes at `joint_worlds` (`None` where a joint has no node: it stays in its bind pose).
    ///
    /// `node` is the world matrix of the node that places points without weights, `file` that of the file's root.
    pub(super) fn set(
        &mut self,
        skin: &Skin,
        joint_worlds: impl Iterator<Item = Option<DMat4>>,
        node: &DMat4,
        file: &DMat4,
        dual_quaternions: bool,
    ) {
        self.matrices.clear();
        self.rigid.clear();
        let bind = *file * skin.bind_shape;
        // A bind shape is where the node was when the skin was bound: both would place the point twice.
        let loose = if skin.has_identity_bind_shape() { *node * skin.bind_shape } else { bind };
        let worlds = joint_worlds.chain(std::iter::repeat(None));
        let joints = skin.joints.iter().zip(worlds).map(|(joint, world)| match world {
            Some(world) => world * joint.inverse_bind * skin.bind_shape,
            None => bind,
        });
        for matrix in joints.chain([loose, bind]) {
            self.matrices.push(Affine::of(&matrix));
            if dual_quaternions {
                self.rigid.push(DualQuaternion::of(&matrix));
            }
        }
        self.has_nonuniform_scale = self.matrices.iter().any(has_nonuniform_scale);
    }

    /// Whether the skin as a whole is mirrored: by its first matrix.
    pub(super) fn mirrors(&self) -> bool {
        self.matrices.first().is_some_and(|first| first.linear().determinant() < 0.0)
    }

    /// Bends the mesh: `from` holds positions and normals before, `to` those in the world afterwards. Returns the box round it.
    pub(super) fn deform(&mut self, skin: &Skin, mesh: &Mesh, from: (&[Vec3], &[Vec3]), to: (&mut [Vec3], &mut [Vec3])) -> Bounds {
        let (plan, matrices) = if self.rigid.is_empty() {
            let plan = self.plan.get_or_insert_with(|| SkinningPlan::of_skin(skin, mesh));
            for point in plan.preblended() {
                let blended =
                    Affine::sum(skin.influences_of(*point as usize), |joint| self.matrices[joint_index(joint, skin.joints.len())]);
                self.matrices.push(blended);
            }
            (&*plan, &self.matrices)
        } else {
            let plan = self.rigid_plan.get_or_insert_with(|| SkinningPlan::of_points(mesh));
            self.blended.clear();
            for point in 0..=mesh.source_count {
                self.blended.push(blend_quaternions(&self.rigid, &self.matrices, skin.influences_of(point as usize)));
            }
            (&*plan, &self.blended)
        };
        let mut task = DeformJob { plan, matrices, uneven: self.has_nonuniform_scale, from, to, bounds: Bounds::EMPTY };
        skin_kernel::deform(*LEVEL, &mut task);
        let bounds = task.bounds;
        // A coordinate that is no number gets lost or spoils the box: then the careful way.
        if bounds.min.is_finite() && bounds.max.is_finite() { bounds } else { Bounds::of(task.to.0.iter().copied()) }
    }
}

/// Where the matrix of an influence's joint stands: behind the joints and the one for points that no joint moves comes that for no joint.
fn joint_index(joint: i32, joints: usize) -> usize {
    usize::try_from(joint).ok().filter(|joint| *joint < joints).unwrap_or(joints + 1)
}

/// The matrix of a point with these influences; `rigid` and `matrices` both hold the joints and the two others behind them.
fn blend_quaternions(rigid: &[DualQuaternion], matrices: &[Affine], influences: &[Influence]) -> Affine {
    let joints = rigid.len() - 2;
    let Some(first) = influences.first().map(|first| joint_index(first.joint, joints)) else {
        return matrices[joints];
    };
    let (mut real, mut dual, mut stretch) = (Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), Mat3A::ZERO);
    for influence in influences {
        let part = &rigid[joint_index(influence.joint, joints)];
        // q and −q are the same turn: all are taken from the side of the first.
        let weight = if rigid[first].real.dot(part.real) < 0.0 { -influence.weight } else { influence.weight };
        real += part.real * weight;
        dual += part.dual * weight;
        stretch += part.stretch * influence.weight;
    }
    let length = real.length();
    if length <= 1e-12 {
        // Opposite half turns cancel out: then the first joint alone decides.
        return matrices[first];
    }
    let (real, dual) = (real * (1.0 / length), dual * (1.0 / length));
    let t = dual * real.conjugate() * 2.0;
    Affine::from_parts(Mat3A::from_quat(real) * stretch, Vec3::new(t.x, t.y, t.z))
}

/// Turns normals of a rigid surface: the inverse transpose, up to a positive factor.
pub(super) fn normal_matrix(matrix: &DMat4) -> Mat3A {
    skin_kernel::cofactor(&Affine::of(matrix).linear())
}
