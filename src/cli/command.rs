//! The tree of commands and options. Built at run time, since every text comes from the catalogue.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, Styles, TypedValueParser, ValueParser};
use clap::{Arg, ArgAction, ArgGroup, Command};

use super::arg_parsers;
use crate::tr;

/// The whole command line.
pub fn command() -> Command {
    page(
        "sinew",
        "cli-about",
        "sinew [FILE…]\n  sinew COMMAND …",
        &[("sinew", "cli-example-start"), ("sinew walk.dae biceps.yaml", "cli-example-open")],
    )
    .version(env!("CARGO_PKG_VERSION"))
    .disable_version_flag(true)
    .disable_help_subcommand(true)
    .subcommand_help_heading(tr!("cli-heading-commands"))
    .args_conflicts_with_subcommands(true)
    .arg(files("cli-arg-files").num_args(0..))
    .arg(
        Arg::new("version")
            .short('V')
            .long("version")
            .action(ArgAction::Version)
            .help(tr!("cli-arg-version"))
            .help_heading(tr!("cli-heading-options")),
    )
    .arg(help_flag())
    .subcommands(
        [info(), check(), render(), export(), convert(), measure(), fit(), attach(), bench(), completions(), help()]
            .map(|command| command.args([quiet(), verbose(), help_flag()])),
    )
}

fn info() -> Command {
    page(
        "info",
        "cli-about-info",
        "sinew info FILE [--json]",
        &[("sinew info walk.dae", "cli-example-info"), ("sinew info - --json < walk.dae", "cli-example-info-json")],
    )
    .arg(file())
    .arg(flag("json", "cli-arg-json", "cli-heading-options"))
}

fn check() -> Command {
    page(
        "check",
        "cli-about-check",
        "sinew check FILE… [--json]",
        &[("sinew check *.dae", "cli-example-check"), ("sinew check walk.dae --json", "cli-example-check-json")],
    )
    .arg(files("cli-arg-check-files").num_args(1..).required(true))
    .arg(flag("json", "cli-arg-json", "cli-heading-options"))
}

fn render() -> Command {
    let view = "cli-heading-view";
    let look = "cli-heading-appearance";
    page(
        "render",
        "cli-about-render",
        "sinew render FILE… -o OUT [OPTIONS]",
        &[
            ("sinew render walk.dae -o walk.png --time 1.5 --bones", "cli-example-render"),
            ("sinew render walk.dae -o walk.gif --size 480x480 --fps 20", "cli-example-render-gif"),
            ("sinew render walk.dae -o frame-%04d.png --from 0 --to 2 --fps 30", "cli-example-render-sequence"),
            ("sinew render biceps.yaml -o turn.gif --angle 90 --turntable", "cli-example-render-turntable"),
            ("sinew render biceps.yaml -o bend.mp4 --sweep-angle 0:130 --duration 3", "cli-example-render-sweep"),
        ],
    )
    .arg(files("cli-arg-render-files").num_args(1..).required(true))
    .arg(output("cli-arg-render-output"))
    .arg(option("size", "WxH", arg_parsers::size, "cli-arg-size", "cli-heading-output").allow_hyphen_values(true))
    .arg(number("scale", "K", arg_parsers::number_within(0.1, 16.0), "cli-arg-scale", "cli-heading-output"))
    .arg(choice("samples", &["1", "4"], "cli-arg-samples", "cli-heading-output"))
    .arg(option("background", "COLOUR", arg_parsers::backdrop, "cli-arg-background", "cli-heading-output"))
    .arg(option("threads", "N", arg_parsers::threads, "cli-arg-threads", "cli-heading-output"))
    .arg(flag("stats", "cli-arg-stats", "cli-heading-output"))
    .arg(flag("force", "cli-arg-force", "cli-heading-output"))
    .args(pose_args())
    .arg(number("from", "S", arg_parsers::number, "cli-arg-from", "cli-heading-time").conflicts_with("time"))
    .arg(number("to", "S", arg_parsers::number, "cli-arg-to", "cli-heading-time").conflicts_with("time"))
    .arg(number("duration", "S", arg_parsers::number_within(0.0, 1e6), "cli-arg-duration", "cli-heading-time").conflicts_with("to"))
    .arg(
        option("sweep-angle", "FROM:TO", arg_parsers::span(-360.0, 360.0), "cli-arg-sweep-angle", "cli-heading-time")
            .allow_hyphen_values(true)
            .conflicts_with_all(["angle", "contraction", "sweep-contraction", "from", "to"]),
    )
    .arg(
        option("sweep-contraction", "FROM:TO", arg_parsers::span(0.0, 100.0), "cli-arg-sweep-contraction", "cli-heading-time")
            .allow_hyphen_values(true)
            .conflicts_with_all(["angle", "contraction", "from", "to"]),
    )
    .arg(number("fps", "N", arg_parsers::number_within(0.01, 1000.0), "cli-arg-fps", "cli-heading-time"))
    .arg(choice("camera", &["orbit", "front", "right", "top", "iso"], "cli-arg-camera", view))
    .arg(number("yaw", "DEG", arg_parsers::number, "cli-arg-yaw", view))
    .arg(number("pitch", "DEG", arg_parsers::number_within(-90.0, 90.0), "cli-arg-pitch", view))
    .arg(number("zoom", "F", arg_parsers::number_within(0.01, 100.0), "cli-arg-zoom", view))
    .arg(flag("turntable", "cli-arg-turntable", view))
    .arg(option("light", "X,Y,Z", arg_parsers::point, "cli-arg-light", look).allow_hyphen_values(true))
    .arg(choice("shading", &["flat", "gouraud", "phong"], "cli-arg-shading", look))
    .arg(flag("bones", "cli-arg-bones", look))
    .arg(flag("wireframe", "cli-arg-wireframe", look))
    .arg(flag("grid", "cli-arg-grid", look))
    .arg(flag("axes", "cli-arg-axes", look))
    .arg(flag("bounding-box", "cli-arg-bounding-box", look))
    .arg(flag("lines-of-action", "cli-arg-lines-of-action", look))
    .arg(flag("no-materials", "cli-arg-no-materials", look))
    .arg(flag("no-normals", "cli-arg-no-normals", look))
    .arg(flag("no-see-through", "cli-arg-no-see-through", look))
}

