//! Which matrices move which vertex, laid out once so that the inner loop meets no surprises.

use rustc_hash::FxHashMap;

use super::skin_kernel::Affine;
use sinew_scene::{Mesh, Skin};

/// Vertices that are worked on together: a multiple of every number of lanes.
pub(super) const GROUP: usize = 16;

/// A vertex with more influences than this gets its matrix beforehand, so that one of them in a group does not fill it up.
const MAX_INFLUENCES: usize = 8;

/// Steps of eight bytes from one matrix to the next.
const OFFSET_STRIDE: u32 = (size_of::<Affine>() / 8) as u32;

/// The share of one matrix in a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct WeightedMatrixRef {
    /// Where the matrix stands in the list, in steps of eight bytes: a processor adds such a step up for nothing, not so one of 64.
    byte_offset: u32,
    /// Its weight.
    pub(super) weight: f32,
}

impl WeightedMatrixRef {
    fn new(matrix: u32, weight: f32) -> Self {
        Self { byte_offset: matrix.min(u32::MAX / OFFSET_STRIDE) * OFFSET_STRIDE, weight }
    }

    /// Its index in the list of matrices.
    fn matrix(self) -> usize {
        (self.byte_offset / OFFSET_STRIDE) as usize
    }

    /// The matrix itself.
    ///
    /// # Safety
    /// There are more than [`WeightedMatrixRef::matrix`] matrices.
    #[inline(always)]
    pub(super) unsafe fn of(self, matrices: &[Affine]) -> &Affine {
        // SAFETY: the caller's promise; `place` is a whole number of matrices.
        unsafe { &*matrices.as_ptr().cast::<u64>().add(self.byte_offset as usize).cast() }
    }
}

/// The picks of all vertices of a mesh, in groups. Within a group every vertex has equally many: those with fewer repeat their first with weight 0.
///
/// The matrices that a plan for a skin picks from are: the joints, the one for vertices without influences, the one for influences of no joint, and
/// then one for each point of [`SkinningPlan::preblended`].
#[derive(Debug, Clone, Default)]
pub(super) struct SkinningPlan {
    refs: Vec<WeightedMatrixRef>,
    /// For each group, how many picks each of its vertices has.
    sizes: Vec<u32>,
    vertices: usize,
    matrix_count: usize,
    preblended: Vec<u32>,
}

impl SkinningPlan {
    /// For a skin on a mesh.
    pub(super) fn of_skin(skin: &Skin, mesh: &Mesh) -> Self {
        let joints = skin.joints.len() as u32;
        let (loose, bind) = (joints, joints + 1);
        let (mut long, mut places) = (Vec::new(), FxHashMap::default());
        let mut plan = Self::of(mesh, |point, picks| {
            let influences = skin.influences_of(point as usize);
            if influences.len() > MAX_INFLUENCES {
                // Vertices that were split from one point share its matrix.
                let place = *places.entry(point).or_insert_with(|| {
                    long.push(point);
                    bind + long.len() as u32
                });
                picks.push(WeightedMatrixRef::new(place, 1.0));
            } else if influences.is_empty() {
                picks.push(WeightedMatrixRef::new(loose, 1.0));
            } else {
                picks.extend(influences.iter().map(|influence| {
                    let joint = u32::try_from(influence.joint).ok().filter(|joint| *joint < joints);
                    WeightedMatrixRef::new(joint.unwrap_or(bind), influence.weight)
                }));
            }
        });
        plan.preblended = long;
        plan
    }

    /// For one matrix a point of the file, and behind those one for vertices of no point.
    pub(super) fn of_points(mesh: &Mesh) -> Self {
        Self::of(mesh, |point, picks| picks.push(WeightedMatrixRef::new(point.min(mesh.source_count), 1.0)))
    }

