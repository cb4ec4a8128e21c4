//! Small clouds of two to seven dimensions, asked and compared with the definition.

use hidden_point_removal::{
    Error, Exponential, Inversion, Options, PointCloud, PointCloudNd, Visibility,
};

use super::rational::{flipped_as, visible_by_definition};
use super::rng::Rng;

pub const KINDS: [&str; 6] = ["ball", "lattice", "cube", "on axes", "all sizes", "line"];

/// A cloud, a viewpoint and a question.
#[derive(Debug)]
pub struct Case {
    pub kind: &'static str,
    pub rows: Vec<Vec<f64>>,
    pub viewpoint: Vec<f64>,
    pub options: Options,
}

impl Case {
    /// The viewpoint lies up to 10¹² units from a cloud of size 1, or on one of its points or
    /// very near it. One cloud of four has another unit, one of three large coordinates.
    pub fn random(rng: &mut Rng, dimension: usize, most_points: usize) -> Self {
        let kind = rng.pick(&KINDS);
        let count = 1 + rng.below(most_points);
        let mut rows: Vec<Vec<f64>> = (0..count)
            .map(|_| (0..dimension).map(|_| coordinate(rng, kind)).collect())
            .collect();
        if kind == "line" {
            for k in 2..count {
                let share = f64::from(rng.integer(-2, 2)) * 0.5;
                let along = rows[0].iter().zip(&rows[1]);
                rows[k] = along.map(|(a, b)| a + share * (b - a)).collect();
            }
        }
        if rng.chance(4) {
            rows[rng.below(count)] = rows[rng.below(count)].clone();
        }
        let distance = match rng.below(3) {
            0 => power_of_ten(rng, 0.0, 12.0),
            _ => rng.between(0.0, 4.0),
        };
        let mut viewpoint: Vec<f64> = match kind {
            "lattice" | "cube" => {
                let step = distance.round();
                (0..dimension)
                    .map(|_| f64::from(rng.integer(-2, 2)) * step)
                    .collect()
            }
            _ => (0..dimension)
                .map(|_| rng.between(-distance, distance))
                .collect(),
        };
        if rng.chance(5) {
            viewpoint = rows[rng.below(count)].clone();
            if rng.chance(2) {
                viewpoint.iter_mut().for_each(|x| *x += 1e-9 * rng.unit());
            }
        }
        let offset = if rng.chance(3) { 1e6 } else { 0.0 };
        let unit = if rng.chance(4) {
            power_of_ten(rng, -140.0, 140.0)
        } else {
            1.0
        };
        for x in rows.iter_mut().flatten().chain(&mut viewpoint) {
            *x = (*x + offset) * unit;
        }
        let options = match rng.below(6) {
            0 => Options::inversion(Inversion::Power(rng.between(1.1, 16.0))),
            1 => Options::inversion(Inversion::Exponential(Exponential::Auto)),
            2 => Options::default(),
            3 => Options::exponent(0.0),
            _ => Options::exponent(rng.between(0.0, 6.0)),
        };
        Self {
            kind,
            rows,
            viewpoint,
            options,
        }
    }

    pub fn asked(&self) -> Result<Visibility, Error> {
        /// In space; a plane is one with z = 0.
        fn fixed(row: &[f64]) -> [f64; 3] {
            core::array::from_fn(|axis| row.get(axis).copied().unwrap_or(0.0))
        }
        let Self {
            rows,
            viewpoint,
            options,
            ..
        } = self;
        match viewpoint.len() {
            2 | 3 => PointCloud::new(&rows.iter().map(|row| fixed(row)).collect::<Vec<_>>())?
                .visible_from(fixed(viewpoint), options),
            dimension => {
                PointCloudNd::new(dimension, &rows.concat())?.visible_from(viewpoint, options)
            }
        }
    }

    /// Whether the answer is that of the definition. `None` where the cloud is refused, or lies in
    /// a flat except for rounding.
    pub fn is_right(&self) -> Option<bool> {
        let answer = self.asked().ok().filter(Visibility::exact)?;
        let flipped = flipped_as(&self.rows, &self.viewpoint, &answer);
        Some(answer.indices() == visible_by_definition(&flipped))
    }
}

fn coordinate(rng: &mut Rng, kind: &str) -> f64 {
    match kind {
        "lattice" => f64::from(rng.integer(-1, 1)),
        "cube" => f64::from(rng.integer(0, 1)),
        "on axes" if !rng.chance(3) => 0.0,
        "all sizes" => rng.between(-1.0, 1.0) * power_of_ten(rng, -20.0, 3.0),
        _ => rng.between(-1.0, 1.0),
    }
}

fn power_of_ten(rng: &mut Rng, low: f64, high: f64) -> f64 {
    libm::pow(10.0, rng.between(low, high))
}