fn export() -> Command {
    page(
        "export",
        "cli-about-export",
        "sinew export FILE -o OUT.obj [OPTIONS]",
        &[
            ("sinew export walk.dae -o walk.obj --time 1.5", "cli-example-export"),
            ("sinew export biceps.yaml -o biceps.stl --angle 90", "cli-example-export-muscle"),
        ],
    )
    .arg(file())
    .arg(output("cli-arg-export-output"))
    .arg(flag("force", "cli-arg-force", "cli-heading-output"))
    .args(pose_args())
}

fn convert() -> Command {
    page(
        "convert",
        "cli-about-convert",
        "sinew convert FILE OUT",
        &[
            ("sinew convert walk.dae walk.glb", "cli-example-convert"),
            ("sinew convert biceps.yaml biceps.gltf", "cli-example-convert-muscle"),
        ],
    )
    .arg(file())
    .arg(
        Arg::new("out")
            .value_name("OUT")
            .value_parser(clap::value_parser!(PathBuf))
            .value_hint(clap::ValueHint::FilePath)
            .required(true)
            .help(tr!("cli-arg-convert-output"))
            .help_heading(tr!("cli-heading-arguments")),
    )
    .arg(flag("force", "cli-arg-force", "cli-heading-options"))
}

fn measure() -> Command {
    let heading = "cli-heading-options";
    page(
        "measure",
        "cli-about-measure",
        "sinew measure FILE… [OPTIONS]",
        &[
            ("sinew measure biceps.yaml --angles 0,30,60,90", "cli-example-measure"),
            ("sinew measure biceps.yaml --sweep 0:120:5 --csv > biceps.csv", "cli-example-measure-csv"),
            ("sinew measure biceps.yaml --compare radii.csv", "cli-example-measure-compare"),
            ("sinew measure arm-muscles.yaml --times 0:4:0.1 --csv", "cli-example-measure-times"),
            ("sinew measure biceps.yaml --plot biceps.svg", "cli-example-measure-plot"),
            ("sinew measure biceps.yaml triceps.yaml --plot arms.svg --published", "cli-example-measure-published"),
            ("sinew measure walk.dae --joints --csv > joints.csv", "cli-example-measure-joints"),
        ],
    )
    .arg(files("cli-arg-measure-files").num_args(1..).required(true))
    .arg(option("angles", "DEG,DEG,…", arg_parsers::angles, "cli-arg-angles", heading).allow_hyphen_values(true).conflicts_with("sweep"))
    .arg(option("sweep", "FROM:TO:STEP", arg_parsers::sweep, "cli-arg-sweep", heading).allow_hyphen_values(true))
    .arg(option("joint", "NAME", clap::value_parser!(String), "cli-arg-joint", heading).conflicts_with_all(["over-time", "compare"]))
    .arg(
        option("times", "FROM:TO:STEP", arg_parsers::times, "cli-arg-times", heading)
            .allow_hyphen_values(true)
            .conflicts_with_all(["angles", "sweep", "compare"]),
    )
    .arg(flag("joints", "cli-arg-joints", heading).conflicts_with_all(["angles", "sweep", "compare"]))
    .group(ArgGroup::new("over-time").args(["times", "joints"]).multiple(true))
    .arg(option("clip", "NAME", clap::value_parser!(String), "cli-arg-clip", heading).requires("over-time"))
    .arg(
        option("compare", "CSV", clap::value_parser!(PathBuf), "cli-arg-compare", heading)
            .conflicts_with_all(["angles", "sweep"])
            .value_hint(clap::ValueHint::FilePath),
    )
    .arg(flag("csv", "cli-arg-csv", heading).conflicts_with("json"))
    .arg(flag("json", "cli-arg-json", heading))
    .arg(
        option("plot", "OUT", clap::value_parser!(PathBuf), "cli-arg-plot", heading)
            .conflicts_with("compare")
            .value_hint(clap::ValueHint::FilePath),
    )
    .arg(number("scale", "K", arg_parsers::number_within(0.1, 8.0), "cli-arg-plot-scale", heading).requires("plot"))
    .arg(flag("published", "cli-arg-published", heading).requires("plot").conflicts_with_all(["over-time", "joint"]))
    .arg(flag("force", "cli-arg-force", heading))
}

