//! Paths and sizes of the muscles of an arm: Arm26 of OpenSim, a right arm.
//!
//! Jeff Reinbolt, Ajay Seth, Ayman Habib and Sam Hamner after a model by Kate Holzbaur; licence CC BY 3.0. Holzbaur, Murray and Delp 2005, A model of the upper
//! extremity for simulating musculoskeletal surgery and analyzing neuromuscular control, Ann. Biomed. Eng. 33:829. The figures are those of the model; points
//! on its base are given from the centre of the shoulder. The wrist is ours: Arm26 has none; it stands where the lunate meets the radius. So is where along a unit its belly lies,
//! and so are the sides on which muscles pass the cylinder of the elbow, where the model takes the nearer one.

use glam::DVec3;

use super::data::Segment::{Forearm, Girdle, Humerus};
use super::data::{Coordinate, CoordinateData, Model, MuscleData, SegmentData, WrapData, fixed};
use crate::config::WrapShape;

/// The arm.
pub(super) const ARM: Model = Model {
    name: "Arm26",
    credit: "Reinbolt, Seth, Habib, Hamner after a model by Holzbaur; CC BY 3.0",
    segments: &[
        // Its frame is the humerus' in the default pose, and has that bone's scale.
        SegmentData { segment: Girdle, begin: [0.0, 0.0, 0.0], end: [0.0061, -0.2904, -0.0123] },
        SegmentData { segment: Humerus, begin: [0.0, 0.0, 0.0], end: [0.0061, -0.2904, -0.0123] },
        SegmentData { segment: Forearm, begin: [0.0, 0.0, 0.0], end: [0.008, -0.249, 0.063] },
    ],
    coordinates: &[
        CoordinateData { coordinate: Coordinate::ElbowFlexion, range: [0.0, 130.0] },
        CoordinateData { coordinate: Coordinate::ShoulderElevation, range: [-40.0, 90.0] },
    ],
    muscles: &MUSCLES,
};

/// The elbow, as the triceps passes it.
const AT_ELBOW_BEHIND: WrapData = WrapData { side: [-1.0, 0.0, 0.0], between: Some([3, 4]), ..AT_ELBOW_FRONT };
/// The elbow, as the brachialis passes it.
const AT_ELBOW_FRONT: WrapData = WrapData {
    segment: Humerus,
    shape: WrapShape::Cylinder { radius: 0.016, length: 0.05 },
    center: [0.0028, -0.2919, -0.0069],
    rotation: [-0.14015, -0.00628319, 0.154985],
    side: [1.0, 0.0, 0.0],
    between: None,
};
/// The head of the humerus under the long head of the triceps.
const AT_SHOULDER_BEHIND: WrapData = WrapData {
    segment: Humerus,
    shape: WrapShape::Ellipsoid { radii: DVec3::new(0.035, 0.02, 0.02) },
    center: [-0.0078, -0.0041, -0.0014],
    rotation: [3.00162, -0.853466, 2.57419],
    side: [0.0, 0.0, 1.0],
    between: Some([0, 1]),
};
/// The head of the humerus under the long head of the biceps.
const AT_SHOULDER_FRONT: WrapData = WrapData {
    segment: Humerus,
    shape: WrapShape::Ellipsoid { radii: DVec3::new(0.025, 0.02, 0.02) },
    center: [0.0033, 0.0073, 0.0003],
    rotation: [-2.00434, -1.00164, 0.975465],
    side: [0.0, -1.0, 0.0],
    between: Some([1, 2]),
};

