//! All questions that a cloud can be asked.

use hidden_point_removal::{
    Inversion, Lighting, NonFinite, Options, PointCloud, Radius, Visibility, merge_visible,
    permissible_curvature, radius_bound, ring_of_viewpoints,
};

use super::answer::{Answer, Collector};
use super::clouds::Subject;
use super::options::{exponential, exponential_of, looks, with_kernel, with_rule};
use super::rng::Rng;
use super::scenes::Scene;

pub type Question = (&'static str, fn(&Subject) -> Answer);

const DIRECTION: [f64; 3] = [0.3, -0.7, 0.2];

pub const QUESTIONS: &[Question] = &[
    ("auto", |s| view(s, &Options::default())),
    ("opposite", |s| view(s, &with_rule(Radius::Opposite))),
    ("exponent_0", |s| view(s, &Options::exponent(0.0))),
    ("exponent_1.7", |s| view(s, &Options::exponent(1.7))),
    ("exponent_9", |s| view(s, &Options::exponent(9.0))),
    ("power_1.3", |s| {
        view(s, &with_kernel(Inversion::Power(1.3)))
    }),
    ("power_7.1", |s| {
        view(s, &with_kernel(Inversion::Power(7.1)))
    }),
    ("exponential", |s| view(s, &exponential())),
    ("exponential_given", |s| view(s, &exponential_of(s))),
    ("looks_2", |s| view(s, &looks(2))),
    ("looks_3", |s| view(s, &looks(3))),
    ("direction", |s| along(s, &Options::default())),
    ("direction_exponential", |s| along(s, &exponential())),
    ("single_precision", single_precision),
    ("any", |s| of_ring(s, 1)),
    ("at_least_2", |s| of_ring(s, 2)),
    ("merge", merge),
    ("walk", walk),
    ("changed", changed),
    ("reconstruct", reconstruct),
    ("illuminate", illuminate),
    ("plane", plane),
];

/// The questions whose ways through the code differ most.
pub const LARGE: &[Question] = &[
    ("auto", |s| view(s, &Options::default())),
    ("exponent_3", |s| view(s, &Options::exponent(3.0))),
    ("power_1.3", |s| {
        view(s, &with_kernel(Inversion::Power(1.3)))
    }),
    ("exponential", |s| view(s, &exponential())),
    ("looks_3", |s| view(s, &looks(3))),
    ("direction", |s| along(s, &Options::default())),
    ("single_precision", single_precision),
    ("merge", merge),
    ("walk", walk),
    ("changed", changed),
    ("reconstruct", reconstruct),
    ("plane", plane),
];

/// A scene as it is, with its own radius.
pub fn own_options(scene: &Scene) -> Answer {
    let cloud = PointCloud::new(&scene.points).expect("an acceptable cloud");
    one(&expected(
        cloud.visible_from(scene.viewpoint, &scene.options),
    ))
}

fn view(subject: &Subject, options: &Options) -> Answer {
    one(&expected(
        subject.cloud.visible_from(subject.viewpoint, options),
    ))
}

fn along(subject: &Subject, options: &Options) -> Answer {
    one(&expected(
        subject.cloud.visible_from_direction(DIRECTION, options),
    ))
}

/// The cloud in `f32`; what overflows is skipped.
fn single_precision(subject: &Subject) -> Answer {
    let points: Vec<_> = subject.points.iter().map(|p| p.map(|x| x as f32)).collect();
    let cloud = expected(PointCloud::with_non_finite(&points, NonFinite::Skip));
    one(&expected(
        cloud.visible_from(subject.viewpoint, &Options::default()),
    ))
}

fn of_ring(subject: &Subject, k: usize) -> Answer {
    let ring = ring(subject, 4);
    one(&expected(subject.cloud.visible_from_at_least(
        k,
        &ring,
        &Options::default(),
    )))
}

/// Three parts of the cloud. One point in eight is in two parts.
fn merge(subject: &Subject) -> Answer {
    let radius = expected(subject.cloud.auto_radius(subject.viewpoint, Radius::Auto)).radius;
    let mut rng = Rng::new(8);
    let mut parts = vec![(Vec::new(), Vec::new()); 3];
    for (id, &point) in (0..).zip(&subject.points) {
        for _ in 0..if rng.chance(8) { 2 } else { 1 } {
            let (positions, ids) = &mut parts[rng.below(3)];
            positions.push(point);
            ids.push(id);
        }
    }
    let parts: Vec<_> = parts.iter().map(|(p, ids)| (&p[..], &ids[..])).collect();
    let mut answer = Collector::new();
    for options in [Options::radius(radius), exponential_of(subject)] {
        answer.indices(&expected(merge_visible(
            &parts,
            subject.viewpoint,
            &options,
        )));
    }
    answer.finish()
}

/// Views that follow each other. Most of them start from the view before.
fn walk(subject: &Subject) -> Answer {
    let mut answer = Collector::new();
    let mut observer = subject.cloud.observer();
    let target = subject.target();
    for step in 0..12 {
        let part = f64::from(step) * if step < 6 { 1e-5 } else { 0.11 };
        let at = subject.viewpoint;
        let place = core::array::from_fn(|i| at[i] + (target[i] - at[i]) * part);
        answer.view(&expected(
            observer.visible_from(place, &Options::exponent(1.0)),
        ));
    }
    answer.finish()
}

/// A cloud that lost every third point and got some of them back.
fn changed(subject: &Subject) -> Answer {
    let points = &subject.points;
    let mut cloud = expected(PointCloud::new(points));
    let every_third: Vec<u32> = (0..points.len() as u32).step_by(3).collect();
    expected(cloud.remove(&every_third));
    let mut answer = Collector::new();
    answer.view(&expected(
        cloud.visible_from(subject.viewpoint, &Options::default()),
    ));
    expected(cloud.append(&points[..points.len() / 2]));
    answer.view(&expected(
        cloud.visible_from(subject.viewpoint, &Options::default()),
    ));
    answer.finish()
}

fn reconstruct(subject: &Subject) -> Answer {
    let mut answer = Collector::new();
    for (options, longest) in [
        (Options::default(), None),
        (exponential(), Some(f64::INFINITY)),
    ] {
        let mesh = expected(
            subject
                .cloud
                .reconstruct(subject.viewpoint, &options, longest),
        );
        answer.view(&mesh.visibility);
        answer.triangles(&mesh.triangles);
    }
    answer.finish()
}

fn illuminate(subject: &Subject) -> Answer {
    let (options, lights) = (Options::default(), ring(subject, 3));
    let mesh = expected(subject.cloud.reconstruct(subject.viewpoint, &options, None));
    let mut answer = Collector::new();
    for triangles in [None, Some(&mesh.triangles[..])] {
        let lighting = Lighting {
            triangles,
            smoothing: 3,
            ambient: 0.0,
        };
        answer.brightness(&expected(
            subject.cloud.illuminate(&lights, &options, &lighting),
        ));
    }
    answer.finish()
}

/// The cloud seen from above, in a plane.
fn plane(subject: &Subject) -> Answer {
    let flat = |[x, y, _]: [f64; 3]| [x, y, 0.0];
    let points: Vec<_> = subject.points.iter().map(|&p| flat(p)).collect();
    let cloud = expected(PointCloud::new(&points));
    let mut answer = Collector::new();
    for options in [Options::default(), exponential()] {
        answer.view(&expected(
            cloud.visible_from(flat(subject.viewpoint), &options),
        ));
    }
    answer.finish()
}

/// The formulas of the paper and rings, which need no cloud.
pub fn formulas() -> Answer {
    let mut rng = Rng::new(9);
    let mut answer = Collector::new();
    for _ in 0..200 {
        let (r, times) = (rng.between(0.1, 9.0), rng.between(1.0, 90.0));
        let curvature = permissible_curvature(r * times, r, rng.between(0.01, 3.1));
        answer.number(expected(curvature));
        answer.number(expected(radius_bound(
            rng.between(0.1, 9.0),
            r,
            rng.unit() + 0.1,
        )));
        let ring = expected(ring_of_viewpoints(
            rng.in_ball(),
            rng.in_ball(),
            9,
            rng.unit(),
        ));
        answer.numbers(ring.iter().flatten());
    }
    answer.finish()
}

fn ring(subject: &Subject, count: usize) -> Vec<[f64; 3]> {
    expected(ring_of_viewpoints(
        subject.viewpoint,
        subject.target(),
        count,
        0.05,
    ))
}

fn one(view: &Visibility) -> Answer {
    let mut answer = Collector::new();
    answer.view(view);
    answer.finish()
}

/// Every case is one that the crate answers.
fn expected<T>(result: Result<T, hidden_point_removal::Error>) -> T {
    result.expect("an answer")
}
