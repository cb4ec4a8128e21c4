//! Times the native build: `cargo run --release --example bench_native -- FILE X,Y,Z EXPONENT [RUNS]`
//!
//! FILE holds raw little-endian f32 x y z. Prints one JSON line: milliseconds of
//! building the cloud and of each query, and the number of visible points.

use std::time::Instant;

use hidden_point_removal::{Options, PointCloud};

fn main() {
    let mut args = std::env::args().skip(1);
    let mut next = |what: &str| {
        args.next()
            .unwrap_or_else(|| panic!("missing argument: {what}"))
    };
    let bytes = std::fs::read(next("FILE")).expect("FILE can be read");
    let viewpoint: Vec<f64> = next("X,Y,Z")
        .split(',')
        .map(|x| x.parse().expect("a number"))
        .collect();
    let viewpoint: [f64; 3] = viewpoint.try_into().expect("three coordinates");
    let exponent: f64 = next("EXPONENT").parse().expect("a number");
    let runs: usize = args
        .next()
        .map_or(5, |runs| runs.parse().expect("a number"));

    let positions: Vec<[f32; 3]> = bytes
        .chunks_exact(12)
        .map(|p| {
            core::array::from_fn(|i| {
                f32::from_le_bytes([p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]])
            })
        })
        .collect();
    let start = Instant::now();
    let cloud = PointCloud::new(&positions).expect("a valid cloud");
    let build = start.elapsed().as_secs_f64() * 1e3;
    let options = Options::with_exponent(exponent);
    let mut visible = 0;
    let queries: Vec<f64> = (0..runs)
        .map(|_| {
            let start = Instant::now();
            visible = cloud
                .visible_from(viewpoint, &options)
                .expect("a valid view")
                .count();
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    println!(
        "{{\"points\":{},\"visible\":{visible},\"build_ms\":{build:.2},\"query_ms\":{queries:.2?}}}",
        cloud.len()
    );
}
