//! Writes the visible points of a raw cloud to a file that other programs can read:
//! `cargo run --release --example visible -- FILE X,Y,Z EXPONENT OUT`
//!
//! FILE holds little-endian `f32` x y z. OUT receives the indices of the visible points,
//! ascending, as little-endian `u32`. The program prints the radius.

use std::error::Error;

use hidden_point_removal::{Options, PointCloud};

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [file, viewpoint, exponent, out] = args.as_slice() else {
        return Err("usage: visible FILE X,Y,Z EXPONENT OUT".into());
    };
    let positions: Vec<[f32; 3]> = std::fs::read(file)?
        .chunks_exact(12)
        .map(|p| {
            core::array::from_fn(|i| f32::from_le_bytes(core::array::from_fn(|b| p[4 * i + b])))
        })
        .collect();
    let viewpoint = viewpoint
        .split(',')
        .map(str::parse)
        .collect::<Result<Vec<f64>, _>>()?;
    let viewpoint: [f64; 3] = viewpoint
        .try_into()
        .map_err(|_| "three coordinates are needed")?;

    let cloud = PointCloud::new(&positions)?;
    let visible = cloud.visible_from(viewpoint, &Options::with_exponent(exponent.parse()?))?;
    let bytes: Vec<u8> = visible
        .indices()
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    std::fs::write(out, bytes)?;
    println!("{:?}", visible.radius());
    Ok(())
}
