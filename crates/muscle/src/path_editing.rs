//! Where a hand's new via point goes, and the ball of a muscle that is to go round a joint.

use glam::{DMat3, DMat4, DVec3};

use super::MuscleState;
use super::config::{Anchor, Wrap, WrapShape};
use super::joint_dof::JointDof;
use super::line_of_action::{Frames, Line, LineSolver};
use super::muscle_rig::MuscleRig;
use super::retarget::{beside, neat};
use super::solved_muscle::SolvedMuscle;
use super::wrap_object::angles_of;
use super::wrap_placement::WrapPlacement;
use sinew_scene::{Graph, NodeId, Scene};

/// Places along a centre line that are looked at for the nearest one.
const PLACES: u32 = 256;
/// Places of a geodesic of the line of action.
const ARC_PLACES: usize = 17;
/// Radius of a new ball over the muscle's thickest radius.
const THICK: f64 = 0.8;
/// A side that is as near as this to an axis of its bone, as a cosine, is that axis: numbers that a person can read.
const NEAR_AXIS: f64 = 0.95;
/// Nearer to the centre line than this share of its length a ball's middle is on it, and the line does not say on which side it passes.
const ON_LINE: f64 = 1e-3;

impl MuscleRig {
    /// Where a new via point of muscle `index` goes that is to change its way the least: on the drawn centre line, half-way along the longest stretch.
    /// Its number, its bone (that of the point before it) and its place in the world; `None` where nothing holds the muscle.
    pub fn via_half_way(&self, index: usize, drive: MuscleState, world: &[DMat4]) -> Option<(usize, NodeId, DVec3)> {
        let line = self.line(index)?;
        let corners = self.corners(line, world);
        let length = |pair: &[DVec3]| pair[0].distance(pair[1]);
        let (number, pair) = corners.windows(2).enumerate().max_by(|a, b| length(a.1).total_cmp(&length(b.1)))?;
        let before = number.checked_sub(1).and_then(|before| line.via.get(before)).map_or(line.origin, |via| via.point);
        let (place, _) = self.nearest(index, drive, world, 0.5 * (pair[0] + pair[1]))?;
        Some((number, *self.bones.get(before.bone)?, self.root_matrix(world).transform_point3(place)))
    }

    /// The number of a new via point of muscle `index` at a place in the world: the stretch that passes nearest gets it.
    pub fn via_number_at(&self, index: usize, place: DVec3, world: &[DMat4]) -> Option<usize> {
        let corners = self.corners(self.line(index)?, world);
        let place = self.frames(world).from_world.transform_point3(place);
        let away = |pair: &[DVec3]| {
            let along = pair[1] - pair[0];
            let share = (place - pair[0]).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
            place.distance(pair[0] + along * share.clamp(0.0, 1.0))
        };
        corners.windows(2).enumerate().min_by(|a, b| away(a.1).total_cmp(&away(b.1))).map(|(number, _)| number)
    }

    /// Where a via point of muscle `index` goes for which a hand shows a place on the muscle itself: the bone of the point before it, and the place inside,
    /// on the drawn centre line, in the world.
    pub fn via_inside(&self, index: usize, place: DVec3, drive: MuscleState, world: &[DMat4]) -> Option<(NodeId, DVec3)> {
        let line = self.line(index)?;
        let number = self.via_number_at(index, place, world)?;
        let before = number.checked_sub(1).and_then(|before| line.via.get(before)).map_or(line.origin, |via| via.point);
        let (inside, _) = self.nearest(index, drive, world, self.frames(world).from_world.transform_point3(place))?;
        Some((*self.bones.get(before.bone)?, self.root_matrix(world).transform_point3(inside)))
    }

    /// What muscle `index` goes round where a hand chooses `node` for surface `number`: its centre in the joint by which the muscle leaves that bone. A surface that
    /// is there already keeps its shape and stays turned as it is; a new one is a sphere with its side where the muscle passes now. `None` where nothing holds the muscle or
    /// the file has no name for the bone.
    pub fn wrap_on(&self, index: usize, number: usize, node: NodeId, scene: &Scene, drive: MuscleState, world: &[DMat4]) -> Option<Wrap> {
        let (line, spec) = (self.line(index)?, self.spec(index)?);
        let node = self.carrier(&scene.graph, node);
        let ends = [line.origin, line.insertion].map(|point| self.bones.get(point.bone).copied());
        let joint = joint_of(&scene.graph, node, [ends[0]?, ends[1]?]);
        let middle = world.get(joint.index())?.w_axis.truncate();
        if let (Some(there), Some(wrap)) = (self.wrap_placement(index, number, world), spec.wraps.get(number)) {
            let mut wrap = Wrap { center: self.anchor_at(&scene.graph, node, middle, world)?, ..wrap.clone() };
            match (wrap.shape, there.side) {
                (WrapShape::Sphere { .. }, Some(side)) => {
                    (wrap.rotation, wrap.side) = (DVec3::ZERO, Some(readable(self.direction_on(node, side, world))));
                }
                _ => {
                    let [x, z] = [there.axes.x_axis, there.axes.z_axis].map(|axis| self.direction_on(node, axis, world));
                    wrap.rotation = angles_of(x, z);
                }
            }
            return Some(wrap);
        }
        let side = self.root_matrix(world).transform_vector3(self.side_of(index, middle, scene, drive, world)?);
        let thickest = spec.profile.radii().iter().copied().fold(0.0, f64::max);
        let radius = neat(THICK * thickest);
        let root = self.root_matrix(world);
        let ends = [line.origin, line.insertion].map(|point| root.transform_point3(self.frames(world).place(point)));
        let wide = root.transform_vector3(DVec3::X * (radius * self.scale(index))).length();
        let middle = beside(middle, ends, side.normalize_or(DVec3::X), wide);
        let center: Anchor = self.anchor_at(&scene.graph, node, middle, world)?;
        Some(Wrap::sphere(center, radius, readable(self.direction_on(node, side, world))))
    }

