//! Consequences of the definition's answer for a cloud: other ways to ask the same question,
//! and answers that combine several views.

use hidden_point_removal::{
    Exponential, Inversion, Options, PointCloud, Radius, Visibility, merge_visible,
};

use crate::common::flip::flip_as;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::{definition, indices_of, lower, sectors};

#[derive(Clone, Copy, Debug)]
pub enum Aspect {
    /// The visible points of parts, and some other points, merged.
    Merged,
    /// Points appended in parts, others removed in between.
    Changed,
    /// The same view as a cloud of two dimensions, if it is flat.
    Planar,
    /// Several viewpoints at once.
    Union,
    /// In single precision.
    Single,
    /// Shared by threads.
    Divided,
    /// Along an axis, for small whole coordinates.
    Direction,
}

impl Aspect {
    pub const ALL: [Self; 7] = [
        Self::Merged,
        Self::Changed,
        Self::Planar,
        Self::Union,
        Self::Single,
        Self::Divided,
        Self::Direction,
    ];

    /// Whether this aspect is right, given the right `answer` to the scene and its `visible`
    /// points. `None` if the scene does not allow this aspect.
    pub fn check(
        self,
        scene: &Scene,
        answer: &Visibility,
        visible: &[bool],
        rng: &mut Rng,
    ) -> Option<Result<(), String>> {
        let expected = indices_of(visible);
        let (found, expected) = match self {
            Self::Merged => (merged(scene, answer, rng)?, expected),
            Self::Changed => (changed(scene, rng)?, expected),
            Self::Planar => planar(scene)?,
            Self::Single => (single(scene)?, expected),
            Self::Union => union(scene, visible, rng)?,
            Self::Direction => along_axis(scene, rng)?,
            Self::Divided => {
                let cloud = PointCloud::new(&scene.points).ok()?;
                let count = 2 + rng.below(5);
                let compared = sectors::compare(&cloud, scene.viewpoint, &scene.options, count);
                return Some(compared);
            }
        };
        let wrong = || format!("answered {found:?}, expected {expected:?}");
        Some((found == expected).then_some(()).ok_or_else(wrong))
    }
}

/// Options with the numbers that an answer used.
pub fn given(answer: &Visibility) -> Options {
    let inversion = answer.inversion();
    let mut options = Options::inversion(inversion);
    if !matches!(inversion, Inversion::Exponential(_)) && answer.radius() > 0.0 {
        options.radius = Radius::Absolute(answer.radius());
    }
    options
}

fn merged(scene: &Scene, answer: &Visibility, rng: &mut Rng) -> Option<Vec<u32>> {
    let options = given(answer);
    let is_given = matches!(options.radius, Radius::Absolute(_))
        || matches!(
            options.inversion,
            Inversion::Exponential(Exponential::Scale(_))
        );
    if !is_given {
        return None;
    }
    let mut parts = vec![(Vec::new(), Vec::new()); 1 + rng.below(4)];
    for (id, &point) in (0..).zip(&scene.points) {
        loop {
            let part = rng.below(parts.len());
            parts[part].0.push(point);
            parts[part].1.push(id);
            if !rng.chance(6) {
                break;
            }
        }
    }
    // Each part leaves out all or some of its hidden points.
    let keeps_some = rng.chance(2);
    for (positions, ids) in &mut parts {
        let cloud = PointCloud::new(positions).expect("an acceptable part");
        let mask = cloud
            .visible_from(scene.viewpoint, &options)
            .expect("an acceptable view of a part")
            .mask();
        let kept = |&k: &usize| mask[k] == 1 || keeps_some && rng.chance(3);
        let kept: Vec<usize> = (0..ids.len()).filter(kept).collect();
        *positions = kept.iter().map(|&k| positions[k]).collect();
        *ids = kept.iter().map(|&k| ids[k]).collect();
    }
    let parts: Vec<_> = parts.iter().map(|(p, ids)| (&p[..], &ids[..])).collect();
    Some(merge_visible(&parts, scene.viewpoint, &options).expect("parts that merge"))
}

fn changed(scene: &Scene, rng: &mut Rng) -> Option<Vec<u32>> {
    let n = scene.points.len();
    let first = rng.below(n + 1);
    let mut cloud = PointCloud::new(&scene.points[..first]).ok()?;
    // Other points come and go. They take indices, which are subtracted again below.
    let others: Vec<[f64; 3]> = (0..rng.below(4)).map(|_| rng.in_ball()).collect();
    cloud.append(&others).ok()?;
    let taken: Vec<u32> = (first as u32..(first + others.len()) as u32).collect();
    if rng.chance(2) {
        let _ = cloud.visible_from(scene.viewpoint, &scene.options);
    }
    cloud.remove(&taken).ok()?;
    cloud.append(&scene.points[first..]).ok()?;
    let answer = cloud.visible_from(scene.viewpoint, &scene.options).ok()?;
    let number = |&i: &u32| {
        if i < first as u32 {
            i
        } else {
            i - others.len() as u32
        }
    };
    Some(answer.indices().iter().map(number).collect())
}

