//! Signs of life during long work. Whoever waits for a worker can tell by them whether it still
//! computes, and a binding can stop it there. In other builds a step does nothing.

#[cfg(feature = "stop")]
use {
    alloc::{boxed::Box, sync::Arc},
    core::cell::RefCell,
    core::sync::atomic::{AtomicBool, Ordering},
};
#[cfg(any(feature = "wasm", feature = "stop"))]
use {core::cell::Cell, std::thread_local};

/// A step takes from about half a microsecond to some microseconds, so there is a beat every few
/// milliseconds.
#[cfg(any(feature = "wasm", feature = "stop"))]
const EVERY: u32 = 1024;

#[cfg(any(feature = "wasm", feature = "stop"))]
thread_local! {
    static STEPS: Cell<u32> = const { Cell::new(0) };
}

#[cfg(feature = "wasm")]
thread_local! {
    static LISTENER: Cell<Option<fn()>> = const { Cell::new(None) };
}

#[cfg(feature = "stop")]
thread_local! {
    static STOP: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// From now on, `listener` is called again and again while anything is computed.
#[cfg(feature = "wasm")]
pub(crate) fn listen(listener: fn()) {
    LISTENER.set(Some(listener));
}

/// With this, a thread that was stopped unwinds.
#[cfg(feature = "stop")]
pub struct Stopped;

/// From now on, this thread and those that work for it unwind with [`Stopped`], a few milliseconds
/// after the flag was set.
#[cfg(feature = "stop")]
pub fn stop_by(flag: Option<Arc<AtomicBool>>) {
    STOP.set(flag);
}

/// What stops this thread.
#[cfg(feature = "stop")]
pub fn stop() -> Option<Arc<AtomicBool>> {
    STOP.with_borrow(Clone::clone)
}

/// To be called in loops that may run for long.
#[inline(always)]
pub(crate) fn step() {
    #[cfg(any(feature = "wasm", feature = "stop"))]
    count(1);
}

/// The same, in a loop over indices whose steps take less than a microsecond.
#[inline(always)]
#[cfg_attr(not(any(feature = "wasm", feature = "stop")), allow(unused_variables))]
pub(crate) fn step_at(index: usize) {
    #[cfg(any(feature = "wasm", feature = "stop"))]
    if index % 64 == 0 {
        count(64);
    }
}

/// The same, for work that takes as long as `count` steps.
#[inline(always)]
#[cfg_attr(not(any(feature = "wasm", feature = "stop")), allow(unused_variables))]
pub(crate) fn steps(count: usize) {
    #[cfg(any(feature = "wasm", feature = "stop"))]
    self::count(count as u32);
}

#[cfg(any(feature = "wasm", feature = "stop"))]
#[inline(never)]
fn count(steps: u32) {
    let before = STEPS.get();
    let after = before.wrapping_add(steps);
    STEPS.set(after);
    if before / EVERY != after / EVERY {
        #[cfg(feature = "wasm")]
        if let Some(listener) = LISTENER.get() {
            listener();
        }
        #[cfg(feature = "stop")]
        STOP.with_borrow(|flag| {
            if flag
                .as_ref()
                .is_some_and(|flag| flag.load(Ordering::Relaxed))
            {
                std::panic::resume_unwind(Box::new(Stopped));
            }
        });
    }
}