    /// Surface `number` of muscle `index` with another shape of about the same size: sphere (0), cylinder (1), ellipsoid (2) or torus (3). What has an axis
    /// lies along the joint's where it had none; a torus lies across the muscle. `None` where there is no such surface, or it has that shape already.
    pub fn wrap_shaped(
        &self,
        index: usize,
        number: usize,
        shape: usize,
        joint: Option<&JointDof>,
        scene: &Scene,
        world: &[DMat4],
    ) -> Option<Wrap> {
        let wrap = self.spec(index)?.wraps.get(number)?;
        let old = match wrap.shape {
            WrapShape::Sphere { .. } => 0,
            WrapShape::Cylinder { .. } => 1,
            WrapShape::Ellipsoid { .. } => 2,
            WrapShape::Torus { .. } => 3,
        };
        let radius = wrap.shape.sizes().next()?;
        let new = match shape {
            0 => WrapShape::Sphere { radius },
            1 => WrapShape::Cylinder { radius, length: neat(4.0 * radius) },
            2 => WrapShape::Ellipsoid { radii: DVec3::new(radius, radius, neat(1.5 * radius)) },
            3 => WrapShape::Torus { radius: neat(1.5 * radius), tube: neat(0.5 * radius) },
            _ => return None,
        };
        if old == shape {
            return None;
        }
        let mut wrap = Wrap { shape: new, ..wrap.clone() };
        let placement = self.wrap_placement(index, number, world)?;
        let node = *self.bones.get(self.line(index)?.wraps.get(number)?.center.bone)?;
        let along = |axis: DVec3| self.direction_on(node, axis, world);
        // A sphere has no axis, so that its side tells x and the joint the axis; from then on the frame stays.
        if old == 0 {
            let bend = joint.map(|joint| {
                let above = scene.graph.node(joint.node).parent().and_then(|parent| world.get(parent.index()));
                above.map_or(joint.axis, |above| above.transform_vector3(joint.axis))
            });
            let side = placement.side.unwrap_or(placement.axes.x_axis);
            let axis = bend.unwrap_or(placement.axes.y_axis);
            let axis = if shape == 3 { axis.cross(side) } else { axis };
            let axis = axis.reject_from(side).try_normalize().unwrap_or_else(|| side.any_orthonormal_vector());
            wrap.rotation = angles_of(along(side), along(axis));
            wrap.side = wrap.side.map(|_| DVec3::X);
        }
        if shape == 0 {
            // The side of a sphere is along the bone's axes.
            wrap.rotation = DVec3::ZERO;
            wrap.side = placement.side.map(|side| readable(along(side)));
        }
        if shape == 3 {
            wrap.side = None;
        }
        Some(wrap)
    }

    /// The half axis of surface `number` of muscle `index` nearest to the side on which the muscle passes it in this pose, in the surface's frame.
    pub fn passing_side(&self, index: usize, number: usize, world: &[DMat4]) -> DVec3 {
        let found = || {
            let line = self.line(index)?;
            let wrap = line.wraps.get(number)?;
            let frames = self.frames(world);
            let placed = wrap.placed(&frames.frame(wrap.center.bone), 0, 0..0);
            let mut solver = LineSolver::default();
            let solution = line.solve(&frames, &mut solver);
            let on_it = solution.arcs().iter().find(|arc| arc.surface == number).map(|arc| arc.start_normal());
            let nearest = || {
                let ends = solution.stretches().get(wrap.stretches.start)?;
                let along = (ends.end - ends.start).try_normalize()?;
                Some((ends.start - placed.center).reject_from_normalized(along))
            };
            let local = placed.rotation.inverse() * on_it.or_else(nearest)?;
            let local = if matches!(wrap.shape, WrapShape::Cylinder { .. }) { local.with_z(0.0) } else { local };
            let axis = (0..3).max_by(|a, b| local[*a].abs().total_cmp(&local[*b].abs()))?;
            Some(DVec3::AXES[axis] * local[axis].signum() + DVec3::ZERO)
        };
        found().unwrap_or(DVec3::X)
    }

