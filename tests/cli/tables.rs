//! `sinew measure --joints` and `--plot`: the angles of a clip's joints against what the file says, and curves of them and of muscles.

use serde_json::Value;

use crate::support::{arg, config, folder, models, sinew, sinew_ru};

/// A chain of three joints in line; the middle one turns by 90° about x from 0.5 s to 1.5 s.
fn chain() -> String {
    let end = "<matrix sid=\"transform\">1 0 0 0 0 1 0 0 0 0 1 100 0 0 0 1</matrix>";
    let column = models::column();
    assert_eq!(column.matches(end).count(), 1);
    column.replace(end, &format!("{end}<node id=\"tip-bone\" name=\"tip, end\" sid=\"tip\" type=\"JOINT\">{end}</node>"))
}

fn near(value: &Value, wanted: f64) {
    let value = value.as_f64().expect("a number");
    assert!((value - wanted).abs() < 1e-4, "{value} is not {wanted}");
}

#[test]
fn flexion_and_turn_are_those_of_the_file() {
    let folder = folder();
    let file = models::write(folder.path(), "chain.dae", &chain());
    let table = sinew(["measure", arg(&file), "--joints", "--times", "0.5:1.5:1", "--json"]).json();
    assert_eq!(table["file"], arg(&file));
    let names: Vec<&str> = table["joints"].as_array().expect("a list").iter().filter_map(|joint| joint["name"].as_str()).collect();
    assert_eq!(names, ["lower", "upper", "tip, end"]);
    let [lower, upper, tip] = [0, 1, 2].map(|joint| &table["joints"][joint]["samples"]);
    for (moment, (time, angle)) in [(0.5, 0.0), (1.5, 90.0)].into_iter().enumerate() {
        near(&upper[moment]["time"], time);
        near(&upper[moment]["flexion"], angle);
        near(&upper[moment]["turn"], angle);
        near(&upper[moment]["turn_x"], angle);
        near(&upper[moment]["turn_y"], 0.0);
        near(&upper[moment]["turn_z"], 0.0);
        for end in [lower, tip] {
            assert!(end[moment]["flexion"].is_null(), "a joint at an end has but one bone");
            near(&end[moment]["turn"], 0.0);
        }
    }
    // Without times: the whole clip, 25 times a second.
    let csv = sinew(["measure", arg(&file), "--joints", "--csv"]).well();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!((lines[0], lines.len()), ("joint,time,flexion,turn,turn_x,turn_y,turn_z", 1 + 3 * 26));
    assert!(lines[1].starts_with("lower,0.5,,0,0,0,0"), "{}", lines[1]);
    assert!(lines[53].starts_with("\"tip, end\",0.5,,"), "{}", lines[53]);
    // Programs in any language read the same.
    assert_eq!(csv, sinew_ru(["measure", arg(&file), "--joints", "--csv"]).well());
    let people = sinew_ru(["measure", arg(&file), "--joints"]).well();
    assert!(people.contains("upper") && people.contains("90,0") && people.contains("сгибание"), "{people}");
}

#[test]
fn the_elbow_of_the_demo_bends_as_its_name_says() {
    let table = sinew(["measure", arg(&config("curl.dae")), "--joints", "--json"]).json();
    let joints = table["joints"].as_array().expect("a list");
    assert!(!joints.is_empty());
    let most =
        |joint: &Value| joint["samples"].as_array().expect("a list").iter().filter_map(|row| row["flexion"].as_f64()).fold(0.0, f64::max);
    assert!(joints.iter().map(most).fold(0.0, f64::max) > 90.0);
}

#[test]
fn what_has_no_joints_or_no_time_is_told() {
    let folder = folder();
    let still = models::write(folder.path(), "cube.dae", &models::cube(""));
    assert!(sinew(["measure", arg(&still), "--joints"]).refused(2).contains("no clip"));
    assert!(sinew(["measure", arg(&config("biceps.yaml")), "--joints"]).refused(2).contains("no clip"));
    let file = models::write(folder.path(), "chain.dae", &chain());
    assert!(sinew(["measure", arg(&file), "--joints", "--clip", "jump"]).refused(2).contains("jump"));
    sinew(["measure", arg(&file), "--joints", "--angles", "0"]).refused(2);
    // A clip of a year is no table.
    let long = models::write(folder.path(), "long.dae", &chain().replace("0.5 1.5<", "0.5 31536000<"));
    assert!(sinew(["measure", arg(&long), "--joints", "--csv"]).refused(2).contains("4000000"));
}

/// Whether plots in pixels can be drawn here: they need a font of the machine.
fn has_font() -> bool {
    let folder = folder();
    let ended = sinew(["measure", arg(&config("biceps.yaml")), "--plot", arg(&folder.path().join("a.png"))]);
    if ended.code != 0 {
        crate::support::left_out_by_hand(&format!("no plots in pixels: {}", ended.err.trim_end()));
    }
    ended.code == 0
}

/// The lines of an SVG; the words.
fn read_svg(text: &str) -> (Vec<Vec<(f64, f64)>>, Vec<String>) {
    let file = roxmltree::Document::parse(text).expect("well-formed");
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let points = |text: &str| text.split(' ').filter_map(|pair| pair.split_once(',')).map(|(x, y)| (number(x), number(y))).collect();
    let lines = file.descendants().filter(|node| node.has_tag_name("polyline"));
    let lines = lines.map(|node| points(node.attribute("points").expect("points")));
    let words = file.descendants().filter(|node| node.has_tag_name("text")).filter_map(|node| node.text());
    (lines.collect(), words.map(str::to_owned).collect())
}

