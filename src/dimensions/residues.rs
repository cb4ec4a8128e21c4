//! Exact signs of determinants of any order. Coordinates are integers times a power of two for
//! each axis. Their determinants are computed modulo primes of 31 bits, as many as the largest
//! possible determinant needs (the Chinese remainder theorem).

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, fill, filled};
use crate::hull::Decoded;

/// Where the search for primes starts, downward. It is 3 modulo 4, and no number that coordinates
/// are likely to be multiples of.
const FIRST_CANDIDATE: u64 = 0x7a3f_91b7;

/// Points as integers, one scale for each axis.
pub(super) struct Integers {
    rows: Vec<f64>,
    rank: usize,
    /// The position of the last bit of each axis, and the number of bits from there to the first.
    lowest: Vec<usize>,
    bits: Vec<usize>,
}

impl Integers {
    pub(super) fn new(rows: Vec<f64>, rank: usize) -> Result<Self, OutOfMemory> {
        let mut lowest = filled(rank, usize::MAX)?;
        let mut bits = filled(rank, 0usize)?;
        for (i, &x) in rows.iter().enumerate().filter(|(_, x)| **x != 0.0) {
            let (axis, position) = (i % rank, parts(x).position);
            lowest[axis] = lowest[axis].min(position);
            bits[axis] = bits[axis].max(position + f64::MANTISSA_DIGITS as usize);
        }
        for (bits, lowest) in bits.iter_mut().zip(&lowest) {
            *bits = bits.saturating_sub(*lowest);
        }
        Ok(Self {
            rows,
            rank,
            lowest,
            bits,
        })
    }

    /// A coordinate of a point modulo `prime`.
    #[inline(never)]
    pub(super) fn residue(&self, point: usize, axis: usize, prime: u64) -> u64 {
        let x = self.rows[point * self.rank + axis];
        if x == 0.0 {
            return 0;
        }
        let parts = parts(x);
        let mut residue = parts.significand % prime;
        let mut shift = parts.position - self.lowest[axis];
        while shift > 0 {
            let step = shift.min(32);
            residue = times_plus(residue, 1 << step, 0, prime);
            shift -= step;
        }
        if parts.negative && residue > 0 {
            prime - residue
        } else {
            residue
        }
    }

    /// The same of the vector from `origin` to a point, or of `origin` itself.
    #[inline(never)]
    fn residue_from(&self, origin: usize, point: usize, axis: usize, prime: u64) -> u64 {
        let residue = self.residue(point, axis, prime);
        if point == origin {
            return residue;
        }
        times_plus(prime - 1, self.residue(origin, axis, prime), residue, prime)
    }
}

/// Primes below 2³¹, whose product is larger than twice the largest determinant.
#[derive(Default)]
pub(super) struct Primes {
    primes: Vec<u64>,
    /// For each prime, the inverse of the product of the primes before it.
    inverses: Vec<u64>,
    candidate: u64,
}

impl Primes {
    fn suffice_for(&mut self, integers: &Integers) -> Result<(), OutOfMemory> {
        let order = integers.rank;
        // Hadamard's bound would be smaller. Each of the order! products has a factor of each
        // axis, a difference of two coordinates. One bit more is for the sign.
        let factorial = order * (usize::BITS - order.leading_zeros()) as usize;
        let bits = integers.bits.iter().sum::<usize>() + order + factorial + 1;
        let count = bits.div_ceil(30);
        fill(&mut self.primes, count, 0)?;
        fill(&mut self.inverses, count, 1)?;
        self.candidate = FIRST_CANDIDATE;
        for number in 0..count {
            self.primes[number] = self.next();
        }
        self.invert();
        Ok(())
    }

    /// Takes another prime instead of one that divides a determinant.
    fn exchange(&mut self, number: usize) {
        self.primes[number] = self.next();
        self.invert();
    }

    fn next(&mut self) -> u64 {
        loop {
            self.candidate -= 4;
            if is_prime(self.candidate) {
                return self.candidate;
            }
        }
    }

