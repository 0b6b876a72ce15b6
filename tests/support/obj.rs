//! Reads the OBJ files that the program writes, and measures them.

use std::path::Path;

use glam::DVec3;

/// One group of triangles.
#[derive(Debug, Default, Clone)]
pub(crate) struct Group {
    /// Its name.
    pub name: String,
    /// Corners: position and normal.
    pub triangles: Vec<[(DVec3, DVec3); 3]>,
}

/// Reads the groups of a file; every line must be one that the program is meant to write.
pub(crate) fn read(path: &Path) -> Vec<Group> {
    let text = std::fs::read_to_string(path).expect("an OBJ file");
    let (mut points, mut normals, mut groups, mut uvs) = (Vec::new(), Vec::new(), Vec::<Group>::new(), 0);
    for line in text.lines() {
        let (kind, rest) = line.split_once(' ').expect("a kind and its values");
        match kind {
            "#" | "mtllib" | "usemtl" => {}
            "vt" => uvs += 1,
            "g" => groups.push(Group { name: rest.to_owned(), ..Group::default() }),
            "v" => points.push(vector(rest)),
            "vn" => normals.push(vector(rest)),
            "f" => {
                let corners: Vec<_> = rest
                    .split(' ')
                    .map(|corner| {
                        let number = |text: &str| text.parse::<usize>().expect("a number") - 1;
                        let (point, rest) = corner.split_once('/').expect("a//a or a/a/a");
                        let (uv, normal) = rest.split_once('/').expect("a//a or a/a/a");
                        assert!(uv.is_empty() || number(uv) < uvs, "{corner}");
                        (points[number(point)], normals[number(normal)])
                    })
                    .collect();
                let group = groups.last_mut().expect("faces stand in a group");
                group.triangles.push(corners.try_into().expect("triangles"));
            }
            other => panic!("unexpected line kind {other}"),
        }
    }
    groups
}

fn vector(text: &str) -> DVec3 {
    let numbers: Vec<f64> = text.split(' ').map(|number| number.parse().expect("a number")).collect();
    let vector = DVec3::from_array(numbers.try_into().expect("three numbers"));
    assert!(vector.is_finite(), "{text}");
    vector
}

impl Group {
    /// Lowest and highest corner.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        let points = || self.triangles.iter().flatten().map(|(point, _)| *point);
        (points().fold(DVec3::INFINITY, DVec3::min), points().fold(DVec3::NEG_INFINITY, DVec3::max))
    }

    /// Surface area, and its centroid.
    pub(crate) fn area(&self) -> (f64, DVec3) {
        let (mut area, mut moment) = (0.0, DVec3::ZERO);
        for [(a, _), (b, _), (c, _)] in &self.triangles {
            let part = (*b - *a).cross(*c - *a).length() / 2.0;
            area += part;
            moment += part * (*a + *b + *c) / 3.0;
        }
        (area, if area > 0.0 { moment / area } else { DVec3::ZERO })
    }

    /// Enclosed volume, positive where triangles are counter-clockwise seen from outside.
    pub(crate) fn volume(&self) -> f64 {
        self.triangles.iter().map(|[(a, _), (b, _), (c, _)]| a.dot(b.cross(*c)) / 6.0).sum()
    }

    /// Whether every normal is a unit vector that looks out of its triangle's side.
    pub(crate) fn normals_point_out(&self) -> bool {
        self.triangles.iter().all(|corners| {
            let [a, b, c] = corners.map(|(point, _)| point);
            let plane = (b - a).cross(c - a);
            corners.iter().all(|(_, normal)| (normal.length() - 1.0).abs() < 1e-5 && normal.dot(plane) > -1e-9)
        })
    }
}

/// All groups as one.
pub(crate) fn whole(groups: &[Group]) -> Group {
    Group { name: String::new(), triangles: groups.iter().flat_map(|group| group.triangles.clone()).collect() }
}