    /// `refs_of` appends the references of a point: at least one, at most [`MAX_INFLUENCES`].
    fn of(mesh: &Mesh, mut refs_of: impl FnMut(u32, &mut Vec<WeightedMatrixRef>)) -> Self {
        let count = mesh.positions.len();
        let mut plan = Self { vertices: count, ..Self::default() };
        let mut here = Vec::new();
        for first in (0..count).step_by(GROUP) {
            here.clear();
            // Places beyond the last vertex repeat it.
            let ranges: [_; GROUP] = std::array::from_fn(|place| {
                let from = here.len();
                let vertex = (first + place).min(count - 1);
                refs_of(mesh.source_vertex.get(vertex).copied().unwrap_or(u32::MAX), &mut here);
                from..here.len()
            });
            let size = ranges.iter().map(ExactSizeIterator::len).max().unwrap_or(1);
            for range in ranges {
                let own = &here[range];
                let fill = WeightedMatrixRef { weight: 0.0, ..own[0] };
                plan.refs.extend(own.iter().copied().chain(std::iter::repeat_n(fill, size - own.len())));
            }
            plan.sizes.push(size as u32);
        }
        plan.matrix_count = plan.refs.iter().map(|pick| pick.matrix() + 1).max().unwrap_or(0);
        plan
    }

    /// How many vertices it moves.
    pub(super) fn vertices(&self) -> usize {
        self.vertices
    }

    /// How many matrices it picks from, at least.
    pub(super) fn matrix_count(&self) -> usize {
        self.matrix_count
    }

    /// Points of the file whose matrices are to be blended beforehand.
    pub(super) fn preblended(&self) -> &[u32] {
        &self.preblended
    }

    /// For each group its first vertex and its picks: [`GROUP`] times equally many, one vertex after the other.
    pub(super) fn groups(&self) -> impl Iterator<Item = (usize, &[WeightedMatrixRef])> {
        let mut rest = self.refs.as_slice();
        self.sizes.iter().enumerate().map_while(move |(group, size)| {
            let (picks, after) = rest.split_at_checked(*size as usize * GROUP)?;
            rest = after;
            Some((group * GROUP, picks))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_scene::Influence;

    #[test]
    fn vertices_of_a_group_have_equally_many_picks_and_a_long_list_gets_a_matrix_of_its_own() {
        let mut skin = Skin { offsets: vec![0], ..Skin::default() };
        skin.joints = vec![sinew_scene::SkinJoint { name: String::new(), inverse_bind: glam::DMat4::IDENTITY }; 3];
        let lists: [&[i32]; 4] = [&[0, 1], &[], &[2, -1, 7], &[0, 1, 2, 0, 1, 2, 0, 1, 2]];
        for list in lists {
            skin.influences.extend(list.iter().map(|joint| Influence { joint: *joint, weight: 0.25 }));
            skin.offsets.push(skin.influences.len() as u32);
        }
        // Point 9 is not in the skin.
        let mesh = Mesh { positions: vec![glam::Vec3::ZERO; 6], source_vertex: vec![3, 0, 1, 3, 2, 9], source_count: 4, ..Mesh::default() };
        let plan = SkinningPlan::of_skin(&skin, &mesh);
        let groups: Vec<_> = plan.groups().collect();
        assert_eq!((groups.len(), groups[0].0, groups[0].1.len()), (1, 0, 3 * GROUP));
        let vertex = |v: usize| groups[0].1[v * 3..v * 3 + 3].iter().map(|pick| (pick.matrix(), pick.weight)).collect::<Vec<_>>();
        assert_eq!(vertex(0), [(5, 1.0), (5, 0.0), (5, 0.0)]);
        assert_eq!(vertex(1), [(0, 0.25), (1, 0.25), (0, 0.0)]);
        assert_eq!(vertex(2), [(3, 1.0), (3, 0.0), (3, 0.0)]);
        assert_eq!(vertex(3), vertex(0));
        assert_eq!(vertex(4), [(2, 0.25), (4, 0.25), (4, 0.25)]);
        assert_eq!(vertex(5), vertex(2));
        assert_eq!(vertex(15), vertex(5));
        assert_eq!((plan.matrix_count(), plan.preblended(), plan.vertices()), (6, [3].as_slice(), 6));
    }
}
