//! Times the native build: `bench_native FILE f32|f64 < TASKS`
//!
//! FILE holds raw little-endian x y z. Each line of TASKS is a question with one exponent,
//! `EXPONENT RUNS x y z`. The answer to each line is one line of JSON, the `Outcome` of measure.ts.
//! That file explains the measurements.

use std::io::{BufRead, stdin};
use std::time::Instant;

use hidden_point_removal::{Options, PointCloud, Position, Visibility};

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [file, precision] = args.as_slice() else {
        panic!("usage: bench_native FILE f32|f64 < TASKS");
    };
    let bytes = std::fs::read(file).expect("FILE can be read");
    match precision.as_str() {
        "f32" => answer_all(&points(&bytes, f32::from_le_bytes)),
        "f64" => answer_all(&points(&bytes, f64::from_le_bytes)),
        _ => panic!("the precision is f32 or f64"),
    }
}

/// The points of a file.
fn points<T: Copy, const SIZE: usize>(bytes: &[u8], read: fn([u8; SIZE]) -> T) -> Vec<[T; 3]> {
    let at = |i: usize| read(core::array::from_fn(|byte| bytes[i * SIZE + byte]));
    (0..bytes.len() / (3 * SIZE))
        .map(|p| core::array::from_fn(|axis| at(3 * p + axis)))
        .collect()
}

fn answer_all<P: Position>(positions: &[P]) {
    for line in stdin().lock().lines() {
        let line = line.expect("TASKS can be read");
        println!("{}", outcome(positions, &line));
    }
}

fn outcome<P: Position>(positions: &[P], line: &str) -> String {
    let numbers = numbers(line);
    let [exponent, runs, x, y, z] = numbers[..] else {
        panic!("a task is EXPONENT RUNS x y z");
    };
    let options = Options::exponent(exponent);
    // As in measure.ts, the observer already holds the memory that a query needs.
    let (cloud, build) = timed(|| PointCloud::new(positions).expect("a valid cloud"));
    let mut observer = cloud.observer();
    let mut query = || {
        let view = timed(|| observer.visible_from([x, y, z], &options));
        (view.0.expect("a valid view"), view.1)
    };
    let (view, _) = query(); // Not counted.
    let cold: Vec<f64> = (0..runs as usize)
        .map(|_| {
            let (again, milliseconds) = query();
            assert!(again == view, "two queries gave different answers");
            milliseconds
        })
        .collect();
    format!(
        r#"{{"build":[{build:?}],"cold":{cold:?},"visible":{},"radius":{:?},"digest":"{}"}}"#,
        view.count(),
        view.radius(),
        digest_of(&view),
    )
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64() * 1e3)
}

fn numbers(line: &str) -> Vec<f64> {
    let numbers = line.split_whitespace();
    numbers.map(|x| x.parse().expect("a number")).collect()
}

/// FNV-1a over 32-bit words, twice with different constants; measure.ts has the same.
fn digest_of(view: &Visibility) -> String {
    let start = (0x811c_9dc5_u32, 0x9e37_79b9_u32);
    let (a, b) = view.indices().iter().fold(start, |(a, b), &index| {
        (
            (a ^ index).wrapping_mul(0x0100_0193),
            (b ^ index).wrapping_mul(0x85eb_ca6b).rotate_left(13),
        )
    });
    format!("{a:08x}{b:08x}")
}
