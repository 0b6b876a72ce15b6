//! `asset`: unit, up axis, and who wrote the file.

use glam::{DMat3, DMat4, DVec3};

use super::context::{Context, ReadResult, child, children, text_of};
use super::{Asset, El, Finding};

/// Reads what the file says of itself.
///
/// # Errors
/// None of its own; see [`Context::reals`].
pub(super) fn read(context: &mut Context<'_>) -> ReadResult<Asset> {
    let root = context.root;
    let version = root.attribute("version").unwrap_or_default().trim().to_owned();
    if !(version.starts_with("1.4") || version.starts_with("1.5")) {
        context.report.report(root, Finding::UnknownVersion(version.clone()));
    }
    let mut asset = Asset { format: super::FORMAT, version, authoring_tool: String::new(), up_axis: "Y_UP".to_owned(), unit_metres: 1.0 };
    let Some(element) = child(root, "asset") else { return Ok(asset) };
    asset.authoring_tool = children(element, "contributor")
        .filter_map(|contributor| child(contributor, "authoring_tool"))
        .map(|tool| text_of(tool).split_whitespace().collect::<Vec<_>>().join(" "))
        .find(|tool| !tool.is_empty())
        .unwrap_or_default();
    let local = local(context, element);
    if let Some(unit) = local.unit {
        asset.unit_metres = unit;
    }
    if let Some(axis) = local.axis {
        asset.up_axis = axis.to_owned();
    }
    Ok(asset)
}

/// Whether the document of an element has colours of materials as scene-linear values: Blender writes what it reckons with. All others write sRGB.
pub(super) fn is_scene_linear(element: El<'_>) -> bool {
    let document = element.ancestors().find(|above| above.tag_name().name() == "COLLADA");
    let Some(asset) = document.and_then(|document| child(document, "asset")) else { return false };
    let mut tools = children(asset, "contributor").filter_map(|contributor| child(contributor, "authoring_tool"));
    tools.any(|tool| text_of(tool).to_ascii_lowercase().contains("blender"))
}

/// Unit and axis that one `asset` element gives.
struct Local {
    unit: Option<f64>,
    axis: Option<&'static str>,
}

fn local(context: &mut Context<'_>, asset: El<'_>) -> Local {
    let mut local = Local { unit: None, axis: None };
    if let Some(element) = child(asset, "unit")
        && let Some((key, text)) = ["meter", "meters"].into_iter().find_map(|key| Some((key, element.attribute(key)?)))
    {
        match context.attribute(element, key) {
            Some(unit) if unit > 0.0 => local.unit = Some(unit),
            _ => context.report.report(element, Finding::BadUnit(super::context::shortened(text))),
        }
    }
    if let Some(element) = child(asset, "up_axis") {
        let text = text_of(element);
        local.axis = match text.trim().to_ascii_uppercase().as_str() {
            "X_UP" => Some("X_UP"),
            "Y_UP" => Some("Y_UP"),
            "Z_UP" => Some("Z_UP"),
            _ => {
                context.report.report(element, Finding::BadUpAxis(super::context::shortened(text.trim())));
                None
            }
        };
    }
    local
}

/// From the file's unit and axes to metres, Y up: Z_UP (x,y,z)→(x,z,−y), X_UP (x,y,z)→(−y,x,z).
pub(super) fn to_world(asset: &Asset) -> DMat4 {
    conversion(&asset.up_axis, asset.unit_metres)
}

fn conversion(axis: &str, unit: f64) -> DMat4 {
    let turn = match axis {
        "Z_UP" => DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
        "X_UP" => DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z),
        _ => DMat3::IDENTITY,
    };
    DMat4::from_mat3(turn * unit)
}

/// From an element's own unit and axes to those of the document, where an `asset` in it or around it says others. The unit and axis of an `asset` hold
/// for everything in the element that it stands in (COLLADA 1.4.1, `unit`), the innermost first.
pub(super) fn space<'a>(context: &mut Context<'a>, document: &Asset, element: El<'a>) -> Option<DMat4> {
    let (mut axis, mut unit) = (None, None);
    let root = context.root;
    for around in element.ancestors().take_while(|around| *around != root && around.is_element()) {
        let Some(asset) = context.asset_of(around) else { continue };
        let local = local(context, asset);
        (axis, unit) = (axis.or(local.axis), unit.or(local.unit));
    }
    let (axis, unit) = (axis.unwrap_or(&document.up_axis), unit.unwrap_or(document.unit_metres));
    (axis != document.up_axis || unit != document.unit_metres).then(|| to_world(document).inverse() * conversion(axis, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_and_unit_are_turned_into_the_world() {
        let point = DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(conversion("Y_UP", 0.01).transform_point3(point), point * 0.01);
        assert_eq!(conversion("Z_UP", 1.0).transform_point3(point), DVec3::new(1.0, 3.0, -2.0));
        assert_eq!(conversion("X_UP", 2.0).transform_point3(point), DVec3::new(-4.0, 2.0, 6.0));
    }
}
