//! Where a texture lies that repeats, moves and turns: drawn, as glTF and as OBJ.

use std::path::{Path, PathBuf};

use crate::render_support::models::square;
use crate::render_support::{World, camera_at, plain};
use glam::{Mat4, Vec2};
use proptest::prelude::*;
use sinew::document::{Document, PoseBuffers};
use sinew::export::gltf::{self, GltfContainer};
use sinew::export::surface::SurfaceFormat;
use sinew::formats::SCENE_READERS;
use sinew::output::Output;
use sinew::progress::Progress;
use sinew::render::Renderer;
use sinew::scene::{Frame, Material, Paint, TextureTransform, WrapMode};

const PLACING: TextureTransform = TextureTransform { repeat: Vec2::new(3.0, 2.0), offset: Vec2::new(0.3, -0.2), rotation: 30.0 };

/// A square with a texture that is placed by the texture, or whose coordinates were moved beforehand.
fn world(placing: TextureTransform, wrap: WrapMode, moved: bool) -> World {
    let mut world = World::default();
    let texel = |x: u32, y: u32| [(x * 37 % 256) as u8, (y * 51 % 256) as u8, ((x ^ y) * 8 % 256) as u8, 255];
    let mut texture = world.image(32, 32, texel, wrap);
    let mut mesh = square();
    if moved {
        mesh.uv_sets[0].iter_mut().for_each(|uv| *uv = placing.matrix().transform_point2(*uv));
    } else {
        texture.transform = Some(placing);
    }
    let material =
        world.material(Material { diffuse: Paint { texture: Some(texture), ..Paint::color(1.0, 1.0, 1.0) }, ..Material::default() });
    world.place(mesh, Mat4::IDENTITY, Some(material));
    world
}

fn drawn(world: &World) -> Vec<u32> {
    world.draw(&mut Renderer::new(Some(1)), &camera_at(3.0), &plain(), [160, 160])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn a_placed_texture_is_drawn_like_one_whose_coordinates_were_moved_beforehand(
        repeat in (-4.0..4.0f32, -4.0..4.0f32), offset in (-2.0..2.0f32, -2.0..2.0f32), turn in -360.0..360.0f32, mirror in any::<bool>(),
    ) {
        let placing = TextureTransform { repeat: repeat.into(), offset: offset.into(), rotation: turn };
        let wrap = if mirror { WrapMode::Mirror } else { WrapMode::Repeat };
        prop_assert_eq!(drawn(&world(placing, wrap, false)), drawn(&world(placing, wrap, true)));
    }
}

#[test]
fn three_times_three_tiles_are_drawn() {
    let tiles = TextureTransform { repeat: Vec2::splat(3.0), ..TextureTransform::default() };
    let picture = drawn(&world(tiles, WrapMode::Repeat, false));
    assert_ne!(picture, drawn(&world(TextureTransform::default(), WrapMode::Repeat, false)));
    assert_eq!(picture, drawn(&world(tiles, WrapMode::Repeat, true)));
}

#[test]
fn colours_of_vertices_without_a_material_multiply_white() {
    let colored = |bound: bool| {
        let mut world = World::default();
        let mut mesh = square();
        mesh.colors = mesh.positions.iter().map(|p| (*p * 0.5 + glam::Vec3::splat(0.5)).extend(1.0)).collect();
        let white = world.material(Material { diffuse: Paint::color(1.0, 1.0, 1.0), ..Material::default() });
        world.place(mesh, Mat4::IDENTITY, bound.then_some(white));
        drawn(&world)
    };
    assert_eq!(colored(false), colored(true));
}

