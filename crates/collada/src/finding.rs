//! What the reader reports of a document that it could read.

use super::{ReadErrorKind, diagnostic_codes as codes};
use sinew_scene::diagnostics::{DiagnosticKind, Severity};
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage, Value, decimal};
use sinew_scene::{Label, Unnamed};

/// What the reader found. Texts from the file are as they stand there, long ones shortened.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The bytes do not fit this encoding, which the file names; they are read as Windows-1252.
    WrongEncoding(String),
    /// This version is not known; the file is read as 1.4.1.
    UnknownVersion(String),
    /// This unit is not a positive number; 1 metre is used.
    BadUnit(String),
    /// This up axis is none of X_UP, Y_UP, Z_UP; Y_UP is used.
    BadUpAxis(String),
    /// Another element has the same id; references mean the nearest one that fits.
    RepeatedId,
    /// This namespace prefix is declared nowhere; names are read without it.
    UndeclaredPrefix(String),
    /// A reference names this, which is not in the file.
    BrokenReference(String),
    /// A reference names an element that cannot stand there.
    WrongReference {
        /// What it names.
        target: String,
        /// The tag of that element.
        tag: String,
    },
    /// A reference names this other file, which is not loaded.
    ExternalReference(String),
    /// A further document of the archive cannot be read.
    BrokenPart(ReadErrorKind),
    /// A reference leads to itself in a circle.
    ReferenceCycle,
    /// Numbers have decimal commas, this entry is the first; they are read as points.
    DecimalComma(String),
    /// Entries of a list are no numbers; 0 stands in for them.
    BadNumbers {
        /// How many.
        count: usize,
        /// The first of them.
        first: String,
    },
    /// A value is infinite or not a number; it is left out.
    NotFinite,
    /// Points are infinite or not numbers; what uses them is not drawn.
    PointsNotFinite,
    /// Keys are infinite or not numbers; they are left out.
    KeysNotFinite,
    /// Normals, texture coordinates or colours of so many vertices are infinite or not numbers; the vertices are drawn without.
    AttributesNotFinite(usize),
    /// So many weights are infinite or not numbers; they are left out.
    WeightsNotFinite(usize),
    /// A count disagrees with the data, which are used.
    CountMismatch {
        /// The count.
        said: usize,
        /// How many there are.
        found: usize,
    },
    /// The stride of an accessor is smaller than its params take, which is used.
    StrideMismatch {
        /// The stride.
        said: usize,
        /// What the params take.
        found: usize,
    },
    /// There are more joint names than inverse bind matrices or the other way round; those that have both are used.
    JointCountMismatch {
        /// Joint names.
        names: usize,
        /// Inverse bind matrices.
        matrices: usize,
    },
    /// There are more times than values or the other way round; the keys that have both are used.
    KeyCountMismatch {
        /// Times.
        times: usize,
        /// Values.
        values: usize,
    },
    /// So many weights are missing at the end of a list.
    InfluencesMissing(usize),
    /// So many faces point outside of their lists; they are left out.
    FacesOutOfRange(usize),
    /// So many vertices point outside of their lists of normals, texture coordinates or colours; they are drawn without.
    AttributesOutOfRange(usize),
    /// So many weights name joints or values that are not there; they are left out.
    InfluencesOutOfRange(usize),
    /// A list is empty; what points into it goes without.
    EmptyList,
    /// So many faces have too few corners; they are left out.
    IncompleteFaces(usize),
    /// So many polygons are too intricate to be cut into triangles; they are left out.
    PolygonsTooComplex(usize),
    /// A mesh has no positions and is not drawn.
    NoPositions,
    /// A mesh has no faces and no lines.
    NoFaces,
    /// Geometry of this kind is not shown.
    UnsupportedGeometry(String),
    /// There are more than [`limits::UV_SETS`] sets of texture coordinates; the others are left out.
    TooManyUvSets,
    /// The file does not say which scene to show; the first one is shown.
    NoSceneNamed,
    /// The file has no scene; its parts are shown as they stand.
    NoScene,
    /// The file has no scene and no geometry.
    NothingToShow,
    /// The last row of a matrix is not 0 0 0 1; these numbers are taken instead.
    BottomRow,
    /// A transform has the wrong number of values; it is left out.
    BadTransform {
        /// How many it needs.
        wanted: usize,
        /// How many it has.
        found: usize,
    },
    /// This element is not shown: kinematics and formulas.
    UnsupportedElement(String),
    /// The scene has more than [`limits::NODES`] nodes or is more than [`limits::DEPTH`] levels deep; the rest is left out.
    TooManyNodes,
    /// Morph targets are made from one another in more than [`limits::MORPH_DEPTH`] steps; the rest is left out.
    MorphsTooDeep,
    /// The scene grows too large for the file's size; the rest is left out.
    SceneTooLarge,
    /// Drawing all instances would take more than [`limits::INSTANCES_BYTES`]; the rest is left out.
    InstancesTooLarge,
    /// Joints of a skin are not in the scene; they stay in their bind pose.
    JointsNotFound {
        /// How many.
        count: usize,
        /// The first of them.
        first: String,
    },
    /// A skin and its joints do not meet at rest: an inverse bind matrix makes it larger or smaller.
    BindPoseScaled {
        /// The skin; empty where it has no name.
        skin: String,
        /// The joint whose matrix does.
        joint: String,
        /// How many times as large.
        factor: f64,
    },
    /// A skin and its joints do not meet at rest: they make it larger or smaller than the node that holds it does.
    BindPoseScaledByNode {
        /// The skin; empty where it has no name.
        skin: String,
        /// One of its joints.
        joint: String,
        /// How many times as large.
        factor: f64,
    },
    /// A skin and its joints do not meet at rest: they turn it away from the node that holds it.
    BindPoseTurned {
        /// The skin; empty where it has no name.
        skin: String,
        /// One of its joints.
        joint: String,
        /// By how many degrees.
        angle: f64,
    },
    /// A skeleton is not part of the scene; it was added to it.
    SkeletonNotInScene,
    /// Joint names with blanks in them were put together again.
    JointNamesRejoined,
    /// A skin has no usable element or input of this name; the mesh is shown without it.
    SkinWithout(String),
    /// A skin has no usable weights; the mesh keeps to its bind shape.
    SkinWithoutWeights,
    /// A skin has no usable inverse bind matrices; its joints are taken to be bound at the origin.
    SkinWithoutInverseBind,
    /// A skin lies over a skin; only the one nearer to the mesh is used.
    SecondSkin,
    /// The weights of a skin speak of more or fewer points than the mesh has.
    SkinPointsMismatch {
        /// Points that have weights.
        found: usize,
        /// Points of the mesh.
        wanted: usize,
    },
    /// The weights of so many points do not add up to 1; they are scaled.
    WeightsNotNormalised(usize),
    /// A controller has neither a skin nor a morph; it is left out.
    EmptyController,
    /// A morph has no list of targets; it is left out.
    MorphWithoutTargets,
    /// A morph has fewer weights than targets; 0 is used.
    MorphWeightsMissing,
    /// A morph target has more or fewer points than its base; it is not used.
    MorphTargetMismatch {
        /// Its mesh; empty where that has no name.
        target: String,
        /// Its points.
        found: usize,
        /// Those of the base.
        wanted: usize,
    },
    /// An animation moves this, which is not in the scene.
    UnknownTarget(String),
    /// An animation moves this, which is not shown moving.
    UnsupportedTarget(String),
    /// A sampler has no usable times or values; it is left out.
    BadSampler,
    /// The keys of a curve have too few numbers; it is left out.
    KeySize {
        /// How many each has.
        found: usize,
        /// How many it needs.
        wanted: usize,
    },
    /// This interpolation is read as LINEAR.
    UnsupportedInterpolation(String),
    /// Curved keys have no usable tangents; they are read as LINEAR.
    MissingTangents,
    /// Matrix keys shear; they are interpolated element by element.
    ShearedKeys,
    /// A clip moves nothing; it is left out.
    EmptyClip,
    /// This material symbol of a mesh is bound to nothing; a neutral material is used.
    UnboundMaterial(String),
    /// This texture leads to no image; it is left out.
    TextureNotFound(String),
    /// An effect has no common profile; a neutral material is used.
    NoCommonProfile,
    /// By the letter a material would be invisible; its transparency is taken the other way round.
    TransparencyInverted,
    /// A light has no kind that is known; it is left out.
    BadLight,
    /// A camera has no projection; it is left out.
    BadCamera,
    /// So many more findings are not kept: [`limits::FINDINGS`] are.
    More(usize),
}