    /// Where surface `number` of muscle `index` is.
    pub fn wrap_placement(&self, index: usize, number: usize, world: &[DMat4]) -> Option<WrapPlacement> {
        let wrap = self.line(index)?.wraps.get(number)?;
        let (frames, root) = (self.frames(world), self.root_matrix(world));
        let placed = wrap.placed(&frames.frame(wrap.center.bone), 0, 0..0);
        let metres = root.transform_vector3(DVec3::X).length();
        let axis = |axis: DVec3| root.transform_vector3(placed.rotation * axis).normalize_or(axis);
        let axes = DMat3::from_cols(axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z));
        let side = placed.side.direction().map(|side| axes * side);
        Some(WrapPlacement { shape: wrap.shape.scaled(metres), center: root.transform_point3(placed.center), axes, side })
    }

    /// Points of the line of action of a solved muscle `index` in the world, metres: ends, via points that are passed, and places on geodesics. `None` where nothing
    /// holds the muscle.
    pub fn line_of_action(&self, index: usize, solved: &SolvedMuscle, world: &[DMat4]) -> Option<Vec<DVec3>> {
        self.line(index)?;
        let (solution, root) = (solved.line_of_action(), self.root_matrix(world));
        let mut points: Vec<DVec3> = Vec::new();
        for stretch in solution.stretches() {
            points.push(stretch.start);
            for arc in solution.arcs_of(stretch) {
                points.extend(arc.sample(ARC_PLACES).map(|(point, _)| point));
            }
        }
        points.extend(solution.stretches().last().map(|stretch| stretch.end));
        Some(points.into_iter().map(|point| root.transform_point3(point)).collect())
    }

    fn line(&self, index: usize) -> Option<&Line> {
        self.muscles.get(index)?.line.as_ref()
    }

    /// Origin, via points and insertion, from the root.
    fn corners(&self, line: &Line, world: &[DMat4]) -> Vec<DVec3> {
        let frames = self.frames(world);
        let at_rest = |number: usize| line.via.get(number.checked_sub(1)?).map(|via| frames.place(via.point));
        // A via point that is not passed keeps its number.
        (0..line.count()).filter_map(|number| line.place(number, &frames).or_else(|| at_rest(number))).collect()
    }

    /// The place on the drawn centre line nearest to a point, both from the root, and the line's direction there.
    fn nearest(&self, index: usize, drive: MuscleState, world: &[DMat4], point: DVec3) -> Option<(DVec3, DVec3)> {
        self.line(index)?;
        let solved = self.solve(index, drive, world);
        let path = solved.centerline();
        let mut cursor = path.cursor();
        let frames = (0..=PLACES).map(|step| cursor.frame_at(path.length() * f64::from(step) / f64::from(PLACES)));
        let away = |at: DVec3| at.distance_squared(point);
        let nearest = frames.min_by(|a, b| away(a.position).total_cmp(&away(b.position)))?;
        Some((nearest.position, nearest.tangent))
    }

    /// The side of a point of the world on which muscle `index` passes; where it goes right through, the one to which the joint bends. From the root.
    fn side_of(&self, index: usize, middle: DVec3, scene: &Scene, drive: MuscleState, world: &[DMat4]) -> Option<DVec3> {
        let middle = self.frames(world).from_world.transform_point3(middle);
        let (place, tangent) = self.nearest(index, drive, world, middle)?;
        let out = (place - middle).reject_from_normalized(tangent.normalize_or(DVec3::Y));
        if out.length() > ON_LINE * self.profile(index)?.rest_length() {
            return Some(out.normalize_or(DVec3::X));
        }
        let bends = self.joint().map_or(DVec3::Z.cross(tangent), |joint| self.revolute_of(&joint, scene, world).bends(tangent));
        Some(bends.normalize_or(DVec3::X))
    }
}

/// The joint by which a muscle between the bones `ends` leaves the bone `node`: its own where just one end is beyond it, else that of the bone on it which
/// leads to one end alone.
fn joint_of(graph: &Graph, node: NodeId, ends: [NodeId; 2]) -> NodeId {
    let parts = |top: NodeId| {
        let below = graph.subtree(top);
        below.contains(&ends[0]) != below.contains(&ends[1])
    };
    if parts(node) {
        return node;
    }
    graph.node(node).children().iter().copied().find(|child| parts(*child)).unwrap_or(node)
}

/// A direction in numbers that a person can read.
fn readable(side: DVec3) -> DVec3 {
    let largest = (0..3).max_by(|a, b| side[*a].abs().total_cmp(&side[*b].abs())).unwrap_or(0);
    if side[largest].abs() >= NEAR_AXIS * side.length() {
        return DVec3::AXES[largest] * side[largest].signum() + DVec3::ZERO;
    }
    (side * 100.0).round() / 100.0 + DVec3::ZERO
}
