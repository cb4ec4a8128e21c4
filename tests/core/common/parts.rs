//! Sectors of a cloud in parts. Each asks for boxes of the rest until all of its points are decided.

use hidden_point_removal::{Inversion, Options, Radius, share_visible};

use super::ask;
use super::rng::Rng;
use super::scenes::Scene;

/// Points in a box.
const BLOCK: usize = 16;

pub type Place = [f64; 3];

/// The visible indices of one sector, and how many points it held at the end.
pub struct Asked {
    pub visible: Vec<usize>,
    pub rounds: usize,
    pub held: usize,
}

/// The box around some points.
pub fn box_of(points: &[Place], block: &[usize]) -> [Place; 2] {
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
        inversion => (whole.radius() > 0.0)
            .then(|| Options::with_inversion(inversion).radius(Radius::Absolute(whole.radius()))),
    }
}

/// Divides a scene among sectors by `sector_of` and compares with the whole. Some other points are
/// given at the start. Returns the rounds of each sector, and the points that it held.
pub fn compare(
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
pub fn octant(scene: &Scene, k: usize) -> usize {
    (0..3)
        .filter(|&axis| scene.points[k][axis] > scene.viewpoint[axis])
        .map(|axis| 1 << axis)
        .sum()
}

/// Asks for sectors of directions and for sectors by chance.
pub fn compare_both(rng: &mut Rng, mut scene: Scene, title: &str) {
    let Some(options) = numbers_of(&scene) else {
        return;
    };
    scene.options = options;
    // Equal points are always in one sector of directions, but not in one by chance. Then a sector
    // answers for its own copy only, and all agree.
    compare(rng, &scene, 8, &mut |_, k| octant(&scene, k), title);
    compare(rng, &scene, 3, &mut |rng, _| rng.below(3), title);
}
