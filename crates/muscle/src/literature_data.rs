//! Published figures that models are held against, each with its source. Angles are elbow flexion in degrees, moment arms and lengths centimetres,
//! volumes cubic centimetres.

/// A figure or series, and who published it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Published {
    /// What a plot's legend calls it.
    pub name: &'static str,
    /// Where it stands.
    pub source: &'static str,
    /// Angle and value.
    pub points: &'static [[f64; 2]],
}

/// Peak moment arm of the biceps in ten upper limbs.
pub const MURRAY_2000: Published = Published {
    name: "Murray 2000",
    source: "W. M. Murray, T. S. Buchanan, S. L. Delp: The isometric functional capacity of muscles that cross the elbow. \
             J. Biomech. 33 (2000) 943–952.",
    points: &[[90.0, 4.7]],
};

/// Where the moment arms of Arm26 come from: OpenSim 4.6 computed them from the model, with the shoulder at 0°.
const ARM26: &str = "Arm26, a model that comes with OpenSim: J. A. Reinbolt, A. Seth, A. Habib, S. R. Hamner; adapted from K. R. S. Holzbaur, \
                     W. M. Murray, S. L. Delp: A model of the upper extremity. Ann. Biomed. Eng. 33 (2005) 829–840.";

/// Moment arm of both heads of the biceps in the Arm26 model.
pub const ARM26_BICEPS: Published = Published {
    name: "Arm26 biceps",
    source: ARM26,
    points: &[
        [0.0, 0.94],
        [10.0, 1.53],
        [20.0, 2.10],
        [30.0, 2.65],
        [40.0, 3.16],
        [50.0, 3.63],
        [60.0, 4.05],
        [70.0, 4.41],
        [80.0, 4.69],
        [90.0, 4.88],
        [100.0, 4.94],
        [110.0, 4.85],
        [120.0, 4.56],
        [130.0, 4.03],
    ],
};

/// Moment arm of the three heads of the triceps in the Arm26 model, which differ by 0.2 mm at most.
pub const ARM26_TRICEPS: Published = Published {
    name: "Arm26 triceps",
    source: ARM26,
    points: &[
        [0.0, -2.01],
        [10.0, -2.32],
        [20.0, -2.41],
        [30.0, -2.41],
        [40.0, -2.35],
        [50.0, -2.25],
        [60.0, -2.12],
        [70.0, -1.97],
        [80.0, -1.98],
        [90.0, -1.99],
        [100.0, -2.00],
        [110.0, -1.99],
        [120.0, -1.97],
        [130.0, -1.94],
    ],
};

/// Moment arm of the brachialis in the Arm26 model.
pub const ARM26_BRACHIALIS: Published = Published {
    name: "Arm26 brachialis",
    source: ARM26,
    points: &[
        [0.0, 1.53],
        [10.0, 1.44],
        [20.0, 1.37],
        [30.0, 1.31],
        [40.0, 1.26],
        [50.0, 1.39],
        [60.0, 1.67],
        [70.0, 1.91],
        [80.0, 2.12],
        [90.0, 2.27],
        [100.0, 2.37],
        [110.0, 2.40],
        [120.0, 2.35],
        [130.0, 2.23],
    ],
};

/// Muscles by the words that names of theirs have, and the moment arms about the elbow that were published of each.
const MOMENT_ARMS: [(&[&str], &[Published]); 3] = [
    (&["biceps", "бицепс"], &[ARM26_BICEPS, MURRAY_2000]),
    (&["triceps", "трицепс"], &[ARM26_TRICEPS]),
    (&["brachialis", "плечевая"], &[ARM26_BRACHIALIS]),
];
/// Words of names of other muscles: of the thigh, of the calf, of the forearm.
const ELSEWHERE: [&str; 6] = ["femoris", "surae", "бедра", "голени", "лучевая", "плечелучевая"];

/// What was published of the moment arm about the elbow of a muscle with this name; nothing where the name is of no such muscle.
pub fn moment_arms(muscle: &str) -> &'static [Published] {
    let name = muscle.to_lowercase();
    let has = |words: &[&str]| name.split(|letter: char| !letter.is_alphanumeric()).any(|word| words.contains(&word));
    let found = MOMENT_ARMS.iter().find(|(words, _)| has(words) && !has(&ELSEWHERE));
    found.map_or(&[], |(_, published)| published)
}

/// Radii that were measured on a biceps at four angles, as [`super::validation::Table::parse`] reads them; the source stands in its first lines.
pub const MEASURED_RADII: &str = include_str!("../presets/biceps-radii.csv");

/// How much the biceps of Arm26 shortens from 0° to 130°.
pub const ARM26_SHORTENING: f64 = 8.39;

/// Range that peak moment arms of a biceps in human proportions lie in, and the angles at which they do.
pub const BICEPS_PEAK: [[f64; 2]; 2] = [[4.5, 5.0], [85.0, 110.0]];
/// Range of a biceps' shortening from 0° to 130°.
pub const BICEPS_SHORTENING: [f64; 2] = [7.0, 8.5];
/// Range of a biceps' volume, cm³: about the mean of [`VOLUME_SOURCE`].
pub const BICEPS_VOLUME: [f64; 2] = [130.0, 160.0];
/// Mean and standard deviation of muscles' volumes in ten adults, cm³, by the preset that they belong to; of [`VOLUME_SOURCE`].
pub const VOLUMES: [(&str, [f64; 2]); 3] = [("biceps", [144.0, 69.0]), ("triceps", [372.0, 177.0]), ("brachialis", [144.0, 64.0])];
/// Where the volumes of muscles come from.
pub const VOLUME_SOURCE: &str = "K. R. S. Holzbaur, W. M. Murray, G. E. Gold, S. L. Delp: Upper limb muscle volumes in adult subjects. \
                                 J. Biomech. 40 (2007) 742–749.";

impl Published {
    /// Root mean square of `model` − published over the points at angles within `range`; `None` where there is none.
    pub fn rms(&self, range: [f64; 2], model: impl Fn(f64) -> f64) -> Option<f64> {
        let inside = || self.points.iter().filter(|[angle, _]| (range[0]..=range[1]).contains(angle));
        let squares: f64 = inside().map(|[angle, value]| (model(*angle) - value).powi(2)).sum();
        match inside().count() {
            0 => None,
            count => Some((squares / count as f64).sqrt()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moment_arms_are_found_by_the_name_of_the_muscle() {
        let names = |muscle: &str| moment_arms(muscle).iter().map(|published| published.name).collect::<Vec<_>>();
        assert_eq!(names("Biceps"), ["Arm26 biceps", "Murray 2000"]);
        assert_eq!((names("left triceps-2"), names("Brachialis")), (vec!["Arm26 triceps"], vec!["Arm26 brachialis"]));
        assert_eq!(names("Трицепс"), ["Arm26 triceps"]);
        for other in ["", "Biceps femoris", "Triceps surae", "bicepsoid", "Deltoid"] {
            assert!(names(other).is_empty(), "{other}");
        }
    }
}
