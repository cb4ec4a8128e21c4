//! The arguments, the tallies, and the code that repeats a wrong answer.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use hidden_point_removal::{Inversion, Options};

use super::common::rng::Rng;
use super::common::scenes::Scene;

/// This many wrong cases are printed in full. More are only counted.
const MOST_PRINTED: usize = 20;

pub struct Run {
    pub rng: Rng,
    start: Instant,
    end: Instant,
    /// For each kind: how many cases were tried, and how many of them were wrong.
    kinds: BTreeMap<String, [u64; 2]>,
    printed: usize,
}

impl Run {
    /// Reads `--minutes M --seed N`. Without `--seed`, the seed is the time.
    pub fn start() -> Self {
        let minutes: f64 = argument("--minutes").map_or(1.0, |x| x.parse().expect("a number"));
        let now = SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .expect("a clock");
        let seed: u64 = argument("--seed").map_or(now.as_secs(), |x| x.parse().expect("a number"));
        println!("seed {seed}, {minutes} minutes");
        // A panic counts as a wrong answer, and is reported with its scene.
        std::panic::set_hook(Box::new(|_| {}));
        let start = Instant::now();
        Self {
            rng: Rng::new(seed),
            start,
            end: start + Duration::from_secs_f64(minutes * 60.0),
            kinds: BTreeMap::new(),
            printed: 0,
        }
    }

    pub fn goes_on(&self) -> bool {
        Instant::now() < self.end
    }

    /// Counts cases of a kind that were right.
    pub fn count(&mut self, kind: &str, cases: u64) {
        self.kinds.entry(kind.to_string()).or_default()[0] += cases;
    }

    /// Counts a wrong case; returns whether it is to be printed.
    pub fn count_wrong(&mut self, kind: &str) -> bool {
        let [tried, wrong] = self.kinds.entry(kind.to_string()).or_default();
        *tried += 1;
        *wrong += 1;
        self.printed += 1;
        self.printed <= MOST_PRINTED
    }

    /// Prints the tallies, and the totals as the last line. Ends with status 1 if anything was
    /// wrong.
    pub fn finish(self) {
        let [mut tried, mut wrong] = [0; 2];
        for (kind, [of_kind, wrong_of_kind]) in &self.kinds {
            println!("{kind}: {of_kind} tried, {wrong_of_kind} wrong");
            tried += of_kind;
            wrong += wrong_of_kind;
        }
        println!("{:.0} seconds", self.start.elapsed().as_secs_f64());
        println!("{tried} tried, {wrong} wrong");
        if wrong > 0 {
            std::process::exit(1);
        }
    }
}

pub fn argument(name: &str) -> Option<String> {
    std::env::args().skip_while(|arg| arg != name).nth(1)
}

/// The result of a check. A panic is an error, too.
pub fn checked<T>(check: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(check)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| text.to_string()));
        Err(format!("panicked: {}", text.unwrap_or_default()))
    })
}

/// The scene as Rust, ready to become a fixture.
pub fn literal(scene: &Scene) -> String {
    let mut text = format!("Scene {{\n    points: vec![  // {}\n", scene.points.len());
    for p in &scene.points {
        text += &format!("        {p:?},\n");
    }
    text + &format!(
        "    ],\n    viewpoint: {:?},\n    options: {},\n}}",
        scene.viewpoint,
        options_literal(&scene.options)
    )
}

fn options_literal(options: &Options) -> String {
    let inversion = match options.inversion {
        Inversion::Exponential(scale) => format!("Exponential(Exponential::{scale:?})"),
        other => format!("{other:?}"),
    };
    format!(
        "Options::inversion(Inversion::{inversion}).with_radius(Radius::{:?})",
        options.radius
    )
}