/// A square with a texture that Maya placed, and one beside it with colours of vertices and no material.
fn file(folder: &Path) -> PathBuf {
    let maya = "<extra><technique profile=\"MAYA\"><repeatU>3</repeatU><repeatV>2</repeatV><offsetU>0.3</offsetU><offsetV>-0.2</offsetV><rotateUV>30</rotateUV></technique></extra>";
    let library = format!(
        "<library_images><image id=\"i\"><init_from>i.png</init_from></image></library_images><library_effects><effect id=\"e\"><profile_COMMON><technique>\
         <lambert><diffuse><texture texture=\"i\" texcoord=\"\">{maya}</texture></diffuse></lambert></technique></profile_COMMON></effect></library_effects>\
         <library_materials><material id=\"m\"><instance_effect url=\"#e\"/></material></library_materials>"
    );
    let mesh = |id: &str, list: &str, semantic: &str| {
        let primitive = format!(
            "{list}<vertices id=\"{id}-v\"><input semantic=\"POSITION\" source=\"#{id}-p\"/></vertices><triangles material=\"s\" count=\"2\"><input semantic=\"VERTEX\" source=\"#{id}-v\" offset=\"0\"/>\
             <input semantic=\"{semantic}\" source=\"#{id}-l\" offset=\"0\"/><p>0 1 2 0 2 3</p></triangles>"
        );
        crate::build::geometry(id, "0 0 0 1 0 0 1 1 0 0 1 0", &primitive).replacen(
            &format!("<vertices id=\"{id}-v\"><input semantic=\"POSITION\" source=\"#{id}-p\"/></vertices>\n"),
            "",
            1,
        )
    };
    let square = mesh("g", &crate::build::floats("g-l", "S T", "0 0 1 0 1 1 0 1"), "TEXCOORD");
    let colored = mesh("h", &crate::build::floats("h-l", "R G B", "1 0 0 0 1 0 0 0 1 1 1 0"), "COLOR");
    let nodes = "<node><instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" target=\"#m\"/></technique_common></bind_material></instance_geometry></node>\
                 <node><translate>2 0 0</translate><instance_geometry url=\"#h\"/></node>";
    let text = crate::build::document(&(library + &crate::build::geometries(&(square + &colored)) + &crate::build::scene(nodes)));
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([10, 20, 30, 255]));
    image.save(folder.join("i.png")).expect("written");
    let file = folder.join("square.dae");
    std::fs::write(&file, text).expect("written");
    file
}

#[test]
fn gltf_gets_the_place_as_an_extension_and_white_for_colours_without_a_material() {
    let folder = tempfile::tempdir().expect("a folder");
    let document = Document::open(&[file(folder.path())], SCENE_READERS, &Progress::default()).expect("readable");
    let out = folder.path().join("out.gltf");
    gltf::save(&Output::of_program(&out), GltfContainer::Text, &document).expect("written");
    let root: serde_json::Value = serde_json::from_slice(&std::fs::read(&out).expect("there")).expect("JSON");
    assert!(root["extensionsUsed"].as_array().is_some_and(|used| used.contains(&"KHR_texture_transform".into())), "{root}");
    let place = &root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"];
    let pair = |key: &str| Vec2::new(place[key][0].as_f64().expect(key) as f32, place[key][1].as_f64().expect(key) as f32);
    let (offset, scale, turn) = (pair("offset"), pair("scale"), place["rotation"].as_f64().expect("rotation") as f32);
    for uv in [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::new(0.3, 0.8)] {
        // As the extension has it: coordinates from the upper edge, and a rotation that turns them the other way.
        let given = Vec2::new(uv.x, 1.0 - uv.y) * scale;
        let (sin, cos) = turn.sin_cos();
        let read = Vec2::new(cos * given.x + sin * given.y, cos * given.y - sin * given.x) + offset;
        let wanted = PLACING.matrix().transform_point2(uv);
        assert!(read.abs_diff_eq(Vec2::new(wanted.x, 1.0 - wanted.y), 1e-5), "{uv}: {read} is not {wanted}");
    }
    let bare = root["meshes"][1]["primitives"][0]["material"].as_u64().expect("a material") as usize;
    let surface = &root["materials"][bare]["pbrMetallicRoughness"];
    assert_eq!(
        (surface["baseColorFactor"].clone(), surface["metallicFactor"].as_f64()),
        (serde_json::json!([1.0, 1.0, 1.0, 1.0]), Some(0.0))
    );
}

#[test]
fn obj_gets_coordinates_that_are_moved() {
    let folder = tempfile::tempdir().expect("a folder");
    let document = Document::open(&[file(folder.path())], SCENE_READERS, &Progress::default()).expect("readable");
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&document.start_state(), &mut buffers, &mut frame);
    let out = folder.path().join("out.obj");
    SurfaceFormat::Obj.save(&Output::of_program(&out), &document.scene, &frame).expect("written");
    let text = std::fs::read_to_string(&out).expect("there");
    let found: Vec<Vec2> = text
        .lines()
        .filter_map(|line| {
            let mut numbers = line.strip_prefix("vt ")?.split(' ').map(|number| number.parse::<f32>().expect("a number"));
            Some(Vec2::new(numbers.next()?, numbers.next()?))
        })
        .collect();
    assert_eq!(found.len(), 4);
    for (uv, found) in [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].into_iter().zip(found) {
        assert!(found.abs_diff_eq(PLACING.matrix().transform_point2(uv), 1e-5), "{uv}: {found}");
    }
}
