//! One line for an answer of any kind.

use std::fmt;

use hidden_point_removal::{Exponential, Inversion, Visibility};

/// FNV-1a, 64 bits, over the bytes of 64-bit words.
pub struct Digest(u64);

impl Digest {
    pub fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub fn add(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    pub fn value(&self) -> u64 {
        self.0
    }
}

pub struct Answer {
    pub digest: u64,
    count: usize,
    radius: Option<f64>,
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{:016x} {} ", self.digest, self.count)?;
        match self.radius {
            Some(radius) => write!(f, "{:016x}", radius.to_bits()),
            None => write!(f, "-"),
        }
    }
}

/// Collects the parts of an answer: several views, a mesh, brightness.
pub struct Collector {
    digest: Digest,
    count: usize,
    radius: Option<f64>,
}

impl Collector {
    pub fn new() -> Self {
        Self {
            digest: Digest::new(),
            count: 0,
            radius: None,
        }
    }

    /// A view; the radius of the first one is shown.
    pub fn view(&mut self, view: &Visibility) {
        self.number(view.radius());
        self.number(view.exponent());
        self.digest.add(u64::from(view.evaluations()));
        match view.inversion() {
            Inversion::Spherical | Inversion::Looks(_) => {}
            Inversion::Power(gamma) => self.number(gamma),
            Inversion::Exponential(Exponential::Scale(scale)) => self.number(scale),
            other => panic!("{other:?} has no number"),
        }
        self.numbers(view.looks().iter());
        self.indices(view.indices());
        self.floats(view.scores());
        self.radius.get_or_insert(view.radius());
    }

    /// A set of points; each adds to the count.
    pub fn indices(&mut self, indices: &[u32]) {
        self.count += indices.len();
        self.list(indices.iter().map(|&i| u64::from(i)));
    }

    pub fn triangles(&mut self, triangles: &[[u32; 3]]) {
        self.list(triangles.iter().flatten().map(|&i| u64::from(i)));
    }

    /// The brightness of every point. Each point that gets any light adds to the count.
    pub fn brightness(&mut self, brightness: &[f32]) {
        self.count += brightness.iter().filter(|&&x| x > 0.0).count();
        self.floats(brightness);
    }

    fn floats(&mut self, floats: &[f32]) {
        self.list(floats.iter().map(|x| u64::from(x.to_bits())));
    }

    pub fn number(&mut self, x: f64) {
        self.digest.add(x.to_bits());
    }

    pub fn numbers<'a>(&mut self, numbers: impl Iterator<Item = &'a f64>) {
        self.list(numbers.map(|x| x.to_bits()));
    }

    pub fn finish(self) -> Answer {
        Answer {
            digest: self.digest.value(),
            count: self.count,
            radius: self.radius,
        }
    }

    fn list(&mut self, words: impl Iterator<Item = u64>) {
        words.for_each(|word| self.digest.add(word));
        self.digest.add(u64::MAX);
    }
}
