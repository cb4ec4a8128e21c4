//! Keeps the points of an XYZ file that a viewpoint can see.
//!
//! ```text
//! cargo run --release --example filter_xyz -- cloud.xyz 0,0,5 > visible.xyz
//! ```
//!
//! Every line holds x, y, z and any further values, separated by spaces. Lines are
//! copied unchanged.

use std::error::Error;
use std::io::{BufWriter, Write};

use hidden_point_removal::{Options, PointCloud};

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let (Some(file), Some(viewpoint)) = (args.next(), args.next()) else {
        return Err("usage: filter_xyz CLOUD.xyz X,Y,Z".into());
    };
    let viewpoint = coordinates(viewpoint.split(','))?;

    let text = std::fs::read_to_string(&file).map_err(|e| format!("{file}: {e}"))?;
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .collect();
    let positions = lines
        .iter()
        .map(|line| coordinates(line.split_whitespace()).map_err(|e| format!("{e}: {line:?}")))
        .collect::<Result<Vec<_>, _>>()?;

    let cloud = PointCloud::new(&positions)?;
    let visible = cloud.visible_from(viewpoint, &Options::default())?;
    eprintln!(
        "{} of {} points are visible (R = {:.6}, exponent {:.3})",
        visible.count(),
        cloud.len(),
        visible.radius(),
        visible.exponent()
    );
    let mut out = BufWriter::new(std::io::stdout().lock());
    for &index in visible.indices() {
        writeln!(out, "{}", lines[index as usize])?;
    }
    Ok(())
}

/// The first three fields as numbers.
fn coordinates<'a>(fields: impl Iterator<Item = &'a str>) -> Result<[f64; 3], Box<dyn Error>> {
    let numbers = fields
        .take(3)
        .map(|field| field.trim().parse::<f64>())
        .collect::<Result<Vec<_>, _>>()?;
    numbers
        .try_into()
        .map_err(|_| "three coordinates are needed".into())
}