fn fit() -> Command {
    let heading = "cli-heading-options";
    page(
        "fit",
        "cli-about-fit",
        "sinew fit CSV -o OUT.yaml [OPTIONS]",
        &[
            ("sinew fit radii.csv -o muscle.yaml", "cli-example-fit"),
            ("sinew fit radii.csv -o muscle.yaml --like arm.yaml --model poses", "cli-example-fit-poses"),
        ],
    )
    .arg(files("cli-arg-fit-table").value_name("CSV").required(true))
    .arg(output("cli-arg-fit-output"))
    .arg(option("like", "FILE", clap::value_parser!(PathBuf), "cli-arg-like", heading).value_hint(clap::ValueHint::FilePath))
    .arg(choice("model", &["growth", "poses"], "cli-arg-model", heading))
    .arg(flag("force", "cli-arg-force", heading))
    .arg(flag("json", "cli-arg-json", heading))
}

fn attach() -> Command {
    let heading = "cli-heading-options";
    page(
        "attach",
        "cli-about-attach",
        "sinew attach FILE --set arm|leg|body -o OUT.yaml [OPTIONS]",
        &[
            ("sinew attach walk.dae --set leg -o walk-muscles.yaml", "cli-example-attach"),
            ("sinew attach walk.dae --set body --side left -o left.yaml", "cli-example-attach-side"),
        ],
    )
    .arg(file())
    .arg(output("cli-arg-attach-output"))
    .arg(choice("set", &["arm", "leg", "body"], "cli-arg-set", heading).required(true))
    .arg(choice("side", &["left", "right", "both"], "cli-arg-side", heading))
    .arg(flag("force", "cli-arg-force", heading))
}

fn bench() -> Command {
    let heading = "cli-heading-options";
    page(
        "bench",
        "cli-about-bench",
        "sinew bench [FILE…] [OPTIONS]",
        &[
            ("sinew bench", "cli-example-bench"),
            ("sinew bench --threads 1", "cli-example-bench-threads"),
            ("sinew bench walk.dae --scene walk", "cli-example-bench-file"),
        ],
    )
    .arg(files("cli-arg-bench-file").num_args(0..))
    .arg(option("scene", "TEXT", clap::value_parser!(String), "cli-arg-bench-scene", heading))
    .arg(option("threads", "N", arg_parsers::threads, "cli-arg-bench-threads", heading))
    .arg(number("seconds", "S", arg_parsers::number_within(0.01, 60.0), "cli-arg-seconds", heading))
    .arg(flag("json", "cli-arg-json", heading))
}

fn completions() -> Command {
    page(
        "completions",
        "cli-about-completions",
        "sinew completions SHELL",
        &[("sinew completions bash > ~/.local/share/bash-completion/completions/sinew", "cli-example-completions")],
    )
    .arg(
        Arg::new("shell")
            .value_name("bash|zsh|fish")
            .required(true)
            .value_parser(PossibleValuesParser::new(["bash", "zsh", "fish"]))
            .hide_possible_values(true)
            .help(tr!("cli-arg-shell"))
            .help_heading(tr!("cli-heading-arguments")),
    )
}

fn help() -> Command {
    page("help", "cli-about-help", "sinew help [COMMAND]", &[("sinew help render", "cli-example-help")])
        .arg(Arg::new("command").value_name("COMMAND").help(tr!("cli-arg-command")).help_heading(tr!("cli-heading-arguments")))
}

