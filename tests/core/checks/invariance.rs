//! Neither the order of the points nor copies, changes, earlier views, precision or a unit change a bit of an answer,
//! whatever was asked.

use hidden_point_removal::{
    Error, Exponential, Inversion, Options, PointCloud, Radius, Visibility,
};

use super::same;
use crate::common::cloud_of;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;

/// From a viewpoint, or along a direction.
#[derive(Clone, Copy, Debug)]
enum From {
    Viewpoint([f64; 3]),
    Direction([f64; 3]),
}

impl From {
    fn ask(self, cloud: &PointCloud, options: &Options) -> Result<Visibility, Error> {
        match self {
            Self::Viewpoint(at) => cloud.visible_from(at, options),
            Self::Direction(ahead) => cloud.visible_from_direction(ahead, options),
        }
    }

    /// The same question in another unit. A direction may have any length.
    fn times(self, unit: f64) -> Self {
        match self {
            Self::Viewpoint(at) => Self::Viewpoint(at.map(|x| x * unit)),
            Self::Direction(ahead) => Self::Direction(ahead.map(|x| x * unit)),
        }
    }
}

/// Options without absolute numbers, so that they mean the same in every unit.
fn options(rng: &mut Rng, points: usize, along: bool) -> Options {
    let radius = match rng.below(4) {
        0 if !along && points < 200 => Radius::Opposite,
        1 => Radius::Exponent(rng.pick(&[0.0, 1.0, 3.0])),
        _ => Radius::Auto,
    };
    match rng.below(7) {
        0..3 => Options::looks(2 + rng.below(2)).with_scores(true),
        3 => Options::inversion(Inversion::Exponential(Exponential::Auto)),
        4 if !along => Options::inversion(Inversion::Power(rng.between(1.1, 4.0))),
        _ => Options::default().with_radius(radius),
    }
}

/// The radius and the inversion, and for each point of an order whether it is visible, and the bits of its score.
type Bits = (u64, String, Vec<(u8, u32)>);

fn bits(answer: &Visibility, order: &[usize]) -> Bits {
    let (mask, scores) = (answer.mask(), answer.scores());
    let score = |k: usize| scores.get(k).map_or(0, |score| score.to_bits());
    let points = order.iter().map(|&k| (mask[k], score(k))).collect();
    let inversion = format!("{:?}", answer.inversion());
    (answer.radius().to_bits(), inversion, points)
}

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let points = &scene.points;
    let along = rng.chance(3);
    let from = match along {
        true => From::Direction(rng.direction()),
        false => From::Viewpoint(scene.viewpoint),
    };
    let options = options(rng, points.len(), along);
    let n = points.len();
    let straight: Vec<usize> = (0..n).collect();
    let cloud = cloud_of(points, false);
    let before = match from.ask(&cloud, &options) {
        Ok(before) => before,
        Err(error) if error.code() == "radius" => return Ok(()),
        Err(error) => return Err(error.to_string()),
    };
    let mut scores = before.scores().iter();
    if let Some(score) = scores.find(|score| !(0.0..=1.0).contains(*score)) {
        return Err(format!("score {score}"));
    }
    let expected = bits(&before, &straight);
    let title = |what: &str| format!("{what}, {from:?} with {options:?}");
    let ask = |cloud: &PointCloud| {
        let answer = from.ask(cloud, &options);
        answer.map_err(|error| title(&error.to_string()))
    };
    let plain = options.with_scores(false);
    let without = from.ask(&cloud, &plain).map(Visibility::into_indices);
    same(
        &title("without scores"),
        without,
        Ok(before.indices().to_vec()),
    )?;

    let mut order = straight.clone();
    rng.shuffle(&mut order);
    let shuffled: Vec<_> = order.iter().map(|&k| points[k]).collect();
    let mut back = vec![0; n];
    order
        .iter()
        .enumerate()
        .for_each(|(now, &then)| back[then] = now);
    let after = ask(&cloud_of(&shuffled, rng.chance(2)))?;
    same(&title("shuffled"), bits(&after, &back), expected.clone())?;

    // Strangers come and go between two parts. Copies come and stay.
    let (first, second) = points.split_at(rng.below(n + 1));
    let mut changed = cloud_of(first, false);
    let strangers: Vec<_> = (0..1 + rng.below(9)).map(|_| rng.in_ball()).collect();
    changed
        .append(&strangers)
        .map_err(|error| error.to_string())?;
    if rng.chance(2) {
        let _ = from.ask(&changed, &options);
    }
    let begin = first.len() + strangers.len();
    let gone: Vec<u32> = (first.len() as u32..begin as u32).collect();
    changed.remove(&gone).map_err(|error| error.to_string())?;
    changed.append(second).map_err(|error| error.to_string())?;
    let present: Vec<usize> = (0..first.len()).chain(begin..changed.len()).collect();
    let after = bits(&ask(&changed)?, &present);
    same(&title("changed"), after, expected.clone())?;
    changed.append(points).map_err(|error| error.to_string())?;
    let twice = ask(&changed)?;
    same(&title("copied"), bits(&twice, &present), expected.clone())?;
    let copies: Vec<usize> = (n + strangers.len()..changed.len()).collect();
    same(&title("copies"), bits(&twice, &copies), expected.clone())?;

    // Where no number leaves the range, and along a direction for any length of it.
    let numbers = points.iter().flatten().chain(&scene.viewpoint);
    let sizes: Vec<f64> = numbers.map(|x| x.abs()).filter(|x| *x > 0.0).collect();
    let are_from = |least: f64| sizes.iter().all(|size| (least..1.0 / least).contains(size));
    if are_from(1e-60) {
        let are_looks = matches!(options.inversion, Inversion::Looks(_));
        // The largest ones are near the limits of squares: products of three lengths are out of range.
        let most = if are_looks && are_from(1e-9) { 450 } else { 90 };
        let unit = 2f64.powi(rng.integer(-most, most));
        let scaled: Vec<_> = points.iter().map(|p| p.map(|x| x * unit)).collect();
        let after = from.times(unit).ask(&cloud_of(&scaled, false), &options);
        let after = after.map_err(|error| title(&error.to_string()))?;
        same(&title("in another unit"), after.indices(), before.indices())?;
        if are_looks {
            let after = bits(&after, &straight);
            same(&title("in another unit"), after, expected.clone())?;
        }
        let radius = before.radius() * unit;
        let is_spherical = options.inversion == Inversion::Spherical && !along;
        if is_spherical && after.radius() != radius {
            return Err(title(&format!("radius {}, not {radius}", after.radius())));
        }
    }

    if let From::Viewpoint(viewpoint) = from {
        let mut observer = cloud.observer();
        let aside = viewpoint.map(|x| x + 1e-3 * rng.between(-1.0, 1.0));
        let _ = observer.visible_from(aside, &Options::default());
        for _ in 0..2 {
            let again = observer.visible_from(viewpoint, &options);
            let again = again.map_err(|error| error.to_string())?;
            same(
                &title("observer"),
                bits(&again, &straight),
                expected.clone(),
            )?;
        }
    }
    Ok(())
}
