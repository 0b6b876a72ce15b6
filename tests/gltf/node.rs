//! Readers that run in Node: Khronos' validator and three.js.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// A folder with the readers installed.
pub(crate) struct Node {
    folder: PathBuf,
}

impl Node {
    /// Installs the readers below `target/`, once; `None`, with a word why, where Node is missing or cannot fetch them.
    pub(crate) fn install() -> Option<Self> {
        let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/gltf");
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gltf-readers");
        std::fs::create_dir_all(&folder).expect("a folder below target/");
        for name in ["package.json", "readback.mjs", "validate.mjs"] {
            std::fs::copy(here.join(name), folder.join(name)).expect("copied");
        }
        let works = |program: &str, arguments: &[&str]| {
            let run = Command::new(program).args(arguments).current_dir(&folder).output();
            run.is_ok_and(|ended| ended.status.success())
        };
        let there = |name: &str| folder.join("node_modules").join(name).is_dir();
        if !works("node", &["--version"]) {
            eprintln!("left out: Node is not installed");
            return None;
        }
        let fetch =
            ["install", "--no-package-lock", "--no-audit", "--no-fund", "--ignore-scripts", "--fetch-retries=1", "--fetch-timeout=20000"];
        let installed = ["three", "gltf-validator"].into_iter().all(there);
        if !installed && !works("npm", &fetch) {
            eprintln!("left out: npm could not fetch the readers");
            return None;
        }
        Some(Self { folder })
    }

    fn run(&self, arguments: &[&str]) -> Vec<Value> {
        let ended = Command::new("node").args(arguments).current_dir(&self.folder).output().expect("Node starts");
        let out = String::from_utf8(ended.stdout).expect("UTF-8");
        assert!(ended.status.success(), "{out}{}", String::from_utf8_lossy(&ended.stderr));
        out.lines().map(|line| serde_json::from_str(line).expect("a JSON line")).collect()
    }

    /// Holds the files against the validator, which may find nothing wrong.
    pub(crate) fn validate(&self, files: &[PathBuf]) {
        let names: Vec<&str> = files.iter().map(|file| file.to_str().expect("text")).collect();
        let rows = self.run(&[&["validate.mjs"], names.as_slice()].concat());
        assert_eq!(rows.len(), files.len());
        for row in rows {
            assert!(row["errors"] == 0 && row["warnings"] == 0, "{row}");
        }
    }

    /// Reads files with three.js and holds their surfaces against OBJ files, from which they may be as far away as each pose says. Returns how far each surface goes in [`crate::expected::directions`].
    pub(crate) fn read_back(&self, list: &Path, cases: &[Value]) -> Vec<Vec<f64>> {
        std::fs::write(list, serde_json::to_vec(cases).expect("JSON")).expect("written");
        let rows = self.run(&["readback.mjs", list.to_str().expect("text")]);
        assert_eq!(rows.len(), cases.iter().map(|case| case["poses"].as_array().map_or(0, Vec::len)).sum::<usize>());
        let poses = cases.iter().filter_map(|case| case["poses"].as_array()).flatten();
        for (row, pose) in rows.iter().zip(poses) {
            assert!(row["off"].as_f64().expect("a number") <= pose["allowed"].as_f64().expect("a number"), "{row}");
        }
        // A surface without points goes nowhere, which JSON cannot say.
        let reach = |row: &Value| row["reach"].as_array().expect("a list").iter().filter_map(Value::as_f64).collect();
        rows.iter().map(reach).collect()
    }
}
