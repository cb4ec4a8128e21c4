//! Sectors of a cloud in parts: each holds its own points and boxes of the rest, and asks for what is
//! missing.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use hidden_point_removal::{
    Error, Exponential, Inversion, Options, PointCloud, Radius, share_visible,
};

use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS, Scene};
use crate::common::{ask, shapes, structured};

/// Points in a box.
const BLOCK: usize = 16;

type Place = [f64; 3];

/// The visible indices of one sector, and how many points it held at the end.
struct Asked {
    visible: Vec<usize>,
    rounds: usize,
    held: usize,
}

fn box_of(points: &[Place], block: &[usize]) -> [Place; 2] {
    let corner = |best: fn(f64, f64) -> f64| {
        let coordinate = |axis: usize| block.iter().map(|&k| points[k][axis]).reduce(best).unwrap();
        [0, 1, 2].map(coordinate)
    };
    [corner(f64::min), corner(f64::max)]
}

/// Asks for one sector, and gives it the missing boxes until none is missing.
fn ask_sector(
    scene: &Scene,
    mut own: Vec<usize>,
    mut others: Vec<usize>,
    mut blocks: Vec<Vec<usize>>,
) -> Asked {
    let at = |list: &[usize]| list.iter().map(|&k| scene.points[k]).collect::<Vec<_>>();
    let mut asked = Asked {
        visible: Vec::new(),
        rounds: 0,
        held: 0,
    };
    loop {
        asked.rounds += 1;
        asked.held = asked.held.max(own.len() + others.len());
        let boxes: Vec<_> = blocks
            .iter()
            .map(|block| box_of(&scene.points, block))
            .collect();
        let share = share_visible(
            &at(&own),
            &at(&others),
            &boxes,
            scene.viewpoint,
            &scene.options,
        )
        .unwrap();
        let own_of = |list: &[u32]| list.iter().map(|&k| own[k as usize]).collect::<Vec<_>>();
        asked.visible.extend(own_of(share.visible()));
        assert_eq!(share.undecided().is_empty(), share.missing().is_empty());
        if share.missing().is_empty() {
            asked.visible.sort_unstable();
            return asked;
        }
        let undecided = own_of(share.undecided());
        let given: Vec<_> = own.iter().chain(&others).copied().collect();
        others = share.needed().iter().map(|&k| given[k as usize]).collect();
        others.retain(|k| undecided.binary_search(k).is_err());
        own = undecided;
        for &number in share.missing().iter().rev() {
            others.extend(blocks.swap_remove(number as usize));
        }
    }
}

/// The options of a view with numbers only; `None` where there is no number.
fn numbers_of(scene: &Scene) -> Option<Options> {
    let whole = ask(&scene.points, scene.viewpoint, &scene.options);
    match whole.inversion() {
        inversion @ Inversion::Exponential(_) => Some(Options::with_inversion(inversion)),
        inversion => (whole.radius() > 0.0).then(|| Options {
            radius: Radius::Absolute(whole.radius()),
            ..Options::with_inversion(inversion)
        }),
    }
}

/// Divides a scene among sectors by `sector_of` and compares with the whole. Some other points are
/// given at the start. Returns the rounds of each sector, and the points that it held.
fn compare(
    rng: &mut Rng,
    scene: &Scene,
    count: usize,
    sector_of: &mut dyn FnMut(&mut Rng, usize) -> usize,
    title: &str,
) -> Vec<Asked> {
    let n = scene.points.len();
    let mut sectors = vec![Vec::new(); count];
    for k in 0..n {
        sectors[sector_of(rng, k)].push(k);
    }
    let mut seen = Vec::new();
    let mut asked = Vec::new();
    for sector in 0..count {
        let mut others = Vec::new();
        let mut blocks = Vec::new();
        for other in (0..count).filter(|&other| other != sector) {
            for block in sectors[other].chunks(BLOCK) {
                if rng.chance(6) {
                    others.extend_from_slice(block);
                } else {
                    blocks.push(block.to_vec());
                }
            }
        }
        let one = ask_sector(scene, sectors[sector].clone(), others, blocks);
        seen.extend_from_slice(&one.visible);
        asked.push(one);
    }
    seen.sort_unstable();
    let whole = ask(&scene.points, scene.viewpoint, &scene.options);
    let whole: Vec<_> = whole.indices().iter().map(|&k| k as usize).collect();
    assert_eq!(seen, whole, "{title} in {count} sectors");
    asked
}

/// The eighth of space around the viewpoint in which a point lies.
fn octant(scene: &Scene, k: usize) -> usize {
    (0..3)
        .filter(|&axis| scene.points[k][axis] > scene.viewpoint[axis])
        .map(|axis| 1 << axis)
        .sum()
}

/// Asks for sectors of directions and for sectors by chance.
fn compare_both(rng: &mut Rng, mut scene: Scene, title: &str) {
    let Some(options) = numbers_of(&scene) else {
        return;
    };
    scene.options = options;
    // Equal points are always in one sector of directions, but not in one by chance. Then a sector
    // answers for its own copy only, and all agree.
    compare(rng, &scene, 8, &mut |_, k| octant(&scene, k), title);
    compare(rng, &scene, 3, &mut |rng, _| rng.below(3), title);
}