    fn invert(&mut self) {
        for (k, &prime) in self.primes.iter().enumerate() {
            let before = self.primes[..k].iter();
            let product = before.fold(1, |product, &other| times_plus(product, other, 0, prime));
            self.inverses[k] = inverse(product, prime);
        }
    }

    /// The integer with these residues, as a share of the product of all primes; `residues` are
    /// lost. The sign is exact. The share is rounded, a few times for each prime, where it is not
    /// near the smallest f64.
    #[inline(never)]
    fn share(&self, residues: &mut [u64]) -> f64 {
        // Garner's digits, in a mixed radix whose units are the products of the first primes.
        for (k, (&prime, inverse)) in self.primes.iter().zip(&self.inverses).enumerate() {
            let before = residues[..k].iter().zip(&self.primes).rev();
            let value = before.fold(0, |value, (&digit, &other)| {
                times_plus(value, other, digit, prime)
            });
            residues[k] = times_plus(residues[k] + prime - value, *inverse, 0, prime);
        }
        // The digits of half the product, rounded down, are the halves of the primes.
        let mut digits = residues.iter().zip(&self.primes).rev();
        let middle = digits.find(|(digit, prime)| **digit != **prime / 2);
        let negative = middle.is_some_and(|(digit, prime)| *digit > prime / 2);
        if residues.iter().all(|&digit| digit == 0) {
            return 0.0;
        }
        let mut share = 0.0;
        for (k, (&digit, &prime)) in residues.iter().zip(&self.primes).enumerate() {
            let digit = match negative {
                true => prime - u64::from(k > 0) - digit,
                false => digit,
            };
            share = (share + digit as f64) / prime as f64;
        }
        let share = share.max(f64::MIN_POSITIVE);
        if negative { -share } else { share }
    }
}

/// A basis of points, inverted exactly. Its vectors are the *apex*, one of the points, and the
/// differences of the others from the apex.
pub(super) struct Exact {
    integers: Integers,
    primes: Primes,
    apex: usize,
    /// The residues of the inverse times the determinant, prime by prime and column by column.
    numbers: Vec<u64>,
    /// Whether the determinant is negative.
    negative: bool,
    matrix: Vec<u64>,
    spare: Vec<u64>,
}

impl Exact {
    pub(super) fn new(integers: Integers) -> Self {
        Self {
            integers,
            primes: Primes::default(),
            apex: 0,
            numbers: Vec::new(),
            negative: false,
            matrix: Vec::new(),
            spare: Vec::new(),
        }
    }

    /// To be called before all others.
    pub(super) fn prepare(&mut self) -> Result<(), OutOfMemory> {
        self.primes.suffice_for(&self.integers)?;
        let (rank, count) = (self.integers.rank, self.primes.primes.len());
        fill(&mut self.numbers, count * rank * rank, 0)?;
        fill(&mut self.matrix, 2 * rank * rank, 0)?;
        fill(&mut self.spare, count, 0)
    }

    /// Inverts a basis. False where its vectors depend on each other, and once where a prime
    /// divides the determinant; this prime is exchanged.
    pub(super) fn invert(&mut self, basis: &[usize], apex: usize) -> bool {
        let rank = basis.len();
        let width = 2 * rank;
        self.apex = apex;
        for (k, numbers) in self.numbers.chunks_exact_mut(rank * rank).enumerate() {
            let prime = self.primes.primes[k];
            for (row, &point) in basis.iter().enumerate() {
                for axis in 0..rank {
                    let residue = self.integers.residue_from(apex, point, axis, prime);
                    self.matrix[row * width + axis] = residue;
                    self.matrix[row * width + rank + axis] = u64::from(axis == row);
                }
            }
            let determinant = eliminate(&mut self.matrix, rank, prime);
            if determinant == 0 {
                self.primes.exchange(k);
                return false;
            }
            self.spare[k] = determinant;
            for (i, number) in numbers.iter_mut().enumerate() {
                let (column, row) = (i / rank, i % rank);
                let cell = self.matrix[row * width + rank + column];
                *number = times_plus(cell, determinant, 0, prime);
            }
        }
        self.negative = self.primes.share(&mut self.spare) < 0.0;
        true
    }

