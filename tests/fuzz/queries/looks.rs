//! Several looks: neither the order nor copies nor changes nor earlier views change a bit of the scores.

use hidden_point_removal::{Inversion, Options, PointCloud, Visibility};

use super::super::common::cloud_of;
use super::super::common::rng::Rng;
use super::super::common::scenes::Scene;
use super::same;

/// The visible points, and the bits of the scores, of points in an order.
fn bits(answer: &Visibility, order: &[usize]) -> Vec<(u8, u32)> {
    let (mask, scores) = (answer.mask(), answer.scores());
    let of = |&k: &usize| (mask[k], scores[k].to_bits());
    order.iter().map(of).collect()
}

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let Scene {
        points, viewpoint, ..
    } = scene;
    let options = Options::with_inversion(Inversion::Looks(2 + rng.below(2)))
        .scores(true)
        .denoise((points.len() > 3 && rng.chance(4)).then_some(3));
    let n = points.len();
    let straight: Vec<usize> = (0..n).collect();
    let cloud = cloud_of(points, false);
    let before = match cloud.visible_from(*viewpoint, &options) {
        Ok(before) => before,
        Err(error) if error.code() == "radius" => return Ok(()),
        Err(error) => return Err(error.to_string()),
    };
    if let Some(score) = before
        .scores()
        .iter()
        .find(|score| !(0.0..=1.0).contains(*score))
    {
        return Err(format!("score {score}"));
    }
    let expected = bits(&before, &straight);
    let ask = |cloud: &PointCloud| {
        let answer = cloud.visible_from(*viewpoint, &options);
        answer.map_err(|error| error.to_string())
    };
    same(
        "without scores",
        without(&cloud, scene, &options)?,
        before.indices().to_vec(),
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
    same("shuffled", bits(&after, &back), expected.clone())?;

    // Strangers come and go. Copies come and stay, unless noise is removed: they are neighbors.
    let mut changed = cloud_of(points, false);
    let strangers: Vec<_> = (0..1 + rng.below(9)).map(|_| rng.in_ball()).collect();
    changed
        .append(&strangers)
        .map_err(|error| error.to_string())?;
    if rng.chance(2) {
        let _ = changed.visible_from(*viewpoint, &options);
    }
    let gone: Vec<u32> = (n as u32..(n + strangers.len()) as u32).collect();
    changed.remove(&gone).map_err(|error| error.to_string())?;
    same(
        "changed",
        bits(&ask(&changed)?, &straight),
        expected.clone(),
    )?;
    if options.denoise.is_none() {
        changed.append(points).map_err(|error| error.to_string())?;
        let twice = ask(&changed)?;
        same("copied", bits(&twice, &straight), expected.clone())?;
        let copies: Vec<usize> = (n + strangers.len()..changed.len()).collect();
        same("copies", bits(&twice, &copies), expected.clone())?;
    }

    let mut observer = cloud.observer();
    let aside = viewpoint.map(|x| x + 1e-3 * rng.between(-1.0, 1.0));
    let _ = observer.visible_from(aside, &Options::default());
    for _ in 0..2 {
        let again = observer.visible_from(*viewpoint, &options);
        let again = again.map_err(|error| error.to_string())?;
        same("observer", bits(&again, &straight), expected.clone())?;
    }
    Ok(())
}

fn without(cloud: &PointCloud, scene: &Scene, options: &Options) -> Result<Vec<u32>, String> {
    let options = options.scores(false);
    let answer = cloud.visible_from(scene.viewpoint, &options);
    answer
        .map(Visibility::into_indices)
        .map_err(|error| error.to_string())
}
