//! Which points of a sphere can be seen from above, and which from a ring of viewpoints?
//! `cargo run --release --example visible`

use hidden_point_removal::{Error, Options, PointCloud};

fn main() -> Result<(), Error> {
    let positions: Vec<[f64; 3]> = (0..10_000)
        .map(|i| {
            let z = 1.0 - (2 * i + 1) as f64 / 10_000.0;
            let (r, turn) = ((1.0 - z * z).sqrt(), 2.399963 * i as f64);
            [r * turn.cos(), r * turn.sin(), z]
        })
        .collect();
    let cloud = PointCloud::new(&positions)?;

    let visible = cloud.visible_from([0.0, 0.0, 5.0], &Options::default())?;
    println!("{} of {} points", visible.count(), cloud.len()); // → 4118 of 10000 points

    // A wider sphere keeps more points: R is the farthest distance times 10^exponent.
    let wide = cloud.visible_from([0.0, 0.0, 5.0], &Options::exponent(4.0))?;
    println!("{}", wide.count() > visible.count()); // → true

    // A viewpoint that is no number is refused.
    let refused = cloud.visible_from([f64::NAN, 0.0, 0.0], &Options::default());
    println!("{}", refused.is_err()); // → true
    Ok(())
}
