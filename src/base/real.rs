//! Functions with only one right answer: from the platform where there is one. `libm` would
//! bring its own code for them into the wasm, which has an instruction for each.

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