/// A command with its own page of help: what it does, how it is called, arguments, examples.
fn page(name: &'static str, about: &str, usage: &'static str, examples: &[(&str, &str)]) -> Command {
    let template = format!("{{about-with-newline}}\n{}\n  {{usage}}\n\n{{all-args}}{{after-help}}", tr!("cli-heading-usage"));
    let mut after = tr!("cli-heading-examples");
    for (call, caption) in examples {
        after.push_str(&format!("\n  {call}\n      {}", tr!(caption)));
    }
    after.push_str(&format!("\n\n{}", tr!("cli-help-closing")));
    Command::new(name)
        .about(tr!(about))
        .override_usage(usage.replace("OPTIONS", &tr!("cli-word-options")))
        .help_template(template)
        .after_help(after)
        .styles(Styles::plain())
        .max_term_width(100)
        .disable_help_flag(true)
}

/// `--help`, the last of the options on a page.
fn help_flag() -> Arg {
    Arg::new("help").short('h').long("help").action(ArgAction::Help).help(tr!("cli-arg-help")).help_heading(tr!("cli-heading-options"))
}

/// `--quiet`, on every page.
fn quiet() -> Arg {
    flag("quiet", "cli-arg-quiet", "cli-heading-options").short('q').conflicts_with("verbose")
}

/// `--verbose`, on every page.
fn verbose() -> Arg {
    flag("verbose", "cli-arg-verbose", "cli-heading-options").short('v')
}

/// The options that choose a moment, shared by `render` and `export`.
fn pose_args() -> [Arg; 6] {
    let heading = "cli-heading-time";
    [
        number("time", "S", arg_parsers::number, "cli-arg-time", heading),
        option("clip", "NAME", clap::value_parser!(String), "cli-arg-clip", heading),
        number("angle", "DEG", arg_parsers::number_within(-arg_parsers::MOST_DEGREES, arg_parsers::MOST_DEGREES), "cli-arg-angle", heading)
            .conflicts_with("contraction"),
        flag("on-top", "cli-arg-on-top", heading).requires("angle"),
        number("contraction", "PCT", arg_parsers::number_within(0.0, 100.0), "cli-arg-contraction", heading),
        flag("no-skin-follow", "cli-arg-no-skin-follow", heading),
    ]
}

fn file() -> Arg {
    files("cli-arg-file").required(true)
}

fn files(help: &str) -> Arg {
    Arg::new("file")
        .value_name("FILE")
        .value_parser(clap::value_parser!(PathBuf))
        .value_hint(clap::ValueHint::FilePath)
        .help(tr!(help))
        .help_heading(tr!("cli-heading-arguments"))
}

fn output(help: &str) -> Arg {
    Arg::new("output")
        .short('o')
        .long("output")
        .value_name("OUT")
        .value_parser(clap::value_parser!(PathBuf))
        .value_hint(clap::ValueHint::FilePath)
        .required(true)
        .help(tr!(help))
        .help_heading(tr!("cli-heading-output"))
}

fn option(id: &'static str, value: &'static str, parser: impl Into<ValueParser>, help: &str, heading: &str) -> Arg {
    // A negative number is a wrong value, not an unknown option.
    let arg = Arg::new(id).long(id).value_name(value).value_parser(parser).allow_negative_numbers(true);
    arg.help(tr!(help)).help_heading(tr!(heading))
}

/// An option with a number, which may be negative.
fn number(
    id: &'static str,
    value: &'static str,
    parser: impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static,
    help: &str,
    heading: &str,
) -> Arg {
    option(id, value, ValueParser::new(parser), help, heading).allow_hyphen_values(true)
}

fn choice(id: &'static str, choices: &'static [&'static str], help: &str, heading: &str) -> Arg {
    let parser = PossibleValuesParser::new(choices).map(|chosen: String| chosen);
    option(id, "", ValueParser::new(parser), help, heading).value_name(choices.join("|")).hide_possible_values(true)
}

fn flag(id: &'static str, help: &str, heading: &str) -> Arg {
    Arg::new(id).long(id).action(ArgAction::SetTrue).help(tr!(help)).help_heading(tr!(heading))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_is_sound_and_every_text_is_in_the_catalogue() {
        command().debug_assert();
        let mut all = command();
        all.build();
        let mut pages = vec![all.render_help().to_string()];
        pages.extend(all.get_subcommands_mut().map(|sub| sub.render_help().to_string()));
        for page in pages {
            assert!(!page.contains("cli-"), "a message is missing from the catalogue:\n{page}");
        }
    }
}
