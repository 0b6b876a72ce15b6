//! The surface of a muscle: rings round its centre line, a hemisphere at each end, tendons beyond.
//!
//! Between two nodes the radius is linear (a truncated cone); where that cone is bent, more rings follow the bend. Normals are smooth along and
//! round. Texture coordinates, set 0: u goes once round, v from 0 at the origin to 1 at the insertion, so that fibres can be painted along it.

use std::f32::consts::TAU;
use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3, Vec2, Vec3, Vec4};

use super::Solved;
use super::Tendon;
use super::centerline::{Centerline, CrossSectionFrame, Cursor};
use super::flesh::{FlatSection, Flesh};
use super::materials::TENDON_PART;
use super::pennation::BellyTurns;
use super::solved_muscle::SolvedMuscle;
use sinew_scene::{Mesh, Part};

/// Corners of a ring.
pub const SEGMENTS: usize = 36;
/// Vertices of a ring: the seam stands twice, for its two texture coordinates.
const RING: usize = SEGMENTS + 1;
/// Rings of a hemisphere besides its rim.
const CAP: usize = 6;
/// About how many rings a belly has at least.
const FINE: usize = 40;
/// Rings of a tendon's tube.
const TENDON: usize = 12;

/// What decides the topology: it stays the same for all lengths of the muscle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct MuscleTopology {
    nodes: usize,
    /// Rings a span between two nodes.
    steps: usize,
    tendons: [bool; 2],
}

/// What a muscle's surface turned out to be like in a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshQuality {
    /// Whether it may run backwards somewhere, as on the inner side of a bend that is tighter than it is thick: then its inside may be seen from outside.
    pub folded: bool,
    /// Whether the way to the world mirrors it, so that clockwise is outside.
    pub mirrored: bool,
}

/// One ring to be written.
struct Ring {
    frame: CrossSectionFrame,
    radius: f64,
    /// dr/ds.
    slope: f64,
    /// How it is flattened.
    flat: Option<FlatSection>,
}

/// A muscle as it lies in a pose.
#[derive(Clone, Copy)]
pub(super) struct Laid<'a> {
    /// Its shape.
    pub solved: &'a Solved,
    /// Its tendons, with the lengths that they have.
    pub tendons: &'a [Tendon; 2],
    /// Its own centreline.
    pub line: &'a Centerline,
    /// Where bones push it aside.
    pub flesh: &'a Flesh,
}

impl<'a> Laid<'a> {
    /// A solved muscle with these tendons.
    pub(super) fn of(solved: &'a SolvedMuscle, tendons: &'a [Tendon; 2]) -> Self {
        Self { solved: &solved.shape, tendons, line: &solved.centerline, flesh: &solved.flesh }
    }

    /// Where along its line belly and tendons lie.
    pub(super) fn extent(&self) -> Extent<'a> {
        let path = self.flesh.centerline().unwrap_or(self.line);
        // A line that goes round a bone is longer than the muscle's own; its tendons take that up.
        let detour = path.length() - self.line.length();
        let tendons = fitting(self.tendons, self.line.length() - self.solved.length);
        // Where a limit holds the length, the muscle lies in the middle of its line.
        let slack = path.length() - self.solved.length - tendons[0].length - tendons[1].length;
        Extent { path, start: tendons[0].length + 0.5 * slack, tendons, detour }
    }
}

/// Where belly and tendons lie along the line that is drawn.
pub(super) struct Extent<'a> {
    /// The line through the centres of the cross-sections.
    pub path: &'a Centerline,
    /// Where on it the belly begins.
    pub start: f64,
    /// The tendons as they are drawn; each takes up half of the detour as well.
    pub tendons: [Tendon; 2],
    /// By how much the line that is drawn is longer than the muscle's own.
    pub detour: f64,
}

/// Matrices from the space of the centre line to the world.
pub(super) struct ToWorld {
    matrix: DMat4,
    normals: DMat3,
    /// Whether `normals` only turns: then normals of a ring have one length, known before they are made.
    turns: bool,
}