#[test]
fn sectors_of_every_kind_of_scene_give_the_answer_of_the_whole() {
    let mut rng = Rng::new(1);
    for kind in KINDS {
        for (seed, n) in [(1, 0), (2, 9), (3, 30), (4, 200), (5, 900)] {
            let title = format!("{} with seed {seed}", kind.name);
            compare_both(&mut rng, kind.scene(seed, n), &title);
        }
    }
}

#[test]
fn extreme_numbers_are_answered_too() {
    let mut rng = Rng::new(2);
    for kind in EXTREME {
        for seed in 1..4 {
            let title = format!("{} with seed {seed}", kind.name);
            compare_both(&mut rng, kind.scene(seed, 150), &title);
        }
    }
}

#[test]
fn viewpoints_in_planes_and_on_lines_of_points_are_answered_too() {
    let mut rng = Rng::new(3);
    for &(kind, shape) in structured::SHAPES {
        for n in [40, 300, 1200] {
            let scene = structured::scene(&mut rng, (kind, shape), n);
            let title = format!("{kind}, {n} points, {:?}", scene.options);
            compare_both(&mut rng, scene, &title);
        }
    }
}

/// The sectors of a surface need few points of other sectors, in few rounds.
#[test]
fn sectors_hold_a_part_of_the_cloud_only() {
    let mut rng = Rng::new(4);
    let mut points = shapes::bumpy(&mut rng, 20_000);
    let cell = |p: &Place| p.map(|x| (10.0 * x).floor() as i64);
    points.sort_by_key(cell);
    for options in [
        Options::with_radius(300.0),
        Options::with_inversion(Inversion::Exponential(Exponential::Scale(0.001))),
    ] {
        let viewpoint = [0.1, 0.2, 0.05];
        let scene = Scene {
            points: points.clone(),
            viewpoint,
            options,
        };
        for Asked { rounds, held, .. } in
            compare(&mut rng, &scene, 8, &mut |_, k| octant(&scene, k), "bumpy")
        {
            assert!(rounds <= 4, "{rounds} rounds");
            assert!(held < points.len() / 2, "{held} points held");
        }
    }
}

#[test]
fn single_precision_answers_like_double() {
    let points = shapes::bumpy(&mut Rng::new(5), 600);
    let single: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32)).collect();
    let wide: Vec<Place> = single.iter().map(|p| p.map(f64::from)).collect();
    let (viewpoint, options) = ([0.0, 0.5, 3.0], Options::with_radius(100.0));
    let rest = [box_of(&wide, &(300..600).collect::<Vec<_>>())];
    let share = |end| {
        let single = share_visible(
            &single[..200],
            &single[200..end],
            &rest,
            viewpoint,
            &options,
        );
        let double = share_visible(&wide[..200], &wide[200..end], &rest, viewpoint, &options);
        assert_eq!(single, double);
        single.unwrap()
    };
    assert!(!share(300).missing().is_empty());
    let cloud = PointCloud::new(&wide).unwrap();
    let whole = cloud.visible_from(viewpoint, &options).unwrap();
    let own: Vec<u32> = whole
        .indices()
        .iter()
        .copied()
        .filter(|&k| k < 200)
        .collect();
    let complete = share_visible(&wide[..200], &wide[200..], &[], viewpoint, &options).unwrap();
    assert_eq!(complete.visible(), own);
    assert_eq!(complete.needed(), whole.indices());
}

#[test]
fn bad_input_is_refused() {
    let points = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]];
    let ask = |own: &[Place], boxes: &[[Place; 2]], options: &Options| {
        share_visible(own, &points, boxes, [0.0, 0.0, 5.0], options)
    };
    let options = Options::with_radius(100.0);
    let nan = [[f64::NAN, 0.0, 0.0]];
    for bad in [
        [[f64::NAN, 0.0, 0.0], [1.0; 3]],
        [[0.0; 3], [1.0, f64::INFINITY, 1.0]],
        [[0.0, 0.0, 2.0], [1.0; 3]],
    ] {
        assert_eq!(ask(&points, &[bad], &options), Err(Error::BoundsInvalid));
    }
    assert_eq!(
        ask(&nan, &[], &options),
        Err(Error::NonFinite { count: 1, first: 0 })
    );
    assert_eq!(
        ask(&points, &[], &Options::default()),
        Err(Error::MergeRadius)
    );
    let vote = Options {
        vote: Some(1),
        ..options
    };
    assert_eq!(
        ask(&points, &[], &vote),
        Err(Error::MergeNeighbors { option: "vote" })
    );
    assert!(matches!(
        ask(&points, &[], &Options::with_radius(1.0)),
        Err(Error::RadiusTooSmall { .. })
    ));
    // Without own points nothing is asked.
    let share = ask(&[], &[[[0.0; 3], [1.0; 3]]], &options).unwrap();
    assert_eq!((share.visible().len(), share.missing().len()), (0, 0));
}
