//! Work that several threads share.

/// Whether there are threads: only with `std`, and not in WebAssembly.
pub(crate) const HAS_THREADS: bool = cfg!(all(feature = "std", not(target_family = "wasm")));

/// Makes the results with the numbers below `count` in up to `threads` threads, of which the
/// caller's is one. Each thread has a state of its own and takes the next number when it is
/// free. Passes the results one at a time, in any order. Reports the refusal with the lowest
/// number, as one thread does.
pub(crate) fn deal<State, T, E: Send>(
    threads: usize,
    count: usize,
    state: &(dyn Fn() -> State + Sync),
    make: &(dyn Fn(&mut State, usize) -> Result<T, E> + Sync),
    pass: &mut (dyn FnMut(usize, T) + Send),
) -> Result<(), E> {
    #[cfg(all(feature = "std", not(target_family = "wasm")))]
    if threads.min(count) > 1 {
        return deal_out(threads.min(count), count, state, make, pass);
    }
    let _ = threads;
    let mut state = state();
    for number in 0..count {
        pass(number, make(&mut state, number)?);
    }
    Ok(())
}

#[cfg(all(feature = "std", not(target_family = "wasm")))]
fn deal_out<State, T, E: Send>(
    threads: usize,
    count: usize,
    state: &(dyn Fn() -> State + Sync),
    make: &(dyn Fn(&mut State, usize) -> Result<T, E> + Sync),
    pass: &mut (dyn FnMut(usize, T) + Send),
) -> Result<(), E> {
    use core::sync::atomic::{AtomicUsize, Ordering};
    use std::sync::{Mutex, PoisonError};
    use std::thread;

    let next = AtomicUsize::new(0);
    let refused: Option<(usize, E)> = None;
    let outcome = Mutex::new((pass, refused));
    #[cfg(feature = "stop")]
    let stop = crate::base::beat::stop();
    let work = || {
        #[cfg(feature = "stop")]
        crate::base::beat::stop_by(stop.clone());
        let mut state = state();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                return;
            }
            let made = make(&mut state, number);
            let mut outcome = outcome.lock().unwrap_or_else(PoisonError::into_inner);
            let (pass, refused) = &mut *outcome;
            match made {
                Ok(made) => pass(number, made),
                Err(error) => {
                    // All lower numbers are dealt out already.
                    next.store(count, Ordering::Relaxed);
                    if refused.as_ref().is_none_or(|(lowest, _)| number < *lowest) {
                        *refused = Some((number, error));
                    }
                }
            }
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads {
            // If the system refuses a thread, the others do its work.
            if thread::Builder::new().spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    let (_, refused) = outcome.into_inner().unwrap_or_else(PoisonError::into_inner);
    refused.map_or(Ok(()), |(_, error)| Err(error))
}

// A value that is made when it is asked for first.

/// Keeps the value with `std`. Without `std`, it is made for each question.
pub(crate) struct Once<T> {
    #[cfg(feature = "std")]
    kept: std::sync::OnceLock<T>,
    #[cfg(not(feature = "std"))]
    kept: core::marker::PhantomData<T>,
}

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self {
            kept: Default::default(),
        }
    }
}

impl<T: Clone> Once<T> {
    pub(crate) fn get<E>(&self, make: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        #[cfg(feature = "std")]
        if let Some(kept) = self.kept.get() {
            return Ok(kept.clone());
        }
        let made = make()?;
        #[cfg(feature = "std")]
        let made = self.kept.get_or_init(|| made).clone();
        Ok(made)
    }
}