impl ToWorld {
    /// For the rig's root at this world matrix.
    pub(super) fn new(matrix: DMat4) -> Self {
        let linear = DMat3::from_mat4(matrix);
        // A flattened matrix has no inverse; then any normals do.
        let normals = if linear.determinant().abs() > f64::MIN_POSITIVE { linear.inverse().transpose() } else { linear };
        // Only directions matter: keep them away from the limits of f32.
        let size = normals.x_axis.length().max(normals.y_axis.length()).max(normals.z_axis.length());
        let normals = if size > 0.0 && size.is_finite() { normals * (1.0 / size) } else { DMat3::IDENTITY };
        let turns = (normals.transpose() * normals).abs_diff_eq(DMat3::IDENTITY, 1e-6);
        Self { matrix, normals, turns }
    }
}

impl MuscleTopology {
    /// For a muscle of `nodes` nodes with these tendons.
    pub(super) fn new(nodes: usize, tendons: &[Tendon; 2]) -> Self {
        let spans = nodes.saturating_sub(1).max(1);
        Self { nodes, steps: (FINE / spans).clamp(1, 8), tendons: [tendons[0].length > 0.0, tendons[1].length > 0.0] }
    }

    fn belly_rings(&self) -> usize {
        self.nodes.saturating_sub(1) * self.steps + 1 + 2 * CAP
    }

    /// Number of vertices of the mesh.
    pub(super) fn vertices(&self) -> usize {
        let tendons = self.tendons.iter().filter(|there| **there).count() * TENDON;
        self.belly_rings().saturating_add(tendons).saturating_mul(RING)
    }

    /// Number of parts of the mesh: the belly and each tendon.
    pub(super) fn parts(&self) -> usize {
        1 + self.tendons.iter().filter(|there| **there).count()
    }

    /// The mesh: topology, texture coordinates and parts; positions are those of [`MuscleTopology::deform`] and empty here but for their number.
    pub(super) fn mesh(&self, name: &str) -> Arc<Mesh> {
        let mut mesh = Mesh { name: name.to_owned(), ..Mesh::default() };
        let mut uvs = Vec::new();
        let tubes = [Some(self.belly_rings()), self.tendons[0].then_some(TENDON), self.tendons[1].then_some(TENDON)];
        for (tube, rings) in tubes.into_iter().enumerate() {
            let Some(rings) = rings else { continue };
            let (first, before) = (uvs.len() as u32, mesh.triangles.len() as u32);
            for ring in 0..rings {
                // v follows the nodes; the hemispheres keep the value of their rim.
                let v = if tube == 0 {
                    ring.saturating_sub(CAP).min(rings - 1 - 2 * CAP) as f32 / (rings - 1 - 2 * CAP) as f32
                } else {
                    ring as f32 / (rings - 1) as f32
                };
                uvs.extend((0..RING).map(|corner| Vec2::new(corner as f32 / SEGMENTS as f32, v)));
            }
            mesh.colors.extend((0..rings).flat_map(|_| (0..RING).map(|corner| fibre(corner, tube == 0))));
            for ring in 1..rings as u32 {
                for corner in 0..SEGMENTS as u32 {
                    let (a, b) = (first + (ring - 1) * RING as u32 + corner, first + ring * RING as u32 + corner);
                    // At a pole one of the two has no area.
                    if ring > 1 {
                        mesh.triangles.push([a, a + 1, b]);
                    }
                    if (ring as usize) < rings - 1 {
                        mesh.triangles.push([a + 1, b + 1, b]);
                    }
                }
            }
            mesh.parts.push(Part {
                symbol: if tube == 0 { "muscle" } else { TENDON_PART }.to_owned(),
                triangles: before..mesh.triangles.len() as u32,
                lines: 0..0,
            });
        }
        mesh.positions = vec![Vec3::ZERO; uvs.len()];
        mesh.normals = vec![Vec3::Y; uvs.len()];
        mesh.source_count = uvs.len() as u32;
        mesh.source_vertex = (0..mesh.source_count).collect();
        mesh.uv_sets = vec![uvs];
        Arc::new(mesh)
    }