#[test]
fn curves_follow_the_table() {
    let folder = folder();
    let (svg, file) = (folder.path().join("a.svg"), config("biceps-measured.yaml"));
    assert_eq!(sinew(["measure", arg(&file), "--plot", arg(&svg)]).well(), "");
    let (lines, words) = read_svg(&std::fs::read_to_string(&svg).expect("there"));
    for word in ["belly, mm", "moment arm, mm", "largest radius, mm", "volume, mm³", "angle, °"] {
        assert!(words.iter().any(|found| found == word), "{word} is not in {words:?}");
    }
    let mut curves = lines.iter().filter(|points| points.len() > 50);
    let length = curves.next().expect("a curve of the length");
    let table = sinew(["measure", arg(&file), "--sweep", "0:90:90", "--json"]).json();
    let rows = &table["muscles"][0]["samples"];
    let lengths = [0, 1].map(|row| rows[row]["length"].as_f64().expect("a number"));
    assert!(lengths[1] < lengths[0] && length[0].1 < length[90].1, "what is shorter lies lower, and lower is more");
    // Straight scales: halfway between two lengths is halfway between their heights.
    let middle =
        sinew(["measure", arg(&file), "--angles", "45", "--json"]).json()["muscles"][0]["samples"][0]["length"].as_f64().expect("one");
    let part = |value: f64, ends: [f64; 2]| (value - ends[0]) / (ends[1] - ends[0]);
    assert!((part(middle, lengths) - part(length[45].1, [length[0].1, length[90].1])).abs() < 1e-3);
    assert!((part(45.0, [0.0, 90.0]) - part(length[45].0, [length[0].0, length[90].0])).abs() < 1e-3);
}

#[test]
fn plots_are_drawn_in_any_size_and_language() {
    if !has_font() {
        return;
    }
    let folder = folder();
    let png = folder.path().join("a.png");
    for (file, options) in
        [(config("curl-muscles.yaml"), &[][..]), (config("biceps.yaml"), &["--sweep", "0:90:5"]), (config("walker.dae"), &["--joints"])]
    {
        for (scale, width) in [("1", 848), ("0.1", 85), ("3", 2544)] {
            let call = [&["measure", arg(&file), "--plot", arg(&png), "--scale", scale], options].concat();
            assert_eq!(sinew_ru(call).well(), "");
            let picture = crate::support::picture::read(&png);
            assert_eq!(picture.size.0, width);
            assert!(picture.unlike(&[255, 255, 255]) > picture.bytes.len() / 3 / 200, "{scale}");
        }
    }
    // Table and plot at once.
    let csv = sinew(["measure", arg(&config("biceps.yaml")), "--plot", arg(&png), "--csv"]).well();
    assert_eq!(csv.lines().count(), 142, "a row a degree");
}

#[test]
fn moment_arms_are_drawn_over_published_ones() {
    let folder = folder();
    let svg = folder.path().join("a.svg");
    let [biceps, triceps] = ["biceps-human-wrapped.yaml", "triceps-human.yaml"].map(config);
    let call = ["measure", arg(&biceps), arg(&triceps), "--sweep", "0:130:1", "--published", "--plot", arg(&svg)];
    assert_eq!(sinew(call).well(), "");
    let (lines, words) = read_svg(&std::fs::read_to_string(&svg).expect("there"));
    for word in ["— Biceps", "- - Arm26 biceps", "○ Murray 2000", "— Triceps", "- - Arm26 triceps"] {
        assert!(words.iter().any(|found| found == word), "{word} is not in {words:?}");
    }
    assert_eq!(words.iter().filter(|word| *word == "moment arm, mm").count(), 2);
    assert!(!words.iter().any(|word| word == "belly, mm"));
    // A point a degree of each muscle, and one a ten degrees of Arm26, over the same width.
    let of = |count: usize| lines.iter().filter(|points| points.len() == count).collect::<Vec<_>>();
    assert_eq!((of(131).len(), of(14).len()), (2, 2));
    for (own, published) in of(131).into_iter().zip(of(14)) {
        assert!((own[0].0 - published[0].0).abs() < 0.1 && (own[130].0 - published[13].0).abs() < 0.1);
    }
    let other = folder.path().join("deltoid.yaml");
    let text = std::fs::read_to_string(&biceps).expect("there");
    std::fs::write(&other, text.replace("name: Biceps", "name: Deltoid")).expect("written");
    let out = folder.path().join("b.svg");
    assert!(sinew(["measure", arg(&other), "--published", "--plot", arg(&out)]).refused(2).contains("biceps"));
    sinew(["measure", arg(&biceps), "--published"]).refused(2);
    std::fs::write(&other, text.replace("unit: mm", "unit: cm")).expect("written");
    assert!(sinew(["measure", arg(&biceps), arg(&other)]).refused(2).contains("units"));
    assert!(!out.exists());
}

#[test]
fn plots_that_cannot_be_are_told() {
    let folder = folder();
    let file = config("biceps.yaml");
    let out = |name: &str| folder.path().join(name);
    assert!(sinew(["measure", arg(&file), "--plot", arg(&out("a.bmp"))]).refused(2).contains(".svg"));
    sinew(["measure", arg(&file), "--plot", arg(&out("a.png")), "--scale", "0"]).refused(2);
    sinew(["measure", arg(&file), "--scale", "2"]).refused(2);
    assert!(sinew(["measure", arg(&file), "--plot", arg(&out("no/a.svg"))]).refused(1).contains("a.svg"));
    assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 0);
}