    /// A number with the sign of the share of vector `column` in the vector from the apex to
    /// `point`.
    pub(super) fn share(&mut self, point: usize, column: usize) -> f64 {
        let rank = self.integers.rank;
        for (k, &prime) in self.primes.primes.iter().enumerate() {
            let cells = &self.numbers[(k * rank + column) * rank..][..rank];
            self.spare[k] = cells.iter().enumerate().fold(0, |sum, (axis, &cell)| {
                let x = self.integers.residue_from(self.apex, point, axis, prime);
                times_plus(x, cell, sum, prime)
            });
        }
        self.signed()
    }

    /// A coordinate of the plane that is 0 at all vectors of the basis except the first, where it
    /// is positive, for points whose axes have size 1. All coordinates have one positive factor, and
    /// each of them the relative error [`error`](Self::error). NaN where an f64 may lose more.
    pub(super) fn plane_at(&mut self, axis: usize) -> f64 {
        let rank = self.integers.rank;
        for (k, spare) in self.spare.iter_mut().enumerate() {
            *spare = self.numbers[k * rank * rank + axis];
        }
        let share = self.signed();
        let span = f64::from_bits((1023 + self.integers.bits[axis] as u64).min(0x7ff) << 52);
        match share.abs() {
            0.0 | 1e-290.. => share * span,
            _ => f64::NAN,
        }
    }

    pub(super) fn error(&self) -> f64 {
        self.spare.len() as f64 * 2.0 * f64::EPSILON
    }

    fn signed(&mut self) -> f64 {
        let share = self.primes.share(&mut self.spare);
        if self.negative { -share } else { share }
    }
}

/// a·b + c modulo `prime`, for a and b up to 2³². A call in a loop keeps it from being unrolled,
/// which saves bytes of the wasm.
#[inline(never)]
pub(super) fn times_plus(a: u64, b: u64, c: u64, prime: u64) -> u64 {
    (a * b + c) % prime
}

#[inline(never)]
fn parts(x: f64) -> Decoded {
    Decoded::of(x)
}

/// Turns the left half of a matrix of 2·`rank` columns into the identity, modulo `prime`, and
/// returns its determinant.
fn eliminate(matrix: &mut [u64], rank: usize, prime: u64) -> u64 {
    let width = 2 * rank;
    let mut determinant = 1;
    for pivot in 0..rank {
        let Some(row) = (pivot..rank).find(|row| matrix[row * width + pivot] != 0) else {
            return 0;
        };
        let value = matrix[row * width + pivot];
        determinant = times_plus(determinant, value, 0, prime);
        if row != pivot {
            determinant = prime - determinant;
        }
        let factor = inverse(value, prime);
        for k in 0..width {
            matrix.swap(row * width + k, pivot * width + k);
            let cell = &mut matrix[pivot * width + k];
            *cell = times_plus(*cell, factor, 0, prime);
        }
        for other in (0..rank).filter(|&other| other != pivot) {
            let times = prime - matrix[other * width + pivot];
            for k in 0..width {
                let (cell, sum) = (matrix[pivot * width + k], matrix[other * width + k]);
                matrix[other * width + k] = times_plus(times, cell, sum, prime);
            }
        }
    }
    determinant
}

/// The inverse of a number from 1 to `prime` − 1 (Euclid).
pub(super) fn inverse(number: u64, prime: u64) -> u64 {
    let (mut rest, mut next) = (prime as i64, number as i64);
    let (mut times, mut next_times) = (0, 1);
    while next != 0 {
        let quotient = rest / next;
        (rest, next) = (next, rest - quotient * next);
        (times, next_times) = (next_times, times - quotient * next_times);
    }
    times.rem_euclid(prime as i64) as u64
}

/// Miller and Rabin's test for a number below 2³¹ that is 3 modulo 4. These bases leave no doubt.
fn is_prime(number: u64) -> bool {
    [2, 3, 5, 7].iter().all(|base| {
        let mut power = 1;
        for bit in (0..u32::BITS).rev() {
            power = times_plus(power, power, 0, number);
            if (number / 2) >> bit & 1 == 1 {
                power = times_plus(power, *base, 0, number);
            }
        }
        power == 1 || power == number - 1
    })
}