    /// Changes the texture coordinates of the mesh so that fibres go round the belly: towards its seam, from both sides.
    pub(super) fn turn_fibers(&self, turns: &BellyTurns<'_>, coordinates: &mut [Vec2]) {
        let places = self.nodes.saturating_sub(1) * self.steps;
        let mut turned = 0.0;
        for (ring, corners) in coordinates.chunks_mut(RING).take(self.belly_rings()).enumerate() {
            // The hemispheres keep the value of their rim.
            let place = ring.saturating_sub(CAP).min(places);
            let (span, step) = (place / self.steps, place % self.steps);
            if step == 0 && place > 0 && ring == place + CAP {
                turned += turns.over(span - 1, 1.0);
            }
            let here = turned + if step > 0 { turns.over(span, step as f64 / self.steps as f64) } else { 0.0 };
            for corner in corners {
                corner.x = corner.x.min(1.0 - corner.x) - here as f32;
            }
        }
    }

    /// Writes positions and normals in the world of a muscle as it lies in a pose.
    pub(super) fn deform(&self, laid: &Laid<'_>, to_world: &ToWorld, positions: &mut Vec<Vec3>, normals: &mut Vec<Vec3>) -> MeshQuality {
        positions.clear();
        normals.clear();
        let mut out = Writer { to_world, circle: circle(), positions, normals, before: None, folded: false };
        let Laid { solved, flesh, .. } = *laid;
        let Extent { path, start, ref tendons, detour } = laid.extent();
        let section = |at: f64| flesh.section(at / path.length());
        let spans = self.nodes.saturating_sub(1).max(1);
        let spacing = solved.length / spans as f64;
        let radius = |node: usize| solved.radii.get(node).copied().unwrap_or(0.0);
        let cone = |span: usize| (radius(span + 1) - radius(span)) / spacing;
        // Slope at a node: the mean of the cones that meet there.
        let slope = |node: usize| 0.5 * (cone(node.max(1) - 1) + cone(node.min(spans - 1)));
        let mut cursor = path.cursor();
        out.cap(cursor.frame_at(start), radius(0), -1.0, section(start));
        for span in 0..spans {
            let steps = if span + 1 == spans { self.steps + 1 } else { self.steps };
            for step in 0..steps {
                let share = step as f64 / self.steps as f64;
                let blend = |a: f64, b: f64| a + (b - a) * share;
                let at = start + (span as f64 + share) * spacing;
                let (frame, flat) = (cursor.frame_at(at), section(at));
                let ring = Ring { frame, radius: blend(radius(span), radius(span + 1)), slope: blend(slope(span), slope(span + 1)), flat };
                out.ring(&ring);
            }
        }
        let end = start + solved.length;
        out.cap(cursor.frame_at(end), radius(spans), 1.0, section(end));
        if self.tendons[0] {
            out.tendon(
                path.cursor(),
                start - tendons[0].length - 0.5 * detour,
                start,
                [tendons[0].radius, tendons[0].radius.min(radius(0))],
            );
        }
        if self.tendons[1] {
            out.tendon(
                path.cursor(),
                end,
                end + tendons[1].length + 0.5 * detour,
                [tendons[1].radius.min(radius(spans)), tendons[1].radius],
            );
        }
        MeshQuality { folded: out.folded, mirrored: to_world.matrix.determinant() < 0.0 }
    }
}

/// Tendons that a line leaves no more than `room` for are drawn slack, as if they were so much shorter: the belly is not pushed together for them.
fn fitting(tendons: &[Tendon; 2], room: f64) -> [Tendon; 2] {
    let long = tendons[0].length + tendons[1].length;
    // Rounding makes no tendon slack.
    let share = if long > 0.0 && long - room > 1e-9 * long { room.max(0.0) / long } else { 1.0 };
    tendons.map(|tendon| Tendon { length: tendon.length * share, ..tendon })
}

