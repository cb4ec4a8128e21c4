//! Counts the labels that change and change back in a slow orbit:
//! `count_flicker FILE f32|f64 DISTANCE EXPONENT|automatic STEP`
//!
//! FILE and DISTANCE are as in count.rs. The orbit has [`VIEWS`] views, STEP degrees from one to the
//! next. A label flickers if a point is seen in a view and not in the views before and after it, or
//! the other way round. Once all answers are exact, and once all are drafts.

use hidden_point_removal::{Options, PointCloud, Position};

mod raw;
use raw::{orbit, points};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const VIEWS: u32 = 40;

fn main() -> Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [file, precision, distance, exponent, step] = args.as_slice() else {
        return Err("usage: count_flicker FILE f32|f64 DISTANCE EXPONENT|automatic STEP".into());
    };
    let bytes = std::fs::read(file)?;
    let options = match exponent.as_str() {
        "automatic" => Options::default(),
        exponent => Options::with_exponent(exponent.parse()?),
    };
    let (distance, step) = (distance.parse()?, step.parse()?);
    for draft in [false, true] {
        let options = Options { draft, ..options };
        let changes = match precision.as_str() {
            "f32" => count(
                &points(&bytes, f32::from_le_bytes),
                distance,
                step,
                &options,
            )?,
            "f64" => count(
                &points(&bytes, f64::from_le_bytes),
                distance,
                step,
                &options,
            )?,
            _ => return Err("the precision is f32 or f64".into()),
        };
        let Changes {
            points,
            changed,
            back,
        } = changes;
        let views = f64::from(VIEWS - 2) * points as f64;
        println!(
            "draft {draft}: {:.0} of a million labels change from a view to the next, {:.0} change back",
            1e6 * changed as f64 / views,
            1e6 * back as f64 / views,
        );
    }
    Ok(())
}

struct Changes {
    points: usize,
    /// Labels that differ from those of the view before.
    changed: usize,
    /// Labels that differ from those of the views before and after, which are equal.
    back: usize,
}

fn count<P: Position>(
    points: &[P],
    distance: f64,
    step: f64,
    options: &Options,
) -> Result<Changes> {
    let at = orbit(points, distance);
    let cloud = PointCloud::new(points)?;
    let mut observer = cloud.observer();
    let mut labels = Vec::new();
    for view in 0..VIEWS {
        let viewpoint = at(f64::from(view) * step);
        labels.push(observer.visible_from(viewpoint, options)?.mask());
    }
    let [mut changed, mut back] = [0, 0];
    for views in labels.windows(3) {
        for point in 0..points.len() {
            let [before, now, after] = [0, 1, 2].map(|view| views[view][point]);
            changed += usize::from(now != before);
            back += usize::from(now != before && now != after);
        }
    }
    Ok(Changes {
        points: points.len(),
        changed,
        back,
    })
}
