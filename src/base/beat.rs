//! Signs of life during long work. Whoever waits for a worker can tell by them whether it still
//! computes. Only the bindings listen; in other builds a step does nothing.

#[cfg(feature = "wasm")]
use {core::cell::Cell, std::thread_local};

/// A step takes from about half a microsecond to some microseconds, so the listener is called every
/// few milliseconds.
#[cfg(feature = "wasm")]
const EVERY: u32 = 1024;

#[cfg(feature = "wasm")]
thread_local! {
    static LISTENER: Cell<Option<fn()>> = const { Cell::new(None) };
    static STEPS: Cell<u32> = const { Cell::new(0) };
}

/// From now on, `listener` is called again and again while anything is computed.
#[cfg(feature = "wasm")]
pub(crate) fn listen(listener: fn()) {
    LISTENER.set(Some(listener));
}

/// To be called in loops that may run for long.
#[inline(always)]
pub(crate) fn step() {
    #[cfg(feature = "wasm")]
    count(1);
}

/// The same, in a loop over indices whose steps take less than a microsecond.
#[inline(always)]
#[cfg_attr(not(feature = "wasm"), allow(unused_variables))]
pub(crate) fn step_at(index: usize) {
    #[cfg(feature = "wasm")]
    if index % 64 == 0 {
        count(64);
    }
}

/// The same, for work that takes as long as `count` steps.
#[inline(always)]
#[cfg_attr(not(feature = "wasm"), allow(unused_variables))]
pub(crate) fn steps(count: usize) {
    #[cfg(feature = "wasm")]
    self::count(count as u32);
}

#[cfg(feature = "wasm")]
#[inline(never)]
fn count(steps: u32) {
    let before = STEPS.get();
    let after = before.wrapping_add(steps);
    STEPS.set(after);
    if before / EVERY != after / EVERY {
        if let Some(listener) = LISTENER.get() {
            listener();
        }
    }
}