/// Fibres: lengthwise streaks a little darker than the material, the same at every ring, so that they follow the nodes.
fn fibre(corner: usize, flesh: bool) -> Vec4 {
    // Multiples of the golden ratio never repeat and lie evenly: no two neighbours alike, no pattern to see.
    let spread = ((corner % SEGMENTS) as f32 * 0.618_034).fract();
    let shade = 1.0 - if flesh { 0.22 } else { 0.06 } * spread;
    Vec4::new(shade, shade, shade, 1.0)
}

/// Cosine and sine of each corner of a ring.
fn circle() -> &'static [(f32, f32); RING] {
    static CIRCLE: std::sync::OnceLock<[(f32, f32); RING]> = std::sync::OnceLock::new();
    CIRCLE.get_or_init(|| {
        std::array::from_fn(|corner| {
            let (sin, cos) = ((corner % SEGMENTS) as f32 / SEGMENTS as f32 * TAU).sin_cos();
            (cos, sin)
        })
    })
}

/// The half axes of a flattened circle of radius 1.
#[derive(Clone, Copy, PartialEq)]
struct FlatAxes {
    /// Direction of the short one.
    toward: DVec3,
    /// Length of the long one; the short one is 1 over it.
    long: f64,
}

impl FlatAxes {
    const ROUND: Self = Self { toward: DVec3::ZERO, long: 1.0 };

    /// Square to a tangent; `None` where the direction is along it.
    fn new(flat: FlatSection, tangent: DVec3) -> Option<Self> {
        let toward = flat.toward.reject_from_normalized(tangent).try_normalize()?;
        Some(Self { toward, long: flat.flatness.sqrt() })
    }

    /// What becomes of a direction of the circle.
    fn stretched(&self, axis: DVec3) -> DVec3 {
        let short = self.toward * self.toward.dot(axis);
        (axis - short) * self.long + short / self.long
    }

    /// What becomes of a normal.
    fn normal(&self, axis: DVec3) -> DVec3 {
        let short = self.toward * self.toward.dot(axis);
        (axis - short) / self.long + short * self.long
    }
}

struct Writer<'a> {
    to_world: &'a ToWorld,
    circle: &'static [(f32, f32); RING],
    positions: &'a mut Vec<Vec3>,
    normals: &'a mut Vec<Vec3>,
    /// Middle, tangent and radius of the ring before, in the same tube.
    before: Option<(DVec3, DVec3, f64)>,
    folded: bool,
}