/// The muscles.
const MUSCLES: [MuscleData; 6] = [
    MuscleData {
        name: "TRIlong",
        meaning: "Triceps brachii, long head",
        force: 798.52,
        fiber: 0.134,
        tendon: 0.143,
        belly_on: Humerus,
        origin_tendon: 0.2,
        belly_end: 0.92,
        path: &[
            fixed(Girdle, [-0.036105, -0.00673, -0.02277]),
            fixed(Humerus, [-0.02714, -0.11441, -0.00664]),
            fixed(Humerus, [-0.03184, -0.22637, -0.01217]),
            fixed(Humerus, [-0.01743, -0.26757, -0.01208]),
            fixed(Forearm, [-0.0219, 0.01046, -0.00078]),
        ],
        wraps: &[AT_ELBOW_BEHIND, AT_SHOULDER_BEHIND],
    },
    MuscleData {
        name: "TRIlat",
        meaning: "Triceps brachii, lateral head",
        force: 624.3,
        fiber: 0.1138,
        tendon: 0.098,
        belly_on: Humerus,
        origin_tendon: 0.1,
        belly_end: 0.92,
        path: &[
            fixed(Humerus, [-0.00599, -0.12646, 0.00428]),
            fixed(Humerus, [-0.02344, -0.14528, 0.00928]),
            fixed(Humerus, [-0.03184, -0.22637, -0.01217]),
            fixed(Humerus, [-0.01743, -0.26757, -0.01208]),
            fixed(Forearm, [-0.0219, 0.01046, -0.00078]),
        ],
        wraps: &[AT_ELBOW_BEHIND],
    },
    MuscleData {
        name: "TRImed",
        meaning: "Triceps brachii, medial head",
        force: 624.3,
        fiber: 0.1138,
        tendon: 0.0908,
        belly_on: Humerus,
        origin_tendon: 0.1,
        belly_end: 0.92,
        path: &[
            fixed(Humerus, [-0.00838, -0.13695, -0.00906]),
            fixed(Humerus, [-0.02601, -0.15139, -0.0108]),
            fixed(Humerus, [-0.03184, -0.22637, -0.01217]),
            fixed(Humerus, [-0.01743, -0.26757, -0.01208]),
            fixed(Forearm, [-0.0219, 0.01046, -0.00078]),
        ],
        wraps: &[AT_ELBOW_BEHIND],
    },
    MuscleData {
        name: "BIClong",
        meaning: "Biceps brachii, long head",
        force: 624.3,
        fiber: 0.1157,
        tendon: 0.2723,
        belly_on: Humerus,
        origin_tendon: 0.6,
        belly_end: 0.92,
        path: &[
            fixed(Girdle, [-0.02169, 0.01047, -0.02205]),
            fixed(Girdle, [-0.0114, 0.02091, -0.01361]),
            fixed(Humerus, [0.02131, 0.01793, 0.01028]),
            fixed(Humerus, [0.02378, -0.00511, 0.01201]),
            fixed(Humerus, [0.01345, -0.02827, 0.00136]),
            fixed(Humerus, [0.01068, -0.07736, -0.00165]),
            fixed(Humerus, [0.01703, -0.12125, 0.00024]),
            fixed(Humerus, [0.0228, -0.1754, -0.0063]),
            fixed(Forearm, [0.00751, -0.04839, 0.02179]),
        ],
        wraps: &[AT_SHOULDER_FRONT],
    },
    MuscleData {
        name: "BICshort",
        meaning: "Biceps brachii, short head",
        force: 435.56,
        fiber: 0.1321,
        tendon: 0.1923,
        belly_on: Humerus,
        origin_tendon: 0.6,
        belly_end: 0.92,
        path: &[
            fixed(Girdle, [0.02222, -0.00531, -0.03525]),
            fixed(Girdle, [0.01047, -0.03304, -0.02493]),
            fixed(Humerus, [0.01117, -0.07576, -0.01101]),
            fixed(Humerus, [0.01703, -0.12125, -0.01079]),
            fixed(Humerus, [0.0228, -0.1754, -0.0063]),
            fixed(Forearm, [0.00751, -0.04839, 0.02179]),
        ],
        wraps: &[],
    },
    MuscleData {
        name: "BRA",
        meaning: "Brachialis",
        force: 987.26,
        fiber: 0.0858,
        tendon: 0.0535,
        belly_on: Humerus,
        origin_tendon: 0.02,
        belly_end: 0.8,
        path: &[fixed(Humerus, [0.0068, -0.1739, -0.0036]), fixed(Forearm, [-0.0032, -0.0239, 0.0009])],
        wraps: &[AT_ELBOW_FRONT],
    },
];
