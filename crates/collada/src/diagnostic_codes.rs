//! The codes of the findings that the reader reports: stable, so that a script can look for them.

macro_rules! codes {
    ($($(#[doc = $doc:literal])+ $name:ident = $code:literal;)+) => {
        $($(#[doc = $doc])+ pub const $name: &str = $code;)+

        /// Every code with what it means, for documents and tests.
        pub const ALL: &[(&str, &str)] = &[$(($code, concat!($($doc),+))),+];
    };
}

codes! {
    /// The bytes do not fit the encoding that the file names; read as Windows-1252.
    ENCODING = "encoding";
    /// The version attribute is missing or not one that is known; read as 1.4.1.
    UNKNOWN_VERSION = "unknown-version";
    /// The unit is not a positive number; 1 metre is used.
    BAD_UNIT = "bad-unit";
    /// The up axis is none of X_UP, Y_UP, Z_UP; Y_UP is used.
    BAD_UP_AXIS = "bad-up-axis";
    /// Two elements have the same id; references mean the nearest one that fits.
    REPEATED_ID = "repeated-id";
    /// A namespace prefix is used that nobody declares; it is passed over.
    UNDECLARED_PREFIX = "undeclared-prefix";
    /// A reference names an element that is not in the file, or one of the wrong kind.
    BROKEN_REFERENCE = "broken-reference";
    /// A reference names another document, which is not loaded.
    EXTERNAL_REFERENCE = "external-reference";
    /// References lead round in a circle.
    REFERENCE_CYCLE = "reference-cycle";
    /// Numbers have a decimal comma; it is read as a point.
    DECIMAL_COMMA = "decimal-comma";
    /// A list holds something that is no number; 0 stands in for it.
    BAD_NUMBER = "bad-number";
    /// A value is infinite or not a number where it must be finite.
    NOT_FINITE = "not-finite";
    /// A count attribute disagrees with the data; the data are used.
    COUNT_MISMATCH = "count-mismatch";
    /// An index points outside its list: a face without its point is left out, one without another value is drawn without it.
    INDEX_OUT_OF_RANGE = "index-out-of-range";
    /// Indices are left over that make no whole polygon.
    INCOMPLETE_PRIMITIVE = "incomplete-primitive";
    /// Polygons are too intricate to cut into triangles within the limits.
    POLYGON_TOO_COMPLEX = "polygon-too-complex";
    /// A mesh has no positions and cannot be drawn.
    NO_POSITIONS = "no-positions";
    /// A mesh has no faces and no lines, so that there is nothing to draw.
    NO_FACES = "no-faces";
    /// Geometry that is no plain mesh: convex hull, spline, boundary surface.
    UNSUPPORTED_GEOMETRY = "unsupported-geometry";
    /// More sets of texture coordinates than are kept.
    TOO_MANY_UV_SETS = "too-many-uv-sets";
    /// The file names no scene to show; the first one is shown.
    NO_SCENE_NAMED = "no-scene-named";
    /// The file has no scene at all; its geometry is shown as it stands.
    NO_SCENE = "no-scene";
    /// A transform has the wrong number of values and is left out.
    BAD_TRANSFORM = "bad-transform";
    /// A part of the format that is not shown: kinematics, formulas.
    UNSUPPORTED_ELEMENT = "unsupported-element";
    /// A skin names a joint that is not in the scene; it stays in its bind pose.
    JOINT_NOT_FOUND = "joint-not-found";
    /// A skin and its joints do not meet at rest: the bind pose has another size or turn than the scene.
    BIND_POSE_MISMATCH = "bind-pose-mismatch";
    /// Joint names with blanks in them were put together again.
    JOINT_NAMES_REJOINED = "joint-names-rejoined";
    /// A skin names a skeleton that the scene doesn't show; it is added.
    SKELETON_NOT_IN_SCENE = "skeleton-not-in-scene";
    /// A skin lacks something that it needs.
    BAD_SKIN = "bad-skin";
    /// A skin over a skin; only the one nearer to the mesh is used.
    SECOND_SKIN = "second-skin";
    /// The weights of a skin speak of more or fewer points than the mesh has.
    SKIN_POINTS_MISMATCH = "skin-points-mismatch";
    /// The weights of a point do not add up to 1; they are scaled.
    WEIGHTS_NOT_NORMALISED = "weights-not-normalised";
    /// A morph lacks something that it needs.
    BAD_MORPH = "bad-morph";
    /// A morph target has another number of points than its base and is not used.
    MORPH_TARGET_MISMATCH = "morph-target-mismatch";
    /// An animation moves something that is not in the scene.
    UNKNOWN_TARGET = "unknown-target";
    /// An animation moves something that is not shown moving.
    UNSUPPORTED_TARGET = "unsupported-target";
    /// An animation's sampler or sources are missing or do not fit together.
    BAD_CURVE = "bad-curve";
    /// An interpolation that is read as LINEAR.
    UNSUPPORTED_INTERPOLATION = "unsupported-interpolation";
    /// BEZIER or HERMITE keys without tangents, read as LINEAR.
    MISSING_TANGENTS = "missing-tangents";
    /// Matrix keys that shear, interpolated element by element.
    SHEARED_KEYS = "sheared-keys";
    /// An animation clip without a moving part.
    EMPTY_CLIP = "empty-clip";
    /// A material symbol of a mesh is bound to nothing.
    UNBOUND_MATERIAL = "unbound-material";
    /// A texture leads to no image.
    TEXTURE_NOT_FOUND = "texture-not-found";
    /// An effect has no common profile; a neutral material is used.
    NO_COMMON_PROFILE = "no-common-profile";
    /// By the letter a material would be invisible; it was written the wrong way round and is shown solid.
    TRANSPARENCY_INVERTED = "transparency-inverted";
    /// A light or camera lacks something that it needs.
    BAD_LIGHT_OR_CAMERA = "bad-light-or-camera";
    /// Something was left out because a limit was reached.
    LIMIT_REACHED = "limit-reached";
    /// There were more findings than are kept.
    MORE_FINDINGS = "more-findings";
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    #[test]
    fn codes_are_unique_kebab_case_and_documented() {
        let codes: BTreeSet<_> = super::ALL.iter().map(|(code, _)| code).collect();
        assert_eq!(codes.len(), super::ALL.len());
        for (code, doc) in super::ALL {
            assert!(code.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{code}");
            assert!(!doc.trim().is_empty(), "{code}");
        }
    }
}