impl ToMessage for Finding {
    fn message(&self) -> Message {
        match self {
            Self::WrongEncoding(named) => message!("collada-encoding", named = named),
            Self::UnknownVersion(version) => message!("collada-unknown-version", version = version),
            Self::BadUnit(value) => message!("collada-bad-unit", value = value),
            Self::BadUpAxis(value) => message!("collada-bad-up-axis", value = value),
            Self::RepeatedId => message!("collada-repeated-id"),
            Self::UndeclaredPrefix(prefix) => message!("collada-undeclared-prefix", prefix = prefix),
            Self::BrokenReference(target) => message!("collada-broken-reference", target = target),
            Self::WrongReference { target, tag } => message!("collada-wrong-reference", target = target, tag = tag),
            Self::ExternalReference(file) => message!("collada-external-reference", file = file),
            Self::BrokenPart(error) => message!("collada-part-broken", reason = error.message()),
            Self::ReferenceCycle => message!("collada-reference-cycle"),
            Self::DecimalComma(entry) => message!("collada-decimal-comma", entry = entry),
            Self::BadNumbers { count, first } => message!("collada-bad-number", count = count, first = first),
            Self::NotFinite => message!("collada-not-finite"),
            Self::PointsNotFinite => message!("collada-not-finite-points"),
            Self::KeysNotFinite => message!("collada-not-finite-keys"),
            Self::AttributesNotFinite(count) => message!("collada-not-finite-values", count = count),
            Self::WeightsNotFinite(count) => message!("collada-not-finite-weights", count = count),
            Self::CountMismatch { said, found } => message!("collada-count-mismatch", said = said, found = found),
            Self::StrideMismatch { said, found } => message!("collada-stride-mismatch", said = said, found = found),
            Self::JointCountMismatch { names, matrices } => message!("collada-joint-count", names = names, matrices = matrices),
            Self::KeyCountMismatch { times, values } => message!("collada-key-counts", times = times, values = values),
            Self::InfluencesMissing(count) => message!("collada-influences-missing", count = count),
            Self::FacesOutOfRange(count) => message!("collada-index-out-of-range", count = count),
            Self::AttributesOutOfRange(count) => message!("collada-values-out-of-range", count = count),
            Self::InfluencesOutOfRange(count) => message!("collada-influences-out-of-range", count = count),
            Self::EmptyList => message!("collada-empty-list"),
            Self::IncompleteFaces(count) => message!("collada-incomplete-primitive", count = count),
            Self::PolygonsTooComplex(count) => message!("collada-polygon-too-complex", count = count),
            Self::NoPositions => message!("collada-no-positions"),
            Self::NoFaces => message!("collada-no-faces"),
            Self::UnsupportedGeometry(kind) => message!("collada-unsupported-geometry", kind = kind),
            Self::TooManyUvSets => message!("collada-too-many-uv-sets", limit = limits::UV_SETS),
            Self::NoSceneNamed => message!("collada-no-scene-named"),
            Self::NoScene => message!("collada-no-scene"),
            Self::NothingToShow => message!("collada-nothing-to-show"),
            Self::BottomRow => message!("collada-bottom-row"),
            Self::BadTransform { wanted, found } => message!("collada-bad-transform", wanted = wanted, found = found),
            Self::UnsupportedElement(element) => message!("collada-unsupported-element", element = element),
            Self::TooManyNodes => message!("collada-limit-nodes", nodes = limits::NODES, depth = limits::DEPTH),
            Self::MorphsTooDeep => message!("collada-morph-depth", limit = limits::MORPH_DEPTH),
            Self::SceneTooLarge => message!("collada-limit-reached"),
            Self::InstancesTooLarge => message!("collada-limit-drawn", limit = limits::INSTANCES_BYTES >> 20),
            Self::JointsNotFound { count, first } => message!("collada-joint-not-found", count = count, first = first),
            Self::BindPoseScaled { skin, joint, factor } => {
                message!("collada-bind-scale", skin = Label::of(skin, Unnamed::Skin), joint = joint, factor = three_digits(*factor))
            }
            Self::BindPoseScaledByNode { skin, joint, factor } => {
                message!("collada-bind-node-scale", skin = Label::of(skin, Unnamed::Skin), joint = joint, factor = three_digits(*factor))
            }
            Self::BindPoseTurned { skin, joint, angle } => {
                message!("collada-bind-node-turn", skin = Label::of(skin, Unnamed::Skin), joint = joint, angle = decimal(*angle, 0))
            }
            Self::SkeletonNotInScene => message!("collada-skeleton-not-in-scene"),
            Self::JointNamesRejoined => message!("collada-joint-names-rejoined"),
            Self::SkinWithout(what) => message!("collada-bad-skin", what = what),
            Self::SkinWithoutWeights => message!("collada-no-weights"),
            Self::SkinWithoutInverseBind => message!("collada-no-inverse-bind"),
            Self::SecondSkin => message!("collada-second-skin"),
            Self::SkinPointsMismatch { found, wanted } => message!("collada-skin-points", found = found, wanted = wanted),
            Self::WeightsNotNormalised(count) => message!("collada-weights-not-normalised", count = count),
            Self::EmptyController => message!("collada-empty-controller"),
            Self::MorphWithoutTargets => message!("collada-bad-morph"),
            Self::MorphWeightsMissing => message!("collada-morph-weights"),
            Self::MorphTargetMismatch { target, found, wanted } => {
                message!("collada-morph-target", target = Label::of(target, Unnamed::Mesh), found = found, wanted = wanted)
            }
            Self::UnknownTarget(target) => message!("collada-unknown-target", target = target),
            Self::UnsupportedTarget(target) => message!("collada-unsupported-target", target = target),
            Self::BadSampler => message!("collada-bad-sampler"),
            Self::KeySize { found, wanted } => message!("collada-key-size", found = found, wanted = wanted),
            Self::UnsupportedInterpolation(name) => message!("collada-unsupported-interpolation", name = name),
            Self::MissingTangents => message!("collada-missing-tangents"),
            Self::ShearedKeys => message!("collada-sheared-keys"),
            Self::EmptyClip => message!("collada-empty-clip"),
            Self::UnboundMaterial(symbol) => message!("collada-unbound-material", symbol = symbol),
            Self::TextureNotFound(name) => message!("collada-texture-not-found", name = name),
            Self::NoCommonProfile => message!("collada-no-common-profile"),
            Self::TransparencyInverted => message!("collada-transparency-inverted"),
            Self::BadLight => message!("collada-bad-light"),
            Self::BadCamera => message!("collada-bad-camera"),
            Self::More(count) => message!("collada-more-findings", count = count, limit = limits::FINDINGS),
        }
    }
}