impl Writer<'_> {
    /// Compares a ring with the one before: no corner may lie behind the plane of the other's ring.
    fn follow(&mut self, position: DVec3, tangent: DVec3, radius: f64) {
        let ahead = self.before.is_none_or(|(from, along, wide)| {
            let (step, turn) = (position - from, along.cross(tangent).length());
            step.dot(along) >= radius * turn && step.dot(tangent) >= wide * turn
        });
        self.folded |= !ahead;
        self.before = Some((position, tangent, radius));
    }

    fn ring(&mut self, ring: &Ring) {
        let CrossSectionFrame { position, tangent, u, v, .. } = ring.frame;
        let section = ring.flat.and_then(|flat| FlatAxes::new(flat, tangent)).unwrap_or(FlatAxes::ROUND);
        self.follow(position, tangent, ring.radius * section.long);
        let matrix = &self.to_world.matrix;
        let centre = matrix.transform_point3(position).as_vec3();
        let [across_u, across_v] = [u, v].map(|axis| (matrix.transform_vector3(section.stretched(axis)) * ring.radius).as_vec3());
        // What is not a number is not drawn, and leaves a hole.
        self.folded |= !(centre + across_u.abs() + across_v.abs()).is_finite();
        // Of length 1 where the matrix only turns.
        let scale = 1.0 / (1.0 + ring.slope * ring.slope).sqrt();
        let normal = |axis: DVec3| (self.to_world.normals * (axis * scale)).as_vec3();
        let (normal_u, normal_v) = (normal(section.normal(u)), normal(section.normal(v)));
        let back = normal(tangent * -ring.slope);
        self.positions.extend(self.circle.iter().map(|&(cos, sin)| centre + across_u * cos + across_v * sin));
        let normals = self.circle.iter().map(|&(cos, sin)| normal_u * cos + normal_v * sin + back);
        if self.to_world.turns && section == FlatAxes::ROUND {
            self.normals.extend(normals);
        } else {
            self.normals.extend(normals.map(|normal| normal * normal.length_squared().max(f32::MIN_POSITIVE).sqrt().recip()));
        }
    }

    /// A hemisphere without its rim, whose pole looks along `direction` times the tangent; its rings come in the order of the path.
    fn cap(&mut self, frame: CrossSectionFrame, radius: f64, direction: f64, flat: Option<FlatSection>) {
        for ring in 0..CAP {
            let latitude = if direction < 0.0 { ring } else { CAP - 1 - ring } as f64 / CAP as f64 * std::f64::consts::FRAC_PI_2;
            // `latitude` is measured from the pole.
            let (sin, cos) = latitude.sin_cos();
            let moved = CrossSectionFrame { position: frame.position + frame.tangent * (direction * radius * cos), ..frame };
            // For a sphere −dr/ds is the tangent of the elevation; at the pole the ring is a point and only the direction along counts.
            let slope = -direction * cos / sin.max(1e-6);
            self.ring(&Ring { frame: moved, radius: radius * sin, slope, flat });
        }
    }

    /// A tube between two lengths of the path, closed by points.
    fn tendon(&mut self, mut cursor: Cursor<'_>, from: f64, to: f64, radii: [f64; 2]) {
        self.before = None;
        for ring in 0..TENDON {
            // The first and last ring are points that close the tube.
            let share = ring.saturating_sub(1).min(TENDON - 3) as f64 / (TENDON - 3) as f64;
            let closes = if ring == 0 {
                1e6
            } else if ring == TENDON - 1 {
                -1e6
            } else {
                0.0
            };
            let radius = if closes == 0.0 { radii[0] + (radii[1] - radii[0]) * share } else { 0.0 };
            self.ring(&Ring { frame: cursor.frame_at(from + (to - from) * share), radius, slope: closes, flat: None });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NO_TENDONS: [Tendon; 2] = [Tendon { length: 0.0, radius: 0.0 }, Tendon { length: 0.0, radius: 0.0 }];

    /// A muscle as thick as `radius` along a quarter of a circle of radius 10.
    fn bent(radius: f64, world: DMat4) -> (MeshQuality, Vec<Vec3>) {
        let mut path = Centerline::new(DVec3::Z);
        path.arc(DVec3::ZERO, DVec3::X, DVec3::Y, 10.0, std::f64::consts::FRAC_PI_2);
        let solved = Solved { length: path.length(), radii: vec![radius; 6], ..Solved::default() };
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        let laid = Laid { solved: &solved, tendons: &NO_TENDONS, line: &path, flesh: &Flesh::default() };
        let cover = MuscleTopology::new(6, &NO_TENDONS).deform(&laid, &ToWorld::new(world), &mut positions, &mut normals);
        (cover, positions)
    }

    #[test]
    fn a_muscle_folds_where_it_is_thicker_than_its_bend() {
        assert!(!bent(9.9, DMat4::IDENTITY).0.folded);
        assert!(bent(10.1, DMat4::IDENTITY).0.folded);
        // What cannot be drawn leaves a hole, and so is not closed.
        assert!(bent(f64::NAN, DMat4::IDENTITY).0.folded && bent(9.0, DMat4::from_scale(DVec3::splat(1e38))).0.folded);
    }

    #[test]
    fn a_mirror_turns_the_outside_round() {
        let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        assert!(!bent(3.0, DMat4::IDENTITY).0.mirrored && bent(3.0, mirror).0.mirrored);
        let volume = |world: DMat4| {
            let (_, positions) = bent(3.0, world);
            let mesh = MuscleTopology::new(6, &NO_TENDONS).mesh("");
            let corner = |v: u32| positions[v as usize].as_dvec3();
            mesh.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum::<f64>()
        };
        assert!(volume(DMat4::IDENTITY) > 0.0 && (volume(DMat4::IDENTITY) + volume(mirror)).abs() < 1e-2);
    }
}
