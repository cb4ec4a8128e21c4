//! Functions with only one correct result, taken from the platform where it has them.
//! The wasm has an instruction for each; `libm` would add code of its own.

use glam::DVec3;

/// The correctly rounded square root.
pub(crate) fn square_root(x: f64) -> f64 {
    #[cfg(feature = "std")]
    {
        x.sqrt()
    }
    #[cfg(not(feature = "std"))]
    {
        libm::sqrt(x)
    }
}

/// The largest integer not above `x`.
pub(crate) fn floor(x: f64) -> f64 {
    #[cfg(feature = "std")]
    {
        x.floor()
    }
    #[cfg(not(feature = "std"))]
    {
        libm::floor(x)
    }
}

/// `f64::max` without the function call that WebAssembly makes for it; neither number may be NaN.
#[inline]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// `f64::min`, likewise.
#[inline]
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The same numbers. They are copied one by one, where WebAssembly's instruction that copies memory would take 6 ns:
/// the compiler leaves out the product only after it has chosen.
#[inline(always)]
pub(crate) fn one_by_one(v: DVec3) -> DVec3 {
    v * 1.0
}

/// From 0 at the first number to 1 at the second one; 0 for NaN.
pub(crate) fn ramp(number: f64, [start, full]: [f64; 2]) -> f64 {
    let share = (number - start) / (full - start);
    if share > 0.0 {
        smaller(share, 1.0)
    } else {
        0.0
    }
}

/// x where it is positive, else 0. WebAssembly engines make a branch of a choice between floats,
/// and no processor can guess it, so the sign bit itself clears the other bits.
#[inline]
pub(crate) fn positive_part(x: f64) -> f64 {
    let bits = x.to_bits();
    let sign = (bits as i64 >> 63) as u64;
    f64::from_bits(bits & !sign)
}

/// The largest normal power of two not above the positive number `x`, or the
/// smallest normal one.
pub(crate) fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.max(f64::MIN_POSITIVE).to_bits() & 0x7ff0_0000_0000_0000)
}

/// The square root of the largest of three squares, without a branch: numbers that are not negative
/// are in the order of their bits.
#[inline]
pub(crate) fn root_of_largest([a, b, c]: [f64; 3]) -> f64 {
    let bits = a.to_bits().max(b.to_bits()).max(c.to_bits());
    square_root(f64::from_bits(bits))
}

/// The sine and the cosine of an angle up to nine eighths of a turn. With this comparison, the compiler leaves
/// out the part of `libm` for larger angles, 1 kB of the wasm.
#[inline(never)]
pub(crate) fn sine_cosine(x: f64) -> (f64, f64) {
    let high = (x.to_bits() >> 32) as u32 & 0x7fff_ffff;
    if high > 0x401c_463b {
        return (f64::NAN, f64::NAN);
    }
    libm::sincos(x)
}