impl DiagnosticKind for Finding {
    fn code(&self) -> &'static str {
        match self {
            Self::WrongEncoding(_) => codes::ENCODING,
            Self::UnknownVersion(_) => codes::UNKNOWN_VERSION,
            Self::BadUnit(_) => codes::BAD_UNIT,
            Self::BadUpAxis(_) => codes::BAD_UP_AXIS,
            Self::RepeatedId => codes::REPEATED_ID,
            Self::UndeclaredPrefix(_) => codes::UNDECLARED_PREFIX,
            Self::BrokenReference(_) | Self::WrongReference { .. } => codes::BROKEN_REFERENCE,
            Self::ExternalReference(_) | Self::BrokenPart(_) => codes::EXTERNAL_REFERENCE,
            Self::ReferenceCycle => codes::REFERENCE_CYCLE,
            Self::DecimalComma(_) => codes::DECIMAL_COMMA,
            Self::BadNumbers { .. } => codes::BAD_NUMBER,
            Self::NotFinite | Self::PointsNotFinite | Self::KeysNotFinite | Self::AttributesNotFinite(_) | Self::WeightsNotFinite(_) => {
                codes::NOT_FINITE
            }
            Self::CountMismatch { .. }
            | Self::StrideMismatch { .. }
            | Self::JointCountMismatch { .. }
            | Self::KeyCountMismatch { .. }
            | Self::InfluencesMissing(_) => codes::COUNT_MISMATCH,
            Self::FacesOutOfRange(_) | Self::AttributesOutOfRange(_) | Self::InfluencesOutOfRange(_) | Self::EmptyList => {
                codes::INDEX_OUT_OF_RANGE
            }
            Self::IncompleteFaces(_) => codes::INCOMPLETE_PRIMITIVE,
            Self::PolygonsTooComplex(_) => codes::POLYGON_TOO_COMPLEX,
            Self::NoPositions => codes::NO_POSITIONS,
            Self::NoFaces => codes::NO_FACES,
            Self::UnsupportedGeometry(_) => codes::UNSUPPORTED_GEOMETRY,
            Self::TooManyUvSets => codes::TOO_MANY_UV_SETS,
            Self::NoSceneNamed => codes::NO_SCENE_NAMED,
            Self::NoScene | Self::NothingToShow => codes::NO_SCENE,
            Self::BottomRow | Self::BadTransform { .. } => codes::BAD_TRANSFORM,
            Self::UnsupportedElement(_) => codes::UNSUPPORTED_ELEMENT,
            Self::TooManyNodes | Self::MorphsTooDeep | Self::SceneTooLarge | Self::InstancesTooLarge => codes::LIMIT_REACHED,
            Self::JointsNotFound { .. } => codes::JOINT_NOT_FOUND,
            Self::BindPoseScaled { .. } | Self::BindPoseScaledByNode { .. } | Self::BindPoseTurned { .. } => codes::BIND_POSE_MISMATCH,
            Self::SkeletonNotInScene => codes::SKELETON_NOT_IN_SCENE,
            Self::JointNamesRejoined => codes::JOINT_NAMES_REJOINED,
            Self::SkinWithout(_) | Self::SkinWithoutWeights | Self::SkinWithoutInverseBind | Self::EmptyController => codes::BAD_SKIN,
            Self::SecondSkin => codes::SECOND_SKIN,
            Self::SkinPointsMismatch { .. } => codes::SKIN_POINTS_MISMATCH,
            Self::WeightsNotNormalised(_) => codes::WEIGHTS_NOT_NORMALISED,
            Self::MorphWithoutTargets | Self::MorphWeightsMissing => codes::BAD_MORPH,
            Self::MorphTargetMismatch { .. } => codes::MORPH_TARGET_MISMATCH,
            Self::UnknownTarget(_) => codes::UNKNOWN_TARGET,
            Self::UnsupportedTarget(_) => codes::UNSUPPORTED_TARGET,
            Self::BadSampler | Self::KeySize { .. } => codes::BAD_CURVE,
            Self::UnsupportedInterpolation(_) => codes::UNSUPPORTED_INTERPOLATION,
            Self::MissingTangents => codes::MISSING_TANGENTS,
            Self::ShearedKeys => codes::SHEARED_KEYS,
            Self::EmptyClip => codes::EMPTY_CLIP,
            Self::UnboundMaterial(_) => codes::UNBOUND_MATERIAL,
            Self::TextureNotFound(_) => codes::TEXTURE_NOT_FOUND,
            Self::NoCommonProfile => codes::NO_COMMON_PROFILE,
            Self::TransparencyInverted => codes::TRANSPARENCY_INVERTED,
            Self::BadLight | Self::BadCamera => codes::BAD_LIGHT_OR_CAMERA,
            Self::More(_) => codes::MORE_FINDINGS,
        }
    }

    fn severity(&self) -> Severity {
        match self {
            Self::UnknownVersion(_)
            | Self::RepeatedId
            | Self::UndeclaredPrefix(_)
            | Self::DecimalComma(_)
            | Self::EmptyList
            | Self::TooManyUvSets
            | Self::JointNamesRejoined
            | Self::UnsupportedTarget(_)
            | Self::UnboundMaterial(_)
            | Self::TransparencyInverted
            | Self::More(_) => Severity::Info,
            _ => Severity::Warning,
        }
    }
}

/// A factor with the three digits that count, without zeros behind the decimal mark.
fn three_digits(value: f64) -> Value {
    let before = value.abs().max(1e-9).log10().floor() as i32;
    let digits = (2 - before).clamp(0, 9) as usize;
    let text = format!("{value:.digits$}");
    let decimals = text.trim_end_matches('0').split_once('.').map_or(0, |(_, decimals)| decimals.len());
    decimal(value, decimals)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_have_the_digits_that_count() {
        for (value, text) in [(100.0, "100"), (1234.5, "1234"), (2.5, "2.5"), (0.01, "0.01"), (1.0 / 3.0, "0.333"), (39.37, "39.4")] {
            assert_eq!(three_digits(value).to_string(), text);
        }
    }
}
