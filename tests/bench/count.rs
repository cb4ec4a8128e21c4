//! Asks the questions whose instructions are counted:
//! `count_instructions FILE f32|f64 DISTANCE EXPONENT|automatic QUESTION…`
//!
//! FILE holds raw little-endian x y z. The viewpoint is DISTANCE radii of the box's corner sphere
//! away from the center of the box, as in views.ts.
//!
//! | QUESTION | counted |
//! |---|---|
//! | `build` | the cloud is built |
//! | `cold` | a view that knows no view before it |
//! | `exponential` | the same, with an exponential flip |
//! | `looks` | the same, with three looks |
//! | `draft` | the draft of such a view |
//!
//! Only `counted` counts. Valgrind writes one file for each question:
//! `valgrind --tool=callgrind --toggle-collect='*counted*' --dump-after=count_instructions::counted`

use std::hint::black_box;
use std::time::Instant;

use hidden_point_removal::{Exponential, Inversion, Options, PointCloud, Position};

mod raw;
use raw::{orbit, points};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const USAGE: &str = "usage: count_instructions FILE f32|f64 DISTANCE EXPONENT|automatic QUESTION…";
fn main() -> Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [file, precision, distance, exponent, questions @ ..] = args.as_slice() else {
        return Err(USAGE.into());
    };
    let bytes = std::fs::read(file)?;
    let options = match exponent.as_str() {
        "automatic" => Options::default(),
        exponent => Options::with_exponent(exponent.parse()?),
    };
    let distance = distance.parse()?;
    match precision.as_str() {
        "f32" => {
            let points = points(&bytes, f32::from_le_bytes);
            ask_all(&points, distance, questions, &options)
        }
        "f64" => {
            let points = points(&bytes, f64::from_le_bytes);
            ask_all(&points, distance, questions, &options)
        }
        _ => Err(USAGE.into()),
    }
}

fn ask_all<P: Position>(
    points: &[P],
    distance: f64,
    questions: &[String],
    options: &Options,
) -> Result<()> {
    let at = orbit(points, distance);
    let cloud = PointCloud::new(points)?;
    for question in questions {
        print!("{question}: ");
        if question == "build" {
            counted(&mut || {
                black_box(PointCloud::new(points)).expect("a cloud");
            });
        } else {
            ask(&cloud, &at, question, *options)?;
        }
    }
    Ok(())
}

fn ask(
    cloud: &PointCloud,
    at: &dyn Fn(f64) -> [f64; 3],
    question: &str,
    mut options: Options,
) -> Result<()> {
    let mut observer = cloud.observer();
    match question {
        "cold" | "draft" | "exponential" | "looks" => {
            options.draft = question == "draft";
            if question == "exponential" {
                options.inversion = Inversion::Exponential(Exponential::default());
            }
            if question == "looks" {
                options.inversion = Inversion::Looks(3);
            }
            // The first view reserves memory.
            observer.visible_from(at(180.0), &options)?;
            observer.forget();
            let viewpoint = at(0.0);
            counted(&mut || {
                black_box(observer.visible_from(viewpoint, &options)).expect("a view");
            });
        }
        _ => return Err(USAGE.into()),
    }
    Ok(())
}

#[inline(never)]
fn counted(work: &mut dyn FnMut()) {
    let start = Instant::now();
    work();
    println!("{:.2} ms", start.elapsed().as_secs_f64() * 1e3);
}