fn planar(scene: &Scene) -> Option<(Vec<u32>, Vec<u32>)> {
    let [x, y, z] = scene.viewpoint;
    if scene.points.iter().any(|p| p[2] != z) {
        return None;
    }
    let flat: Vec<_> = scene.points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let cloud = PointCloud::new(&flat).ok()?;
    // Automatic choices depend on the plane. So this answer may differ from the scene's.
    let answer = cloud.visible_from([x, y, 0.0], &scene.options).ok()?;
    let flip = |&p: &[f64; 3]| flip_as(p, [x, y, 0.0], &answer);
    let flipped: Vec<_> = flat.iter().map(flip).collect();
    let expected = indices_of(&definition::visible(&flipped));
    Some((answer.into_indices(), expected))
}

fn single(scene: &Scene) -> Option<Vec<u32>> {
    let is_single = |x: &f64| f64::from(*x as f32) == *x;
    if !scene.points.iter().flatten().all(is_single) {
        return None;
    }
    let points: Vec<[f32; 3]> = scene.points.iter().map(|p| p.map(|x| x as f32)).collect();
    let cloud = PointCloud::new(&points).ok()?;
    let answer = cloud.visible_from(scene.viewpoint, &scene.options).ok()?;
    Some(answer.into_indices())
}

/// Points that at least a given number of viewpoints see.
fn union(scene: &Scene, visible: &[bool], rng: &mut Rng) -> Option<(Vec<u32>, Vec<u32>)> {
    let cloud = PointCloud::new(&scene.points).ok()?;
    let mut viewpoints = vec![scene.viewpoint];
    let mut counts: Vec<usize> = visible.iter().map(|&seen| usize::from(seen)).collect();
    for _ in 0..rng.below(3) {
        let nudge = rng.direction();
        let viewpoint = core::array::from_fn(|i| scene.viewpoint[i] + nudge[i].round());
        let answer = cloud.visible_from(viewpoint, &scene.options).ok()?;
        let flip = |&p: &[f64; 3]| flip_as(p, viewpoint, &answer);
        let flipped: Vec<_> = scene.points.iter().map(flip).collect();
        if !definition::has_certificates(&flipped) {
            return None;
        }
        for (count, seen) in counts.iter_mut().zip(definition::visible(&flipped)) {
            *count += usize::from(seen);
        }
        viewpoints.push(viewpoint);
    }
    let least = 1 + rng.below(viewpoints.len());
    let found = if least == 1 && rng.chance(2) {
        cloud.visible_from_any(&viewpoints, &scene.options)
    } else {
        cloud.visible_from_at_least(least, &viewpoints, &scene.options)
    };
    let expected: Vec<bool> = counts.iter().map(|&count| count >= least).collect();
    Some((found.ok()?.into_indices(), indices_of(&expected)))
}

/// The lower boundary of the lifted points, in integers: nothing rounds.
fn along_axis(scene: &Scene, rng: &mut Rng) -> Option<(Vec<u32>, Vec<u32>)> {
    const MOST: usize = 14;
    let is_small = |x: &f64| x.fract() == 0.0 && x.abs() < 1000.0;
    if scene.points.len() > MOST || !scene.points.iter().flatten().all(is_small) {
        return None;
    }
    let (axis, sign) = (rng.below(3), if rng.chance(2) { 1 } else { -1 });
    let bend = rng.pick(&[1i64, 2, 4]);
    let mut direction = [0.0; 3];
    direction[axis] = 2.5 * sign as f64;
    let lifted: Vec<[i64; 3]> = scene
        .points
        .iter()
        .map(|p| {
            let p = p.map(|x| x as i64);
            let [x, y] = [p[(axis + 1) % 3], p[(axis + 2) % 3]];
            [x, y, sign * p[axis] + bend * (x * x + y * y)]
        })
        .collect();
    let scale = Exponential::Scale(0.5 / bend as f64);
    let options = Options::inversion(Inversion::Exponential(scale));
    let cloud = PointCloud::new(&scene.points).ok()?;
    let found = cloud.visible_from_direction(direction, &options).ok()?;
    Some((found.into_indices(), indices_of(&lower::visible(&lifted))))
}
